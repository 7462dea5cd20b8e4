#pragma once

#include <string>
#include <vector>

#include "floc/io/table.h"
#include "process/command_line.h"

namespace floc {

/// Format and columns of the table that a command prints, as its options `--format` and `--columns` set them.
struct Printing {
  std::string format;                ///< "table", "csv", "json"; empty: a table on a terminal, csv otherwise
  std::vector<std::string> columns;  ///< names and patterns of the columns chosen; empty: all columns
  std::string command;               ///< command whose columns may be chosen: "moduli", "fit elastic"

  /// Adds a column to the choice. @throws InputError if no table of the command has it, naming the most similar column
  void choose(const std::string& pattern);
};

/// Adds `--format table|csv|json`, and `--columns NAME,...` unless the command has another option of that name. A
/// column that the command does not print ends the program before any work.
void add_printing_options(CommandLine app, Printing& printing);

/// Returns the format that `--format` names. If it is empty: a table on a terminal, csv otherwise.
TableFormat chosen_format(const std::string& format);

/// Returns the chosen columns of a table, in the order of the choice. Without a choice these are all columns; on a
/// terminal those that docs/columns.md names for it, as many as fit its width, with a note on stderr. Chosen columns
/// that only tables of another dimension have are left out, with a note on stderr.
/// @param on_terminal  whether the table is aligned for a terminal
/// @throws InputError if no column is left
Table with_chosen_columns(const Table& table, const Printing& printing, bool on_terminal);

/// Prints a table on stdout. @throws IoError if stdout cannot be written (disk full)
void print_table(const Table& table, const Printing& printing);

}  // namespace floc
