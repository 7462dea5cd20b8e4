#pragma once

#include "floc/network/contact_network.h"
#include "floc/packing/packing.h"

namespace floc {

/// Number of negative eigenvalues of the stiffness matrix of a network, grains and diagonal strains, after
/// rigid translations, rattlers and free rollers are removed: 0 for a stable state. Mechanisms do not count.
/// Inertia alone: a Cholesky factor that succeeds says that there is none, else the negative pivots of L D L^T
/// are counted; a network without negative stiffness needs neither.
template <int Dim>
[[nodiscard]] int count_negative_eigenvalues(const ContactNetwork<Dim>& network);

/// The same with the geometric terms of the forces that the network carries.
/// @param stress  static stress of the state, which the strains convect
template <int Dim>
[[nodiscard]] int count_negative_eigenvalues(const ContactNetwork<Dim>& network, const Mat<Dim>& stress);

/// The same of a packing without its rattlers, see ModuliOptions::loaded_network(). Without prestress only
/// distant attractions can make it more than 0.
template <int Dim>
[[nodiscard]] int count_negative_eigenvalues(const Packing<Dim>& packing, bool prestress = false);

}  // namespace floc
