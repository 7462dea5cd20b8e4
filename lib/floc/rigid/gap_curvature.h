#pragma once

#include <Eigen/Core>

#include "floc/packing/packing.h"

namespace floc {

/// Symmetric matrix over the displacements and rotations of two grains, in the order (u_i, w_i, u_j, w_j).
template <int Dim>
using PairMatrix = Eigen::Matrix<double, 2 * kDofs<Dim>, 2 * kDofs<Dim>>;

/// Displacements and rotation vectors of two grains in this order.
template <int Dim>
using PairMotion = Eigen::Matrix<double, 2 * kDofs<Dim>, 1>;

/// Returns the second derivatives of the gap of a contact with respect to the displacements and the rotation vectors of
/// its grains (1/length, with rotations times a length). The motion of a wall is not part of them.
///
/// The gap of two convex bodies is the largest of n . r - h_i(n) - h_j(-n) over all directions n, with the branch r and
/// the support functions h, whose second derivatives are the radii of curvature of the surfaces. They are zero at a
/// vertex and infinite on a face and along an edge; a rounding is added to them.
template <int Dim>
PairMatrix<Dim> gap_curvature(const Packing<Dim>& packing, const Contact<Dim>& contact);

}  // namespace floc
