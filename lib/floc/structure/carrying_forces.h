#pragma once

#include <optional>

#include "floc/network/carrying_structure.h"

namespace floc {

/// Coordination and forces of the force-carrying structure (docs/physics.md, "Force-carrying structure"),
/// [AR2007]. Shares of grains refer to all grains, averages to its contacts; zero without any.
struct CarryingForces {
  int n_contacts = 0;
  double z = 0.0;       ///< 2 n_contacts/N
  double z_star = 0.0;  ///< 2 n_contacts/(N (1 - x0))
  double x0 = 0.0;      ///< share of rattlers
  double x2 = 0.0;      ///< share of grains with two contacts
  /// z* + 2 x2/(3 (1 - x0)): each sphere with two contacts turns about the line through them at no cost, so
  /// that H = (3/2) N (1 - x0) (z** - 4) + constant with friction. Disks have no such rotation: absent in 2D.
  std::optional<double> z_star_star;
  /// `<N^q>/<N>^q` of the elastic normal force N
  double Z_third = 0.0, Z_five_thirds = 0.0, Z2 = 0.0;
  double M1 = 0.0, M2 = 0.0;   ///< mean |F_T|/N over contacts with N above, and below, `<N>`
  double sliding_share = 0.0;  ///< share of contacts whose tangential force is at its cap
  /// Fabric `<n n>` less 1/Dim (Dim x Dim): no trace, zero where directions are isotropic.
  Eigen::MatrixXd fabric;
  /// Fabric of the strong contacts, with N above `<N>`, and of the others, each over the number of all
  /// contacts, so that their sum is the fabric.
  Eigen::MatrixXd strong_fabric, weak_fabric;
};

/// Computes the coordination and forces of the force-carrying structure.
/// @param carrying  carrying_structure() of this packing
template <int Dim>
CarryingForces carrying_forces(const Packing<Dim>& packing, const CarryingStructure& carrying);

}  // namespace floc
