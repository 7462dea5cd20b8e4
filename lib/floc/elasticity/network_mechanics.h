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
  /// Absent where a mechanism leaves the stress without a solution.
  std::optional<StepResponse<Dim>> isotropic;
  std::optional<StepResponse<Dim>> deviatoric;  ///< likewise
  Percolation percolation;
  std::vector<bool> backbone;  ///< carries an increment in one step or the other; empty if there is neither
};

/// @param moduli  of the same network
template <int Dim>
ContactMechanics<Dim> contact_mechanics(const ContactNetwork<Dim>& network, const Moduli& moduli);

/// How determined a contact network is, in numbers (docs/physics.md, "Stability and mechanisms").
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

template <int Dim>
NetworkMechanics network_mechanics(const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                                   const Moduli& moduli, const ContactMechanics<Dim>& contacts);

}  // namespace floc
