#include <array>
#include <memory>
#include <vector>

#include "commands/fit/fit_commands.h"

namespace floc {

Command add_fit(CommandLine program) {
  CommandLine app = program.add_subcommand("fit", "Fit a law to the results of runs or to tables of data");
  app.require_one_subcommand();
  using AddFit = Command (*)(CommandLine);
  constexpr std::array<AddFit, 9> kFits = {add_fit_consolidation,
                                           add_fit_compression,
                                           add_fit_preconsolidation,
                                           add_fit_elastic,
                                           add_fit_moduli,
                                           add_fit_cycle,
                                           add_fit_strength,
                                           add_fit_dynamic_compaction,
                                           add_fit_force_distribution};
  auto fits = std::make_shared<std::vector<Command>>();
  for (const AddFit add : kFits) fits->push_back(add(app));
  return {app, [fits] {
            for (const Command& fit : *fits)
              if (fit.app.parsed()) return fit.run();
            return static_cast<int>(kUsage);
          }};
}

}  // namespace floc
