#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Unknowns of the stiffness matrix K that are solved for, all in the unit of length: rotations are multiplied by the
/// grain's size.
struct ReducedUnknowns {
  std::vector<int>
      row;  ///< row of the reduced system for each unknown of K; -1 if the unknown is not solved for
  std::vector<int> unknown;  ///< unknown of K for each row of the reduced system
  Eigen::VectorXd length;    ///< scale of each row: unknown of K = length * value in the row
};

/// Selects the unknowns of the stiffness matrix to solve for.
/// @param kept  one entry per unknown: whether to solve for it, see FreeMotions::kept
template <int Dim>
ReducedUnknowns reduce_unknowns(const ContactNetwork<Dim>& network, const std::vector<bool>& kept);

/// Returns the lower triangle of the stiffness matrix of the grains in the reduced unknowns, divided by `unit`
/// (force/length).
/// @param grains  lower triangle of the stiffness matrix in all unknowns, see StiffnessMatrix
Eigen::SparseMatrix<double> reduce(const Eigen::SparseMatrix<double>& grains, const ReducedUnknowns& unknowns,
                                   double unit);

/// Returns the grain to which each row of the reduced system belongs, in ascending order, as groups for
/// SymmetricFactor.
template <int Dim>
std::vector<int> grain_of_rows(const ReducedUnknowns& unknowns);

}  // namespace floc
