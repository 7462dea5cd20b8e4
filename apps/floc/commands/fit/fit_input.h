#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"
#include "process/printing.h"

/// Command lines of the fits, and the tables that they name.
namespace floc {

/// Adds the option `--columns`. @param names  names that may be mapped to columns, listed in the help
void add_columns_option(CommandLine app, std::string& text, const std::string& names);

/// Parses the value of `--columns`. Items name=column map a name to a column of the input table and are returned; other
/// items are columns to print and are added to `printing`.
/// @param names  names that may be mapped to columns
/// @throws InputError if the text is not such a list, or a name is none of `names`
ColumnNames parse_column_names(const std::string& text, const std::vector<std::string>& names,
                               Printing& printing);

/// Prints on stderr how the pressures of a path were converted, and a warning for each of its inconsistencies.
void log_notes(const PathTable& path);

/// Calls `work`, which returns an exit code, for every table of the inputs. An input that cannot be read is reported by
/// name on stderr, and the others are still processed. @return worst of the exit codes, as worse() orders them
int for_each_table(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string& file)>& work);

/// Prints a fit on stdout: `json` if that is the format, otherwise the table. On a terminal only the first `n_short`
/// columns are printed, because the summary on stderr holds the rest. @throws IoError if stdout cannot be written
void print_fit(const Json& json, Table table, std::size_t n_short, const Printing& printing);

}  // namespace floc
