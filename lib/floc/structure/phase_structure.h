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
  /// Number of shuffles: 20 give the share that percolates to a tenth. Each costs one search for connected
  /// parts.
  int n_shuffles = 20;
  std::uint64_t seed = 1;
  int n_bins = 10;  ///< number of bins of the share of like neighbours

  static constexpr WholeRange kShuffles{.least = 1, .most = 100000};
  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Mean pressure of the grains of a phase by the share of their neighbours that belong to it.
struct LikeNeighbourBin {
  double low = 0.0, high = 0.0;  ///< range [low, high) of the share; the last bin includes 1
  int n_grains = 0;
  double mean_size = 0.0;   ///< mean of |p| (stress)
  double mean_error = 0.0;  ///< standard error of mean_size; 0 for fewer than two grains
};

/// Connectivity of one of the two phases of particle pressure.
struct PhaseGeometry {
  std::vector<int> cluster_sizes;    ///< numbers of grains of its connected parts, the largest first
  std::array<bool, 3> along{};       ///< lattice vectors that one of its parts winds along
  int n_directions = 0;              ///< independent ways in which one of its parts winds around the cell
  double shuffled_directions = 0.0;  ///< mean of n_directions over shuffles of the signs
  double shuffled_percolates = 0.0;  ///< share of the shuffles in which n_directions is not zero
  double largest_shuffled = 0.0;     ///< mean number of grains of the largest part over shuffles
  std::vector<LikeNeighbourBin> by_share;
};

/// Phases of positive and of negative particle pressure on the graph of bonds. Random signs would percolate
/// too, and have like neighbours; the control is therefore the same signs shuffled among the grains that have
/// one.
struct PhaseStructure {
  PhaseGeometry positive, negative;
  int n_bonds = 0;              ///< number of bonds between two grains with a sign
  double like_share = 0.0;      ///< share of these between like signs
  double like_expected = 0.0;   ///< mean of like_share over all shuffles, in closed form
  double like_deviation = 0.0;  ///< standard deviation over the shuffles made
};

/// Computes the structure of both phases.
/// @param pressure  of each grain of the network (stress); zero: in neither phase
/// @param cell      of the packing
/// @throws InputError with the faults of the options
template <int Dim>
PhaseStructure phase_structure(const ContactNetwork<Dim>& network, const Cell<Dim>& cell,
                               const std::vector<double>& pressure, const PhaseOptions& options);

}  // namespace floc
