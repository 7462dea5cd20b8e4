#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Settings of the comparison with random signs on the same bonds.
struct PhaseOptions {
  int n_shuffles = 20;  ///< enough for percolation to a tenth; each costs one search for connected parts
  std::uint64_t seed = 1;
  int n_bins = 10;  ///< of the share of like neighbours

  static constexpr WholeRange kShuffles{.least = 1, .most = 100000};
  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Mean pressure of the grains of a phase by the share of their neighbours that belong to it.
struct LikeNeighbourBin {
  double low = 0.0, high = 0.0;  ///< of the share, [low, high); the last bin holds 1
  int n_grains = 0;
  double mean_size = 0.0;   ///< of |p| (stress)
  double mean_error = 0.0;  ///< standard error of it; 0 for fewer than two grains
};

/// How one of the two phases of particle pressure is spread over the bonds.
struct PhaseGeometry {
  std::vector<int> cluster_sizes;    ///< grains of its connected parts, the largest first
  std::array<bool, 3> along{};       ///< lattice vectors that one of its parts winds along
  int n_directions = 0;              ///< independent ways in which one of its parts winds around the cell
  double shuffled_directions = 0.0;  ///< the mean of that over shuffles of the signs
  double shuffled_percolates = 0.0;  ///< share of the shuffles in which it is not zero
  double largest_shuffled = 0.0;     ///< mean size of the largest part over shuffles (grains)
  std::vector<LikeNeighbourBin> by_share;
};

/// The phases of positive and of negative particle pressure on the graph of bonds. Signs that were given to the
/// grains at random would percolate too, and have like neighbours: the same signs, shuffled among the grains
/// that have one, are the control.
struct PhaseStructure {
  PhaseGeometry positive, negative;
  int n_bonds = 0;              ///< between two grains with a sign
  double like_share = 0.0;      ///< share of these between like signs
  double like_expected = 0.0;   ///< its mean over all shuffles, in closed form
  double like_deviation = 0.0;  ///< standard deviation over the shuffles made
};

/// @param pressure  of each grain of the network (stress); zero: in neither phase
/// @param cell      of the packing
/// @throws InputError with the faults of the options
template <int Dim>
PhaseStructure phase_structure(const ContactNetwork<Dim>& network, const Cell<Dim>& cell,
                               const std::vector<double>& pressure, const PhaseOptions& options);

}  // namespace floc
