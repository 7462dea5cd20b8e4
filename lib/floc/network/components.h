#pragma once

#include <cstdint>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Number of periodic cells along each lattice vector between two grains that a chain of contacts connects. The number
/// needs 64 bits, because a single contact may connect grains that are up to 1e9 cells apart.
template <int Dim>
using CellCount = Vec<Dim, std::int64_t>;

/// Connected part of a contact network. Its grains are unwrapped from the periodic cell: each grain is placed at a
/// periodic image that touches a grain that was placed before.
template <int Dim>
struct Component {
  std::vector<int> grains;  ///< grains of the part, in the order in which the search reaches them
  /// unwrapped position of each grain, with the first grain at the origin (length)
  std::vector<Vec<Dim>> place;
  /// linearly independent lattice vectors along which this part is connected to its own periodic images (length)
  std::vector<Vec<Dim>> winding;
  std::vector<int> on_walls;  ///< contacts between grains of this part and walls
};

/// List of the indices of the contacts of each grain.
using Adjacency = std::vector<std::vector<int>>;

/// Returns the contacts of each grain. A contact of a grain with its own periodic image is listed twice.
template <int Dim>
Adjacency contacts_of_grains(const ContactNetwork<Dim>& network);

/// Finds the connected parts of a network, sorted by their first grain. Only active contacts connect grains, and only
/// grains with an active contact are considered. A part that winds around the periodic cell along n independent lattice
/// vectors (Component::winding) percolates along these n vectors. The vectors are found from the integer images of
/// contacts.
/// @param of      contacts_of_grains() of the network
/// @param active  for each contact, whether it connects its grains
/// @throws InputError if a chain of contacts extends over more than 2^40 cells
template <int Dim>
std::vector<Component<Dim>> find_components(const ContactNetwork<Dim>& network, const Adjacency& of,
                                            const std::vector<bool>& active);

}  // namespace floc
