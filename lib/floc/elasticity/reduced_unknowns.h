#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Unknowns of the stiffness matrix K that are solved for. All other unknowns are free motions, which no contact
/// resists. The values solved for are all lengths: rotations are multiplied by the grain's size.
struct ReducedUnknowns {
  /// for each unknown of K, its row in the reduced system; -1 if the unknown is not solved for
  std::vector<int> row;
  std::vector<int> unknown;  ///< for each row of the reduced system, its unknown of K
  /// for each row of the reduced system, the ratio of the unknown of K to the value solved for: 1/(size of the grain)
  /// for rotations, otherwise 1
  Eigen::VectorXd length;
};

/// Selects those unknowns of the stiffness matrix that are solved for.
/// @param kept  for each unknown of the stiffness matrix, whether it is solved for, see FreeMotions::kept
template <int Dim>
ReducedUnknowns reduce_unknowns(const ContactNetwork<Dim>& network, const std::vector<bool>& kept);

/// Returns the stiffness matrix of the grains for the reduced unknowns, divided by `unit`; only its lower triangle.
/// @param grains  lower triangle of the stiffness matrix for all unknowns, see StiffnessMatrix
/// @param unit    stiffness (force/length)
Eigen::SparseMatrix<double> reduce(const Eigen::SparseMatrix<double>& grains, const ReducedUnknowns& unknowns,
                                   double unit);

/// For each row of the reduced system, returns the number of its grain, in ascending order. SymmetricFactor places the
/// rows of a grain together in its ordering.
template <int Dim>
std::vector<int> grain_of_rows(const ReducedUnknowns& unknowns);

}  // namespace floc
