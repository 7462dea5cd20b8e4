#pragma once

#include <optional>
#include <string>

#include "floc/linalg/tangent_solver.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/packing.h"
#include "floc/relaxation/boundary_control.h"

namespace floc {

/// Limits within which Newton steps are trusted: measured as those within which they refine an equilibrium and
/// do not jump to another.
struct StaticSolverOptions {
  double target = 1e-8;  ///< force, moment and stress residuals wanted, in units of F1 and a
  int max_iterations = 12;
  int max_backtracking = 6;
  double largest_step = 2e-3;            ///< relative displacement of two grains in contact, per iteration / a
  double largest_displacement = 2e-2;    ///< the same in total / a
  double largest_yielding_share = 0.15;  ///< of the contacts; beyond it sliding rules and Newton stalls
  /// How systems with the tangent are solved; absent: by a factor in 2D, in 3D as is expected to be fastest.
  std::optional<TangentMethod> method;
};

/// Outcome of a static solution.
template <int Dim>
struct StaticSolution {
  bool converged = false;  ///< the target was reached; `packing` is then the equilibrium, at rest
  std::string reason;      ///< why not, in words
  bool has_lengths =
      true;  ///< the axes of `packing` are at the ends of their way; else they were too far to go
  int iterations = 0;
  double residual = 0.0;  ///< largest of the three residuals reached
  Packing<Dim> packing;   ///< best configuration found
};

/// Solves force, moment and stress balance of a periodic packing by Newton iterations from where it is. The
/// law maps histories back from those it starts with (return mapping); the tangent is the consistent one of
/// the law's response with all geometric terms, unsymmetric where contacts slide. Free motions without
/// stiffness (translations, rattlers, free rollers) carry no load and are given a vanishing stiffness
/// (regularisation). Where that brings grains together that were apart, there is no solution.
///
/// @param control  components under a stress are unknowns; axes and a shear that have a way start from its end,
///                 grains following; the others stay as they are; mean_stress() sets the scale of forces
/// @pre the cell is lower triangular (the first lattice vector along x, ...); it stays so
template <int Dim>
[[nodiscard]] StaticSolution<Dim> solve_statics(const Packing<Dim>& start, const BoundaryControl<Dim>& control,
                                                const StaticSolverOptions& options);

/// How solve_statics() will solve with the tangent of a packing of spheres, and how long it is expected to
/// take; for disks nothing is estimated, as their factor is made without asking.
template <int Dim>
[[nodiscard]] TangentPlan plan_statics(const Packing<Dim>& start, const BoundaryControl<Dim>& control);

/// @param target_stress  stress on each axis, compression positive
template <int Dim>
[[nodiscard]] StaticSolution<Dim> solve_statics(const Packing<Dim>& start, const Vec<Dim>& target_stress,
                                                const StaticSolverOptions& options) {
  return solve_statics(start, BoundaryControl<Dim>::normal_stress(target_stress, 0.0), options);
}

}  // namespace floc
