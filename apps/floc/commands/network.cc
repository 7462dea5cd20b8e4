#include <algorithm>
#include <memory>

#include "floc/network/carrying_structure.h"
#include "floc/tables/network_rows.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"
#include "process/repeated_warnings.h"

namespace floc {
namespace {

struct NetworkCommand {
  std::vector<std::string> files;
  NetworkTableOptions options;
  std::string unit = "mean";
  std::vector<std::string> without;  ///< groups of columns left empty: "mechanics"
  std::vector<std::string> with;     ///< further groups: "bonds", "phases"
  /// Files of the tables beside the main one; empty: none.
  std::string distributions, pressures, exponents, bond_pressures, neighbours, clusters;
  Printing printing;
};

/// Returns the options of the library, with the groups and tables that the command line selects.
NetworkTableOptions options_of(const NetworkCommand& command) {
  NetworkTableOptions options = command.options;
  options.unit = force_unit_named(command.unit);
  options.mechanics = command.without.empty();
  options.bonds.bonds = std::ranges::find(command.with, "bonds") != command.with.end();
  options.bonds.phases = std::ranges::find(command.with, "phases") != command.with.end();
  options.distributions = !command.distributions.empty();
  options.pressures = !command.pressures.empty();
  options.bonds.exponents = !command.exponents.empty();
  options.bonds.pressures = !command.bond_pressures.empty();
  options.bonds.neighbours = !command.neighbours.empty();
  options.bonds.clusters = !command.clusters.empty();
  return options;
}

void write_files(const NetworkCommand& command, const NetworkTables& tables) {
  for (const auto& [path, table] : {std::pair{&command.distributions, &tables.distributions},
                                    {&command.pressures, &tables.pressures},
                                    {&command.exponents, &tables.bonds.exponents},
                                    {&command.bond_pressures, &tables.bonds.pressures},
                                    {&command.neighbours, &tables.bonds.neighbours},
                                    {&command.clusters, &tables.bonds.clusters}})
    if (!path->empty()) write_csv(*path, *table);
}

int run_network(const NetworkCommand& command) {
  const NetworkTableOptions options = options_of(command);
  std::vector<NetworkRow> rows;
  NetworkTables side;
  const int code =
      for_each_state(command.files, [&](const std::string& file, const AnyState& any, const Remarks& remarks) {
        std::visit([&](const auto& state) { rows.push_back(network_row(file, state, options, side, remarks)); },
                   any);
        return int{kDone};
      });
  add_pooled(options, rows.size(), side, printed_remarks());
  write_files(command, side);
  print_table(to_table(network_columns(options), rows), command.printing);
  return code;
}

void add_bond_options(CommandLine app, NetworkCommand& command) {
  app.add_option(
         "--with", command.with,
         "bonds: all interactions by sign, with a class near zero, and estimates of the tensile strength; "
         "phases: how grains of positive and negative pressure are joined, compared with shuffled signs")
      .delimiter(',')
      .one_of({"bonds", "phases"});
  // The variables hold the defaults of BondTableOptions, which show_default() prints.
  app.add_option("--near-zero", command.options.bonds.near,
                 "normal forces below this are near zero, in units of F0")
      .non_negative()
      .show_default();
  app.add_option("--shuffles", command.options.bonds.phase_structure.n_shuffles,
                 "number of shuffles of the signs of the grains, a control for the phases")
      .within(PhaseOptions::kShuffles)
      .show_default();
  app.add_option("--exponents", command.exponents,
                 "file for the exponents of the distributions of forces and particle pressures, by maximum "
                 "likelihood, for each sign and for both");
  app.add_option(
      "--pressure-pdf", command.bond_pressures,
      "file for the distribution of particle pressures, in units of F0/<d>^(d-1), without adhesion of P");
  app.add_option("--pressure-bin-width", command.options.bonds.bin_width,
                 "bin width of this distribution, in that unit")
      .positive()
      .show_default();
  app.add_option("--like-neighbours", command.neighbours,
                 "file for the size of particle pressures against the share of neighbours of the same sign");
  app.add_option("--clusters", command.clusters, "file for the sizes of the connected parts of each phase");
}

}  // namespace

Command add_network(CommandLine program) {
  CommandLine app = program.add_subcommand("network",
                                           "Describe the contact networks of saved states: coordination, "
                                           "forces, particle pressures, what carries the load");
  const auto command = std::make_shared<NetworkCommand>();
  add_states_argument(app, command->files);
  // The defaults of --zero-force and --least-contacts depend on the state, so their variables begin empty.
  app.add_option("--zero-force", command->options.zero_force,
                 "normal forces below this count as zero, in units of max(F0, P a^(d-1)) [the force tolerance "
                 "of the state]")
      .non_negative();
  app.add_option("--least-contacts", command->options.least_contacts,
                 "fewest contacts above that force for a grain of the force-carrying structure [2 where a "
                 "contact carries a tangential force, else d+1]")
      .within(kLeastContacts);
  app.add_option("--pdf", command->distributions,
                 "file for distributions of normal forces (with sign), tangential forces and rolling moments, "
                 "one row per bin");
  app.add_option(
         "--unit", command->unit,
         "unit of these distributions: mean (mean size of their kind), F0 (of moments F0 a) or P (P a^(d-1))")
      .one_of({"mean", "F0", "P"})
      .show_default();
  app.add_option("--bin-width", command->options.bin_width, "bin width of these distributions, in that unit")
      .positive()
      .show_default();
  app.add_option("--particle-stress", command->pressures, "file for the pressure and stress of each grain");
  add_bond_options(app, *command);
  app.add_option(
         "--without", command->without,
         "mechanics: leave empty what needs the moduli (indeterminacy to correlation_size, hyperstaticity and "
         "n_null_modes), which takes most of the time in a large packing")
      .delimiter(',')
      .one_of({"mechanics"});
  add_printing_options(app, command->printing);
  return {app, [command] { return run_network(*command); }};
}

}  // namespace floc
