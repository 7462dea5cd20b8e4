#pragma once

#include <functional>
#include <string>
#include <vector>

#include "floc/tables/fit_parameters.h"
#include "floc/tables/fit_tables.h"
#include "process/printing.h"

/// Functions that the subcommands of `floc fit` share: options, reading of input tables, and printing of fits.
namespace floc {

/// Adds the option `--columns`. The option assigns columns of the input table to the quantities to read, and selects
/// the columns of the output table to print.
/// @param text   receives the value of the option
/// @param names  names of the quantities, as the help lists them
void add_columns_option(CommandLine app, std::string& text, const std::string& names);

/// Adds the option `--phi-limit`. @param text  receives the value of the option, which phi_limit_of() reads
void add_phi_limit_option(CommandLine app, std::string& text);

/// Parses the value of `--columns`, a list of items separated by commas, and returns the items NAME=COLUMN. An item
/// NAME=COLUMN means that the column COLUMN of the input table contains the quantity NAME. Any other item is the name
/// of a column to print and is added to `printing`.
/// @param names  names of the quantities to which columns may be assigned
/// @throws InputError if an item is not valid, or if its NAME is not in `names`
ColumnNames parse_column_names(const std::string& text, const std::vector<std::string>& names,
                               Printing& printing);

/// Returns `names`, followed by the names of all quantities from which solid fractions can be computed
/// (density_names()).
std::vector<std::string> names_with_densities(std::vector<std::string> names);

/// Prints on stderr the quantities that were read from the table of a load path, the conversion of its pressures to
/// another unit, and the rows that are ignored.
void log_notes(const PathTable& path);

/// Prints the format of a table on stderr, unless it is a plain csv table.
void log_description(const CsvTable& table);

/// Calls `work` for every table that the inputs name. `work` returns an exit code. If an input cannot be read, the
/// error is printed on stderr with the name of this input, and the other inputs are still processed.
/// @param inputs  csv files, or directories of `floc run` or of an ensemble
/// @param tables  function that returns the tables of an input
/// @return the worst of the exit codes, by the order of worse()
int for_each_table(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string& file)>& work,
                   const std::function<std::vector<std::string>(const std::string& input)>& tables = tables_of);

/// Prints a fit on stdout: `json` if the chosen format is json, otherwise `table`. On a terminal only the first
/// `n_short` columns of the table are printed, because the summary on stderr contains the values of the other columns.
/// @throws IoError if stdout cannot be written
void print_fit(const Json& json, Table table, std::size_t n_short, const Printing& printing);

}  // namespace floc
