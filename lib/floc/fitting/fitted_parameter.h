#pragma once

#include <optional>
#include <string>

namespace floc {

/// One parameter of a fit. Intervals are made in coordinates that keep the parameter in its range, so they need
/// not be symmetric.
struct FittedParameter {
  std::string name;
  std::optional<double> value;           ///< absent if the data only bound the parameter
  std::optional<double> standard_error;  ///< absent for a held parameter
  std::optional<double> low95, high95;   ///< 95 % interval; a bound where there is no value
  bool identified = true;                ///< whether it is known to within a factor of ten either way
};

/// Returns the parameter exp(c), from c and its standard error; the interval is symmetric in c.
/// @param t95  half width of a 95 % interval in standard errors
FittedParameter from_logarithm(const std::string& name, double c, double error, double t95);

/// Returns the parameter 1/y, from y > 0 and its standard error; the interval is symmetric in y, and open above
/// where it reaches y = 0.
FittedParameter from_inverse(const std::string& name, double y, double error, double t95);

/// Returns a parameter that may have either sign.
FittedParameter from_value(const std::string& name, double value, double error, double t95);

/// Returns a parameter that was given, not fitted.
FittedParameter held_at(const std::string& name, double value);

/// Range of the values that a parameter can have, both ends included.
struct PhysicalRange {
  double low, high;
};

/// Cuts an interval at the range of its parameter. A value outside the range, as of a law that does not
/// describe the data, is removed, and the parameter counts as not identified.
/// @return the reason of the removal, in words; empty if the value is inside
std::string keep_in_range(const PhysicalRange& range, FittedParameter& p);

/// Returns a parameter for which the data give at most a lower bound.
FittedParameter bounded_below(const std::string& name, std::optional<double> low);

}  // namespace floc
