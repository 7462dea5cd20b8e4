#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "commands/compare_runs.h"
#include "floc/base/error.h"
#include "floc/tables/compare_rows.h"
#include "process/command.h"
#include "process/output.h"
#include "process/printing.h"
#include "process/run_states.h"

namespace floc {
namespace {

struct CompareCommand {
  std::vector<std::string> files;
  bool against_first = false;
  CompareTableOptions options;
  /// Names of the csv files for the displacements of the grains and for the contacts; a file with an empty name is not
  /// written.
  std::string displacements, contacts;
  Printing printing;
};

/// Returns whether the inputs are the directories of two runs, which are compared step by step. If there is a single
/// directory, each state in it is compared with the state before.
bool are_two_runs(const std::vector<std::string>& inputs) {
  return inputs.size() == 2 && std::ranges::all_of(inputs, [](const std::string& input) {
           return input != "-" && std::filesystem::is_directory(input);
         });
}

/// Checks that all inputs exist if one of them is a directory, before a table is printed. Otherwise, a mistake in the
/// name of a second directory would give a long table of the states of the first one.
/// @throws InputError naming the input that does not exist
void check_directories_exist(const std::vector<std::string>& inputs) {
  const auto is_directory = [](const std::string& input) {
    return input != "-" && std::filesystem::is_directory(input);
  };
  if (std::ranges::none_of(inputs, is_directory)) return;
  for (const std::string& input : inputs)
    if (input != "-" && !std::filesystem::exists(input))
      throw InputError(input,
                       "there is no file and no directory of this name: expected a state file, or a "
                       "directory that floc run wrote");
}

int run_compare(CompareCommand command) {
  check_directories_exist(command.files);
  command.options.displacements = !command.displacements.empty();
  command.options.contacts = !command.contacts.empty();
  if (are_two_runs(command.files)) return compare_runs(command.files[0], command.files[1], command.printing);
  if (command.files.size() == 1 && !std::filesystem::is_directory(command.files.front())) {
    std::cerr << "floc compare: one state file cannot be compared: give two or more state files, or a "
                 "directory of floc run\n";
    return kUsage;
  }
  std::vector<CompareRow> rows;
  CompareTables side;
  std::optional<std::pair<std::string, AnyState>> reference;
  const int code = for_each_file(states_of_inputs(command.files), [&](const std::string& file) {
    // The first argument of each comparison is `before`: the previous state or, with --against-first, the first state.
    // If `before` is empty (for the first state, and after a state that could not be read), nothing is compared.
    std::optional<std::pair<std::string, AnyState>> before = reference;
    if (!command.against_first) reference.reset();
    std::pair<std::string, AnyState> now(file, read_state(file));
    if (!reference) reference = now;
    if (!before) return int{kDone};
    std::visit(
        [&]<int Old, int New>(const State<Old>& p, const State<New>& q) {
          if constexpr (Old != New) {
            throw InputError(file, fmt::format("this is a state in {}D, but {} is in {}D: states can only be "
                                               "compared if they have the same dimension",
                                               New, before->first, Old));
          } else {
            rows.push_back(compare_row(before->first, p, file, q, command.options, side));
          }
        },
        before->second, now.second);
    return int{kDone};
  });
  if (!command.displacements.empty()) write_csv_unless_failed(command.displacements, side.displacements, code);
  if (!command.contacts.empty()) write_csv_unless_failed(command.contacts, side.contacts, code);
  print_table(to_table(compare_columns(rows), rows), command.printing);
  return code;
}

}  // namespace

Command add_compare(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "compare",
      "Compare states of the same grains: contacts kept, lost and gained, displacements of the grains");
  const auto command = std::make_shared<CompareCommand>();
  app.add_option("STATE", command->files,
                 "state files, or one directory of floc run: each state is compared with the state "
                 "before it; or two directories of floc run: the two runs are compared step by step")
      .required();
  app.add_flag("--against-first", command->against_first,
               "compare each state with the first state, not with the state before it");
  app.add_option("--rigid-tolerance", command->options.rigid_tolerance,
                 "two grains in contact belong to one rigid cluster if both measures of their relative motion "
                 "are below this tolerance: the distance between the two points that touched (in largest "
                 "diameters) and the difference of the rotations of the two grains (radians)")
      .positive()
      .show_default();
  app.add_option("--displacements", command->displacements,
                 "csv file to write, with one row per grain: position in the earlier state, non-affine "
                 "displacement, rigid cluster");
  app.add_option("--contacts", command->contacts,
                 "csv file to write, with one row per contact: kept, lost or gained");
  add_printing_options(app, command->printing);
  return {app, [command] { return run_compare(*command); }};
}

}  // namespace floc
