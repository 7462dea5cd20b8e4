#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "floc/tables/chain_rows.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct ChainCommand {
  ChainOptions chain;
  Printing printing;
};

int run_chain(const ChainCommand& command) {
  const std::vector<ChainRow> rows = chain_rows(command.chain);
  for (const ChainRow& row : rows)
    if (!row.solved.resolved())
      std::cerr << fmt::format(
          "floc chain: {}: rounding in double precision leaves no digit of the solved network correct, so no "
          "value is given\n",
          row.name);
  print_table(chain_table(command.chain, rows), command.printing);
  return kDone;
}

}  // namespace

Command add_chain(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "chain", "Compute the compliances of a chain of equal disks: closed forms and the solved network");
  const auto command = std::make_shared<ChainCommand>();
  app.add_option("--n", command->chain.n,
                 fmt::format("number of disks, {} to {}", kChainLength.least, kChainLength.most))
      .required();
  app.add_option("--R", command->chain.R, "radius of the disks").required();
  app.add_option("--kn", command->chain.k.normal, "K_N (force/length)").required();
  app.add_option("--kt", command->chain.k.tangential, "K_T (force/length)").required();
  app.add_option("--kr", command->chain.k.rolling, "K_R (force * length)").required();
  app.add_option(
         "--bend", command->chain.bend,
         "degrees by which each branch is turned against the one before; a bent chain has no closed form")
      .show_default();
  add_printing_options(app, command->printing);
  return {app, [command] { return run_chain(*command); }};
}

}  // namespace floc
