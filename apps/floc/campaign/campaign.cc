#include "campaign/campaign.h"

#include <array>
#include <memory>
#include <vector>

#include "campaign/commands.h"

namespace floc {

Command add_campaign(CommandLine program) {
  CommandLine app = program.add_subcommand("campaign",
                                           "Run a scene with many values of its keys and many seeds with "
                                           "Snakemake; make tables of means and an html page");
  app.require_one_subcommand();
  using Add = Command (*)(CommandLine);
  constexpr std::array<Add, 7> kParts = {add_campaign_new, add_campaign_check,   add_campaign_plan,
                                         add_campaign_run, add_campaign_collect, add_campaign_outcome,
                                         add_campaign_page};
  auto parts = std::make_shared<std::vector<Command>>();
  for (const Add add : kParts) parts->push_back(add(app));
  return {app, [parts] {
            for (const Command& part : *parts)
              if (part.app.parsed()) return part.run();
            return static_cast<int>(kUsage);
          }};
}

}  // namespace floc
