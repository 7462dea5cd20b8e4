#pragma once

#include <Eigen/Core>

#include "floc/packing/packing.h"

namespace floc {

/// Symmetric matrix whose rows and columns correspond to the displacements u and rotations w of two grains i and j, in
/// the order (u_i, w_i, u_j, w_j).
template <int Dim>
using PairMatrix = Eigen::Matrix<double, 2 * kDofs<Dim>, 2 * kDofs<Dim>>;

/// Displacements and rotation vectors of two grains, in the order of PairMatrix.
template <int Dim>
using PairMotion = Eigen::Matrix<double, 2 * kDofs<Dim>, 1>;

/// Returns the second derivatives of the gap of a contact with respect to the displacements and the rotation vectors of
/// its grains. The unit is 1/length for two displacements, 1 for a displacement and a rotation, and length for two
/// rotations. Entries for the motion of a wall are zero.
///
/// The gap of two convex bodies is the maximum of n . r - h_i(n) - h_j(-n) over all directions n, with the branch
/// vector r and the support functions h of the bodies. The second derivatives of h are the radii of curvature of the
/// surface: zero at a vertex, infinite on a face and along an edge. The radius of rounding is added to them.
template <int Dim>
PairMatrix<Dim> gap_curvature(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns the matrix of the second derivatives of v . (w x (w x n))/2 with respect to a rotation vector w.
inline Mat<1> turn_curvature(const Vec<2>& v, const Vec<2>& n) {
  return Mat<1>(-v.dot(n));
}
inline Mat<3> turn_curvature(const Vec<3>& v, const Vec<3>& n) {
  return 0.5 * (v * n.transpose() + n * v.transpose()) - v.dot(n) * Mat<3>::Identity();
}

/// Returns the matrix that gives, for the velocities of the two grains of a contact, the change of their momenta in a
/// step due to the rotation of the normal force N: -dt^2 N times the second derivatives of the gap (mass). Negative
/// eigenvalues are replaced by zero, so that the step is a convex program.
/// @param weight  dt^2 N, with the time step dt and the normal force N
template <int Dim>
PairMatrix<Dim> convex_stiffness(const PairMatrix<Dim>& curvature, double weight);

}  // namespace floc
