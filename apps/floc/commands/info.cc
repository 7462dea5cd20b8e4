#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "commands/fit/fit_input.h"
#include "floc/base/read_file.h"
#include "floc/tables/consolidation_fits.h"
#include "floc/tables/info_row.h"
#include "floc/tables/size_rows.h"
#include "floc/tables/table_info.h"
#include "process/command.h"
#include "process/finish_output.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct InfoArguments {
  std::vector<std::string> files;
  std::string columns;
  std::string phi_limit = "1";
  Printing printing;
  bool scene = false;
  std::string sizes;  ///< name of the csv file for the sizes of the grains; if empty, no file is written
};

/// Prints the table of the states. In the format "table", each value is printed on its own line after the name of its
/// column: a row with all columns would be wider than a terminal.
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

/// Returns whether a file is a table. A file counts as a table if it is not a directory and if neither its name nor its
/// first bytes are those of a state file or a scene.
bool is_table(const std::string& file) {
  const std::filesystem::path path(file);
  if (file == "-" || !std::filesystem::is_regular_file(path)) return false;
  return path.extension() != ".h5" && path.extension() != ".toml" &&
         !read_beginning(file, 4).starts_with("\x89HDF");
}

/// Prints how floc reads tables: a summary of each table on stderr, and one row for each column of a table on stdout.
int info_of_tables(const std::vector<std::string>& files, const ColumnNames& names, double phi_limit,
                   const Printing& printing) {
  Table table;
  const int code = for_each_file(files, [&](const std::string& file) {
    const TableInfo read = add_table_info(file, names, phi_limit, table);
    spdlog::info("{}: {}", file, read.reading);
    for (const std::string& note : read.notes) spdlog::info("{}: {}", file, note);
    return int{kDone};
  });
  if (!table.rows.empty()) print_table(table, printing);
  return code;
}

int info(const InfoArguments& arguments) {
  Table table, sizes;
  Printing printing = arguments.printing;
  const ColumnNames names = parse_column_names(arguments.columns, names_of_quantities(), printing);
  std::vector<std::string> tables, states;
  for (const std::string& file : arguments.files) (is_table(file) ? tables : states).push_back(file);
  const int code_of_tables = info_of_tables(tables, names, phi_limit_of(arguments.phi_limit), printing);
  const int code = for_each_state(states, [&](const std::string& file, const AnyState& state, const Remarks&) {
    if (arguments.scene)
      std::visit([](const auto& s) { std::cout << s.scene; }, state);
    else
      add_info_row(file, state, table);
    if (!arguments.sizes.empty()) add_size_rows(file, state, sizes);
    return int{kDone};
  });
  if (!arguments.sizes.empty()) write_csv_unless_failed(arguments.sizes, sizes, code);
  if (!table.rows.empty()) print(table, printing);
  finish_output();
  return worse(code, code_of_tables);
}

}  // namespace

Command add_info(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "info", "Print the contents, loading history and provenance of a state file, or how floc reads a table");
  const auto arguments = std::make_shared<InfoArguments>();
  app.add_option("FILE", arguments->files,
                 "state files, or directories that floc run wrote; - reads one state from stdin; or "
                 "tables, to see how floc fit and floc convert read them")
      .required();
  add_phi_limit_option(app, arguments->phi_limit);
  add_columns_option(app, arguments->columns, "quantities such as P_star and void_ratio");
  add_printing_options(app, arguments->printing);
  app.add_flag("--scene", arguments->scene, "print only the scene file with which the state was made");
  app.add_option("--sizes", arguments->sizes,
                 "csv file to write, with one row per interval of diameters (between two sieves if "
                 "the scene has a sieve curve, otherwise a quarter of the range): number of grains, "
                 "their share of the volume, and the share that the scene prescribes");
  return {app, [arguments] { return info(*arguments); }};
}

}  // namespace floc
