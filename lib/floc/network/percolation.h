#pragma once

#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Contacts of a network that can carry a current or a stress through the periodic cell, determined from the
/// connections alone.
struct Percolation {
  /// For each contact, whether it carries current if every contact conducts and a gradient is imposed across the
  /// periodic cell and between opposite walls, for almost all conductances. These are the contacts of blocks (parts
  /// that stay connected without any single grain) that contain a loop around the cell or from wall to wall; in such a
  /// block every contact lies on such a loop (Zaslavsky's lemma on theta graphs).
  std::vector<bool> scalar_backbone;
  /// For each contact, whether it belongs to a part that hangs on a single grain, or on a single contact with a wall,
  /// and contains no loop around the cell: no strain of the cell changes the forces in it. A contact that is neither
  /// here nor in `scalar_backbone` connects two parts that both wind around the cell; it carries no current but may
  /// carry a moment.
  std::vector<bool> dead_end;
  int n_directions =
      0;  ///< largest number of independent directions in which a connected part winds around the cell
};

/// Finds the scalar backbone, the dead ends and the directions of percolation of a network.
template <int Dim>
Percolation find_percolation(const ContactNetwork<Dim>& network);

}  // namespace floc
