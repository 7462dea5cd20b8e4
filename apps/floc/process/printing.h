#pragma once

#include <string>
#include <vector>

#include "floc/io/table.h"
#include "process/command_line.h"

namespace floc {

/// How a command prints its table: what `--format` and `--columns` of its command line say.
struct Printing {
  std::string format;                ///< "table", "csv", "json"; empty: a table on a terminal, csv otherwise
  std::vector<std::string> columns;  ///< names and patterns that were chosen; empty: all of them
  std::string command;               ///< whose columns may be chosen: "moduli", "fit elastic"

  /// Adds a column to the choice. @throws InputError naming it if no table printed by the command has it, with the
  /// nearest that one has
  void choose(const std::string& pattern);
};

/// Adds `--format table|csv|json`, and `--columns NAME,...` to a command that has no option of that name for something
/// else. Columns that the command does not print end the program before work begins.
void add_printing_options(CommandLine app, Printing& printing);

/// What `--format` asks for; without it a table on a terminal, csv otherwise.
TableFormat chosen_format(const std::string& format);

/// The columns chosen, in that order. Without a choice all; on a terminal those that docs/columns.md names, as many as
/// fit its width, which a line on stderr then says. Columns that rows of another dimension have are left out, which
/// stderr says.
/// @param on_terminal  whether the table is aligned for one
/// @throws InputError if none is left
Table with_chosen_columns(const Table& table, const Printing& printing, bool on_terminal);

/// Prints a table on stdout. @throws IoError if stdout cannot take it (disk full).
void print_table(const Table& table, const Printing& printing);

}  // namespace floc
