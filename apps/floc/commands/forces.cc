#include <memory>

#include "floc/tables/forces_rows.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct ForcesCommand {
  std::vector<std::string> files;
  ForcesTableOptions options;
  /// selection of forces, "closest" or "canonical"; if empty, the default for each state
  std::string selection;
  std::string contacts;  ///< csv file for the table of contacts; if empty, no file is written
  Printing printing;
};

int run_forces(const ForcesCommand& command) {
  ForcesTableOptions options = command.options;
  if (!command.selection.empty()) options.selection = force_selection_named(command.selection);
  options.contacts = !command.contacts.empty();
  options.ranges = options.ranges || !options.range_of.empty();
  std::vector<ForcesRow> rows;
  Table contacts;
  const int code = for_each_state(command.files, [&](const std::string& file, const AnyState& any,
                                                     const Remarks& remarks) {
    std::visit([&](const auto& state) { rows.push_back(forces_row(file, state, options, contacts, remarks)); },
               any);
    return int{kDone};
  });
  if (options.contacts) write_csv_unless_failed(command.contacts, contacts, code);
  print_table(to_table(forces_columns(), rows), command.printing);
  return code;
}

}  // namespace

Command add_forces(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "forces",
      "Find balanced contact forces for the geometry of saved states: the forces closest "
      "to those of the state, or the "
      "forces of least elastic energy, and the range of the force of each contact");
  const auto command = std::make_shared<ForcesCommand>();
  add_states_argument(app, command->files);
  app.add_option("--selection", command->selection,
                 "closest: the balanced forces closest to those of the state; canonical: the balanced "
                 "forces of least elastic energy [closest, or canonical for a state without forces]")
      .one_of({"closest", "canonical"});
  app.add_option("--friction", command->options.friction,
                 "friction coefficient of all contacts [that of the contact law]")
      .non_negative();
  app.add_option("--kn", command->options.kn,
                 "normal stiffness of all contacts in the elastic energy (force/length) [that of each contact]")
      .positive();
  app.add_option(
         "--kt", command->options.kt,
         "tangential stiffness of all contacts in the elastic energy (force/length) [that of each contact]")
      .positive();
  app.add_option("--stress", command->options.stress,
                 "stress that the forces transmit, positive in compression: the pressure, the "
                 "components along the axes separated by commas, or all components in the order of "
                 "Voigt [the stress that the forces of the state transmit]")
      .delimiter(',');
  app.add_option(
         "--gap", command->options.gap,
         "largest gap across which pairs of grains may carry a force, in units of the smallest diameter [only "
         "the contacts of the state carry forces]")
      .within(kNearGap);
  // A range is a pair of numbers for each contact, but the table on stdout has one row for each state. The ranges are
  // therefore written only to the file of --contacts, and the options for ranges need this file.
  const auto table = app.add_option(
      "--contacts", command->contacts,
      "csv file to write: contacts with their forces; floc convert --contacts reads it for round "
      "grains in a cell");
  app.add_flag("--range", command->options.ranges,
               "add to the file of --contacts the smallest and the largest normal force that each contact can "
               "carry while all forces balance")
      .needs(table);
  // The option --range-of does not need --range: run_forces() computes ranges if either option is given.
  app.add_option("--range-of", command->options.range_of,
                 "compute the ranges of --range only for the contacts with these numbers, separated "
                 "by commas; numbers count from 0 in the order of the file of --contacts")
      .delimiter(',')
      .needs(table);
  add_printing_options(app, command->printing);
  return {app, [command] { return run_forces(*command); }};
}

}  // namespace floc
