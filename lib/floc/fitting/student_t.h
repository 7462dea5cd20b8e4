#pragma once

namespace floc {

/// Returns the value t for which a Student variable of `dof` >= 1 degrees of freedom lies in [-t, t] with probability
/// 0.95. The value is computed from a finite trigonometric series for the distribution (Abramowitz and Stegun
/// 26.7.3-4). The relative error is below 1e-12.
double student_t_95(int dof);

}  // namespace floc
