#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Settings of phase_structure(). This function compares the phases of a packing with the phases that result if the
/// signs of the particle pressures are shuffled at random.
struct PhaseOptions {
  /// Number of times that the signs of the particle pressures are shuffled. With 20 shuffles, the error of
  /// shuffled_percolates is about 0.1. Each shuffle requires a search for connected parts in each phase.
  int n_shuffles = 20;
  std::uint64_t seed = 1;
  /// Number of bins for the share of neighbours in the phase of the grain.
  int n_bins = 10;

  static constexpr WholeRange kShuffles{.least = 1, .most = 100000};
  /// Returns the faults of the options, each as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Grains of one phase (positive or negative pressure) with similar shares of neighbours in the same phase.
struct LikeNeighbourBin {
  /// Range [low, high) of the share of neighbours in the same phase; the last bin includes 1.
  double low = 0.0, high = 0.0;
  int n_grains = 0;
  double mean_size = 0.0;   ///< mean magnitude of the pressure over the grains of the bin (stress)
  double mean_error = 0.0;  ///< standard error of mean_size; 0 for fewer than two grains
};

/// Connectivity of one of the two phases: the grains with positive pressure, or the grains with negative pressure.
struct PhaseGeometry {
  std::vector<int> cluster_sizes;  ///< number of grains of each connected part, the largest first
  /// For each lattice vector, whether a connected part winds around the cell along this vector.
  std::array<bool, 3> along{};
  /// Largest number of independent directions in which a connected part winds around the cell.
  int n_directions = 0;
  double shuffled_directions = 0.0;  ///< mean of n_directions over the shuffles of the signs
  double shuffled_percolates = 0.0;  ///< share of the shuffles with n_directions > 0
  /// Number of grains of the largest connected part, averaged over the shuffles.
  double largest_shuffled = 0.0;
  std::vector<LikeNeighbourBin> by_share;
};

/// The two phases of a packing: the grains with positive pressure and the grains with negative pressure. Grains of the
/// same phase are connected by bonds. Phases may percolate, and neighbours may have equal signs, by mere chance. For
/// comparison, the signs are therefore shuffled among the grains with nonzero pressure.
struct PhaseStructure {
  PhaseGeometry positive, negative;
  int n_bonds = 0;             ///< number of bonds between two grains of nonzero pressure
  double like_share = 0.0;     ///< share of these bonds whose two grains have pressures of equal sign
  double like_expected = 0.0;  ///< mean of like_share over all possible shuffles of the signs, in closed form
  /// Standard deviation of like_share over the shuffles (PhaseOptions::n_shuffles).
  double like_deviation = 0.0;
};

/// Computes the structure of the two phases, the grains with positive pressure and the grains with negative pressure.
/// @param pressure  pressure of each grain of the network (stress); a grain of zero pressure is in neither phase
/// @param cell      periodic cell of the packing
/// @throws InputError with the faults of the options if they are not valid
template <int Dim>
PhaseStructure phase_structure(const ContactNetwork<Dim>& network, const Cell<Dim>& cell,
                               const std::vector<double>& pressure, const PhaseOptions& options);

}  // namespace floc
