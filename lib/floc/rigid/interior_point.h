#pragma once

#include <vector>

#include "floc/linalg/symmetric_factor.h"
#include "floc/rigid/cone_program.h"

namespace floc {

/// Interior point method for cone programs: predictor and corrector of Mehrotra on the homogeneous embedding, with
/// the scaling of Nesterov and Todd. Each iteration factorizes A (Q + W^-2)^-1 A', whose pattern is that of a
/// stiffness matrix. The embedding has a solution for every program, and its last iterate proves that the program
/// has a solution, that it has none, or that its objective has no bound. [AY1999]; [AG2003].
///
/// Programs of one pattern (first, row, group) share the order of elimination.
template <int Dim>
class InteriorPoint {
 public:
  /// @param pattern  a program with the pattern of those that are solved
  explicit InteriorPoint(const ConeProgram<Dim>& pattern);

  /// Solves a program to the accuracy that rounding allows. Its coefficients, loads and solution should be of order
  /// one, and so should its compliances: those of a linear objective, zero, leave only half of the digits.
  /// @param tolerance  largest residual and relative gap of a solution
  /// @throws std::runtime_error when memory runs out
  ConeSolution<Dim> solve(const ConeProgram<Dim>& program, double tolerance = 1e-8);

  /// Makes the solution of a program with positive compliances as accurate as rounding allows, by Newton's method on the
  /// faces of the cones on which it lies. Interior points end at errors of the square root of rounding where a force
  /// lies on the surface of its cone. The solution stays as it is if its faces are not clear.
  void polish(const ConeProgram<Dim>& program, ConeSolution<Dim>& solution);

  /// Minimises the linear part c' x of the objective, by proximal points: each is the solution of a program with the
  /// compliance w and the last point as its origin, and w falls from point to point. In 2D, where the sides of the
  /// cones are planes, one of the first points is the minimum. [R1976].
  /// @param bound  known lower bound of c' x, at which the search ends
  /// @return as solve(); kUnbounded if there is no minimum
  ConeSolution<Dim> minimise_linear(ConeProgram<Dim> program, double bound);

 private:
  struct Iteration;

  /// Whether c' x falls without bound in the cones.
  bool falls_without_bound(ConeProgram<Dim> program);
  /// Factorizes A G A' for the blocks G. @return false if it is not positive to working precision
  bool factorize(const ConeProgram<Dim>& program, const std::vector<Mat<Dim>>& flexibility);

  SymmetricFactor factor_;
  Eigen::SparseMatrix<double> matrix_;  ///< lower triangle of A G A'
  std::vector<int> place_;              ///< in the values of matrix_: for each pair of entries of each block
};

}  // namespace floc
