#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "floc/base/vec.h"

namespace floc {

/// Convex program over second-order cones for the unknown x, with the dual unknown y:
///
///     minimise  1/2 x' Q x + c' x + 1/2 y' S y    subject to    A x + S y = b,    x_k in K for each block k,
///
/// where block x_k of x has Dim entries, and K is the second-order cone: the vectors v = (v_0, v_1, ..) with |(v_1,
/// ..)| <= v_0. Q and S are symmetric and positive semidefinite.
///
/// Two problems have this form. The first problem is to find the forces of rigid grains at rest. In this case S = 0,
/// and x_k = (P, t/mu) for contact k, with the repulsive normal force P, the tangential force t and the friction
/// coefficient mu. A x = b are the balances of forces and moments on every grain, and the condition that the forces
/// give the stress of the cell. The second problem is to find the impulses of a time step. In this case S contains the
/// masses, and A x + S y = b is the balance of momentum (implicit_step.h).
///
/// A is stored block by block. The entries of block k are the elements first[k] to first[k + 1] - 1 of `row` and
/// `coefficient`. The entries of one block have different rows.
template <int Dim>
struct ConeProgram {
  std::vector<int> first{0};
  std::vector<int> row;
  /// coefficients of each entry of A: the Dim coefficients of one block in one row
  std::vector<Vec<Dim>> coefficient;
  /// number of the group (grain) of each row, ascending; the rows of a group are eliminated together
  std::vector<int> group;
  Eigen::VectorXd load;      ///< right-hand side b
  Eigen::VectorXd softness;  ///< diagonal of S, >= 0; empty if all its elements are zero
  /// Symmetric matrices that are added to S, one for each block. The rows and columns of the matrix of a block are the
  /// rows of A in which the block has entries. The matrices are stored one after the other, each as the rows of its
  /// lower triangle. The list is empty if there are no matrices.
  std::vector<double> block_softness;
  std::vector<Vec<Dim>> compliance;  ///< diagonal of Q, >= 0
  std::vector<Vec<Dim>> linear;      ///< linear part c of the objective

  /// Returns A x.
  Eigen::VectorXd balance(const std::vector<Vec<Dim>>& x) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(n_rows());
    for (int k = 0; k < n_blocks(); ++k)
      for (int e = first[k]; e < first[k + 1]; ++e) out[row[e]] += coefficient[e].dot(x[k]);
    return out;
  }
  /// Returns A' y.
  std::vector<Vec<Dim>> relative_motion(const Eigen::VectorXd& y) const {
    std::vector<Vec<Dim>> out(n_blocks(), Vec<Dim>::Zero());
    for (int k = 0; k < n_blocks(); ++k)
      for (int e = first[k]; e < first[k + 1]; ++e) out[k] += coefficient[e] * y[row[e]];
    return out;
  }

  /// Returns S y.
  Eigen::VectorXd softened(const Eigen::VectorXd& y) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(n_rows());
    if (softness.size() > 0) out = softness.cwiseProduct(y);
    if (block_softness.empty()) return out;
    const double* value = block_softness.data();
    std::vector<double> given, product;  // values of y and S y in the rows of one block
    for (int k = 0; k < n_blocks(); ++k) {
      const int n = first[k + 1] - first[k];
      given.clear();
      for (int e = 0; e < n; ++e) given.push_back(y[row[first[k] + e]]);
      product.assign(n, 0.0);
      for (int e = 0; e < n; ++e) {
        double sum = 0.0;
        for (int f = 0; f < e; ++f) {
          sum += value[f] * given[f];
          product[f] += value[f] * given[e];
        }
        product[e] += sum + value[e] * given[e];
        value += e + 1;
      }
      for (int e = 0; e < n; ++e) out[row[first[k] + e]] += product[e];
    }
    return out;
  }

  int n_blocks() const { return static_cast<int>(first.size()) - 1; }
  int n_rows() const { return static_cast<int>(load.size()); }
};

/// Outcome of the solution of a cone program.
enum class ConeStatus {
  kSolved,
  /// No x satisfies the constraints. The vector y in ConeSolution::motion proves this: b' y > 0, and -A' y lies in the
  /// cones.
  kInfeasible,
  kUnbounded,  ///< the linear objective has no lower bound
  kFailed,     ///< rounding errors ended the iteration before one of the other outcomes was certain
};

template <int Dim>
struct ConeSolution {
  ConeStatus status = ConeStatus::kFailed;
  std::vector<Vec<Dim>> x;
  Eigen::VectorXd motion;  ///< dual unknown y
  double objective = 0.0;  ///< 1/2 x' Q x + c' x + 1/2 y' S y
  double residual = 0.0;   ///< largest |A x + S y - b|
  /// duality gap x' z, with z = Q x + c - A' y: an upper bound of the difference between the objective and its minimum
  double gap = 0.0;
  int n_factorizations = 0;

  /// Returns the duality gap relative to the objective, which is proportional to the number of blocks.
  double relative_gap() const { return gap / (1.0 + std::abs(objective)); }

  /// Returns whether the program was solved. If rounding errors ended the iteration, the program also counts as solved
  /// if the residual and the relative gap are below the given numbers.
  bool is_solved(double nearly, double nearly_no_gap) const {
    return status == ConeStatus::kSolved ||
           (status == ConeStatus::kFailed && residual < nearly && relative_gap() < nearly_no_gap);
  }
};

}  // namespace floc
