#pragma once

#include "floc/lattice/lattice_solution.h"
#include "floc/packing/packing.h"

namespace floc {

/// Returns a loaded lattice as a packing. The grains are the nodes that have an element, in the order of the nodes,
/// with the spacing as diameter. The contacts are the elements that carry a force, with their forces and stiffnesses.
/// The packing and the lattice therefore have the same moduli, modes and pictures.
template <int Dim>
Packing<Dim> packing_of(const Lattice<Dim>& lattice, const LatticeNetwork<Dim>& network,
                        const LatticeSolution<Dim>& solution);

}  // namespace floc
