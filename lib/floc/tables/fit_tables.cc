#include "floc/tables/fit_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>

#include "floc/base/error.h"
#include "floc/io/table_units.h"
#include "floc/run_directory/one_run.h"
#include "floc/tables/path_density.h"

namespace floc {
namespace {

/// Checks the pressures along each branch of a load path: they must all increase, all decrease, or all be equal.
/// @param pressure  name of the column of pressures, for messages
/// @param place     function that returns the place (file and line) of a row, for messages
/// @throws InputError if a pressure breaks this rule
void require_path(const std::vector<PathRow>& rows, const std::string& pressure,
                  const std::function<std::string(int)>& place) {
  if (const auto fault = path_fault(rows))
    throw InputError(place(fault->row),
                     fmt::format("{} = {}: expected {}", pressure,
                                 rows[static_cast<std::size_t>(fault->row)].P_star, fault->expected));
}

/// Reads a table of `floc run`. For each row, gives two properties: how the packing was loaded, and the ratio of the
/// stress on the driven axis to the mean stress.
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

  /// Returns the ratio of the stress on the driven axis to the mean stress in a row. @pre the row has a driven axis
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
  /// @param mapped  whether the user chose this column with --columns; if so, its values are not converted
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
          fmt::format("row {}: the unit of the reduced pressure P* changes from a stress of {:.6g} to a stress "
                      "of {:.6g}, because a stage of the load path sets another force or stiffness of the "
                      "contacts: P* is converted to the unit of the first rows, {:.6g}",
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

/// Names of the columns of a load path other than the pressure.
std::vector<std::string> path_names() {
  std::vector<std::string> names = density_names();
  names.emplace_back("branch");
  return names;
}

/// @throws InputError if the column has a known unit that is not a unit of pressure
void require_unit_of_pressure(const CsvTable& table, const UnitColumn& pressure) {
  const std::string measures = quantity_of_unit(pressure.unit);
  if (measures.empty() || measures == "pressure" || measures.starts_with("force")) return;
  throw InputError(table.place(),
                   fmt::format("the pressures in column \"{}\" have the unit {}: expected a unit of "
                               "pressure, such as kPa",
                               table.columns()[static_cast<std::size_t>(pressure.index)], pressure.unit));
}

/// Returns a summary of a table that was read as a load path, in one line.
std::string reading_of(const PathTable& path, const std::string& density) {
  const int n_reversals = count_reversals(path.rows);
  const std::string description = path.table.description();
  return fmt::format("read {}: pressure{}, {}; {} reversal{}{}{}", path.table.rows_in_words(),
                     path.unit.empty() ? "" : " in " + path.unit, density, n_reversals,
                     n_reversals == 1 ? "" : "s", description.empty() ? "" : "; ", description);
}

/// Adds two notes to a path. The first note lists the rows that are left out because the next row has the same
/// pressure. The second note names the stress that is used as the pressure in rows of oedometer tests.
void add_notes(PathTable& path) {
  if (const std::vector<int> rows = superseded_rows(path.rows); !rows.empty())
    path.notes.push_back(
        fmt::format("{} row{} the pressure of the next row, as in a hold (creep) or at a reversal of the load: "
                    "of successive rows at one pressure, only the last is used (row numbers left out: {})",
                    rows.size(), rows.size() == 1 ? " has" : "s have", ranges(rows)));
  if (!path.stress.empty())
    path.notes.push_back(fmt::format(
        "in rows of an oedometer test, the reduced pressure P* is computed from the {} stress", path.stress));
}

}  // namespace

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

std::pair<std::string, UnitColumn> pressure_column(const NamedColumns& columns,
                                                   const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (columns.is_named(name)) return {name, columns.unit_column(name)};
  for (const std::string& name : names)
    if (const auto found = columns.find_exactly(name)) return {name, *found};
  return {names.back(), columns.unit_column(names.back())};
}

PathTable read_path(const std::string& file, const ColumnNames& columns,
                    const std::vector<std::string>& pressures, OedometerPressure oedometer, double phi_limit) {
  std::vector<std::string> wanted = path_names();
  wanted.insert(wanted.end(), pressures.begin(), pressures.end());
  PathTable path{file == "-" ? "stdin" : file, {}, "", CsvTable::read(file, wanted_names(wanted, columns))};
  const CsvTable& table = path.table;
  const NamedColumns named(table, columns);
  const auto [name, pressure] = pressure_column(named, pressures);
  require_unit_of_pressure(table, pressure);
  const SolidFractions density = solid_fractions(named, phi_limit);
  const int branch = named.has("branch") ? named.column("branch") : -1;
  path.unit = pressure.unit;
  const LoadColumns loads(table);
  PressureUnit unit(table, name, columns.contains(name));
  for (int i = 0; i < table.n_rows(); ++i) {
    const PathLoad load = loads.load(i);
    double P = table.number(i, pressure.index) * unit.factor(i, path.notes);
    double driven_over_mean = 1.0;
    if (load == PathLoad::other)
      P = std::max(P, 0.0);  // cohesive grains may be under tension; a negative pressure is treated as 0
    if (load == PathLoad::oedometric) {
      driven_over_mean = loads.driven_over_mean(i);
      if (oedometer == OedometerPressure::driven) P *= driven_over_mean;
      path.stress = oedometer == OedometerPressure::driven ? "driven" : "mean";
    }
    if (P < 0) throw InputError(table.place(i), fmt::format("{} = {}: expected a pressure >= 0", name, P));
    path.rows.push_back({branch >= 0 ? table.text(i, branch) : "", P, density.phi[static_cast<std::size_t>(i)],
                         load, driven_over_mean});
  }
  require_path(path.rows, name, [&table](int row) { return table.place(row); });
  path.is_of_run = table.has("state") && table.has("branch") && table.has("P_star");
  path.reading = reading_of(path, density.words);
  add_notes(path);
  return path;
}

void convert_pressures(const PathTable& to, PathTable& path) {
  const double factor = unit_factor(path.name, path.unit, to.name, to.unit);
  path.unit = to.unit;
  if (factor == 1.0) return;
  for (PathRow& row : path.rows) row.P_star *= factor;
}

PathTable path_of_arrays(const PathArrays& arrays, double phi_limit) {
  PathTable path;
  path.name = arrays.name;
  const auto place = [&arrays](int row) { return fmt::format("{}[{}]", arrays.name, row); };
  for (std::size_t i = 0; i < arrays.pressure.size(); ++i) {
    const std::string here = place(static_cast<int>(i));
    if (!(arrays.pressure[i] >= 0))
      throw InputError(here, fmt::format("pressure = {}: expected a pressure >= 0", arrays.pressure[i]));
    path.rows.push_back({arrays.branch.empty() ? "" : arrays.branch[i], arrays.pressure[i],
                         solid_fraction_of(here, arrays.density[i], arrays.is_void_ratio, phi_limit)});
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
