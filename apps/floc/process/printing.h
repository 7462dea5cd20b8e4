#pragma once

#include <string>
#include <vector>

#include "floc/io/table.h"
#include "process/command_line.h"

namespace floc {

/// Format and columns of the table that a command prints. The options `--format` and `--columns` set them.
struct Printing {
  std::string format;  ///< "table", "csv" or "json"; empty: "table" on a terminal, "csv" otherwise
  std::vector<std::string> columns;  ///< names of the chosen columns, or patterns of names; empty: all columns
  std::string command;               ///< command that prints the table, such as "moduli" or "fit elastic"

  /// Adds a column, or the columns that match a pattern, to `columns`. @throws InputError if no table of the command
  /// has a column that fits the pattern; the message names the most similar column
  void choose(const std::string& pattern);
};

/// Adds the option `--format table|csv|json` to a command. Also adds the option `--columns NAME,...`, unless the
/// command already has an option called `--columns`. If no table of the command has a chosen column, the program ends
/// with an error before the command starts its work.
void add_printing_options(CommandLine app, Printing& printing);

/// Converts a value of `--format` to a table format. An empty value means "table" on a terminal and "csv" otherwise.
TableFormat chosen_format(const std::string& format);

/// Returns the columns of a table that are to be printed.
/// 1. If the user has chosen columns, these columns are printed in the chosen order. Chosen columns that this table
/// does not have, such as columns of 3D states in a table of 2D states, are left out with a note on stderr.
/// 2. If the user has not chosen columns, a terminal shows the columns that docs/columns.md lists for terminals: as
/// many as fit its width, with a note on stderr.
/// 3. In all other cases, all columns are printed.
/// @param on_terminal  whether the table is printed with aligned columns on a terminal
/// @throws InputError if the table has none of the chosen columns
Table with_chosen_columns(const Table& table, const Printing& printing, bool on_terminal);

/// Prints a table on stdout. @throws IoError if stdout cannot be written (disk full)
void print_table(const Table& table, const Printing& printing);

}  // namespace floc
