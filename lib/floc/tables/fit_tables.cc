#include "floc/tables/fit_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/run_directory/one_run.h"

namespace floc {
namespace {

/// Returns the column whose header is a name, or a name followed by a unit in brackets such as "P [kPa]". Returns
/// nothing if there is no such column.
/// @throws InputError if two columns have this name
std::optional<UnitColumn> find_optional_column(const CsvTable& table, const std::string& name) {
  std::optional<UnitColumn> found;
  for (const bool whole : {true, false}) {
    for (int i = 0; i < static_cast<int>(table.columns().size()); ++i) {
      const std::string& header = table.columns()[static_cast<std::size_t>(i)];
      const auto [bare, unit] = name_and_unit(header);
      if ((whole ? header : bare) != name) continue;
      if (found)
        throw InputError(
            table.place(),
            fmt::format("columns {} and {} of this table are both named \"{}\": rename or remove one of them, "
                        "or choose one by its whole header with --columns",
                        found->index + 1, i + 1, name));
      found = UnitColumn{i, unit};
    }
    if (found) break;
  }
  return found;
}

std::string mapped(const ColumnNames& columns, const std::string& name) {
  const auto found = columns.find(name);
  return found == columns.end() ? name : found->second;
}

double solid_fraction_of(const std::string& place, double value, bool is_void_ratio) {
  if (!is_void_ratio && value <= 0)
    throw InputError(place, fmt::format("phi = {}: expected a positive solid fraction", value));
  if (!is_void_ratio && value > 1)
    throw InputError(place, fmt::format("phi = {}: expected a solid fraction of at most 1; is it in "
                                        "percent, or a void ratio (--columns void_ratio=...)?",
                                        value));
  if (is_void_ratio && value < 0)
    throw InputError(place, fmt::format("void_ratio = {}: expected a void ratio >= 0", value));
  return is_void_ratio ? 1.0 / (1.0 + value) : value;
}

/// Returns the largest rounding error of a number that is given as text: half a unit in its last decimal place. A
/// number with fewer than three decimals is treated as if it had three, because a number such as 0.5 may be exact.
double rounding_of(std::string_view text) {
  constexpr double kThreeDecimals = 5e-4;
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  const std::string_view digits = text.substr(0, end);
  const std::size_t point = std::min(digits.find('.') + 1, digits.size());
  int exponent = point == 0 ? 0 : -static_cast<int>(digits.size() - point);
  if (end < text.size()) exponent += parse_number<int>(text.substr(end + 1)).value_or(0);
  return std::min(0.5 * std::pow(10.0, exponent), kThreeDecimals);
}

/// Reads the solid fractions of a table, from its column phi or void_ratio. If the table has both columns and
/// `--columns` names neither of them, a row whose solid fraction and void ratio contradict each other is an error.
class DensityColumns {
 public:
  DensityColumns(const CsvTable& table, const ColumnNames& columns) : table_(table) {
    const bool named_phi = columns.contains("phi"), named_void_ratio = columns.contains("void_ratio");
    const auto there = [&](const char* name, bool named, bool other_named) {
      return named || (!other_named && has_column(table, columns, name));
    };
    if (there("void_ratio", named_void_ratio, named_phi))
      void_ratio_ = share_column(find_column(table, columns, "void_ratio"));
    if (!void_ratio_ || there("phi", named_phi, named_void_ratio))
      phi_ = share_column(find_column(table, columns, "phi"));
  }

  bool has_void_ratios_alone() const { return !phi_; }
  double phi(int row) const {
    if (!phi_) return solid_fraction_of(table_.place(row), number(row, *void_ratio_), true);
    const double phi = solid_fraction_of(table_.place(row), number(row, *phi_), false);
    if (void_ratio_ && !table_.is_empty(row, void_ratio_->index)) require_same(row, phi);
    return phi;
  }

 private:
  /// A column of solid fractions or void ratios, and the factor by which its numbers are multiplied: 0.01 if its header
  /// gives the unit percent, as in "phi [%]", otherwise 1.
  struct ShareColumn {
    int index;
    double unit;
  };
  static ShareColumn share_column(const UnitColumn& column) {
    return {column.index, column.unit == "%" ? 1e-2 : 1.0};
  }
  double number(int row, const ShareColumn& column) const {
    return column.unit * table_.number(row, column.index);
  }
  double rounding(int row, const ShareColumn& column) const {
    return column.unit * rounding_of(table_.text(row, column.index));
  }

  void require_same(int row, double phi) const {
    constexpr double kArithmetic = 1e-12;
    const double e = number(row, *void_ratio_);
    const double open =
        rounding(row, *phi_) * std::abs(1.0 + e) + rounding(row, *void_ratio_) * phi + kArithmetic;
    if (std::abs(phi * (1.0 + e) - 1.0) <= open) return;
    throw InputError(
        table_.place(row),
        fmt::format("phi = {}, but void_ratio = {} corresponds to phi = {:.6g}: the two columns contradict "
                    "each other; choose one of them with --columns phi=... or --columns void_ratio=...",
                    phi, e, 1.0 / (1.0 + e)));
  }

  const CsvTable& table_;
  std::optional<ShareColumn> phi_, void_ratio_;
};

/// Checks that the pressures along each branch of a load path all grow, all fall or are all equal.
/// @param pressure  name of the column of pressures, for messages
/// @param place     function that returns where a row was read (file and line), for messages
/// @throws InputError if a pressure breaks this rule
void require_path(const std::vector<PathRow>& rows, const std::string& pressure,
                  const std::function<std::string(int)>& place) {
  if (const auto fault = path_fault(rows))
    throw InputError(place(fault->row),
                     fmt::format("{} = {}: expected {}", pressure,
                                 rows[static_cast<std::size_t>(fault->row)].P_star, fault->expected));
}

/// Adds a warning to a load path if its void ratios are all so large that they are probably percentages.
void check_for_percent(PathTable& path) {
  // Void ratios from here on are probably percentages, because even the loosest soils have only about 5.
  constexpr double kLoosest = 10.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const PathRow& row : path.rows) smallest = std::min(smallest, 1.0 / row.phi - 1.0);
  if (path.rows.empty() || smallest < kLoosest) return;
  path.inconsistencies.push_back(
      fmt::format("the void ratio is {:.4g} and more in every row: is it in percent? If it is, write the unit "
                  "into the header of the column, as in \"e [%]\"",
                  smallest));
}

/// Reads two properties of each row of a table of `floc run`: how the packing was loaded, and the ratio of the stress
/// on the driven axis to the mean stress.
class LoadColumns {
 public:
  explicit LoadColumns(const CsvTable& table) : table_(table) {
    if (!table.has("control") || !table.has("axis") || !table.has("p")) return;
    control_ = table.column("control");
    axis_ = table.column("axis");
    mean_ = table.column("p");
  }

  PathLoad load(int row) const {
    const std::string control = control_ < 0 ? "" : table_.text(row, control_);
    if (control.empty() || control == "isotropic") return PathLoad::isotropic;
    return control == "oedometric" ? PathLoad::oedometric : PathLoad::other;
  }

  /// Returns the ratio of the stress on the driven axis of a row to its mean stress. @pre the row has a driven axis
  double driven_over_mean(int row) const {
    const std::string name = fmt::format("stress_{}", static_cast<int>(table_.number(row, axis_)));
    return table_.number(row, table_.column(name)) / table_.number(row, mean_);
  }

 private:
  const CsvTable& table_;
  int control_ = -1, axis_ = -1, mean_ = -1;
};

/// Converts the reduced pressures in the column P_star of a table of `floc run` to one unit of stress. This is
/// necessary because the unit of P_star depends on the force scale of the contact law, which a stage of the load path
/// may change. All pressures are converted to the unit of the first rows under pressure.
class PressureUnit {
 public:
  /// @param name    name of the column of pressures
  /// @param mapped  whether the user chose this column with --columns; its values are then not converted
  PressureUnit(const CsvTable& table, const std::string& name, bool mapped) : table_(table) {
    if (mapped || name != "P_star" || !table.has("P") || !table.has("state")) return;
    reduced_ = table.column("P_star");
    stress_ = table.column("P");
  }

  /// Returns the factor that converts P_star of a row to the unit of the first rows. If the unit of P_star changes at
  /// this row, adds a note to `notes`.
  double factor(int row, std::vector<std::string>& notes) {
    if (reduced_ < 0) return 1.0;
    const double reduced = table_.number(row, reduced_), stress = table_.number(row, stress_);
    if (reduced == 0.0 || stress == 0.0) return 1.0;
    const double unit = stress / reduced;
    if (first_ == 0.0) first_ = last_ = unit;
    if (std::abs(unit / last_ - 1.0) > kSameUnit)
      notes.push_back(
          fmt::format("row {}: the unit of the reduced pressure P* changes from a stress of {:.6g} to one of "
                      "{:.6g}, because a "
                      "stage of the load path sets another force or stiffness of the contacts: P* is converted "
                      "to the unit of the first rows, {:.6g}",
                      row, last_, unit, first_));
    last_ = unit;
    return std::abs(unit / first_ - 1.0) > kSameUnit ? unit / first_ : 1.0;
  }

 private:
  static constexpr double kSameUnit = 1e-9;
  const CsvTable& table_;
  int reduced_ = -1, stress_ = -1;
  // Units of P_star (stress): in the first rows under pressure, and in the row for which factor() was called last.
  double first_ = 0.0, last_ = 0.0;
};

}  // namespace

UnitColumn find_column(const CsvTable& table, const ColumnNames& columns, const std::string& name) {
  if (const auto found = find_optional_column(table, mapped(columns, name))) return *found;
  return {table.column(mapped(columns, name)), ""};
}

bool has_column(const CsvTable& table, const ColumnNames& columns, const std::string& name) {
  return find_optional_column(table, mapped(columns, name)).has_value();
}

std::vector<std::string> tables_of(const std::string& input) {
  namespace fs = std::filesystem;
  if (input == "-" || !fs::is_directory(input)) return {input};
  const fs::path own = fs::path(input) / "path.csv";
  if (fs::exists(own)) {
    require_one_ensemble({input});
    return {own.string()};
  }
  std::map<std::pair<std::size_t, std::string>, std::string> by_seed;
  for (const auto& entry : fs::directory_iterator(input)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("seed-") && fs::exists(entry.path() / "path.csv"))
      by_seed[{name.size(), name}] = (entry.path() / "path.csv").string();
  }
  if (by_seed.empty()) throw InputError(input, "this directory contains neither path.csv nor seed-N/path.csv");
  std::vector<std::string> tables, samples;
  for (const auto& [seed, table] : by_seed) {
    tables.push_back(table);
    samples.push_back(fs::path(table).parent_path().string());
  }
  require_one_ensemble(samples);
  return tables;
}

PathTable read_path(const std::string& file, const ColumnNames& columns,
                    const std::vector<std::string>& pressures, OedometerPressure oedometer) {
  PathTable path{file == "-" ? "stdin" : file, {}, "", CsvTable::read(file)};
  const CsvTable& table = path.table;
  const auto has = [&](const std::string& name) { return has_column(table, columns, name); };
  const auto found = std::find_if(pressures.begin(), pressures.end(), has);
  const std::string& name = found == pressures.end() ? pressures.back() : *found;
  const UnitColumn pressure = find_column(table, columns, name);
  const DensityColumns density(table, columns);
  const bool has_branch = columns.contains("branch") || has_column(table, columns, "branch");
  const int branch = has_branch ? find_column(table, columns, "branch").index : -1;
  path.unit = pressure.unit;
  const LoadColumns loads(table);
  PressureUnit unit(table, name, columns.contains(name));
  for (int i = 0; i < table.n_rows(); ++i) {
    const PathLoad load = loads.load(i);
    double P = table.number(i, pressure.index) * unit.factor(i, path.notes);
    double driven_over_mean = 1.0;
    if (load == PathLoad::other)
      P = std::max(P, 0.0);  // cohesive grains may be under tension, which counts as pressure 0
    if (load == PathLoad::oedometric) {
      driven_over_mean = loads.driven_over_mean(i);
      if (oedometer == OedometerPressure::driven) P *= driven_over_mean;
      path.stress = oedometer == OedometerPressure::driven ? "driven" : "mean";
    }
    if (P < 0) throw InputError(table.place(i), fmt::format("{} = {}: expected a pressure >= 0", name, P));
    path.rows.push_back({branch >= 0 ? table.text(i, branch) : "", P, density.phi(i), load, driven_over_mean});
  }
  if (density.has_void_ratios_alone()) check_for_percent(path);
  if (!path.stress.empty())
    path.notes.push_back(fmt::format(
        "in rows of an oedometer test, the reduced pressure P* is computed from the {} stress", path.stress));
  require_path(path.rows, name, [&table](int row) { return table.place(row); });
  return path;
}

void convert_pressures(const PathTable& to, PathTable& path) {
  const double factor = unit_factor(path.name, path.unit, to.name, to.unit);
  path.unit = to.unit;
  if (factor == 1.0) return;
  for (PathRow& row : path.rows) row.P_star *= factor;
}

PathTable path_of_arrays(const PathArrays& arrays) {
  PathTable path;
  path.name = arrays.name;
  const auto place = [&arrays](int row) { return fmt::format("{}[{}]", arrays.name, row); };
  for (std::size_t i = 0; i < arrays.pressure.size(); ++i) {
    const std::string here = place(static_cast<int>(i));
    if (!(arrays.pressure[i] >= 0))
      throw InputError(here, fmt::format("pressure = {}: expected a pressure >= 0", arrays.pressure[i]));
    path.rows.push_back({arrays.branch.empty() ? "" : arrays.branch[i], arrays.pressure[i],
                         solid_fraction_of(here, arrays.density[i], arrays.is_void_ratio)});
  }
  require_path(path.rows, "pressure", place);
  return path;
}

std::string ranges(const std::vector<int>& rows) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t j = i;
    while (j + 1 < rows.size() && rows[j + 1] == rows[j] + 1) ++j;
    parts.push_back(i == j ? fmt::format("{}", rows[i]) : fmt::format("{}-{}", rows[i], rows[j]));
    i = j + 1;
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace floc
