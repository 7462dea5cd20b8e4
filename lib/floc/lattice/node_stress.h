#pragma once

#include <optional>
#include <vector>

#include "floc/lattice/lattice_solution.h"

namespace floc {

/// Stress of each node, compression positive: sigma_a = -(1/V_a) sum over its elements of r x f, r from the
/// node to where the element's force f on it acts; the symmetric part. The mean over nodes, weighted by volume,
/// is the stress of the cell, void nodes being zero; held nodes also carry what holds them.
template <int Dim>
std::vector<Mat<Dim>> node_stress(const Lattice<Dim>& lattice, const LatticeNetwork<Dim>& network,
                                  const LatticeSolution<Dim>& solution);

/// An exponential tail exp(-beta x) beyond a threshold, by maximum likelihood.
struct StressTail {
  double from = 1.0;                ///< threshold, in units of the mean
  int n = 0;                        ///< values beyond it
  std::optional<double> beta = {};  ///< nothing with fewer than 10
  /// beta/sqrt(n), which takes the values as independent; those of neighbouring nodes are not.
  std::optional<double> error = {};
};

/// Distribution of a stress component over nodes, in units of its mean over those with the sign of the load.
struct StressDistribution {
  int n = 0;                 ///< nodes
  double mean = 0.0;         ///< over all of them (stress)
  double unit = 0.0;         ///< mean over those of the sign of the load: x = stress/unit (stress)
  double spread = 0.0;       ///< standard deviation over the mean of all
  double other_share = 0.0;  ///< share of nodes of the other sign
  double largest = 0.0;      ///< of x
  StressTail loaded_1{1.0}, loaded_2{2.0};  ///< of x beyond 1 and 2
  StressTail other_1{1.0};                  ///< of -x beyond 1, in units of the mean of the other sign
};

/// @param values  one component, of the nodes that count   @param sign  1: compression is the load; -1: tension
StressDistribution stress_distribution(const std::vector<double>& values, double sign);

}  // namespace floc
