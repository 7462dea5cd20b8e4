#include "floc/scene/read_diameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/scene/read_sieve.h"

namespace floc {
namespace {

using Kind = DiameterDistribution::Kind;
using Need = TableReader::Need;

constexpr NumberRule kDiameter{positive, "a positive number (length)"};

/// Returns the text of a file with diameters. If the file cannot be read or is not text, a fault is recorded and
/// std::nullopt is returned.
std::optional<std::string> text_of_list(const std::string& path, TableReader& t, SceneSource& source) {
  try {
    std::string text = read_text(path);
    if (text.find('\0') == std::string::npos) return text;
    source.fault_at(path,
                    "the file is not text in UTF-8: expected diameters, separated by spaces or line ends");
  } catch (const InputError& error) {
    t.fault("file", fmt::format("{}: {}", t.path_of("file"), error.what()));
  }
  return std::nullopt;
}

std::vector<double> read_list_file(const std::string& path, TableReader& t, SceneSource& source) {
  std::vector<double> values;
  const std::optional<std::string> text = text_of_list(path, t, source);
  if (!text) return values;
  std::istringstream in(*text);
  int number = 0, n_faults = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    std::istringstream tokens(line.substr(0, line.find('#')));
    for (std::string token; tokens >> token;) {
      const auto value = parse_number<double>(token);
      if (value && *value > 0) {
        values.push_back(*value);
        continue;
      }
      ++n_faults;
      source.fault_at(fmt::format("{}:{}", path, number),
                      fmt::format("'{}' is not a diameter: expected a positive number{}", token,
                                  decimal_comma_hint(token)));
    }
  }
  if (n_faults == 0 && values.empty())
    source.fault_at(path, "the file contains no diameters: expected numbers, separated by spaces or line ends");
  return values;
}

void read_list(TableReader& t, SceneSource& source, const std::string& directory, DiameterDistribution& d) {
  if (t.has("values")) {
    d.values = t.numbers("values", {kDiameter.holds, "an array of positive numbers (length)"});
  } else if (const auto file = t.text(
                 "file", "the name of a file of diameters, which are separated by spaces or line ends")) {
    d.values = read_list_file((std::filesystem::path(directory) / *file).string(), t, source);
  }
  if (d.values.empty()) return;
  const auto [smallest, largest] = std::minmax_element(d.values.begin(), d.values.end());
  d.min = *smallest;
  d.max = *largest;
}

/// Reads the smallest and the largest diameter of a distribution (keys min and max), or its only two diameters (keys
/// small and large).
/// @param small, large  keys of the two diameters
void read_sizes(TableReader& t, const char* small, const char* large, DiameterDistribution& d) {
  d.min = t.number(small, kDiameter).value_or(0);
  d.max = t.number(large, kDiameter).value_or(0);
  if (d.min > d.max && d.max > 0)
    t.fault(small, fmt::format("grains.diameter.{} = {}: expected at most grains.diameter.{} = {}", small,
                               d.min, large, d.max));
}

void read_lognormal(TableReader& t, int dimension, DiameterDistribution& d) {
  const double median = t.number("median", kDiameter).value_or(0);
  d.sigma =
      t.number("sigma", {positive, "a positive number (standard deviation of the logarithm of the diameter)"})
          .value_or(0);
  // [HC1929]: if the distribution of the mass over the diameters is lognormal, the distribution of the number of grains
  // is lognormal as well. Both distributions have the same sigma. The median by number is the median by mass times
  // exp(-dimension * sigma^2).
  const bool by_mass = t.choice("by", {"number", "mass"}, Need::optional) == 1;
  d.median = by_mass ? median * std::exp(-dimension * d.sigma * d.sigma) : median;
  // Smallest fraction of the complete lognormal distribution that must lie between min and max. With a smaller
  // fraction, the quantiles between min and max would lose more than half of their digits.
  constexpr double kLeastShare = 1e-12;
  if (!(d.min > 0 && d.min < d.max && median > 0 && d.sigma > 0)) return;
  const double share = d.median > 0.0 ? share_within_bounds(d) : 0.0;
  if (!(share >= kLeastShare))
    t.fault("median", fmt::format("grains.diameter.median = {}: only the fraction {:.2g} of {} "
                                  "lies between min = {} and max = {}; expected a fraction of at least {:.0e}",
                                  median, share,
                                  by_mass ? "the number of grains of this distribution" : "this distribution",
                                  d.min, d.max, kLeastShare));
}

/// Reads the key `quantiles`, which determines the quantiles of the distribution that become the diameters of the
/// grains: equally spaced quantiles that include both ends of the distribution ("ends"), or the quantiles in the middle
/// of equal fractions of the grains ("middle").
void read_quantiles(TableReader& t, DiameterDistribution& d) {
  if (t.choice("quantiles", {"ends", "middle"}, Need::optional) == 1)
    d.quantiles = DiameterDistribution::Quantiles::middle;
}

}  // namespace

DiameterDistribution read_diameters(TableReader t, SceneSource& source, const std::string& directory,
                                    int dimension, const std::string& units) {
  DiameterDistribution d;
  d.dimension = dimension;
  const std::size_t n_faults = source.n_faults();
  const auto chosen = t.choice("distribution", {"uniform", "constant", "bidisperse", "list", "power_law",
                                                "lognormal", "uniform_by_volume", "uniform_by_area", "sieve"});
  if (!chosen) return d;
  d.kind = std::array{Kind::uniform,   Kind::constant,  Kind::bidisperse, Kind::list, Kind::power_law,
                      Kind::lognormal, Kind::power_law, Kind::power_law,  Kind::sieve}[*chosen];
  // Three keywords select power laws: "power_law", "uniform_by_volume" and "uniform_by_area". The last two fix the
  // exponent.
  constexpr std::size_t kByVolume = 6, kByArea = 7;
  switch (d.kind) {
    case Kind::uniform:
      read_sizes(t, "min", "max", d);
      read_quantiles(t, d);
      break;
    case Kind::constant:
      d.min = d.max = t.number("value", kDiameter).value_or(0);
      break;
    case Kind::bidisperse:
      read_sizes(t, "small", "large", d);
      d.share_of_large =
          t.number("share_of_large", {[](double x) { return x >= 0 && x <= 1; },
                                      "the number of large grains divided by the number of all grains, 0 to 1"})
              .value_or(0);
      break;
    case Kind::list:
      read_list(t, source, directory, d);
      break;
    case Kind::power_law:
      read_sizes(t, "min", "max", d);
      read_quantiles(t, d);
      if (*chosen == kByVolume || *chosen == kByArea)
        d.exponent = *chosen == kByVolume ? kUniformByVolume : kUniformByArea;
      else
        d.exponent =
            t.number("exponent", {[](double x) { return std::abs(x) <= 100; },
                                  "a number from -100 to 100 (probability density P(d) ~ d^-exponent)"})
                .value_or(0);
      break;
    case Kind::lognormal:
      read_sizes(t, "min", "max", d);
      read_quantiles(t, d);
      read_lognormal(t, dimension, d);
      break;
    case Kind::sieve:
      // With quantiles at the ends, one grain of the largest size is always included, and this grain may have a large
      // part of the mass. Quantiles in the middle of equal fractions are used instead.
      d.quantiles = DiameterDistribution::Quantiles::middle;
      read_sieve(t, source, directory, units, d);
      break;
  }
  t.refuse_other_keys();
  // Later checks need the smallest and the largest diameter. Quantiles in the middle of equal fractions cannot be
  // computed for a distribution with faults. Quantiles at the ends are therefore used: the two diameters are then the
  // ends of the distribution itself.
  if (source.n_faults() > n_faults) d.quantiles = DiameterDistribution::Quantiles::ends;
  return d;
}

}  // namespace floc
