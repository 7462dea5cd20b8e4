#include <iostream>
#include <memory>

#include "floc/tables/modes_rows.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct ModesCommand {
  std::vector<std::string> files;
  std::optional<int> count;
  Printing printing;
};

int run_modes(const ModesCommand& command) {
  std::vector<ModeRow> rows;
  const int code =
      for_each_state(command.files, [&](const std::string& file, const AnyState& any, const Remarks& remarks) {
        const std::vector<std::string> words = std::visit(
            [&](const auto& state) { return add_modes_rows(file, state, command.count, rows, remarks); }, any);
        for (const std::string& one : words) std::cerr << "floc: " << file << ": " << one << '\n';
        return int{kDone};
      });
  print_table(to_table(modes_columns(rows), rows), command.printing);
  return code;
}

}  // namespace

Command add_modes(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "modes",
      "Compute the softest eigenmodes of the stiffness matrix and the mechanisms of saved states: "
      "eigenvalue, participation ratio, coupling to strain");
  const auto command = std::make_shared<ModesCommand>();
  add_states_argument(app, command->files);
  app.add_option("--count", command->count,
                 "number of modes to compute [all modes with eigenvalues below max |F_N|/r, but at least 10 "
                 "and at most 100 modes; max |F_N|/r is the largest ratio of normal force F_N to distance r of "
                 "the centres among all contacts]")
      .positive();
  add_printing_options(app, command->printing);
  return {app, [command] { return run_modes(*command); }};
}

}  // namespace floc
