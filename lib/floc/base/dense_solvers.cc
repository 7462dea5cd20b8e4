#include "floc/base/dense_solvers.h"

#include <Eigen/Dense>

namespace floc {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

SymmetricEigen symmetric_eigen(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(matrix);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

VectorXd symmetric_eigenvalues(const MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

VectorXd tridiagonal_eigenvalues(const VectorXd& diagonal, const VectorXd& beside) {
  Eigen::SelfAdjointEigenSolver<MatrixXd> eigen;
  eigen.computeFromTridiagonal(diagonal, beside, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues();
}

VectorXd solve_symmetric(const MatrixXd& matrix, const VectorXd& right_side) {
  return matrix.ldlt().solve(right_side);
}

VectorXd least_squares_solution(const MatrixXd& columns, const VectorXd& y) {
  return columns.completeOrthogonalDecomposition().solve(y);
}

MatrixXd orthonormal_basis(const MatrixXd& columns, Eigen::Index count) {
  return Eigen::HouseholderQR<MatrixXd>(columns).householderQ() * MatrixXd::Identity(columns.rows(), count);
}

LinearSystemByQr solve_by_qr(const MatrixXd& columns, const VectorXd& y) {
  const Eigen::HouseholderQR<MatrixXd> qr(columns);
  const Eigen::Index n = columns.cols();
  const MatrixXd upper = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  return {qr.solve(y), upper.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(n, n))};
}

SingularValues singular_values(const MatrixXd& matrix) {
  const Eigen::JacobiSVD<MatrixXd> svd(matrix, Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace floc
