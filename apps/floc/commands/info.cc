#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "floc/tables/info_row.h"
#include "floc/tables/size_rows.h"
#include "process/command.h"
#include "process/finish_output.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct InfoArguments {
  std::vector<std::string> files;
  Printing printing;
  bool scene = false;
  std::string sizes;  ///< name of the csv file for the sizes of the grains; if empty, no file is written
};

/// Prints the table of the states. In the format "table" each value is printed on its own line, after the name of its
/// column, because the row of a state is wider than a terminal.
void print(const Table& table, const Printing& printing) {
  if (chosen_format(printing.format) != TableFormat::table) return print_table(table, printing);
  const Table shown = with_chosen_columns(table, printing, false);
  for (const auto& row : shown.rows)
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto* number = std::get_if<double>(&row[k]);
      const auto* integer = std::get_if<std::int64_t>(&row[k]);
      const auto* text = std::get_if<std::string>(&row[k]);
      std::cout << fmt::format("{:<16}{}\n", shown.columns[k],
                               number    ? fmt::format("{:.6g}", *number)
                               : integer ? fmt::format("{}", *integer)
                               : text    ? *text
                                         : "-");
    }
  finish_output();
}

int info(const InfoArguments& arguments) {
  Table table, sizes;
  const int code =
      for_each_state(arguments.files, [&](const std::string& file, const AnyState& state, const Remarks&) {
        if (arguments.scene)
          std::visit([](const auto& s) { std::cout << s.scene; }, state);
        else
          add_info_row(file, state, table);
        if (!arguments.sizes.empty()) add_size_rows(file, state, sizes);
        return int{kDone};
      });
  if (!arguments.sizes.empty()) write_csv(arguments.sizes, sizes);
  if (!table.rows.empty()) print(table, arguments.printing);
  finish_output();
  return code;
}

}  // namespace

Command add_info(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "info", "Print the contents of a state file, its loading history and its provenance");
  const auto arguments = std::make_shared<InfoArguments>();
  add_states_argument(app, arguments->files);
  add_printing_options(app, arguments->printing);
  app.add_flag("--scene", arguments->scene, "print only the scene file with which the state was made");
  app.add_option(
      "--sizes", arguments->sizes,
      "csv file to write, with one row per interval of diameters (between two sieves of the scene's sieve "
      "curve, otherwise a quarter of the range): the grains in it and their share of the volume, beside "
      "the share that the distribution in the scene gives");
  return {app, [arguments] { return info(*arguments); }};
}

}  // namespace floc
