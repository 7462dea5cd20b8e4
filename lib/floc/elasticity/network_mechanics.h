#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/force_increments.h"
#include "floc/elasticity/indeterminacy.h"
#include "floc/elasticity/moduli.h"
#include "floc/network/percolation.h"

namespace floc {

/// Changes of the contact forces of a network in an isotropic and in a deviatoric step of stress.
template <int Dim>
struct ContactMechanics {
  /// Response to an isotropic step of stress; absent if the stress does work on a mechanism.
  std::optional<StepResponse<Dim>> isotropic;
  /// Response to a deviatoric step of stress; absent if the stress does work on a mechanism.
  std::optional<StepResponse<Dim>> deviatoric;
  Percolation percolation;
  /// For each contact, whether its forces change in at least one of the two steps of stress; empty if both responses
  /// are absent.
  std::vector<bool> backbone;
};

/// Computes the response of each contact to an isotropic and to a deviatoric step of stress, and finds the backbone and
/// the directions in which the network percolates.
/// @param moduli  moduli of the same network
template <int Dim>
ContactMechanics<Dim> contact_mechanics(const ContactNetwork<Dim>& network, const Moduli& moduli);

/// Numbers that describe to which extent the contacts of a network determine the contact forces (docs/physics.md,
/// "Stability and mechanisms").
struct NetworkMechanics {
  double rattler_fraction = 0.0;  ///< x0: number of rattlers divided by the number of grains
  /// Coordination number without rattlers: twice the number of touching contacts between grains that are not rattlers,
  /// divided by the number of grains that are not rattlers.
  double z_star = 0.0;
  /// Dimensionless shear modulus G/(K_N Phi (1 - x0)), with the mean normal stiffness K_N of touching contacts, the
  /// solid fraction Phi and the rattler fraction x0; in 3D multiplied by the largest diameter. Absent without contacts.
  std::optional<double> G_star;
  int n_dead_ends =
      0;  ///< number of grains that have one contact or belong to a chain that ends in such a grain
  int n_components = 0;  ///< number of connected parts of the network after the dead ends have been removed
  Indeterminacy indeterminacy;
  /// smallest share of the touching contacts that together have 95 % of the elastic energy in the isotropic step of
  /// stress
  std::optional<double> energy_share_95;
  /// smallest share of the touching contacts that together have 95 % of the elastic energy in the deviatoric step of
  /// stress
  std::optional<double> energy_share_95_deviatoric;
  /// share of contacts in the mechanical backbone, see mechanical_backbone()
  std::optional<double> backbone_share;
  /// Share of contacts through which a current would flow if every contact were a conductor, see Percolation; absent
  /// without contacts.
  std::optional<double> scalar_backbone_share;
  int n_percolating = 0;  ///< number of directions in which the network percolates through the periodic cell
};

/// Computes the numbers of NetworkMechanics.
/// @param moduli, contacts  moduli and contact_mechanics() of the same network
template <int Dim>
NetworkMechanics network_mechanics(const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                                   const Moduli& moduli, const ContactMechanics<Dim>& contacts);

}  // namespace floc
