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
void choose_column(const std::string& pattern);

/// Whether `--columns` was given.
bool columns_are_chosen();

/// @throws InputError naming what is chosen and is no column of any table, with the nearest that is one: called
/// before work begins
void check_chosen_columns();

/// The columns chosen, in that order. Without a choice all; on a terminal those that docs/columns.md names, as
/// many as fit its width, which a line on stderr then says.
/// @param on_terminal  whether the table is aligned for one
/// @throws InputError as above; what this table alone has not is said on stderr and left out
Table with_chosen_columns(const Table& table, bool on_terminal);

}  // namespace floc
