#pragma once

namespace floc {

/// Returns the t for which a Student variable of `dof` >= 1 degrees of freedom lies in [-t, t] with probability 0.95.
/// The distribution is computed by a finite trigonometric series (Abramowitz and Stegun 26.7.3-4). The relative error
/// of t is below 1e-12.
double student_t_95(int dof);

}  // namespace floc
