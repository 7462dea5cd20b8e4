#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"
#include "process/printing.h"

/// Parts of the command lines of `floc fit`, and reading of the tables that they name.
namespace floc {

/// Adds the option `--columns`, which maps names to columns of the input table and chooses columns to print.
/// @param text   receives the value of the option
/// @param names  names that may be mapped to columns, as listed in the help
void add_columns_option(CommandLine app, std::string& text, const std::string& names);

/// Parses the value of `--columns`, a list of items separated by commas. Items name=column map a name to a column of
/// the input table and are returned. All other items are columns to print and are added to `printing`.
/// @param names  names that may be mapped to columns
/// @throws InputError if an item is not valid or maps a name that is not in `names`
ColumnNames parse_column_names(const std::string& text, const std::vector<std::string>& names,
                               Printing& printing);

/// Prints on stderr how the pressures of a path were converted to another unit, and a warning for each inconsistency in
/// the path.
void log_notes(const PathTable& path);

/// Calls `work`, which returns an exit code, for every table of the inputs. If an input cannot be read, an error that
/// names it is printed on stderr, and the other inputs are still processed.
/// @return the worst of the exit codes, in the order of worse()
int for_each_table(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string& file)>& work);

/// Prints a fit on stdout, as `json` if that is the chosen format, otherwise as `table`. On a terminal only the first
/// `n_short` columns are printed, because the summary on stderr contains the others.
/// @throws IoError if stdout cannot be written
void print_fit(const Json& json, Table table, std::size_t n_short, const Printing& printing);

}  // namespace floc
