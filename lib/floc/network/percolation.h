#pragma once

#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Contacts of a network that can carry an electric current or a stress through the periodic cell. These contacts
/// follow from the list of grains in contact alone; stiffnesses are not needed.
struct Percolation {
  /// For each contact, whether it is in the scalar backbone: whether it carries current if every contact is a resistor
  /// and a voltage is applied across the periodic cell or between opposite walls. A block is a set of contacts in which
  /// any two contacts lie on a common loop. If a block contains a loop around the cell or from wall to wall, every
  /// contact of the block lies on a loop of this kind (Zaslavsky's lemma on theta graphs). All contacts of the block
  /// are then in the backbone, because the current through them is nonzero for almost all values of the resistances.
  /// The contacts of all other blocks are not in the backbone.
  std::vector<bool> scalar_backbone;
  /// For each contact, whether it is in a dead end. A dead end is a part of the network that contains no loop around
  /// the cell, and is connected to the rest by a single grain or by a single contact with a wall. No strain of the cell
  /// changes the forces in a dead end. Some contacts are neither in a dead end nor in the scalar backbone. Each of
  /// these contacts connects two parts that both wind around the cell. No current flows through the contact, but its
  /// moment may differ from zero.
  std::vector<bool> dead_end;
  /// largest number of independent lattice vectors along which a connected part of the network winds around the cell
  int n_directions = 0;
};

/// Finds the scalar backbone, the dead ends and the directions of percolation of a network.
template <int Dim>
Percolation find_percolation(const ContactNetwork<Dim>& network);

}  // namespace floc
