#pragma once

#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Contacts of a network that can carry a current or a stress through the periodic cell, judged by connectivity
/// alone.
struct Percolation {
  /// Contacts that carry current if each conducts and a gradient is imposed across the periodic cell, and from
  /// each wall to its opposite, for almost all conductances. These are the contacts of the blocks (parts that
  /// stay connected without any one grain) that hold a loop around the cell or from wall to wall: in such a
  /// block every contact lies on one (Zaslavsky's lemma on theta graphs).
  std::vector<bool> scalar_backbone;
  /// Contacts of parts that hang on one grain, or on one contact with a wall, and hold no loop around the cell:
  /// no strain of the cell changes any force in them. Contacts in neither list join parts that both wind around
  /// the cell; they conduct nothing but may carry a moment.
  std::vector<bool> dead_end;
  int n_directions = 0;  ///< largest number of independent ways in which a part winds around the cell
};

/// Finds the backbone, dead ends and directions of percolation of a network.
template <int Dim>
Percolation find_percolation(const ContactNetwork<Dim>& network);

}  // namespace floc
