#include "process/printing.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/base/parse_number.h"
#include "floc/tables/column_reference.h"
#include "process/finish_output.h"

namespace floc {
namespace {

std::string pattern_of(const std::string& chosen) {
  return chosen == "all" ? "*" : chosen;
}

/// Table that a command prints in place of its usual table if an option is given.
constexpr const char* kPrintedInPlace = "plan --check";

/// Returns the names of the columns that a command can print, or patterns of these names. Some tables are written only
/// with an option, such as the table of "moduli --increments". The columns of such tables are included only if the
/// command has no other table, as for "campaign collect --table runs", or if the table is printed in place of the
/// other.
std::vector<std::string> names_printed_by(const std::string& command) {
  std::vector<std::string> printed, with_option;
  for (const DescribedTable& table : described_tables()) {
    if (table.name != command && !table.name.starts_with(command + " ")) continue;
    const bool needs_option = table.name.starts_with(command + " --") && table.name != kPrintedInPlace;
    auto& names = needs_option ? with_option : printed;
    for (const DescribedColumn& column : table.columns) names.push_back(column.name);
  }
  return printed.empty() ? with_option : printed;
}

/// Checks the name or pattern of a column that the user chose. @throws InputError if none of the tables that the
/// command prints has a column that fits; commands without tables are not checked
void expect_column_of(const std::string& command, const std::string& chosen) {
  const std::vector<std::string> names = names_printed_by(command);
  const std::string pattern = pattern_of(chosen);
  const bool known = std::ranges::any_of(
      names, [&](const std::string& name) { return stands_for(pattern, name) || stands_for(name, pattern); });
  if (!known && !names.empty())
    throw InputError("--columns", fmt::format("no column of floc {} is named {}; the nearest is {}", command,
                                              chosen, nearest_name(chosen, names)));
}

int terminal_width() {
  constexpr int kUsual = 80;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  const char* said = std::getenv("COLUMNS");
  const auto columns = said == nullptr ? std::nullopt : parse_number<int>(said);
  return columns && *columns > 0 ? *columns : kUsual;
}

Table of_columns(const Table& table, const std::vector<std::size_t>& indices) {
  Table part;
  for (const std::size_t k : indices) part.columns.push_back(table.columns[k]);
  for (const auto& row : table.rows) {
    auto& cells = part.rows.emplace_back();
    for (const std::size_t k : indices) cells.push_back(row[k]);
  }
  return part;
}

/// Returns the length of the longest line of a table as it is printed (characters).
std::size_t printed_width(const Table& table) {
  std::ostringstream text;
  write_table(text, table, TableFormat::table);
  std::istringstream lines(text.str());
  std::size_t widest = 0;
  for (std::string line; std::getline(lines, line);) widest = std::max(widest, line.size());
  return widest;
}

/// Returns a table with the first of the columns `wanted`: as many as fit the width of the terminal, but at least one.
Table fitting(const Table& table, const std::vector<std::string>& wanted) {
  const auto room = static_cast<std::size_t>(terminal_width());
  std::vector<std::size_t> shown;
  for (const std::string& name : wanted) {
    const auto at = std::ranges::find(table.columns, name);
    if (at == table.columns.end()) continue;
    shown.push_back(static_cast<std::size_t>(at - table.columns.begin()));
    if (shown.size() == 1 || printed_width(of_columns(table, shown)) <= room) continue;
    shown.pop_back();
    break;
  }
  return of_columns(table, shown);
}

Table chosen_part(const Table& table, const std::vector<std::string>& columns) {
  std::vector<std::size_t> indices;
  for (const std::string& chosen : columns) {
    bool found = false;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (!stands_for(pattern_of(chosen), table.columns[k])) continue;
      found = true;
      if (std::ranges::find(indices, k) == indices.end()) indices.push_back(k);
    }
    if (!found) std::cerr << fmt::format("floc: --columns {}: the table has no column of this name\n", chosen);
  }
  if (indices.empty())
    throw InputError("--columns",
                     fmt::format("the table has none of the chosen columns; the column nearest to {} is {}",
                                 columns.front(), nearest_name(columns.front(), table.columns)));
  return of_columns(table, indices);
}

}  // namespace

void Printing::choose(const std::string& pattern) {
  expect_column_of(command, pattern);
  columns.push_back(pattern);
}

void add_printing_options(CommandLine app, Printing& printing) {
  app.after_parsing([&printing, command = app.full_name()] {
    printing.command = command;
    for (const std::string& chosen : printing.columns) expect_column_of(command, chosen);
  });
  app.add_option("--format", printing.format,
                 "format of the printed table: table, csv or json [table on a terminal, csv otherwise]")
      .one_of({"table", "csv", "json"});
  if (app.has_option("--columns")) return;
  app.add_option("--columns", printing.columns,
                 "NAME,...: columns to print, in this order: names, patterns such as 'error_*', or all; floc "
                 "help columns describes the columns [all; on a terminal as many as fit its width]")
      .delimiter(',')
      .one_argument_each();
}

TableFormat chosen_format(const std::string& format) {
  if (format == "json") return TableFormat::json;
  if (format == "csv") return TableFormat::csv;
  if (format == "table") return TableFormat::table;
  return isatty(STDOUT_FILENO) ? TableFormat::table : TableFormat::csv;
}

void print_table(const Table& table, const Printing& printing) {
  const TableFormat chosen = chosen_format(printing.format);
  const bool on_terminal = chosen == TableFormat::table && isatty(STDOUT_FILENO) == 1;
  write_table(std::cout, with_chosen_columns(table, printing, on_terminal), chosen);
  finish_output();
}

Table with_chosen_columns(const Table& table, const Printing& printing, bool on_terminal) {
  if (!printing.columns.empty()) return chosen_part(table, printing.columns);
  const DescribedTable* described = on_terminal ? table_with(table.columns) : nullptr;
  if (described == nullptr || described->on_terminal.empty()) return table;
  Table part = fitting(table, described->on_terminal);
  if (part.columns.size() < table.columns.size())
    std::cerr << fmt::format(
        "{} of {} columns are shown; --columns all prints all of them, floc help columns {} describes them\n",
        part.columns.size(), table.columns.size(), described->name);
  return part;
}

}  // namespace floc
