#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Settings of the comparison of the signs of particle pressure with randomly shuffled signs.
struct PhaseOptions {
  /// Number of shuffles of the signs of particle pressure. 20 shuffles determine the share of shuffles that
  /// percolate to about 0.1; each costs one search for connected parts.
  int n_shuffles = 20;
  std::uint64_t seed = 1;
  int n_bins = 10;  ///< number of bins of the share of neighbours with equal sign

  static constexpr WholeRange kShuffles{.least = 1, .most = 100000};
  /// Returns the faults of the options, each as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Mean pressure of the grains of a phase in a bin of the share of their neighbours that are in this phase.
struct LikeNeighbourBin {
  /// Range [low, high) of the share of neighbours in the phase; the last bin includes 1.
  double low = 0.0, high = 0.0;
  int n_grains = 0;
  double mean_size = 0.0;   ///< mean of |p| over the grains of the bin (stress)
  double mean_error = 0.0;  ///< standard error of mean_size; 0 for fewer than two grains
};

/// Connectivity of one of the two phases: the grains with positive, or with negative, pressure.
struct PhaseGeometry {
  std::vector<int> cluster_sizes;  ///< numbers of grains of the connected parts, the largest first
  std::array<bool, 3> along{};     ///< whether a part winds around the cell along each lattice vector
  /// Largest number of independent directions in which a part winds around the cell.
  int n_directions = 0;
  double shuffled_directions = 0.0;  ///< mean of n_directions over the shuffles of the signs
  double shuffled_percolates = 0.0;  ///< share of the shuffles in which n_directions is not zero
  double largest_shuffled = 0.0;     ///< mean over the shuffles of the number of grains of the largest part
  std::vector<LikeNeighbourBin> by_share;
};

/// The two phases of grains with positive and with negative pressure, connected by bonds. Even random signs
/// would percolate and have neighbours of equal sign. The phases are therefore compared with a control, in
/// which the signs are shuffled among the grains of nonzero pressure.
struct PhaseStructure {
  PhaseGeometry positive, negative;
  int n_bonds = 0;              ///< number of bonds between two grains of nonzero pressure
  double like_share = 0.0;      ///< share of these bonds that join equal signs
  double like_expected = 0.0;   ///< mean of like_share over all possible shuffles, in closed form
  double like_deviation = 0.0;  ///< standard deviation of like_share over the shuffles made
};

/// Computes the structure of the phases of positive and of negative particle pressure.
/// @param pressure  pressure of each grain of the network (stress); a grain of zero pressure is in neither phase
/// @param cell      periodic cell of the packing
/// @throws InputError with the faults of the options if they are not valid
template <int Dim>
PhaseStructure phase_structure(const ContactNetwork<Dim>& network, const Cell<Dim>& cell,
                               const std::vector<double>& pressure, const PhaseOptions& options);

}  // namespace floc
