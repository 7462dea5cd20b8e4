#pragma once

#include <string>

#include "floc/packing/packing.h"
#include "floc/rigid/contact_dynamics.h"

namespace floc {

/// Result of the search for a minimum.
struct LeastVolume {
  int n_steps = 0;      ///< number of Newton steps
  std::string failure;  ///< reason why no minimum was found, as a sentence; empty if a minimum was found
  /// Whether the forces are not exact yet, because the last weight mu was larger. This is so for rounded grains.
  bool is_near = false;
};

/// Moves polyhedra without friction and adhesion to a local minimum of P V, with the pressure P and the volume V, among
/// all packings without overlaps. At the minimum the grains are in stable equilibrium: the multipliers of the gaps are
/// the forces of the contacts.
///
/// Two convex bodies do not overlap if and only if a plane separates them. The planes of all near pairs are unknowns in
/// addition to the positions of the grains and the sides of the cell, and each vertex has a gap to each plane of its
/// grain. The gaps g are smooth functions of the unknowns. The minimum of P V - mu sum log g is found for a sequence of
/// decreasing mu, by Newton's method with the exact second derivatives (interior point method [NW2006]). The minimum is
/// accepted if the matrix of second derivatives is positive definite, so that no motion decreases P V.
///
/// Where a rounded corner or edge touches an edge, only the curvature of the rounding fixes the direction of the plane.
/// The equations are then so badly conditioned that rounding errors hide the sign of the second derivatives at a small
/// mu. The search for rounded grains therefore ends near the minimum, at a larger mu.
///
/// The contact points of two grains (manifold.h) cannot serve as constraints, because they belong to the closest
/// features at the start of a step. If two faces are nearly parallel, one corner may be closest before a step and
/// another corner after it. Steps with the contact points as constraints would then not converge.
/// @param packing  packing in which grains nearly touch or overlap; the search shrinks the grains and then lets them
/// grow. It receives the minimum, with the contact points whose gap is below `contact_gap` and their normal forces. The
/// force of a pair is divided equally among its contact points
/// @param contact_gap  largest gap of a contact, divided by the diameter of the smaller grain
/// @throws Interrupted if the program is interrupted (base/interruption.h)
LeastVolume minimise_volume(Packing<3>& packing, const BoundaryLoad<3>& load, double contact_gap);

}  // namespace floc
