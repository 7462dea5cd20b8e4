#pragma once

#include <string>
#include <vector>

#include "command_line.h"
#include "floc/io/table.h"

namespace floc {

/// Adds `--columns NAME,...`, which says what of its table a command prints; nothing to a command that has an
/// option of that name for something else. A call prints one table, so that there is one choice in the program.
void add_columns_choice(CommandLine app);

/// Adds to the choice a name or pattern that came in another way: beside the columns to read in `fit --columns`.
/// @throws InputError as expect_columns_of() does
void choose_column(const std::string& pattern);

/// Whether `--columns` was given.
bool columns_are_chosen();

/// Says which command runs: its columns are those that may be chosen, now and later.
/// @param command  "moduli", "fit elastic"
/// @throws InputError naming a chosen column that no table printed by the command has, with the nearest that one
/// has: before work begins
void expect_columns_of(const std::string& command);

/// The columns chosen, in that order. Without a choice all; on a terminal those that docs/columns.md names, as
/// many as fit its width, which a line on stderr then says.
/// @param on_terminal  whether the table is aligned for one
/// Columns that rows of another dimension have are left out, which stderr says.
/// @throws InputError if none is left
Table with_chosen_columns(const Table& table, bool on_terminal);

}  // namespace floc
