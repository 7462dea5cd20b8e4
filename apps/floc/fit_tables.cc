#include "fit_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "command.h"
#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/run/one_run.h"
#include "output.h"
#include "printed_columns.h"

namespace floc {
namespace {

/// "sigma [kPa]" or "sigma (kPa)" -> name and unit.
std::pair<std::string, std::string> name_and_unit(const std::string& header) {
  const std::size_t open = header.find_first_of("[(");
  const bool has_unit = open != std::string::npos && open > 0 && (header.back() == ']' || header.back() == ')');
  if (!has_unit) return {header, ""};
  return {std::string(trimmed(header.substr(0, open))), header.substr(open + 1, header.size() - open - 2)};
}

/// @throws InputError if two columns have the name
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
            fmt::format("columns {} and {} are both named \"{}\": rename or remove one of them, or "
                        "name the one that counts by its whole header with --columns",
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

/// How far a number may be from what was rounded to it: half a unit in its last place, or of three decimals where
/// it has fewer, as 0.5 may be exact.
double rounding_of(std::string_view text) {
  constexpr double kThreeDecimals = 5e-4;
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  const std::string_view digits = text.substr(0, end);
  const std::size_t point = std::min(digits.find('.') + 1, digits.size());
  int exponent = point == 0 ? 0 : -static_cast<int>(digits.size() - point);
  if (end < text.size()) exponent += parse_number<int>(text.substr(end + 1)).value_or(0);
  return std::min(0.5 * std::pow(10.0, exponent), kThreeDecimals);
}

/// The solid fractions of a table, from phi or void_ratio: the one that `--columns` names, or both, which may not
/// contradict each other.
class DensityColumns {
 public:
  DensityColumns(const CsvTable& table, const ColumnNames& columns) : table_(table) {
    const bool named_phi = columns.contains("phi"), named_void_ratio = columns.contains("void_ratio");
    const auto there = [&](const char* name, bool named, bool other_named) {
      return named || (!other_named && has_column(table, columns, name));
    };
    if (there("void_ratio", named_void_ratio, named_phi))
      void_ratio_ = find_column(table, columns, "void_ratio").index;
    if (void_ratio_ < 0 || there("phi", named_phi, named_void_ratio))
      phi_ = find_column(table, columns, "phi").index;
  }

  double phi(int row) const {
    if (phi_ < 0) return solid_fraction_of(table_.place(row), table_.number(row, void_ratio_), true);
    const double phi = solid_fraction_of(table_.place(row), table_.number(row, phi_), false);
    if (void_ratio_ >= 0 && !table_.is_empty(row, void_ratio_)) require_same(row, phi);
    return phi;
  }

 private:
  void require_same(int row, double phi) const {
    constexpr double kArithmetic = 1e-12;
    const double e = table_.number(row, void_ratio_);
    const double open = rounding_of(table_.text(row, phi_)) * std::abs(1.0 + e) +
                        rounding_of(table_.text(row, void_ratio_)) * phi + kArithmetic;
    if (std::abs(phi * (1.0 + e) - 1.0) <= open) return;
    throw InputError(
        table_.place(row),
        fmt::format("phi = {}, but void_ratio = {}, which is a phi of {:.6g}: these contradict each "
                    "other; say which column counts (--columns phi=... or --columns void_ratio=...)",
                    phi, e, 1.0 / (1.0 + e)));
  }

  const CsvTable& table_;
  int phi_ = -1, void_ratio_ = -1;
};

/// @throws InputError unless rows keep to their branches. @param place  of a row, for messages
void require_path(const std::vector<PathRow>& rows, const std::string& pressure,
                  const std::function<std::string(int)>& place) {
  if (const auto fault = path_fault(rows))
    throw InputError(place(fault->row),
                     fmt::format("{} = {}: expected {}", pressure,
                                 rows[static_cast<std::size_t>(fault->row)].P_star, fault->expected));
}

/// How the rows of a table of `floc run` are loaded, and the factor from their mean stress to the driven one.
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

  /// @pre the row is loaded with a driven axis
  double driven_over_mean(int row) const {
    const std::string name = fmt::format("stress_{}", static_cast<int>(table_.number(row, axis_)));
    return table_.number(row, table_.column(name)) / table_.number(row, mean_);
  }

 private:
  const CsvTable& table_;
  int control_ = -1, axis_ = -1, mean_ = -1;
};

}  // namespace

void add_columns_option(CommandLine app, std::string& text, const std::string& names) {
  app.add_option("--columns", text,
                 "name=column,...: columns of the table that stand for " + names +
                     "; names and patterns without = are columns to print [all; on a terminal those that fit]")
      .joined(',');
}

ColumnNames parse_column_names(const std::string& text, const std::vector<std::string>& names) {
  ColumnNames columns;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    const std::string_view item = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::size_t equals = item.find('=');
    const std::string name(trimmed(item.substr(0, equals)));
    if (equals == std::string_view::npos && !name.empty()) {
      choose_column(name);
      continue;
    }
    if (name.empty() || trimmed(item.substr(equals + 1)).empty() ||
        std::find(names.begin(), names.end(), name) == names.end())
      throw InputError("--columns", fmt::format("\"{}\", expected name=column with name one of {}", item,
                                                fmt::join(names, ", ")));
    if (!columns.emplace(name, trimmed(item.substr(equals + 1))).second)
      throw InputError("--columns", fmt::format("{} is given twice", name));
  }
  check_chosen_columns();
  return columns;
}

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
  if (by_seed.empty()) throw InputError(input, "holds neither path.csv nor seed-N/path.csv");
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
  for (int i = 0; i < table.n_rows(); ++i) {
    const PathLoad load = loads.load(i);
    double P = table.number(i, pressure.index);
    if (load == PathLoad::other) P = std::max(P, 0.0);  // which cohesive grains may carry as tension
    if (load == PathLoad::oedometric && oedometer == OedometerPressure::driven) P *= loads.driven_over_mean(i);
    if (P < 0) throw InputError(table.place(i), fmt::format("{} = {}: expected a pressure >= 0", name, P));
    path.rows.push_back({branch >= 0 ? table.text(i, branch) : "", P, density.phi(i), load});
  }
  require_path(path.rows, name, [&table](int row) { return table.place(row); });
  return path;
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

int for_each_table(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string& file)>& work) {
  int code = kDone;
  for (const std::string& input : inputs) {
    try {
      for (const std::string& table : tables_of(input)) code = worse(code, work(table));
    } catch (const InputError& error) {
      std::cerr << "floc: " << error.what() << '\n';
      code = worse(code, kBadInput);
    }
  }
  return code;
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
