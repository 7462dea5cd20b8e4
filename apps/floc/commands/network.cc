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
  std::vector<std::string> without;  ///< groups of columns that are left empty: "mechanics"
  std::vector<std::string> with;     ///< groups of columns that are added: "bonds", "phases"
  /// Names of the csv files of the tables that are written in addition to the printed table; a table with an empty name
  /// is not written.
  std::string distributions, pressures, exponents, bond_pressures, neighbours, clusters;
  Printing printing;
};

/// Converts the command line to the options of the library: the groups of columns and the csv files to compute.
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

void write_files(const NetworkCommand& command, const NetworkTables& tables, int code) {
  for (const auto& [path, table] : {std::pair{&command.distributions, &tables.distributions},
                                    {&command.pressures, &tables.pressures},
                                    {&command.exponents, &tables.bonds.exponents},
                                    {&command.bond_pressures, &tables.bonds.pressures},
                                    {&command.neighbours, &tables.bonds.neighbours},
                                    {&command.clusters, &tables.bonds.clusters}})
    if (!path->empty()) write_csv_unless_failed(*path, *table, code);
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
  write_files(command, side, code);
  print_table(to_table(network_columns(options), rows), command.printing);
  return code;
}

void add_bond_options(CommandLine app, NetworkCommand& command) {
  app.add_option("--with", command.with,
                 "columns to add. bonds: numbers of contacts in compression, in tension and near zero force, "
                 "and estimates of the tensile strength; phases: clusters of grains with positive and with "
                 "negative particle pressure, compared with clusters after random permutations of the signs")
      .delimiter(',')
      .one_of({"bonds", "phases"});
  // The variables of the following options contain the defaults of BondTableOptions. The function show_default() adds
  // them to the help text.
  app.add_option("--near-zero", command.options.bonds.near,
                 "magnitude below which a normal force counts as near zero, in units of F0")
      .non_negative()
      .show_default();
  app.add_option("--shuffles", command.options.bonds.phase_structure.n_shuffles,
                 "for --with phases, number of random permutations of the signs of the particle pressures; the "
                 "clusters of the state are compared with the clusters after these permutations")
      .within(PhaseOptions::kShuffles)
      .show_default();
  app.add_option(
      "--exponents", command.exponents,
      "csv file to write: exponents b of exponential distributions exp(-b x), fitted by maximum likelihood to "
      "the "
      "magnitudes x of the positive, of the negative and of all normal forces and particle pressures");
  app.add_option("--pressure-pdf", command.bond_pressures,
                 "csv file to write: distribution of the particle pressures, in units of F0/<d>^(D-1) (F0: "
                 "pull-off force, <d>: mean diameter, D: dimension) or, without adhesion, of the pressure P");
  app.add_option("--pressure-bin-width", command.options.bonds.bin_width,
                 "bin width of the distribution of --pressure-pdf, in the unit of its pressures")
      .positive()
      .show_default();
  app.add_option(
      "--like-neighbours", command.neighbours,
      "csv file to write: mean magnitude of the particle pressure of grains, against the fraction of their "
      "neighbours with a pressure of the same sign");
  app.add_option("--clusters", command.clusters,
                 "csv file to write: sizes of the clusters of grains with positive and with negative pressure");
}

}  // namespace

Command add_network(CommandLine program) {
  CommandLine app = program.add_subcommand("network",
                                           "Describe the contact networks of saved states: coordination, "
                                           "forces, particle pressures, load-carrying structure");
  const auto command = std::make_shared<NetworkCommand>();
  add_states_argument(app, command->files);
  // The defaults of --zero-force and --least-contacts depend on the state, so the variables of these options are empty
  // here.
  app.add_option(
         "--zero-force", command->options.zero_force,
         "magnitude below which a normal force counts as zero, in units of max(F0, P a^(d-1)) (F0: pull-off "
         "force, P: pressure, a: largest diameter, d: dimension) [the force tolerance of the state]")
      .non_negative();
  app.add_option("--least-contacts", command->options.least_contacts,
                 "smallest number of contacts with a force above --zero-force that a grain needs to belong to "
                 "the force-carrying "
                 "structure [2 if any contact carries a tangential force, otherwise d+1 with the dimension d]")
      .within(kLeastContacts);
  app.add_option("--pdf", command->distributions,
                 "csv file to write, with one row per bin: distributions of the normal forces (with sign), of "
                 "the tangential forces and of the rolling moments");
  app.add_option("--unit", command->unit,
                 "unit of the distributions of --pdf: mean (mean magnitude of the force or moment), F0 (the "
                 "pull-off force F0, or F0 a for moments, with the largest diameter a) or P (P a^(d-1) with "
                 "the pressure P and the dimension d)")
      .one_of({"mean", "F0", "P"})
      .show_default();
  app.add_option("--bin-width", command->options.bin_width,
                 "bin width of the distributions of --pdf, in the unit given by --unit")
      .positive()
      .show_default();
  app.add_option("--particle-stress", command->pressures,
                 "csv file to write, with one row per grain: its pressure and stress");
  add_bond_options(app, *command);
  app.add_option("--without", command->without,
                 "mechanics: leave empty all columns that need the elastic response (indeterminacy to "
                 "correlation_size, hyperstaticity, n_null_modes); computing them takes most of the time in a "
                 "large packing")
      .delimiter(',')
      .one_of({"mechanics"});
  add_printing_options(app, command->printing);
  return {app, [command] { return run_network(*command); }};
}

}  // namespace floc
