#pragma once

#include <optional>

#include "floc/network/carrying_structure.h"

namespace floc {

/// Coordination and forces of the force-carrying structure of a packing. This structure consists of all grains and
/// contacts except rattlers and their contacts (docs/physics.md, "Force-carrying structure"; [AR2007]). Shares of
/// grains are relative to all N grains of the packing. Averages are taken over the contacts of the structure, and are
/// zero if there are no contacts.
struct CarryingForces {
  int n_contacts = 0;
  double z = 0.0;       ///< coordination number 2 n_contacts/N, with N the number of all grains
  double z_star = 0.0;  ///< coordination number without rattlers, 2 n_contacts/(N (1 - x0))
  double x0 = 0.0;      ///< share of rattlers (grains that carry no force) among all grains
  double x2 = 0.0;      ///< share of grains with exactly two force-carrying contacts
  /// Corrected coordination number z** = z* + 2 x2/(3 (1 - x0)), where z* is the member z_star. It is due to spheres
  /// with two contacts, which turn freely about the line through both contacts. With friction and N grains, the degree
  /// of hyperstaticity is H = (3/2) N (1 - x0) (z** - 4) + constant. z** is absent in 2D, where a disk cannot turn
  /// about this line.
  std::optional<double> z_star_star;
  /// Reduced moments `<N^q>/<N>^q` of the elastic normal force N, for q = 1/3, 5/3 and 2.
  double Z_third = 0.0, Z_five_thirds = 0.0, Z2 = 0.0;
  /// Means of |F_T|/N, the tangential force divided by the elastic normal force. M1 is the mean over the contacts with
  /// N > `<N>`, and M2 the mean over the contacts with N <= `<N>`.
  double M1 = 0.0, M2 = 0.0;
  double sliding_share = 0.0;  ///< share of contacts whose tangential force is at the limit of friction
  /// Fabric tensor `<n n>` - 1/Dim of the normals n (Dim x Dim). The trace is zero. All entries are zero if the
  /// directions of the contacts are isotropic.
  Eigen::MatrixXd fabric;
  /// Parts of `fabric` due to the strong contacts (elastic normal force above the mean) and due to the weak contacts.
  /// The sum of both parts is `fabric`.
  Eigen::MatrixXd strong_fabric, weak_fabric;
};

/// Computes the coordination and forces of the force-carrying structure.
/// @param carrying  result of carrying_structure() for this packing
template <int Dim>
CarryingForces carrying_forces(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
