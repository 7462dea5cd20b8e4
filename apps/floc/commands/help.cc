#include "commands/help.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>
#include <iostream>
#include <memory>

#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/tables/column_reference.h"
#include "process/finish_output.h"
#include "process/printing.h"

namespace floc {
namespace {

struct HelpArguments {
  std::vector<std::string> table;  ///< words of the table name, such as "fit", "consolidation"
  Printing printing;
};

/// Returns the descriptions of all tables whose names begin with `name`. For example, "moduli" stands for the tables
/// "moduli" and "moduli --increments", and an empty name for all tables.
/// @throws InputError if no table has a name that begins with `name`; the message contains the most similar table name
std::vector<DescribedTable> tables_named(const std::string& name) {
  std::vector<DescribedTable> found;
  std::vector<std::string> names;
  for (const DescribedTable& table : described_tables()) {
    names.push_back(table.name);
    if (name.empty() || table.name == name || table.name.starts_with(name + " ")) found.push_back(table);
  }
  if (found.empty())
    throw InputError("floc help columns", "no table is named \"" + name + "\"; the nearest is \"" +
                                              nearest_name(name, names) + "\"");
  return found;
}

/// Prints name, unit and meaning of each column of the tables that tables_named() returns for `name`.
/// @throws InputError if no table has a name that begins with `name`; the message contains the most similar table name
void print_column_reference(const std::string& name, const Printing& printing) {
  const std::vector<DescribedTable> tables = tables_named(name);
  Table all{{"table", "column", "unit", "meaning"}, {}};
  for (const DescribedTable& table : tables)
    for (const DescribedColumn& c : table.columns)
      all.rows.push_back({table.name, c.name, or_undefined(c.unit), c.meaning});
  if (chosen_format(printing.format) != TableFormat::table) return print_table(all, printing);
  for (const DescribedTable& table : tables) {
    Table one{{"column", "unit", "meaning"}, {}};
    for (const DescribedColumn& c : table.columns) one.rows.push_back({c.name, c.unit, c.meaning});
    std::cout << (&table == tables.data() ? "" : "\n") << table.name << "\n\n";
    write_table(std::cout, one, TableFormat::table);
  }
  finish_output();
}

}  // namespace

Command add_help(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "help", "Explain a command (floc help moduli) or the columns of tables (floc help columns)");
  CommandLine columns = app.add_subcommand(
      "columns", "print name, unit and meaning of the columns of one table or of all tables");
  app.require_one_subcommand();
  auto arguments = std::make_shared<HelpArguments>();
  columns.add_option("TABLE", arguments->table,
                     "name of a table: moduli, fit consolidation, path.csv, ... [all tables]");
  columns
      .add_option("--format", arguments->printing.format,
                  "output format: table, csv or json [table on a terminal, otherwise csv]")
      .one_of({"table", "csv", "json"});
  return {app, [arguments] {
            print_column_reference(fmt::format("{}", fmt::join(arguments->table, " ")), arguments->printing);
            return int{kDone};
          }};
}

std::vector<char*> arguments_of_help(int argc, char** argv) {
  static char help[] = "--help";
  std::vector<char*> arguments(argv, argv + argc);
  const bool asks = argc > 1 && std::strcmp(argv[1], "help") == 0;
  if (!asks || (argc > 2 && (std::strcmp(argv[2], "columns") == 0 || argv[2][0] == '-'))) return arguments;
  arguments.erase(arguments.begin() + 1);
  arguments.push_back(help);
  return arguments;
}

}  // namespace floc
