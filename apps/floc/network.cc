#include <memory>

#include "command.h"
#include "floc/network/carrying_structure.h"
#include "network_rows.h"
#include "output.h"

namespace floc {
namespace {

int run_network(const NetworkCommand& command) {
  std::vector<NetworkRow> rows;
  NetworkTables side;
  const int code = for_each_state(command.files, [&](const std::string& file, const AnyState& any) {
    std::visit([&](const auto& state) { rows.push_back(network_row(file, state, command, side)); }, any);
    return int{kDone};
  });
  add_pooled(command, rows.size(), side);
  if (!command.distributions.empty()) write_csv(command.distributions, side.distributions);
  if (!command.pressures.empty()) write_csv(command.pressures, side.pressures);
  write_bond_tables(command.bonds, side.bonds);
  print_table(to_table(network_columns(command), rows), command.format);
  return code;
}

}  // namespace

Command add_network(CommandLine program) {
  CommandLine app = program.add_subcommand("network",
                                           "Describe the contact networks of saved states: coordination, "
                                           "forces, particle pressures, what carries the load");
  const auto command = std::make_shared<NetworkCommand>();
  add_states_argument(app, command->files);
  app.add_option("--zero-force", command->zero_force,
                 "normal forces below this count as zero, in units of max(F0, P a^(d-1)) [the force tolerance "
                 "of the state]")
      .non_negative();
  app.add_option("--least-contacts", command->least_contacts,
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
  app.add_option("--bin-width", command->bin_width, "bin width of these distributions, in that unit")
      .positive()
      .show_default();
  app.add_option("--particle-stress", command->pressures, "file for the pressure and stress of each grain");
  add_bond_options(app, command->bonds);
  app.add_option(
         "--without", command->without,
         "mechanics: leave empty what needs the moduli (indeterminacy to correlation_size, hyperstaticity and "
         "n_null_modes), which takes most of the time in a large packing")
      .delimiter(',')
      .one_of({"mechanics"});
  add_format_option(app, command->format);
  return {app, [command] { return run_network(*command); }};
}

}  // namespace floc
