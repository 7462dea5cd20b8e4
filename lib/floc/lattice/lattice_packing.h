#pragma once

#include "floc/lattice/lattice_solution.h"
#include "floc/packing/packing.h"

namespace floc {

/// A loaded lattice as a packing: its grains are the nodes that have an element, in their order, as wide as the
/// spacing; its contacts are the elements that carry, with their forces and stiffnesses. The moduli, networks,
/// modes and pictures of this packing are thus those of the lattice.
template <int Dim>
Packing<Dim> packing_of(const Lattice<Dim>& lattice, const LatticeNetwork<Dim>& network,
                        const LatticeSolution<Dim>& solution);

}  // namespace floc
