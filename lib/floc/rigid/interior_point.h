#pragma once

#include <vector>

#include "floc/linalg/symmetric_factor.h"
#include "floc/rigid/cone_program.h"

namespace floc {

/// Interior point method for cone programs: Mehrotra's predictor and corrector on the homogeneous embedding, with the
/// scaling of Nesterov and Todd. Each iteration factorizes the matrix A (Q + W^-2)^-1 A', with the scaling W; the
/// matrix has the sparsity pattern of a stiffness matrix. The embedding has a solution for every program. The last
/// iterate either gives a solution of the program, or proves that the program has no solution, or proves that the
/// objective has no lower bound [AY1999, AG2003].
///
/// The elimination order is computed once and used for all programs with the same sparsity pattern (`first`, `row`,
/// `group`).
template <int Dim>
class InteriorPoint {
 public:
  /// @param pattern  any program with the sparsity pattern of the programs to be solved
  explicit InteriorPoint(const ConeProgram<Dim>& pattern);

  /// Solves a program to the accuracy that rounding allows. The coefficients, loads, compliances and the solution
  /// should be of order one. If the compliances are zero (linear objective), only half of the digits of the solution
  /// are correct.
  /// @param tolerance  largest residual and relative gap of a solution
  /// @throws std::runtime_error when memory runs out
  ConeSolution<Dim> solve(const ConeProgram<Dim>& program, double tolerance = 1e-8);

  /// Makes the solution of a program with positive compliances as accurate as rounding allows. If a force lies on the
  /// surface of its cone, the error of solve() is of the order of the square root of the rounding error. Newton's
  /// method then improves the solution, with each block fixed to the face of the cone on which it lies. If these faces
  /// cannot be determined, the solution is not changed.
  void polish(const ConeProgram<Dim>& program, ConeSolution<Dim>& solution);

  /// Minimises the linear part c' x of the objective by the proximal point method [R1976]. Each point is the solution
  /// of a program with the objective c' x + w |x - x_0|^2/2, where x_0 is the previous point; the compliance w
  /// decreases from point to point. In 2D the surfaces of the cones are flat, and one of the first points is the
  /// minimum.
  /// @param bound  known lower bound of c' x; the search ends when c' x reaches the bound
  /// @return result as from solve(); its status is kUnbounded if there is no minimum
  ConeSolution<Dim> minimise_linear(ConeProgram<Dim> program, double bound);

 private:
  struct Iteration;

  /// Returns whether c' x has no lower bound for x in the cones with A x = 0.
  bool falls_without_bound(ConeProgram<Dim> program);
  /// Factorizes A G A', with the blocks G in `flexibility`.
  /// @return false if the matrix is not positive definite within rounding errors
  bool factorize(const ConeProgram<Dim>& program, const std::vector<Mat<Dim>>& flexibility);

  SymmetricFactor factor_;
  Eigen::SparseMatrix<double> matrix_;  ///< lower triangle of A G A'
  /// for each pair of entries of each block, the index of its element in the array of values of matrix_
  std::vector<int> place_;
};

}  // namespace floc
