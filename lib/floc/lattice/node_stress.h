#pragma once

#include <optional>
#include <vector>

#include "floc/lattice/lattice_solution.h"

namespace floc {

/// Returns the stress of each node, compression positive: the symmetric part of sigma_a = -(1/V_a) sum of r f^T over
/// the elements of node a, with the volume V_a of the node, the force f of the element on it, and the vector r from the
/// node to the point at which f acts. The mean over all nodes, weighted by volume and with zero for void nodes, is the
/// stress of the cell. The stress of fixed nodes includes the forces that hold them.
template <int Dim>
std::vector<Mat<Dim>> node_stress(const Lattice<Dim>& lattice, const LatticeNetwork<Dim>& network,
                                  const LatticeSolution<Dim>& solution);

/// Exponential tail exp(-beta x) of a distribution beyond a threshold, fitted by maximum likelihood.
struct StressTail {
  double from = 1.0;                ///< threshold, in units of the mean
  int n = 0;                        ///< number of values beyond the threshold
  std::optional<double> beta = {};  ///< decay rate beta; absent for fewer than 10 values
  /// Standard error beta/sqrt(n) of beta. It assumes independent values, but the stresses of neighbouring nodes are
  /// correlated.
  std::optional<double> error = {};
};

/// Distribution of a stress component over the nodes of a lattice, in units of its mean over the nodes where it has the
/// sign of the load.
struct StressDistribution {
  int n = 0;                 ///< number of nodes
  double mean = 0.0;         ///< mean over all nodes (stress)
  double unit = 0.0;         ///< mean over nodes with the sign of the load: x = stress/unit (stress)
  double spread = 0.0;       ///< standard deviation over all nodes, divided by `mean`
  double other_share = 0.0;  ///< share of nodes where the stress has the opposite sign to the load
  double largest = 0.0;      ///< largest value of x = stress/unit
  StressTail loaded_1{1.0}, loaded_2{2.0};  ///< tails of x = stress/unit beyond 1 and beyond 2
  /// tail of the stresses whose sign is opposite to that of the load, beyond 1 in units of their mean
  StressTail other_1{1.0};
};

/// Computes the distribution of one stress component.
/// @param values  values of the stress component at the nodes to include (stress)
/// @param sign    sign of the load: 1 for compression, -1 for tension
StressDistribution stress_distribution(const std::vector<double>& values, double sign);

}  // namespace floc
