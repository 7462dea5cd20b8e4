#pragma once

#include "floc/network/contact_network.h"

namespace floc {

/// Number of components of the motion of two grains at their contact: the displacement of j relative to i, the rotation
/// of i, and the rotation of j. Geometric terms are linear in them.
template <int Dim>
inline constexpr int kMotionRows = Dim + 2 * kRotations<Dim>;

template <int Dim>
using MotionMatrix = Eigen::Matrix<double, kMotionRows<Dim>, kMotionRows<Dim>>;

/// Computes the geometric stiffness of a contact: the change of its forces and moments if the frame of the contact
/// turns and they keep their components in this frame. Let n be the normal, r the branch vector, dr the displacement of
/// j relative to i, psi = n.(rotation of i + rotation of j)/2 and dn = (1 - n n) dr/|r|. The frame then turns by w = n
/// x dn + psi n. Let f = -F n + S be the force on i, with the normal force F and the tangential force S; share_i r x S
/// + M the moment on i and share_j r x S - M the moment on j, with the lever arms share_i r and share_j r and the
/// rolling and twisting moment M. Then
///
///   df = -F dn + w x S,  d(moment on i) = share_i (dr x S + r x (w x S)) + w x M
///
/// @return matrix with the components of the motion as columns, and the forces and moments that do work on them as
///         rows; the sign is that of a stiffness
template <int Dim>
MotionMatrix<Dim> geometric_stiffness(const NetworkContact<Dim>& contact);

/// Motion at a contact per unit of each unknown of its two grains: rows are the components of the motion (see
/// kMotionRows), columns the unknowns.
template <int Dim>
struct GrainMotions {
  /// columns: unknowns of i; if i = j, those of j are added
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> on_i;
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> on_j;  ///< columns: unknowns of j; zero if i = j
};

/// Returns the motion at a contact per unit of each unknown of its two grains.
/// @param size_i, size_j  lengths by which rotations are multiplied to give the unknowns of i and of j; 1 if the
///                        unknowns are the rotations themselves
template <int Dim>
GrainMotions<Dim> grain_motions(const NetworkContact<Dim>& contact, double size_i, double size_j);

}  // namespace floc
