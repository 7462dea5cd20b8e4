#pragma once

namespace floc {

/// Returns the regularised incomplete beta function I_x(a, b): the probability that a beta variable with the parameters
/// a and b is below x. The function is computed by a continued fraction (Abramowitz and Stegun 26.5.8), with a relative
/// error below 1e-10.
/// @pre a > 0, b > 0, 0 <= x <= 1
double incomplete_beta(double a, double b, double x);

}  // namespace floc
