#include "floc/tables/path_density.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/infinity.h"
#include "floc/base/parse_number.h"
#include "floc/io/table_units.h"

namespace floc {
namespace {

/// A quantity from which solid fractions are computed.
struct Density {
  const char* name;      ///< name of the quantity in floc and in tables
  const char* words;     ///< name of the quantity in messages
  const char* measures;  ///< dimension: "density", "length" or "share" (ratio, may be in percent)

  bool is_share() const { return measures == std::string_view("share"); }
};

constexpr auto kDensities = std::to_array<Density>({{"phi", "solid fraction", "share"},
                                                    {"void_ratio", "void ratio", "share"},
                                                    {"porosity", "porosity", "share"},
                                                    {"specific_volume", "specific volume", "share"},
                                                    {"dry_density", "dry density", "density"},
                                                    {"bulk_density", "bulk density", "density"},
                                                    {"axial_strain", "axial strain", "share"},
                                                    {"height", "height", "length"}});

/// Column of the table that contains a density, with the factor by which its numbers are multiplied.
struct DensityColumn {
  Density density;
  UnitColumn column;
  double factor = 1.0;

  bool is(const char* name) const { return density.name == std::string_view(name); }
};

/// Returns the largest rounding error of a number in a text: half a unit in the last decimal place of the number. A
/// number with fewer than three decimals, such as 0.5, is treated as if it had three decimals, because it may be exact.
double rounding_of(std::string_view text) {
  constexpr double kThreeDecimals = 5e-4;
  const std::size_t end = std::min(text.find_first_of("eE"), text.size());
  const std::string_view digits = text.substr(0, end);
  const std::size_t point = std::min(digits.find('.') + 1, digits.size());
  int exponent = point == 0 ? 0 : -static_cast<int>(digits.size() - point);
  if (end < text.size()) exponent += parse_number<int>(text.substr(end + 1)).value_or(0);
  return std::min(0.5 * std::pow(10.0, exponent), kThreeDecimals);
}

/// Returns the smallest and the largest number in a column. @pre the table has rows
std::pair<double, double> range_of(const CsvTable& table, int column) {
  double least = table.number(0, column), most = least;
  for (int row = 1; row < table.n_rows(); ++row) {
    const double value = table.number(row, column);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return {least, most};
}

std::string percent_question(const std::string& name, const std::string& header) {
  const std::string item = fmt::format("{}={}", name, name_and_unit(header).first);
  return fmt::format("is it in percent? Answer yes with --columns \"{} [%]\", or no with --columns \"{} [1]\"",
                     item, item);
}

/// Returns advice for a solid fraction above 1 that is possible for a powder measured in a die under load. Returns an
/// empty text for other solid fractions.
std::string advice_for_die(double phi) {
  if (!(phi > 1.0 && phi <= largest_solid_fraction(kInfinity))) return "";
  return "; if this density was measured in a die under load, where elastic strain may raise it above the "
         "density of the solid, give --phi-limit none";
}

/// Reads the solid fractions of one table.
class DensityReader {
 public:
  DensityReader(const NamedColumns& columns, double phi_limit)
      : columns_(columns), table_(columns.table()), phi_limit_(phi_limit), main_(main_column()) {
    read_factor_of_share();
    read_references();
  }

  SolidFractions read() const {
    SolidFractions read;
    const std::optional<DensityColumn> second = second_column();
    for (int row = 0; row < table_.n_rows(); ++row) {
      read.phi.push_back(phi(row));
      if (second && !table_.is_empty(row, second->column.index)) require_same(row, read.phi.back(), *second);
    }
    read.words = main_.density.words;
    if (!main_.column.unit.empty()) read.words += " in " + main_.column.unit;
    if (!reference_words_.empty()) read.words += fmt::format(" ({})", fmt::join(reference_words_, ", "));
    return read;
  }

 private:
  /// Returns whether all numbers are given that are needed to convert the density `name` to a solid fraction.
  bool is_complete(const std::string& name) const {
    const auto known = [this](const char* of) { return columns_.given_number(of) || columns_.has(of); };
    if (name == "dry_density" || name == "bulk_density") return known("particle_density");
    if (name == "axial_strain") return known("initial_void_ratio");
    return name != "height" || known("initial_void_ratio") || known("solid_height");
  }

  DensityColumn main_column() const {
    const auto is_named = [this](const Density& density) { return columns_.is_named(density.name); };
    const bool any_named = std::any_of(kDensities.begin(), kDensities.end(), is_named);
    std::string almost;  // reasons why columns of a density cannot be used
    for (const Density& density : kDensities) {
      if (any_named && !is_named(density)) continue;
      const auto column = columns_.find(density.name);
      if (!column) continue;
      if (!is_of(density, *column))
        almost += fmt::format("; the column \"{}\" has the name of a {}, but not its unit", header(*column),
                              density.words);
      else if (is_complete(density.name))
        return {density, *column};
      else
        almost += what_is_missing(density, *column);
    }
    throw InputError(table_.place(), fmt::format("the table has no column \"phi\", and no column of a void "
                                                 "ratio, porosity or other density; its columns are {}{}",
                                                 fmt::join(table_.columns(), ", "), almost));
  }

  /// Returns whether a column contains a density: the user has named the column for the density, or the header is the
  /// name that floc uses for the density. If the header is another usual name of the density, the unit must be absent
  /// or be a unit of the density. For example, the diameter "D [mm]" of a tablet is not a relative density.
  bool is_of(const Density& density, const UnitColumn& column) const {
    if (columns_.is_named(density.name) || columns_.find_exactly(density.name)) return true;
    return column.unit.empty() || quantity_of_unit(column.unit) == density.measures;
  }

  std::string what_is_missing(const Density& density, const UnitColumn& column) const {
    const std::string_view name = density.name;
    const char* needed = name == "axial_strain" ? "initial_void_ratio=NUMBER"
                         : name == "height"     ? "initial_void_ratio=NUMBER or solid_height=NUMBER"
                                                : "particle_density=NUMBER";
    return fmt::format("; the column \"{}\" ({}) could be used with --columns {}", header(column),
                       density.words, needed);
  }

  /// If the table has columns of both void ratios and solid fractions, returns the column of void ratios; the two
  /// columns must agree. Returns nothing if one of the columns is missing, or if the user has named only one of them.
  std::optional<DensityColumn> second_column() const {
    const bool phi = columns_.is_named("phi"), void_ratio = columns_.is_named("void_ratio");
    if (!main_.is("phi") || phi != void_ratio) return std::nullopt;
    const auto column = columns_.find("void_ratio");
    if (!column) return std::nullopt;
    return DensityColumn{kDensities[1], *column, share_of_one(place_of(*column), column->unit)};
  }

  /// Reads the reference values of the density: the density of the grains, or the state of the sample before the test.
  void read_references() {
    if (main_.is("dry_density") || main_.is("bulk_density")) {
      const GivenNumber particles = reference("particle_density", "particle density");
      const std::string& unit = particles.unit.empty() ? main_.column.unit : particles.unit;
      main_.factor =
          unit_factor(place_of(main_.column), main_.column.unit, "particle_density", unit) / particles.value;
    }
    if (main_.is("axial_strain")) initial_ = 1.0 + reference("initial_void_ratio", "initial void ratio").value;
    if (main_.is("height")) main_.factor = 1.0 / height_of_grains();
  }

  double height_of_grains() {
    const auto in_unit_of_column = [this](const GivenNumber& length) {
      if (length.unit.empty()) return length.value;
      return length.value * unit_factor("--columns", length.unit, place_of(main_.column), main_.column.unit);
    };
    if (columns_.given_number("solid_height") || columns_.has("solid_height"))
      return in_unit_of_column(reference("solid_height", "height of the grains"));
    const double e = reference("initial_void_ratio", "initial void ratio").value;
    double height = table_.n_rows() > 0 ? table_.number(0, main_.column.index) : 1.0;
    if (columns_.given_number("initial_height") || columns_.has("initial_height"))
      height = in_unit_of_column(reference("initial_height", "initial height"));
    return height / (1.0 + e);
  }

  /// Returns a number that is the same for all rows: the number given by the user or, without such a number, the first
  /// number in the column `name`.
  GivenNumber reference(const char* name, const char* words) {
    GivenNumber number{0.0, ""};
    if (const auto given = columns_.given_number(name)) {
      number = *given;
    } else {
      const UnitColumn column = columns_.unit_column(name);
      if (table_.n_rows() > 0) number = {table_.number(0, column.index), column.unit};
    }
    if (number.value <= 0.0 && table_.n_rows() > 0)
      throw InputError("--columns", fmt::format("{} = {}: expected a positive number", name, number.value));
    reference_words_.push_back(
        fmt::format("{} {}{}{}", words, number.value, number.unit.empty() ? "" : " ", number.unit));
    return number;
  }

  double phi(int row) const {
    const double value = table_.number(row, main_.column.index) * main_.factor;
    const std::string place = table_.place(row);
    if (main_.is("phi") || main_.is("void_ratio"))
      return solid_fraction_of(place, value, main_.is("void_ratio"), phi_limit_);
    if (main_.is("porosity")) return in_range(row, 1.0 - value, "a porosity from 0 to 1");
    if (main_.is("specific_volume")) return in_range(row, 1.0 / value, "a specific volume of at least 1");
    if (main_.is("axial_strain"))
      return in_range(row, 1.0 / (initial_ * (1.0 - value)),
                      "an axial strain, positive in compression, at which the solid fraction is at most 1");
    if (main_.is("height")) return in_range(row, 1.0 / value, "a height of at least the height of the grains");
    return in_range(row, value, "a density up to the density of the particles");
  }

  /// Returns `phi` if it is a possible solid fraction.
  /// @throws InputError if `phi` is not possible; the message names the cell from which `phi` was computed
  double in_range(int row, double phi, const char* expected) const {
    if (phi > 0.0 && phi <= largest_solid_fraction(phi_limit_)) return phi;
    throw InputError(table_.place(row), fmt::format("{} = {}: expected {}; {}{}", main_.density.name,
                                                    table_.text(row, main_.column.index), expected, question(),
                                                    advice_for_die(phi)));
  }

  void read_factor_of_share() {
    if (!main_.density.is_share()) return;
    main_.factor = factor_of_share(columns_, main_.density.name);
    if (!main_.is("axial_strain") || table_.n_rows() == 0) return;
    const auto [least, most] = range_of(table_, main_.column.index);
    if (most > 0.0 || least == 0.0) return;
    main_.factor *= -1.0;
    reference_words_.emplace_back("negative in compression");
  }

  std::string question() const {
    return main_.density.is_share() ? percent_question(main_.density.name, header(main_.column))
                                    : "are the unit of the column and the reference values right?";
  }

  void require_same(int row, double phi, const DensityColumn& void_ratio) const {
    constexpr double kArithmetic = 1e-12;
    const auto rounding = [&](const DensityColumn& of) {
      return of.factor * rounding_of(table_.number_text(row, of.column.index));
    };
    const double e = void_ratio.factor * table_.number(row, void_ratio.column.index);
    const double open = rounding(main_) * std::abs(1.0 + e) + rounding(void_ratio) * phi + kArithmetic;
    if (std::abs(phi * (1.0 + e) - 1.0) <= open) return;
    throw InputError(
        table_.place(row),
        fmt::format("phi = {}, but void_ratio = {} corresponds to phi = {:.6g}: the two columns contradict "
                    "each other; choose one of them with --columns phi=... or --columns void_ratio=...",
                    phi, e, 1.0 / (1.0 + e)));
  }

  const std::string& header(const UnitColumn& column) const {
    return table_.columns()[static_cast<std::size_t>(column.index)];
  }
  std::string place_of(const UnitColumn& column) const {
    return fmt::format("{}, column {}", table_.place(), header(column));
  }

  const NamedColumns& columns_;
  const CsvTable& table_;
  double phi_limit_;
  DensityColumn main_;
  double initial_ = 1.0;  // ratio of the volume of the sample to the volume of its grains before the test
  std::vector<std::string> reference_words_;
};

}  // namespace

std::vector<std::string> density_names() {
  std::vector<std::string> names;
  for (const Density& density : kDensities) names.emplace_back(density.name);
  for (const char* name : {"particle_density", "initial_void_ratio", "initial_height", "solid_height"})
    names.emplace_back(name);
  return names;
}

double factor_of_share(const NamedColumns& columns, const std::string& name) {
  const CsvTable& table = columns.table();
  const UnitColumn column = columns.unit_column(name);
  const std::string& header = table.columns()[static_cast<std::size_t>(column.index)];
  const double factor = share_of_one(fmt::format("{}, column {}", table.place(), header), column.unit);
  if (column.unit_is_given || table.n_rows() == 0) return factor;
  const auto refuse = [&](const std::string& words) {
    throw InputError(table.place(0), fmt::format("{} is {}: {}", name, words, percent_question(name, header)));
  };
  const bool is_strain = name == "axial_strain";
  auto [least, most] = range_of(table, column.index);
  if (is_strain && most <= 0.0) std::tie(least, most) = std::pair(-most, -least);
  // Void ratios of soils are below 5, void ratios of peat and of the loosest powders below 20. Solid fractions above 1
  // are refused later, in a message that names the row.
  constexpr double kLoose = 10.0, kLoosest = 30.0;
  const bool has_no_bound = name == "void_ratio" || name == "e" || name == "specific_volume";
  if (factor == 1.0 && has_no_bound && least >= kLoose)
    refuse(fmt::format("{:.4g} and more in every row", least));
  if (factor == 1.0 && name != "phi" && most > (has_no_bound ? kLoosest : 1.0))
    refuse(fmt::format("{:.4g} in at least one row", most));
  // A strain below one percent is possible, but a solid fraction below one percent is not.
  if (factor < 1.0 && !is_strain && most <= 1.0)
    refuse(fmt::format("at most {:.4g} {}, according to the header", most, column.unit));
  return factor;
}

SolidFractions solid_fractions(const NamedColumns& columns, double phi_limit) {
  return DensityReader(columns, phi_limit).read();
}

double largest_solid_fraction(double phi_limit) {
  constexpr double kSolid = 1.0, kMost = 1.5;
  return std::clamp(phi_limit, kSolid, kMost);
}

double solid_fraction_of(const std::string& place, double value, bool is_void_ratio, double phi_limit) {
  const double most = largest_solid_fraction(phi_limit), phi = is_void_ratio ? 1.0 / (1.0 + value) : value;
  if (!is_void_ratio && value <= 0)
    throw InputError(place, fmt::format("phi = {}: expected a positive solid fraction", value));
  if (!is_void_ratio && value > most)
    throw InputError(place, fmt::format("phi = {}: expected a solid fraction of at most {:g}; is it in "
                                        "percent (--columns \"phi=... [%]\"), or a void ratio (--columns "
                                        "void_ratio=...)?{}",
                                        value, most, advice_for_die(phi)));
  if (is_void_ratio && !(value > -1.0 && phi <= most))
    throw InputError(place, fmt::format("void_ratio = {}: expected a void ratio >= {:.3g}{}", value,
                                        1.0 / most - 1.0, advice_for_die(phi)));
  return phi;
}

}  // namespace floc
