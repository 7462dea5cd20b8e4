#pragma once

#include <optional>
#include <string>

#include "floc/linalg/tangent_solver.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/packing.h"
#include "floc/relaxation/boundary_control.h"

namespace floc {

/// Limits of the Newton iterations of the static solver. The default values were found by tests: with them, the
/// iterations refine an equilibrium and do not jump to another equilibrium.
struct StaticSolverOptions {
  /// Upper bound of the residuals of a solution. The unit is F1 for forces, F1 a for moments and F1/a^(D-1) for
  /// stresses, with the force scale F1, the largest diameter a and the dimension D.
  double target = 1e-8;
  int max_iterations = 12;
  int max_backtracking = 6;
  /// Largest relative displacement of two grains in contact in one iteration, in units of the largest diameter.
  double largest_step = 2e-3;
  /// Largest relative displacement of two grains in contact over all iterations, in units of the largest diameter.
  double largest_displacement = 2e-2;
  /// Largest share of contacts with a spring at its cap (mobilised contacts). With a larger share, the iterations would
  /// stall and are therefore given up.
  double largest_mobilised_share = 0.15;
  /// Method by which linear systems with the tangent matrix are solved; if absent, a factorization in 2D, and in 3D the
  /// method that is expected to be fastest.
  std::optional<TangentMethod> method;
};

/// Result of solving the equations of static equilibrium.
template <int Dim>
struct StaticSolution {
  /// Whether StaticSolverOptions::target was reached; `packing` is then the equilibrium, at rest.
  bool converged = false;
  std::string reason;  ///< reason of the failure; empty if `converged` is true
  /// Whether the axes of `packing` have their imposed lengths; false if the imposed lengths were too far from the
  /// initial lengths.
  bool has_lengths = true;
  int iterations = 0;
  /// Largest of the force, moment and stress residuals that were reached, in the units of StaticSolverOptions::target.
  double residual = 0.0;
  Packing<Dim> packing;  ///< packing in the state with the smallest residual that was found
};

/// Solves the balance of forces, moments and stresses of a periodic packing by Newton iterations, from its present
/// state. The history variables of the contacts are updated from their values at the start (return mapping). The
/// tangent matrix contains the consistent tangent of the contact law and all geometric terms. The matrix is not
/// symmetric if contacts slide. Motions without stiffness and without load (translations of the packing, rattlers,
/// grains that roll freely) get a negligible stiffness (regularisation). The solution fails if grains come into contact
/// that were too far apart at the start.
/// @param control  control of the boundary. Components that follow a stress are unknowns. If there is a strain ramp
/// (StrainRamp), the cell is first deformed to the end of the ramp, and the grains are moved affinely with it. All
/// other components are fixed. control.mean_stress() sets the scale of forces.
/// @pre the cell matrix is lower triangular (the first lattice vector along x, ...); it stays lower triangular
template <int Dim>
[[nodiscard]] StaticSolution<Dim> solve_statics(const Packing<Dim>& start, const BoundaryControl<Dim>& control,
                                                const StaticSolverOptions& options);

/// Returns the method by which solve_statics() will solve linear systems with the tangent matrix of a packing. For
/// spheres, also returns the computing time that the method is expected to take. For disks there is no estimate, since
/// their tangent matrix is always factorized.
template <int Dim>
[[nodiscard]] TangentPlan plan_statics(const Packing<Dim>& start, const BoundaryControl<Dim>& control);

/// Computes the static equilibrium of a periodic packing under a stress imposed on each axis.
/// @param target_stress  stress on each axis, compression positive (force/length^(Dim-1))
template <int Dim>
[[nodiscard]] StaticSolution<Dim> solve_statics(const Packing<Dim>& start, const Vec<Dim>& target_stress,
                                                const StaticSolverOptions& options) {
  return solve_statics(start, BoundaryControl<Dim>::normal_stress(target_stress, 0.0), options);
}

}  // namespace floc
