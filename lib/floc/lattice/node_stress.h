#pragma once

#include <optional>
#include <vector>

#include "floc/lattice/lattice_solution.h"

namespace floc {

/// Returns the stress of each node, compression positive. The stress of node a is the symmetric part of -(1/V_a) times
/// the sum of r f^T over the elements of the node. Here V_a is the volume of the node, f is the force of the element on
/// the node, and r is the vector from the node to the point at which f acts. The mean over all nodes, weighted by
/// volume and with zero for void nodes, is the stress of the cell. The stress of a fixed node includes the forces that
/// keep the node in place.
template <int Dim>
std::vector<Mat<Dim>> node_stress(const Lattice<Dim>& lattice, const LatticeNetwork<Dim>& network,
                                  const LatticeSolution<Dim>& solution);

/// Exponential tail exp(-beta x) of the distribution of a number x above a threshold, fitted by maximum likelihood.
struct StressTail {
  double from = 1.0;                ///< threshold of x above which the tail is fitted
  int n = 0;                        ///< number of values of x above the threshold
  std::optional<double> beta = {};  ///< decay rate beta; absent for fewer than 10 values
  /// Standard error beta/sqrt(n) of beta. The formula assumes independent values, although the stresses of neighbouring
  /// nodes are correlated.
  std::optional<double> error = {};
};

/// Distribution of a stress component over the nodes of a lattice. The number x of a node is the component at this
/// node, divided by the mean of the component over the nodes where it has the sign of the load. Values whose magnitude
/// is below `least` are rounding errors and have neither sign.
struct StressDistribution {
  int n = 0;          ///< number of nodes in the distribution
  double mean = 0.0;  ///< mean of the component over all nodes (stress)
  /// smallest magnitude of a component that has a sign (stress)
  double least = 0.0;
  /// mean of the component over the nodes where it has the same sign as the load (stress); the unit in which x is given
  double unit = 0.0;
  /// standard deviation of the component over all nodes, divided by `mean`; NaN if the magnitude of `mean` is below
  /// `least`
  double spread = 0.0;
  double other_share = 0.0;  ///< share of the nodes where the component and the load have opposite signs
  double largest = 0.0;      ///< largest value of x
  StressTail loaded_1{1.0}, loaded_2{2.0};  ///< exponential tails of the distribution of x above 1 and above 2
  /// exponential tail, above 1, for the nodes where the component and the load have opposite signs; for this tail, x is
  /// the component divided by its mean over these nodes
  StressTail other_1{1.0};
};

/// Values below this share of the root mean square of all values count as rounding errors. Of 91 000 nodes of a
/// thousand disks, 1500 had stresses below 1e-13 of the load, and only one had between 1e-13 and this share of it.
inline constexpr double kRoundingShare = 1e-6;

/// Computes the distribution of one stress component over nodes of a lattice.
/// @param values  the component at each of these nodes (stress)
/// @param sign    sign of the load: 1 for compression, -1 for tension
/// @param least   magnitude below which a value may be a rounding error (stress); at least kRoundingShare times the
///                root mean square of the values is used
StressDistribution stress_distribution(const std::vector<double>& values, double sign, double least = 0.0);

}  // namespace floc
