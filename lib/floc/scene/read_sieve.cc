#include "floc/scene/read_sieve.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>

#include "floc/base/error.h"
#include "floc/io/csv.h"
#include "floc/io/table_columns.h"
#include "floc/io/table_units.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// Rows of a sieve analysis as the user gives them, and the place of these rows, for messages.
struct Sieves {
  std::string place;
  std::vector<double> sizes;    ///< sizes of the openings (unit of the scene)
  std::vector<double> passing;  ///< percentage of the mass that passes each sieve
  std::vector<int> lines;       ///< line of each row in the file; empty for arrays in the scene

  std::string place_of(std::size_t row) const {
    return lines.empty() ? place : fmt::format("{}:{}", place, lines[row]);
  }
};

/// Returns the factor by which the column of sizes is multiplied to obtain lengths in the unit of the scene.
/// @param scaled  whether the key `scale` is given
double length_factor(const CsvTable& table, const UnitColumn& column, const std::string& units, bool scaled) {
  const std::string place =
      fmt::format("{}, column {}", table.place(), table.columns()[static_cast<std::size_t>(column.index)]);
  if (units == "SI") return unit_factor(place, column.unit, "the scene", "m");
  if (!column.unit.empty() && !scaled)
    throw InputError(place,
                     fmt::format("the sizes are in {}, but the scene is in reduced units: expected the key "
                                 "grains.diameter.scale, the number by which sizes are multiplied, for "
                                 "example the reciprocal of the largest size",
                                 column.unit));
  return 1.0;
}

/// Returns the factor that converts the column of passing masses to percent.
double percent_factor(const CsvTable& table, const UnitColumn& column) {
  const std::string& header = table.columns()[static_cast<std::size_t>(column.index)];
  if (!column.unit.empty())
    return 100.0 * share_of_one(fmt::format("{}, column {}", table.place(), header), column.unit);
  // If the unit is [-] or another sign for pure numbers, the numbers of the column are fractions. A column without a
  // unit contains percentages.
  const bool are_fractions =
      name_and_unit(header).first != header || states_no_unit(table.unit_cell(column.index));
  return are_fractions ? 100.0 : 1.0;
}

/// Returns the column of the quantity `name`. Its header may be any accepted name of this quantity.
/// @throws InputError that names the content of the missing column and the existing columns
UnitColumn column_of(const NamedColumns& columns, const std::string& name, const char* content,
                     const char* names) {
  if (const auto found = columns.find(name)) return *found;
  const CsvTable& table = columns.table();
  throw InputError(table.place(),
                   fmt::format("there is no column with {}: expected one with a name such as {}, but "
                               "the columns are {}",
                               content, names, fmt::join(table.columns(), ", ")));
}

Sieves read_sieve_file(const std::string& path, const std::string& units, bool scaled) {
  const CsvTable table = CsvTable::read(path, {"sieve_size", "passing"});
  const NamedColumns columns(table, {});
  const UnitColumn size = column_of(columns, "sieve_size", "the sizes of the sieves", "size, sieve or opening");
  const UnitColumn passing =
      column_of(columns, "passing", "the percentage of the mass that passes", "passing or finer");
  const double length = length_factor(table, size, units, scaled), percent = percent_factor(table, passing);
  Sieves sieves{path, {}, {}, {}};
  for (int row = 0; row < table.n_rows(); ++row) {
    sieves.sizes.push_back(length * table.number(row, size.index));
    sieves.passing.push_back(percent * table.number(row, passing.index));
    sieves.lines.push_back(table.line(row));
  }
  return sieves;
}

std::optional<Sieves> read_rows(TableReader& t, SceneSource& source, const std::string& directory,
                                const std::string& units, bool scaled) {
  if (!t.has("sizes") && !t.has("passing")) {
    const auto file =
        t.text("file",
               "the name of a file with the sizes of sieves and the percentages of the mass that pass "
               "them, or the arrays sizes and passing");
    if (!file) return std::nullopt;
    const std::string path = (std::filesystem::path(directory) / *file).string();
    try {
      return read_sieve_file(path, units, scaled);
    } catch (const InputError& error) {
      source.fault_at("", error.what());
      return std::nullopt;
    }
  }
  Sieves sieves;
  sieves.place = t.path();
  for (const auto& [key, values] : {std::pair{"sizes", &sieves.sizes}, {"passing", &sieves.passing}}) {
    if (!t.has(key)) t.fault(key, fmt::format("{} is missing: expected an array of numbers", t.path_of(key)));
    *values = t.numbers(key, {[](double) { return true; }, "an array of numbers"});
  }
  if (sieves.sizes.empty() || sieves.passing.empty()) return std::nullopt;
  if (sieves.sizes.size() != sieves.passing.size()) {
    t.fault("passing",
            fmt::format("{} has {} numbers, but {} has {}: expected equally many", t.path_of("passing"),
                        sieves.passing.size(), t.path_of("sizes"), sieves.sizes.size()));
    return std::nullopt;
  }
  return sieves;
}

/// Sorts the rows by size, because tables of sieves may begin with the finest or with the coarsest sieve.
void sort_by_size(Sieves& sieves) {
  std::vector<std::size_t> order(sieves.sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t j) { return sieves.sizes[i] < sieves.sizes[j]; });
  Sieves sorted{sieves.place, {}, {}, {}};
  for (const std::size_t row : order) {
    sorted.sizes.push_back(sieves.sizes[row]);
    sorted.passing.push_back(sieves.passing[row]);
    if (!sieves.lines.empty()) sorted.lines.push_back(sieves.lines[row]);
  }
  sieves = std::move(sorted);
}

/// Returns the place and the message of the first fault in rows sorted by size; std::nullopt if the rows form a valid
/// grading curve.
std::optional<std::pair<std::string, std::string>> fault_of(const Sieves& s) {
  const auto at = [&](std::size_t row, std::string words) {
    return std::pair{s.place_of(row), std::move(words)};
  };
  for (std::size_t k = 0; k < s.sizes.size(); ++k) {
    // The comparisons are negated so that NaN is refused, too; TOML allows nan as a number.
    if (!(s.sizes[k] > 0.0))
      return at(k,
                fmt::format("the size of a sieve is {:g}: expected a positive size. Between sizes the curve is "
                            "linear in the logarithm of the size, so for the pan give the largest size that "
                            "all grains exceed, with 0 % passing",
                            s.sizes[k]));
    if (!(s.passing[k] >= 0.0 && s.passing[k] <= 100.0))
      return at(
          k, fmt::format("{:g} % of the mass pass the sieve of size {:g}: expected a percentage from 0 to 100",
                         s.passing[k], s.sizes[k]));
    if (k == 0) continue;
    // The rows are sorted by size. Equal sizes are therefore in adjacent rows, and the percentages are in order if they
    // are in order between adjacent rows.
    if (s.sizes[k] == s.sizes[k - 1])
      return at(k, fmt::format("two rows have the size {:g}: expected one row for each sieve", s.sizes[k]));
    if (s.passing[k] < s.passing[k - 1])
      return at(
          k, fmt::format("{:g} % of the mass pass the sieve of size {:g}, but {:g} % pass the finer sieve of "
                         "size {:g}: expected the percentage of the whole mass that is finer than each sieve, "
                         "which does not decrease with the size (not the percentage that each sieve retains)",
                         s.passing[k], s.sizes[k], s.passing[k - 1], s.sizes[k - 1]));
  }
  if (s.sizes.size() < 2)
    return std::pair{s.place, std::string("there is one sieve: expected at least two rows")};
  return std::nullopt;
}

/// Records a fault if an end of the curve is open. The lower end is open if the curve does not begin at 0 % and the key
/// min is not given. The upper end is open if the curve does not end at 100 % and the key max is not given.
/// @return whether a fault was recorded
bool has_open_end(const Sieves& s, bool has_min, bool has_max, SceneSource& source) {
  const std::size_t last = s.sizes.size() - 1;
  if (s.passing.front() > 0.0 && !has_min)
    source.fault_at(s.place_of(0),
                    fmt::format("{:g} % of the mass are finer than the finest sieve, {:g}: expected a row for "
                                "the largest size that all grains exceed, with 0 % passing, or the key "
                                "grains.diameter.min, below which grains are left out",
                                s.passing.front(), s.sizes.front()));
  if (s.passing.back() < 100.0 && !has_max)
    source.fault_at(
        s.place_of(last),
        fmt::format("only {:g} % of the mass pass the coarsest sieve, {:g}: expected a row for the size "
                    "that all grains pass, with 100 % (fractions need the header [-]), or the key "
                    "grains.diameter.max, above which grains are left out",
                    s.passing.back(), s.sizes.back()));
  return (s.passing.front() > 0.0 && !has_min) || (s.passing.back() < 100.0 && !has_max);
}

/// Returns the smallest and the largest size of the range that contains mass: the last size with 0 % and the first size
/// with 100 %.
std::pair<double, double> ends_of(const Sieves& s) {
  double low = s.sizes.front(), high = s.sizes.back();
  for (std::size_t k = 0; k < s.sizes.size(); ++k)
    if (s.passing[k] <= s.passing.front()) low = s.sizes[k];
  for (std::size_t k = s.sizes.size(); k-- > 0;)
    if (s.passing[k] >= s.passing.back()) high = s.sizes[k];
  return {low, high};
}

}  // namespace

void read_sieve(TableReader& t, SceneSource& source, const std::string& directory, const std::string& units,
                DiameterDistribution& d) {
  constexpr NumberRule kLength{positive, "a positive number (length)"};
  const auto scale = t.number(
      "scale", {positive, "a positive number, by which the sizes of sieves are multiplied"}, Need::optional);
  const auto min = t.number("min", kLength, Need::optional), max = t.number("max", kLength, Need::optional);
  std::optional<Sieves> sieves = read_rows(t, source, directory, units, scale.has_value());
  if (!sieves) return;
  for (double& size : sieves->sizes) size *= scale.value_or(1.0);
  sort_by_size(*sieves);
  if (const auto fault = fault_of(*sieves)) return source.fault_at(fault->first, fault->second);
  if (has_open_end(*sieves, min.has_value(), max.has_value(), source)) return;
  d.curve = {sieves->sizes, sieves->passing};
  const auto [low, high] = ends_of(*sieves);
  for (const auto& [key, cut] : {std::pair{"min", min}, {"max", max}})
    if (cut && !(*cut >= low && *cut <= high)) {
      t.fault(key, fmt::format("{} = {:g}: expected a size within the curve, from {:g} to {:g}", t.path_of(key),
                               *cut, low, high));
      return;
    }
  d.min = min.value_or(low);
  d.max = max.value_or(high);
  if (!(d.min < d.max) || passing_at(d.curve, d.min) >= passing_at(d.curve, d.max))
    return t.fault("min", fmt::format("no grains are between the sizes {:g} and {:g}: expected a wider range",
                                      d.min, d.max));
  // A complete curve is left unchanged to the last bit, so that a scene that contains the rows of the file gives the
  // same grains.
  if (min || max) d.curve = cut_curve(d.curve, d.min, d.max);
}

}  // namespace floc
