#pragma once

#include <cstdint>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Whole cells along each lattice vector, added up over many contacts: up to 1e9 (a state's limit) times their
/// number.
template <int Dim>
using CellCount = Vec<Dim, std::int64_t>;

/// A connected part of a network, unwrapped from the periodic cell along its contacts.
template <int Dim>
struct Component {
  std::vector<int> grains;        ///< in the order in which they are reached
  std::vector<Vec<Dim>> place;    ///< unwrapped position of each, the first at the origin (length)
  std::vector<Vec<Dim>> winding;  ///< independent lattice vectors between the part and its own images (length)
  std::vector<int> on_walls;      ///< contacts of its grains with walls
};

/// Indices of the contacts of each grain.
using Adjacency = std::vector<std::vector<int>>;

/// Returns the contacts of each grain; a contact of a grain with its own image is listed twice.
template <int Dim>
Adjacency contacts_of_grains(const ContactNetwork<Dim>& network);

/// Finds the connected parts of the grains that have an active contact, sorted by first grain. A part that
/// winds around the cell along n independent lattice vectors (its `winding`, found from integer images)
/// percolates along them.
/// @param of      contacts_of_grains() of the network
/// @param active  one entry per contact: whether it connects
/// @throws InputError if images lead around more than 2^40 cells
template <int Dim>
std::vector<Component<Dim>> find_components(const ContactNetwork<Dim>& network, const Adjacency& of,
                                            const std::vector<bool>& active);

}  // namespace floc
