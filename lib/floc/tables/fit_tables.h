#pragma once

#include <map>
#include <string>
#include <vector>

#include "floc/fitting/loading_path.h"
#include "floc/io/csv.h"
#include "floc/io/table.h"
#include "floc/io/table_units.h"

namespace floc {

/// Map from the names that floc uses to the columns of an input table, from `--columns name=column,...`.
using ColumnNames = std::map<std::string, std::string>;

/// Index of a column of a table, and the unit in its header, such as "sigma [kPa]" or "sigma (kPa)".
struct UnitColumn {
  int index;
  std::string unit;  ///< empty if the header has none
};

/// Finds the column that `columns` maps `name` to, otherwise the column of this name. A unit in brackets may
/// follow the name in the header.
/// @throws InputError listing the columns of the table, if there is no such column
UnitColumn find_column(const CsvTable& table, const ColumnNames& columns, const std::string& name);
/// Returns whether find_column() would find a column.
bool has_column(const CsvTable& table, const ColumnNames& columns, const std::string& name);

/// Returns the tables that a command-line argument stands for: for a file, the file itself; for a directory
/// DIR, the file DIR/path.csv or the files DIR/seed-N/path.csv in the order of N.
/// @throws InputError for a directory that has none of these
std::vector<std::string> tables_of(const std::string& input);

/// A load path with the table from which it was read.
struct PathTable {
  std::string name;
  std::vector<PathRow> rows;
  std::string unit;  ///< unit of the pressures; empty if the header has none
  CsvTable table;
  /// Stress taken as the pressure of oedometric rows, "driven" (on the driven axis) or "mean"; empty without
  /// such rows.
  std::string stress = {};
  std::vector<std::string> notes = {};            ///< messages about conversions of the pressures, for stderr
  std::vector<std::string> inconsistencies = {};  ///< warnings about values that may be in another unit

  /// Returns `stress` as a cell of a table.
  TableValue stress_of_rows() const { return or_undefined(stress); }
};

/// Stress that is taken as the pressure of oedometric rows: on the driven axis, or the mean over the axes.
enum class OedometerPressure { driven, mean };

/// Reads a load path from a table: the pressure (the first of the columns `pressures` that the table has), phi
/// or void_ratio and, if present, branch. In rows of `floc run` with one driven axis and no lateral strain, the
/// pressure is the stress that `oedometer` selects. If the unit of P_star changes along a path of `floc run`,
/// the pressures are converted to the unit of the first rows.
/// @throws InputError with file, line and value if a column is missing, a value is not a number or is negative,
/// or a pressure contradicts its branch
PathTable read_path(const std::string& file, const ColumnNames& columns,
                    const std::vector<std::string>& pressures = {"P_star"},
                    OedometerPressure oedometer = OedometerPressure::driven);

/// Converts the pressures of `path` to the unit of the path `to`, so that a mean of both can be formed.
/// @throws InputError if only one of the paths has a unit, or if the units cannot be converted
void convert_pressures(const PathTable& to, PathTable& path);

/// A load path given as arrays, for the Python package.
struct PathArrays {
  std::string name;  ///< name of the path in messages
  std::vector<double> pressure;
  std::vector<double> density;  ///< solid fraction or void ratio at each pressure
  bool is_void_ratio = false;
  std::vector<std::string> branch;  ///< name of the branch of each pressure; may be empty
};

/// Converts arrays to a load path, whose table is empty.
/// @throws InputError with array, index and value, if a value is negative or contradicts its branch
PathTable path_of_arrays(const PathArrays& arrays);

/// Returns row numbers as a text of ranges, such as "1-9, 12".
std::string ranges(const std::vector<int>& rows);

}  // namespace floc
