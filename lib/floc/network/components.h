#pragma once

#include <cstdint>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Number of whole cells along each lattice vector, added up over many contacts: up to 1e9 (the limit for one contact
/// of a state) times the number of contacts.
template <int Dim>
using CellCount = Vec<Dim, std::int64_t>;

/// Connected part of a contact network, unwrapped from the periodic cell along its contacts.
template <int Dim>
struct Component {
  std::vector<int> grains;  ///< grains of the part, in the order in which the search reaches them
  std::vector<Vec<Dim>>
      place;  ///< unwrapped position of each grain, with the first grain at the origin (length)
  /// linearly independent lattice vectors that lead from the part to its own periodic images (length)
  std::vector<Vec<Dim>> winding;
  std::vector<int> on_walls;  ///< contacts of the grains of the part with walls
};

/// Lists of contacts (indices), one list per grain.
using Adjacency = std::vector<std::vector<int>>;

/// Returns the contacts of each grain; a contact of a grain with its own image is listed twice.
template <int Dim>
Adjacency contacts_of_grains(const ContactNetwork<Dim>& network);

/// Finds the connected parts of a network, among the grains that have an active contact, sorted by their first grain. A
/// part that winds around the cell along n independent lattice vectors (`winding`, found from the integer images of
/// contacts) percolates along them.
/// @param of      contacts_of_grains() of the network
/// @param active  one entry per contact: whether it connects its grains
/// @throws InputError if a chain of contacts leads around more than 2^40 cells
template <int Dim>
std::vector<Component<Dim>> find_components(const ContactNetwork<Dim>& network, const Adjacency& of,
                                            const std::vector<bool>& active);

}  // namespace floc
