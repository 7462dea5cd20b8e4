#pragma once

#include "floc/network/contact_network.h"

namespace floc {

/// Number of components of the motion of a contact on which geometric terms depend linearly: displacement of j relative
/// to i, rotation of i, rotation of j.
template <int Dim>
inline constexpr int kMotionRows = Dim + 2 * kRotations<Dim>;

template <int Dim>
using MotionMatrix = Eigen::Matrix<double, kMotionRows<Dim>, kMotionRows<Dim>>;

/// Computes the geometric stiffness of a contact: its forces keep their components in the frame of the contact while
/// the frame turns. Let dr be the displacement of j relative to i, psi = n.(rotation of i + rotation of j)/2 and dn =
/// (1 - n n) dr/r. The frame then turns by w = n x dn + psi n. With the force f = -F n + S on i, the moment share_i r x
/// S + M on i and the moment share_j r x S - M on j:
///
///   df = -F dn + w x S,  d(moment on i) = share_i (dr x S + r x (w x S)) + w x M
///
/// Columns are the components of the motion, rows are the forces and moments that do work on them; the sign is that of
/// a stiffness.
template <int Dim>
MotionMatrix<Dim> geometric_stiffness(const NetworkContact<Dim>& contact);

/// Motion of a contact per unit of each unknown of its two grains: rows are the components of the motion, columns the
/// unknowns.
template <int Dim>
struct GrainMotions {
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> on_i;  ///< unknowns of i; those of j are added if i = j
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> on_j;  ///< unknowns of j; zero if i = j
};

/// Returns the motion of a contact per unit of each unknown of its two grains.
/// @param size_i, size_j  lengths by which the rotations are multiplied in the unknowns; 1 if the unknowns are the
///                rotations
template <int Dim>
GrainMotions<Dim> grain_motions(const NetworkContact<Dim>& contact, double size_i, double size_j);

}  // namespace floc
