#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"
#include "process/printing.h"

/// Command lines of the fits, and the tables that they name.
namespace floc {

/// Adds `--columns`. @param names  those that may be mapped, for the help
void add_columns_option(CommandLine app, std::string& text, const std::string& names);

/// Reads what `--columns` was given: names mapped to columns of the table, and names of columns to print, which
/// `printing` takes.
/// @param names  those that may be mapped
/// @throws InputError for text that is no list of name=column, or another name
ColumnNames parse_column_names(const std::string& text, const std::vector<std::string>& names,
                               Printing& printing);

/// Says on stderr what was done to the pressures of a path, and warns of what is in doubt.
void log_notes(const PathTable& path);

/// Hands every table of the inputs to `work`, which returns its exit code. What cannot be read is reported by
/// name on stderr and the others are still done. @return the worst of the exit codes
int for_each_table(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string& file)>& work);

/// Prints a fit on stdout: `json` if that is the format, otherwise the table; on a terminal only its first `n_short`
/// columns, where the words on stderr say the rest. @throws IoError if stdout cannot take it.
void print_fit(const Json& json, Table table, std::size_t n_short, const Printing& printing);

}  // namespace floc
