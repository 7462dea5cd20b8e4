#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "floc/fitting/loading_path.h"
#include "floc/io/csv.h"
#include "floc/io/table.h"
#include "floc/io/table_columns.h"
#include "floc/io/table_units.h"

namespace floc {

/// Returns the files of the tables that an argument of a command denotes: the file itself or, for a directory DIR, the
/// file DIR/path.csv of a run or the files DIR/seed-N/path.csv of an ensemble, in the order of N.
/// @throws InputError for a directory that contains none of these files
std::vector<std::string> tables_of(const std::string& input);

/// A load path with the table from which it was read.
struct PathTable {
  std::string name;
  std::vector<PathRow> rows;
  std::string unit;  ///< unit of the pressures; empty if the header of the column has no unit
  CsvTable table;
  /// Stress used as the pressure in rows of oedometer tests: "driven" (on the driven axis) or "mean" (over the axes);
  /// empty if the table has no such rows.
  std::string stress = {};
  /// Summary of the table in one line: number of rows, quantities, units and reversals of the load.
  std::string reading = {};
  /// whether `floc run` has written the table, so that `reading` need not be printed
  bool is_of_run = false;
  std::vector<std::string> notes =
      {};  ///< messages about conversions of the pressures, and about rows that are left out

  /// Returns `stress` as a table cell, which is empty if `stress` is empty.
  TableValue stress_of_rows() const { return or_undefined(stress); }
};

/// Finds the column of the pressures: the column that the user named; otherwise the first of `names` that is a column
/// of the table; otherwise a column with another usual name of a pressure.
/// @return name and column
/// @throws InputError, with a list of the columns of the table, if there is no column of pressures
std::pair<std::string, UnitColumn> pressure_column(const NamedColumns& columns,
                                                   const std::vector<std::string>& names);

/// Stress used as the pressure in rows of oedometer tests: the stress on the driven axis, or the mean over the axes.
enum class OedometerPressure { driven, mean };

/// Reads a load path from a table: the pressure, the solid fraction (see solid_fractions()) and, if the table has it,
/// the name of the branch. If successive rows have the same pressure, only the last of them is used. In rows of
/// oedometer tests in a table of `floc run`, the pressure is the stress that `oedometer` selects. If the unit of P_star
/// changes along a path of `floc run`, the pressures are converted to the unit of the first rows.
/// @param columns    headers that the user assigned to quantities; needed for headers that floc does not know
/// @param pressures  names of columns of pressures; the first of them that exists in the table is read
/// @param phi_limit  see largest_solid_fraction()
/// @throws InputError with file, line and value if a column is missing, if a value is not a number or is negative, or
/// if the pressures along a branch are neither all increasing, nor all decreasing, nor all equal
PathTable read_path(const std::string& file, const ColumnNames& columns,
                    const std::vector<std::string>& pressures = {"P_star"},
                    OedometerPressure oedometer = OedometerPressure::driven, double phi_limit = 1.0);

/// Converts the pressures of `path` to the unit of the path `to`, so that the mean of the two paths can be computed.
/// @throws InputError if only one of the paths has a unit, or if the units cannot be converted
void convert_pressures(const PathTable& to, PathTable& path);

/// A load path that a caller of the Python package passes as arrays, with one element for each point of the path.
struct PathArrays {
  std::string name;  ///< name of the path in messages
  std::vector<double> pressure;
  std::vector<double> density;  ///< solid fraction or void ratio at each pressure
  bool is_void_ratio = false;
  std::vector<std::string> branch;  ///< name of the branch of each point; empty if the branches have no names
};

/// Converts arrays to a load path, without a table.
/// @param phi_limit  see largest_solid_fraction()
/// @throws InputError with the name of the arrays, the index and the value, if a value is negative, or if the pressures
/// along a branch are neither all increasing, nor all decreasing, nor all equal
PathTable path_of_arrays(const PathArrays& arrays, double phi_limit = 1.0);

/// Returns a text with the ranges of ascending row numbers, such as "1-9, 12".
std::string ranges(const std::vector<int>& rows);

}  // namespace floc
