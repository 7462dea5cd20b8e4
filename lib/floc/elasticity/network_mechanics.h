#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/force_increments.h"
#include "floc/elasticity/indeterminacy.h"
#include "floc/elasticity/moduli.h"
#include "floc/network/percolation.h"

namespace floc {

/// Response of each contact of a network to a small step, isotropic and deviatoric.
template <int Dim>
struct ContactMechanics {
  /// Response to an isotropic step; absent where the stress would do work on a mechanism.
  std::optional<StepResponse<Dim>> isotropic;
  /// Response to a deviatoric step; absent under the same condition.
  std::optional<StepResponse<Dim>> deviatoric;
  Percolation percolation;
  /// Whether a contact carries an increment in one step or the other; empty if both responses are absent.
  std::vector<bool> backbone;
};

/// Computes the response of each contact to both steps, and the percolation of the network.
/// @param moduli  of the same network
template <int Dim>
ContactMechanics<Dim> contact_mechanics(const ContactNetwork<Dim>& network, const Moduli& moduli);

/// Counts and ratios that say how far the contacts of a network determine its forces (docs/physics.md,
/// "Stability and mechanisms").
struct NetworkMechanics {
  double rattler_fraction = 0.0;  ///< x0
  /// Twice the touching contacts between grains per grain that is not a rattler; contacts of rattlers are left out.
  double z_star = 0.0;
  /// G/(K_N Phi (1 - x0)) with the mean K_N of touching contacts, in 3D times the largest diameter so that it
  /// has no dimension; absent without contacts.
  std::optional<double> G_star;
  int n_dead_ends = 0;   ///< grains that hang on a single contact, or on a chain of such grains
  int n_components = 0;  ///< connected parts besides them
  Indeterminacy indeterminacy;
  std::optional<double> energy_share_95;  ///< isotropic step, see StepResponse
  std::optional<double> energy_share_95_deviatoric;
  std::optional<double> backbone_share;  ///< contacts of the mechanical backbone over all
  /// Contacts of the scalar backbone over all; absent without contacts.
  std::optional<double> scalar_backbone_share;
  int n_percolating = 0;  ///< directions in which the network winds around the cell
};

/// Computes these numbers. @param moduli, contacts  of the same network
template <int Dim>
NetworkMechanics network_mechanics(const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                                   const Moduli& moduli, const ContactMechanics<Dim>& contacts);

}  // namespace floc
