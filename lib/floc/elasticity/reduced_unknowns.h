#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "floc/network/contact_network.h"

namespace floc {

/// The unknowns of K that are solved for, made alike: rotations become the displacements they give at the
/// grain's size.
struct ReducedUnknowns {
  std::vector<int> row;      ///< of each unknown of K; -1: not solved for
  std::vector<int> unknown;  ///< of K, for each row
  Eigen::VectorXd length;    ///< of each row: unknown of K = length * value here
};

/// @param kept  one entry per unknown of K, see FreeMotions::kept
template <int Dim>
ReducedUnknowns reduce_unknowns(const ContactNetwork<Dim>& network, const std::vector<bool>& kept);

/// Lower triangle of the block of the grains in those unknowns, over `unit` (force/length).
/// @param grains  lower triangle of K, see StiffnessMatrix
Eigen::SparseMatrix<double> reduce(const Eigen::SparseMatrix<double>& grains, const ReducedUnknowns& unknowns,
                                   double unit);

/// The grain that each row belongs to, ascending: groups of SymmetricFactor.
template <int Dim>
std::vector<int> grain_of_rows(const ReducedUnknowns& unknowns);

}  // namespace floc
