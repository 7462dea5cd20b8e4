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
          "floc chain: compliance {}: rounding in double precision leaves no correct digit in the solution of "
          "the "
          "contact network, so the columns solved and error_bound are empty\n",
          row.name);
  print_table(chain_table(command.chain, rows), command.printing);
  return kDone;
}

}  // namespace

Command add_chain(CommandLine program) {
  CommandLine app = program.add_subcommand("chain",
                                           "Compute the compliances of a chain of equal disks, by closed "
                                           "formulas and by solving the contact network");
  const auto command = std::make_shared<ChainCommand>();
  app.add_option("--n", command->chain.n,
                 fmt::format("number of disks, from {} to {}", kChainLength.least, kChainLength.most))
      .required();
  app.add_option("--R", command->chain.R, "radius of the disks (length)").required();
  app.add_option("--kn", command->chain.k.normal, "normal stiffness K_N of the contacts (force/length)")
      .required();
  app.add_option("--kt", command->chain.k.tangential, "tangential stiffness K_T of the contacts (force/length)")
      .required();
  app.add_option("--kr", command->chain.k.rolling, "rolling stiffness K_R of the contacts (force * length)")
      .required();
  app.add_option("--bend", command->chain.bend,
                 "angle between successive segments of the chain, which join the centres of touching disks "
                 "(degrees); there are no closed formulas for a bent chain")
      .show_default();
  add_printing_options(app, command->printing);
  return {app, [command] { return run_chain(*command); }};
}

}  // namespace floc
