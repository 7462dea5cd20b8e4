#pragma once

#include <optional>
#include <string>

namespace floc {

/// One parameter of a fit. The interval is computed in a coordinate such as the logarithm of a positive parameter, so
/// that the interval cannot leave the range of the parameter. It may therefore be asymmetric.
struct FittedParameter {
  std::string name;
  std::optional<double> value;           ///< fitted value; absent if the data give only bounds of the parameter
  std::optional<double> standard_error;  ///< absent for a parameter that was given, not fitted
  std::optional<double> low95, high95;   ///< ends of the 95 % interval; bounds if there is no value
  bool identified = true;                ///< whether the data determine the parameter to within a factor of ten
};

/// Returns the parameter exp(c), with a 95 % interval that is symmetric in c.
/// @param error  standard error of c
/// @param t95  half width of a 95 % interval, in standard errors
FittedParameter from_logarithm(const std::string& name, double c, double error, double t95);

/// Returns the parameter 1/y, with a 95 % interval that is symmetric in y. If the interval of y reaches zero, the
/// interval of 1/y has no upper end.
/// @param y,error  y > 0 and the standard error of y
FittedParameter from_inverse(const std::string& name, double y, double error, double t95);

/// Returns a parameter that may be negative, with a 95 % interval that is symmetric about its value.
FittedParameter from_value(const std::string& name, double value, double error, double t95);

/// Returns a parameter that was given, not fitted.
FittedParameter held_at(const std::string& name, double value);

/// Range of the values that a parameter can have, both ends included.
struct PhysicalRange {
  double low, high;
};

/// Limits the interval of a parameter to its physical range. If the value is outside of the range, the law does not
/// describe the data: the value is removed, and the parameter counts as not identified.
/// @return the reason why the value was removed; empty if the value is inside the range
std::string keep_in_range(const PhysicalRange& range, FittedParameter& p);

/// Returns a parameter without a value, with the lower bound `low` if the data give one.
FittedParameter bounded_below(const std::string& name, std::optional<double> low);

}  // namespace floc
