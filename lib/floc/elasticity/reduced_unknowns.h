#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// Unknowns of K that are solved for, in one unit: rotations are replaced by displacements, rotation times the
/// grain's size.
struct ReducedUnknowns {
  std::vector<int> row;      ///< row of each unknown of K; -1 if it is not solved for
  std::vector<int> unknown;  ///< unknown of K of each row
  Eigen::VectorXd length;    ///< scale of each row: unknown of K = length * value in the row
};

/// Selects the unknowns to solve for. @param kept  one entry per unknown of K, see FreeMotions::kept
template <int Dim>
ReducedUnknowns reduce_unknowns(const ContactNetwork<Dim>& network, const std::vector<bool>& kept);

/// Returns the lower triangle of the block of the grains in those unknowns, divided by `unit` (force/length).
/// @param grains  lower triangle of K, see StiffnessMatrix
Eigen::SparseMatrix<double> reduce(const Eigen::SparseMatrix<double>& grains, const ReducedUnknowns& unknowns,
                                   double unit);

/// Returns the grain that each row belongs to, ascending, as groups for SymmetricFactor.
template <int Dim>
std::vector<int> grain_of_rows(const ReducedUnknowns& unknowns);

}  // namespace floc
