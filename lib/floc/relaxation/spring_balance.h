#pragma once

#include "floc/packing/equilibrium.h"
#include "floc/packing/load_target.h"
#include "floc/packing/packing.h"

namespace floc {

/// Result of balancing the springs of a packing.
template <int Dim>
struct SpringBalance {
  Packing<Dim> packing;  ///< packing at rest with the smallest residual that was found
  Residuals residuals;   ///< residuals of this packing
  /// Whether these residuals are at most the target, or so small that they may be rounding errors.
  bool converged = false;
};

/// Refines the static equilibrium of elastic grains with corners by Newton iterations on the positions, the rotations,
/// the sides of the cell that are under stress, and the walls that move under a pressure.
///
/// The time steps that bring such grains to rest (ContactDynamics) leave out negative geometric stiffnesses, so that
/// each of them is a convex program. They therefore approach the equilibrium ever more slowly if a motion is soft. The
/// tangent matrix of these iterations contains all terms. The contact points are found anew in each iteration, and
/// tangential forces follow from the slip since the start, limited by Coulomb's law (return mapping). The iterations
/// end at the target, or when a step no longer reduces the residual.
/// @param start  packing at rest near an equilibrium, with the contacts that overlap
/// @param load   stress on each axis, or its length; in a box, the pressure on the walls that move
/// @param target  residual, in the units of EquilibriumTolerance, below which the iterations end
/// @pre the grains have corners, and the law has linear springs (add_springs())
template <int Dim>
[[nodiscard]] SpringBalance<Dim> balance_springs(const Packing<Dim>& start, const LoadTarget<Dim>& load,
                                                 double target);

}  // namespace floc
