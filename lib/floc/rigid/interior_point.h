#pragma once

#include <vector>

#include "floc/linalg/symmetric_factor.h"
#include "floc/rigid/cone_program.h"

namespace floc {

/// Interior point method for cone programs: Mehrotra's predictor and corrector on the homogeneous embedding, with the
/// scaling of Nesterov and Todd. Each iteration factorizes A (Q + W^-2)^-1 A', with the scaling W; this matrix has the
/// sparsity pattern of a stiffness matrix. The embedding has a solution for every program. Its last iterate proves that
/// the program has a solution, that it has none, or that its objective has no bound. [AY1999]; [AG2003].
///
/// Programs with one sparsity pattern (`first`, `row`, `group`) share the elimination order.
template <int Dim>
class InteriorPoint {
 public:
  /// @param pattern  a program with the sparsity pattern of the programs that will be solved
  explicit InteriorPoint(const ConeProgram<Dim>& pattern);

  /// Solves a program to the accuracy that rounding allows. Its coefficients, loads and solution should be of order
  /// one. Its compliances should also be of order one: with the zero compliances of a linear objective, only half of
  /// the digits are correct.
  /// @param tolerance  largest residual and relative gap of a solution
  /// @throws std::runtime_error when memory runs out
  ConeSolution<Dim> solve(const ConeProgram<Dim>& program, double tolerance = 1e-8);

  /// Makes the solution of a program with positive compliances as accurate as rounding allows, by Newton's method on
  /// the faces of the cones on which the solution lies. If a force lies on the surface of its cone, an interior point
  /// ends with an error of the square root of rounding. If the faces cannot be determined, the solution is not changed.
  void polish(const ConeProgram<Dim>& program, ConeSolution<Dim>& solution);

  /// Minimises the linear part c' x of the objective, by the proximal point method [R1976]: each point solves a program
  /// with the compliance w and the last point as its origin, and w decreases from point to point. In 2D, where the
  /// sides of the cones are planes, one of the first points is the minimum.
  /// @param bound  known lower bound of c' x, at which the search ends
  /// @return result like that of solve(); kUnbounded if there is no minimum
  ConeSolution<Dim> minimise_linear(ConeProgram<Dim> program, double bound);

 private:
  struct Iteration;

  /// Whether c' x has no lower bound in the cones.
  bool falls_without_bound(ConeProgram<Dim> program);
  /// Factorizes A G A', with the blocks G in `flexibility`.
  /// @return false if the matrix is not positive to working precision
  bool factorize(const ConeProgram<Dim>& program, const std::vector<Mat<Dim>>& flexibility);

  SymmetricFactor factor_;
  Eigen::SparseMatrix<double> matrix_;  ///< lower triangle of A G A'
  /// for each pair of entries of each block: index of its value in the array of the values of matrix_
  std::vector<int> place_;
};

}  // namespace floc
