#pragma once

#include <optional>

#include "floc/network/carrying_structure.h"

namespace floc {

/// Coordination and forces of the force-carrying structure of a packing: all grains and contacts except rattlers and
/// their contacts (docs/physics.md, "Force-carrying structure"; [AR2007]). Shares of grains refer to all N grains of
/// the packing. Averages are taken over the contacts of the structure; they are zero if there are no contacts.
struct CarryingForces {
  int n_contacts = 0;
  double z = 0.0;       ///< coordination number 2 n_contacts/N, with N the number of all grains
  double z_star = 0.0;  ///< coordination number without rattlers, 2 n_contacts/(N (1 - x0))
  double x0 = 0.0;      ///< share of rattlers (grains that carry no force) among all grains
  double x2 = 0.0;      ///< share of grains with exactly two force-carrying contacts
  /// Corrected coordination number z** = z* + 2 x2/(3 (1 - x0)), with z* the member z_star. A sphere with two contacts
  /// turns freely about the line through them. With friction, the degree of hyperstaticity is therefore H = (3/2) N (1
  /// - x0) (z** - 4) + constant, with N the number of grains. z** is absent in 2D, because disks cannot rotate in this
  /// way.
  std::optional<double> z_star_star;
  /// Reduced moments `<N^q>/<N>^q` of the elastic normal force N, for q = 1/3, 5/3 and 2.
  double Z_third = 0.0, Z_five_thirds = 0.0, Z2 = 0.0;
  /// Mean ratio |F_T|/N of tangential to elastic normal force. M1 is the mean over the contacts with N above the mean
  /// `<N>`, M2 the mean over the contacts with N below it.
  double M1 = 0.0, M2 = 0.0;
  double sliding_share = 0.0;  ///< share of contacts whose tangential force is at the limit of friction
  /// Fabric tensor `<n n>` - 1/Dim of the normals n (Dim x Dim). Its trace is zero, and all its entries are zero if the
  /// directions of contacts are isotropic.
  Eigen::MatrixXd fabric;
  /// Fabric tensors of the strong contacts (elastic normal force above the mean) and of the weak contacts, each divided
  /// by the number of all contacts, so that their sum is `fabric`.
  Eigen::MatrixXd strong_fabric, weak_fabric;
};

/// Computes the coordination and forces of the force-carrying structure.
/// @param carrying  result of carrying_structure() for this packing
template <int Dim>
CarryingForces carrying_forces(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
