#pragma once

#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Contacts of a network that can carry a current or a stress through the periodic cell, as far as this follows from
/// which grains are in contact.
struct Percolation {
  /// Scalar backbone: for each contact, whether it carries current if every contact conducts and a voltage is applied
  /// across the periodic cell or between opposite walls, for almost all conductances. Contacts any two of which lie on
  /// a common loop form a block, which stays connected if any one grain is removed. A contact is in the scalar backbone
  /// if its block contains a loop around the cell or from wall to wall; every contact of the block then lies on such a
  /// loop (Zaslavsky's lemma on theta graphs).
  std::vector<bool> scalar_backbone;
  /// For each contact, whether it is in a dead end: a part of the network that hangs on a single grain, or on a single
  /// contact with a wall, and contains no loop around the cell. No strain of the cell changes the forces in a dead end.
  /// A contact that is neither in a dead end nor in the scalar backbone connects two parts that both wind around the
  /// cell; it carries no current but may carry a moment.
  std::vector<bool> dead_end;
  /// largest number of independent directions in which a connected part winds around the cell
  int n_directions = 0;
};

/// Finds the scalar backbone, the dead ends and the directions of percolation of a network.
template <int Dim>
Percolation find_percolation(const ContactNetwork<Dim>& network);

}  // namespace floc
