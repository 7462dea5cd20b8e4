#pragma once

#include <optional>
#include <string>

namespace floc {

/// One parameter of a fit. Intervals are made in coordinates that keep the parameter in its range, so they need
/// not be symmetric.
struct FittedParameter {
  std::string name;
  std::optional<double> value;           ///< absent when the data only bound it
  std::optional<double> standard_error;  ///< absent for a held parameter
  std::optional<double> low95, high95;   ///< 95 % interval; a bound where there is no value
  bool identified = true;                ///< known to within a factor of ten either way
};

/// exp(c), from c and its standard error; the interval is symmetric in c.
/// @param t95  half width of a 95 % interval in standard errors
FittedParameter from_logarithm(const std::string& name, double c, double error, double t95);

/// 1/y, from y > 0 and its standard error; the interval is symmetric in y, and open above where it reaches y =
/// 0.
FittedParameter from_inverse(const std::string& name, double y, double error, double t95);

/// A parameter that may have either sign.
FittedParameter from_value(const std::string& name, double value, double error, double t95);

/// A parameter that was given, not fitted.
FittedParameter held_at(const std::string& name, double value);

/// The values that a parameter can have, both ends included.
struct PhysicalRange {
  double low, high;
};

/// Cuts an interval at the range of its parameter. A value outside the range, which a law takes that does not describe
/// the data, is no result: the parameter loses it and is not identified.
/// @return why, in words; empty where the value is inside
std::string keep_in_range(const PhysicalRange& range, FittedParameter& p);

/// A parameter for which the data give at most a lower bound.
FittedParameter bounded_below(const std::string& name, std::optional<double> low);

}  // namespace floc
