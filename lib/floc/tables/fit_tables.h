#pragma once

#include <map>
#include <string>
#include <vector>

#include "floc/fitting/loading_path.h"
#include "floc/io/csv.h"
#include "floc/io/table.h"
#include "floc/io/table_units.h"

namespace floc {

/// Maps names that floc uses to columns of an input table, as `--columns name=column,...` does.
using ColumnNames = std::map<std::string, std::string>;

/// A column of a table and the unit in its header, as in "sigma [kPa]" or "sigma (kPa)".
struct UnitColumn {
  int index;
  std::string unit;  ///< empty if the header has none
};

/// Finds the column that is mapped to `name` or has that name. A unit in brackets may follow the name in the header.
/// @throws InputError listing the columns of the table, if there is no such column
UnitColumn find_column(const CsvTable& table, const ColumnNames& columns, const std::string& name);
/// Returns whether find_column() finds a column.
bool has_column(const CsvTable& table, const ColumnNames& columns, const std::string& name);

/// Returns the tables that an argument names: a file itself; for a directory DIR, DIR/path.csv or DIR/seed-N/path.csv
/// in the order of N.
/// @throws InputError for a directory that has none of these
std::vector<std::string> tables_of(const std::string& input);

/// A loading path with the table from which it was read.
struct PathTable {
  std::string name;
  std::vector<PathRow> rows;
  std::string unit;  ///< unit of the pressures; empty if the header has none
  CsvTable table;
  /// Stress taken as the pressure of oedometric rows, "driven" or "mean"; empty without such rows.
  std::string stress = {};
  std::vector<std::string> notes = {};            ///< conversions of the pressures, as messages for stderr
  std::vector<std::string> inconsistencies = {};  ///< warnings of values that may be in another unit

  /// Returns `stress` as a value of a table.
  TableValue stress_of_rows() const { return or_undefined(stress); }
};

/// Stress that is taken as the pressure of the rows of an oedometer.
enum class OedometerPressure { driven, mean };

/// Reads the pressure (the first of `pressures` that the table has), phi (or void_ratio) and, if present, branch. The
/// pressure of rows of `floc run` with one driven axis and no lateral strain is the driven stress or the mean stress,
/// as `oedometer` says. If the unit of P_star changes along a path of `floc run`, it is converted to that of the first
/// rows.
/// @throws InputError naming file, line and value if a column is missing, a value is no number or negative, or a
/// pressure contradicts its branch
PathTable read_path(const std::string& file, const ColumnNames& columns,
                    const std::vector<std::string>& pressures = {"P_star"},
                    OedometerPressure oedometer = OedometerPressure::driven);

/// Converts the pressures of a path to the unit of another path with which it is pooled.
/// @throws InputError if only one of them has a unit, or the units cannot be converted
void convert_pressures(const PathTable& to, PathTable& path);

/// A path as arrays.
struct PathArrays {
  std::string name;  ///< for messages
  std::vector<double> pressure;
  std::vector<double> density;  ///< solid fraction or void ratio at each pressure
  bool is_void_ratio = false;
  std::vector<std::string> branch;  ///< branch at each pressure; may be empty
};

/// Returns arrays as a path; its table is empty.
/// @throws InputError naming array, index and value, under the conditions of read_path()
PathTable path_of_arrays(const PathArrays& arrays);

/// Returns row numbers as ranges: "1-9, 12".
std::string ranges(const std::vector<int>& rows);

}  // namespace floc
