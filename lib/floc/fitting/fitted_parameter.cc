#include "floc/fitting/fitted_parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace floc {
namespace {

/// A parameter with the value v is identified if its 95 % interval lies between v/kIdentifiedFactor and
/// v*kIdentifiedFactor.
constexpr double kIdentifiedFactor = 10.0;

}  // namespace

FittedParameter from_logarithm(const std::string& name, double c, double error, double t95) {
  FittedParameter p{
      name, std::exp(c), std::exp(c) * error, std::exp(c - t95 * error), std::exp(c + t95 * error), true};
  p.identified = t95 * error < std::log(kIdentifiedFactor);
  return p;
}

FittedParameter from_inverse(const std::string& name, double y, double error, double t95) {
  const double low = y - t95 * error;
  FittedParameter p{
      name, 1.0 / y, error / (y * y), 1.0 / (y + t95 * error), std::nullopt, std::isfinite(error)};
  if (low > 0.0)
    p.high95 = 1.0 / low;
  else
    p.identified = false;
  return p;
}

FittedParameter from_value(const std::string& name, double value, double error, double t95) {
  return {name, value, error, value - t95 * error, value + t95 * error, std::isfinite(error)};
}

FittedParameter held_at(const std::string& name, double value) {
  return {name, value, {}, {}, {}, true};
}

std::string keep_in_range(const PhysicalRange& range, FittedParameter& p) {
  const auto inside = [&range](double x) { return range.low <= x && x <= range.high; };
  if (!p.value || inside(*p.value)) {
    if (p.low95) p.low95 = std::clamp(*p.low95, range.low, range.high);
    if (p.high95) p.high95 = std::clamp(*p.high95, range.low, range.high);
    return "";
  }
  const std::string limits = std::isinf(range.high)
                                 ? fmt::format("at least {:g}", range.low)
                                 : fmt::format("between {:g} and {:g}", range.low, range.high);
  const std::string why = fmt::format(
      "{} is not identified by these data: its value in the best fit is {:.5g}, but it must be {}. The law "
      "does not describe the data, and the other parameters are those of this best fit",
      p.name, *p.value, limits);
  p.value = p.standard_error = p.low95 = p.high95 = std::nullopt;
  if (std::isfinite(range.low)) p.low95 = range.low;
  if (std::isfinite(range.high)) p.high95 = range.high;
  p.identified = false;
  return why;
}

FittedParameter bounded_below(const std::string& name, std::optional<double> low) {
  return {name, std::nullopt, std::nullopt, low, std::nullopt, false};
}

}  // namespace floc
