#pragma once

#include <optional>
#include <string>

#include "floc/linalg/tangent_solver.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/packing.h"
#include "floc/relaxation/boundary_control.h"

namespace floc {

/// Limits of the Newton steps. They were measured: within them, Newton steps refine an equilibrium and do not
/// jump to another.
struct StaticSolverOptions {
  double target = 1e-8;  ///< bound of force, moment and stress residuals, in units of F1 and a
  int max_iterations = 12;
  int max_backtracking = 6;
  double largest_step = 2e-3;             ///< relative displacement of two grains in contact, per iteration / a
  double largest_displacement = 2e-2;     ///< relative displacement of two grains in contact, in total / a
  double largest_mobilised_share = 0.15;  ///< share of mobilised contacts beyond which Newton steps stall
  /// Method for linear systems with the tangent; absent: a factor in 2D, the method that is expected to be
  /// fastest in 3D.
  std::optional<TangentMethod> method;
};

/// Outcome of a static solution.
template <int Dim>
struct StaticSolution {
  bool converged = false;  ///< the target was reached; `packing` is then the equilibrium, at rest
  std::string reason;      ///< reason of the failure, in words
  bool has_lengths =
      true;  ///< whether the axes of `packing` have their imposed lengths; false if these were too far away
  int iterations = 0;
  double residual = 0.0;  ///< largest of the three residuals reached
  Packing<Dim> packing;   ///< best configuration found
};

/// Solves force, moment and stress balance of a periodic packing by Newton iterations from its present state.
/// Histories are updated from those at the start (return mapping); the tangent is the consistent tangent of the
/// law's response with all geometric terms, unsymmetric where contacts slide. Free motions without stiffness
/// (translations, rattlers, free rollers) carry no load and get a vanishing stiffness (regularisation). The
/// solution fails if this brings grains together that were apart.
/// @param control  components under a stress are unknowns; axes and a shear on a strain ramp start from its end,
/// with the grains deformed affinely; other components are fixed; mean_stress() sets the scale of forces
/// @pre the cell is lower triangular (the first lattice vector along x, ...); it stays so
template <int Dim>
[[nodiscard]] StaticSolution<Dim> solve_statics(const Packing<Dim>& start, const BoundaryControl<Dim>& control,
                                                const StaticSolverOptions& options);

/// Method by which solve_statics() will solve linear systems with the tangent of a packing of spheres, and the
/// time that it is expected to take. For disks no time is estimated, since the tangent is always factorized.
template <int Dim>
[[nodiscard]] TangentPlan plan_statics(const Packing<Dim>& start, const BoundaryControl<Dim>& control);

/// @param target_stress  stress on each axis, compression positive
template <int Dim>
[[nodiscard]] StaticSolution<Dim> solve_statics(const Packing<Dim>& start, const Vec<Dim>& target_stress,
                                                const StaticSolverOptions& options) {
  return solve_statics(start, BoundaryControl<Dim>::normal_stress(target_stress, 0.0), options);
}

}  // namespace floc
