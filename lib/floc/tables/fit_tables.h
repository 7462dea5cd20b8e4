#pragma once

#include <map>
#include <string>
#include <vector>

#include "floc/fitting/loading_path.h"
#include "floc/io/csv.h"
#include "floc/io/table.h"
#include "floc/io/table_units.h"

namespace floc {

/// Names of the program -> columns of a table, as `--columns name=column,...` gives them.
using ColumnNames = std::map<std::string, std::string>;

/// A column of a table and the unit in its header, as in "sigma [kPa]" or "sigma (kPa)"; empty without one.
struct UnitColumn {
  int index;
  std::string unit;
};

/// The column mapped to `name`, or of that name; a unit in brackets may follow it in the header.
/// @throws InputError listing the columns there are, if there is none
UnitColumn find_column(const CsvTable& table, const ColumnNames& columns, const std::string& name);
bool has_column(const CsvTable& table, const ColumnNames& columns, const std::string& name);

/// Tables of an argument: itself, DIR/path.csv, or DIR/seed-N/path.csv in the order of N.
/// @throws InputError for a directory without either
std::vector<std::string> tables_of(const std::string& input);

/// A path table.
struct PathTable {
  std::string name;
  std::vector<PathRow> rows;
  std::string unit;  ///< of the pressures; empty if the header has none
  CsvTable table;
  std::string stress = {};  ///< that of oedometric rows, "driven" or "mean"; empty without such rows
  std::vector<std::string> notes = {};            ///< what was done to the pressures, for stderr
  std::vector<std::string> inconsistencies = {};  ///< warnings of values that may be meant otherwise

  /// `stress` as a table has it.
  TableValue stress_of_rows() const { return or_undefined(stress); }
};

/// What stands for the pressure of the rows of an oedometer.
enum class OedometerPressure { driven, mean };

/// Reads the pressure (the first of `pressures` that the table has), phi (or void_ratio) and, if there is one,
/// branch. Of rows of `floc run` with one driven axis and no lateral strain, the pressure is the driven stress,
/// or the mean stress. P_star of `floc run` whose unit changes on the way is converted to that of its first rows.
/// @throws InputError naming file, line and value for what is no path: columns missing, values that are no
/// numbers, negative, or pressures that break their branch
PathTable read_path(const std::string& file, const ColumnNames& columns,
                    const std::vector<std::string>& pressures = {"P_star"},
                    OedometerPressure oedometer = OedometerPressure::driven);

/// Puts the pressures of a path in the unit of another one, which it is pooled with.
/// @throws InputError where only one has a unit, or the units cannot be converted
void convert_pressures(const PathTable& to, PathTable& path);

/// A path as arrays.
struct PathArrays {
  std::string name;  ///< for messages
  std::vector<double> pressure;
  std::vector<double> density;  ///< solid fractions or void ratios, as many
  bool is_void_ratio = false;
  std::vector<std::string> branch;  ///< as many, or none
};

/// The path of arrays; of no file.
/// @throws InputError naming array, index and value, as read_path()
PathTable path_of_arrays(const PathArrays& arrays);

/// Row numbers as ranges, "1-9, 12".
std::string ranges(const std::vector<int>& rows);

}  // namespace floc
