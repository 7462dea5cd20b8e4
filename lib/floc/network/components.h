#pragma once

#include <cstdint>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// For two grains connected by a chain of contacts: the number of periodic cells between them along each lattice
/// vector. The number needs 64 bits, because a single contact may connect grains that are up to 1e9 cells apart.
template <int Dim>
using CellCount = Vec<Dim, std::int64_t>;

/// Connected part of a contact network. Its grains are unwrapped from the periodic cell: grains are placed one after
/// another, each at the periodic image that touches a grain placed before.
template <int Dim>
struct Component {
  std::vector<int> grains;  ///< grains of the part, in the order in which the search reaches them
  /// unwrapped position of each grain, with the first grain at the origin (length)
  std::vector<Vec<Dim>> place;
  /// linearly independent lattice vectors from this part to those of its periodic images to which it is connected
  /// (length)
  std::vector<Vec<Dim>> winding;
  std::vector<int> on_walls;  ///< indices of the contacts between grains of this part and walls
};

/// List of the indices of the contacts of each grain.
using Adjacency = std::vector<std::vector<int>>;

/// Returns the contacts of each grain. A contact of a grain with its own periodic image is listed twice.
template <int Dim>
Adjacency contacts_of_grains(const ContactNetwork<Dim>& network);

/// Finds the connected parts of a network, sorted by their first grain. Only active contacts connect grains, and only
/// grains with an active contact are considered. A part that is connected to its own periodic images along n
/// independent lattice vectors (Component::winding) winds around the cell and percolates along these vectors. The
/// vectors are computed from the integers NetworkContact::image.
/// @param of      contacts_of_grains() of the network
/// @param active  for each contact, whether it connects its grains
/// @throws InputError if a chain of contacts extends over more than 2^40 cells
template <int Dim>
std::vector<Component<Dim>> find_components(const ContactNetwork<Dim>& network, const Adjacency& of,
                                            const std::vector<bool>& active);

}  // namespace floc
