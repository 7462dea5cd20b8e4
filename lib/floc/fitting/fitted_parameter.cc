#include "floc/fitting/fitted_parameter.h"

#include <cmath>

namespace floc {
namespace {

/// A parameter known to less than this factor either way is not identified.
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

FittedParameter bounded_below(const std::string& name, std::optional<double> low) {
  return {name, std::nullopt, std::nullopt, low, std::nullopt, false};
}

}  // namespace floc
