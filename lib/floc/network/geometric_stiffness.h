#pragma once

#include "floc/network/contact_network.h"

namespace floc {

/// Rows of the motion that geometric terms are linear in: displacement of j against i, rotation of i, rotation
/// of j.
template <int Dim>
inline constexpr int kMotionRows = Dim + 2 * kRotations<Dim>;

template <int Dim>
using MotionMatrix = Eigen::Matrix<double, kMotionRows<Dim>, kMotionRows<Dim>>;

/// Computes the geometric stiffness of a contact: forces keep their components in the frame of the contact
/// while the frame turns. With dr the displacement of j against i, psi = n.(rotation of i + rotation of j)/2
/// and dn = (1 - n n) dr/r, the frame turns by w = n x dn + psi n. With the force f = -F n + S on i, the moment
/// share_i r x S + M on i and the moment share_j r x S - M on j:
///
///   df = -F dn + w x S,  d(moment on i) = share_i (dr x S + r x (w x S)) + w x M
///
/// Rows do work on the motion, columns are the motion; the sign is that of a stiffness.
template <int Dim>
MotionMatrix<Dim> geometric_stiffness(const NetworkContact<Dim>& contact);

/// Columns: the unknowns of the two grains of a contact, as rows of its motion.
template <int Dim>
struct GrainMotions {
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> on_i;  ///< unknowns of i; those of j are added if i = j
  Eigen::Matrix<double, kMotionRows<Dim>, kDofs<Dim>> on_j;  ///< unknowns of j; zero if i = j
};

/// @param size_i, size_j  rotations are unknowns times these (length), or 1 where they are unknowns themselves
template <int Dim>
GrainMotions<Dim> grain_motions(const NetworkContact<Dim>& contact, double size_i, double size_j);

}  // namespace floc
