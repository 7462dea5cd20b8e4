#pragma once

#include <optional>
#include <string>

namespace floc {

/// One parameter of a fit. The interval is computed in a coordinate that keeps the parameter in its range, such as the
/// logarithm of a positive parameter. The interval may therefore be asymmetric.
struct FittedParameter {
  std::string name;
  std::optional<double> value;           ///< fitted value; absent if the data give only bounds of the parameter
  std::optional<double> standard_error;  ///< absent for a parameter that was given, not fitted
  std::optional<double> low95, high95;   ///< ends of the 95 % interval; bounds if there is no value
  bool identified = true;                ///< whether the data determine the parameter to within a factor of ten
};

/// Returns the parameter exp(c) from c and the standard error of c. Its 95 % interval is symmetric in c.
/// @param t95  half width of a 95 % interval, in standard errors
FittedParameter from_logarithm(const std::string& name, double c, double error, double t95);

/// Returns the parameter 1/y from y > 0 and the standard error of y. Its 95 % interval is symmetric in y. If the
/// interval of y reaches zero, the interval of 1/y has no upper end.
FittedParameter from_inverse(const std::string& name, double y, double error, double t95);

/// Returns a parameter that may have either sign, with a 95 % interval that is symmetric about its value.
FittedParameter from_value(const std::string& name, double value, double error, double t95);

/// Returns a parameter that was given, not fitted.
FittedParameter held_at(const std::string& name, double value);

/// Range of the values that a parameter can have, both ends included.
struct PhysicalRange {
  double low, high;
};

/// Limits the interval of a parameter to its physical range. A value outside the range, from a law that does
/// not describe the data, is removed, and the parameter counts as not identified.
/// @return a text with the reason why the value was removed; empty if the value is inside the range
std::string keep_in_range(const PhysicalRange& range, FittedParameter& p);

/// Returns a parameter without a value, with the lower bound `low` if the data give one.
FittedParameter bounded_below(const std::string& name, std::optional<double> low);

}  // namespace floc
