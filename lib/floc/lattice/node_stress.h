#pragma once

#include <optional>
#include <vector>

#include "floc/lattice/lattice_solution.h"

namespace floc {

/// Returns the stress of each node, compression positive: the symmetric part of sigma_a = -(1/V_a) sum of r f^T
/// over its elements, with r from the node to the point at which the element's force f on it acts. The mean
/// over nodes, weighted by volume and with void nodes as zero, is the stress of the cell; the stress of held
/// nodes includes the forces that hold them.
template <int Dim>
std::vector<Mat<Dim>> node_stress(const Lattice<Dim>& lattice, const LatticeNetwork<Dim>& network,
                                  const LatticeSolution<Dim>& solution);

/// An exponential tail exp(-beta x) beyond a threshold, by maximum likelihood.
struct StressTail {
  double from = 1.0;                ///< threshold, in units of the mean
  int n = 0;                        ///< number of values beyond it
  std::optional<double> beta = {};  ///< absent with fewer than 10 values
  /// beta/sqrt(n), which assumes independent values; those of neighbouring nodes are correlated.
  std::optional<double> error = {};
};

/// Distribution of a stress component over nodes, in units of its mean over those with the sign of the load.
struct StressDistribution {
  int n = 0;                 ///< nodes
  double mean = 0.0;         ///< over all of them (stress)
  double unit = 0.0;         ///< mean over nodes with the sign of the load: x = stress/unit (stress)
  double spread = 0.0;       ///< standard deviation over all nodes, over `mean`
  double other_share = 0.0;  ///< share of nodes of the other sign
  double largest = 0.0;      ///< largest x
  StressTail loaded_1{1.0}, loaded_2{2.0};  ///< of x beyond 1 and 2
  StressTail other_1{1.0};                  ///< tail of -x beyond 1, in units of the mean of the other sign
};

/// Computes the distribution of one component.
/// @param values  component of the stress of the nodes to include
/// @param sign    sign of the load: 1 for compression, -1 for tension
StressDistribution stress_distribution(const std::vector<double>& values, double sign);

}  // namespace floc
