#include "floc/elasticity/chain.h"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <numbers>

#include "command.h"
#include "output.h"

namespace floc {
namespace {

struct ChainCommand {
  int n = 0;
  double R = 0.0;
  ChainStiffness k{};
  double bend = 0.0;  ///< degrees
  std::string format;
};

/// One compliance: what it is, its closed form if the chain is straight, and the network's answer.
struct ChainRow {
  std::string name;
  double formula;
  BoundedValue solved;
};

std::vector<ChainRow> chain_rows(const ChainCommand& c) {
  const SolvedChain solved = solve_chain(bent_chain(c.n, c.bend * std::numbers::pi / 180.0), c.R, c.k);
  return {{"axial", chain_axial_compliance(c.n, c.k), solved.axial},
          {"transverse", chain_transverse_compliance(c.n, c.R, c.k), solved.transverse},
          {"rolling", chain_rolling_compliance(c.n, c.k), solved.rolling},
          {"end_disk_deflection", end_disk_deflection(c.n, c.R, c.k), solved.end_disk}};
}

int run_chain(const ChainCommand& c) {
  Table table;
  table.columns = {"n", "R", "kn", "kt", "kr", "bend", "compliance", "formula", "solved", "error_bound"};
  for (const ChainRow& row : chain_rows(c)) {
    const bool resolved = row.solved.resolved();
    if (!resolved)
      std::cerr << fmt::format(
          "floc chain: {}: double precision leaves no digit of the solved network, so none is given\n",
          row.name);
    table.rows.push_back({std::int64_t{c.n}, c.R, c.k.normal, c.k.tangential, c.k.rolling, c.bend, row.name,
                          c.bend == 0.0 ? TableValue{row.formula} : TableValue{},
                          resolved ? TableValue{row.solved.value} : TableValue{},
                          resolved ? TableValue{row.solved.error} : TableValue{}});
  }
  print_table(table, c.format);
  return kDone;
}

}  // namespace

Command add_chain(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "chain", "Compute the compliances of a chain of equal disks: closed forms beside the solved network");
  const auto command = std::make_shared<ChainCommand>();
  app.add_option("--n", command->n, "number of disks").required();
  app.add_option("--R", command->R, "radius of the disks").required();
  app.add_option("--kn", command->k.normal, "K_N (force/length)").required();
  app.add_option("--kt", command->k.tangential, "K_T (force/length)").required();
  app.add_option("--kr", command->k.rolling, "K_R (force * length)").required();
  app.add_option("--bend", command->bend,
                 "degrees by which each branch is turned against the one before: the solved network alone")
      .show_default();
  add_format_option(app, command->format);
  return {app, [command] { return run_chain(*command); }};
}

}  // namespace floc
