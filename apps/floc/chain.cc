#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "chain_rows.h"
#include "command.h"
#include "output.h"

namespace floc {
namespace {

int run_chain(const ChainCommand& command) {
  const std::vector<ChainRow> rows = chain_rows(command);
  for (const ChainRow& row : rows)
    if (!row.solved.resolved())
      std::cerr << fmt::format(
          "floc chain: {}: rounding in double precision leaves no digit of the solved network correct, so no "
          "value is given\n",
          row.name);
  print_table(chain_table(command, rows), command.format);
  return kDone;
}

}  // namespace

Command add_chain(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "chain", "Compute the compliances of a chain of equal disks: closed forms and the solved network");
  const auto command = std::make_shared<ChainCommand>();
  app.add_option("--n", command->n,
                 fmt::format("number of disks, {} to {}", kChainLength.least, kChainLength.most))
      .required();
  app.add_option("--R", command->R, "radius of the disks").required();
  app.add_option("--kn", command->k.normal, "K_N (force/length)").required();
  app.add_option("--kt", command->k.tangential, "K_T (force/length)").required();
  app.add_option("--kr", command->k.rolling, "K_R (force * length)").required();
  app.add_option(
         "--bend", command->bend,
         "degrees by which each branch is turned against the one before; a bent chain has no closed form")
      .show_default();
  add_format_option(app, command->format);
  return {app, [command] { return run_chain(*command); }};
}

}  // namespace floc
