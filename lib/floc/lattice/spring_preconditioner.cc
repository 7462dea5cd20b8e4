#include "floc/lattice/spring_preconditioner.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>

#include "floc/base/dense_solvers.h"
#include "floc/linalg/symmetric_factor.h"
#include "floc/network/symmetric_sum.h"

namespace floc {
namespace {

/// Shift that is added to the diagonal of the stiffness matrix, divided by the largest stiffness. The shift is far
/// below the stiffness of any motion that resists a load, and far above rounding errors.
constexpr double kShift = 1e-9;

template <int Dim, int Size>
double largest_stiffness(const SpringRows<Dim, Size>& springs) {
  double largest = 0.0;
  for (const auto& row : springs.rows) largest = std::max(largest, row.stiffness);
  return largest > 0.0 ? largest : 1.0;
}

/// Returns the inverse of the block of a stiffness matrix that belongs to the free strains. Rows and columns of imposed
/// strains are zero.
/// @param block  stiffness matrix of all strains
/// @param free   for each strain, whether it is free, that is, not imposed
Eigen::MatrixXd free_inverse(const Eigen::MatrixXd& block, std::span<const bool> free) {
  std::vector<int> kept;
  for (int a = 0; a < static_cast<int>(free.size()); ++a)
    if (free[a]) kept.push_back(a);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(block.rows(), block.cols());
  if (kept.empty()) return out;
  const Eigen::MatrixXd part = block(kept, kept);
  const double least =
      kShift * std::max(part.diagonal().cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  const SymmetricEigen modes = symmetric_eigen(part);
  const Eigen::VectorXd values = modes.values.cwiseMax(least);
  out(kept, kept) = modes.vectors * values.cwiseInverse().asDiagonal() * modes.vectors.transpose();
  return out;
}

template <int Dim, int Size>
class FactorPreconditioner final : public SpringPreconditioner<Dim, Size> {
 public:
  explicit FactorPreconditioner(const SpringRows<Dim, Size>& springs)
      : springs_(springs),
        unit_(largest_stiffness(springs)),
        factor_(springs.n_unknowns() > kLarge ? Ordering::metis : Ordering::automatic),
        group_(springs.n_unknowns()) {
    for (int a = 0; a < springs.n_unknowns(); ++a) group_[a] = a / Size;
  }

  void prepare(const std::vector<char>& active) override {
    StiffnessMatrix k = assemble(active);
    factor_.set_matrix(k.grains, group_);
    k.grains.resize(0, 0);
    double shift = kShift;
    while (!factor_.factorize_positive(shift)) {
      shift *= 100.0;
      if (shift > 1.0) throw std::runtime_error("the stiffness matrix of a lattice could not be factorized");
    }
    affine_ = factor_.solve(k.border, 0);
    schur_ = k.boundary - k.border.transpose() * affine_;
    set_free(free_);
  }

  void set_free(const Eigen::Matrix<bool, kSymmetric<Dim>, 1>& free) override {
    free_ = free;
    if (schur_.size() > 0) strains_ = free_inverse(schur_, {free_.data(), kSymmetric<Dim>});
  }

  Eigen::VectorXd apply(const Eigen::VectorXd& residual) const override {
    const int n = springs_.n_unknowns();
    Eigen::VectorXd out(residual.size());
    const Eigen::VectorXd of_nodes = factor_.solve(residual.head(n), 0);
    out.tail(kSymmetric<Dim>) =
        strains_ * (residual.template tail<kSymmetric<Dim>>() - affine_.transpose() * residual.head(n)) / unit_;
    out.head(n) = of_nodes / unit_ - affine_ * out.tail(kSymmetric<Dim>);
    return out;
  }

  bool is_exact() const override { return true; }

 private:
  /// Number of unknowns of a lattice above which nested dissection gives a better ordering than minimum degree.
  static constexpr int kLarge = 20000;

  StiffnessMatrix assemble(const std::vector<char>& active) const {
    using OnNodes = Eigen::Matrix<double, 1, Size, Eigen::RowMajor>;
    using OnStrains = Eigen::Matrix<double, 1, kSymmetric<Dim>, Eigen::RowMajor>;
    SymmetricSum<Size> sum(static_cast<int>(springs_.node.size()), springs_.rows, kSymmetric<Dim>);
    for (std::size_t r = 0; r < springs_.rows.size(); ++r) {
      if (!active[r]) continue;
      const auto& row = springs_.rows[r];
      const Eigen::Matrix<double, 1, 1> k(row.stiffness / unit_);
      const OnNodes on_i = row.on_i.transpose(), on_j = row.on_j.transpose();
      add_contact(row.i, row.j, on_i, on_j, OnStrains(springs_.on_strain[r].transpose()), k, sum);
    }
    return sum.take();
  }

  const SpringRows<Dim, Size>& springs_;
  double unit_;
  SymmetricFactor factor_;
  std::vector<int> group_;
  Eigen::Matrix<bool, kSymmetric<Dim>, 1> free_ = Eigen::Matrix<bool, kSymmetric<Dim>, 1>::Constant(false);
  Eigen::MatrixXd affine_;   // negative displacement of the nodes by relaxation, per unit of each strain
  Eigen::MatrixXd schur_;    // stiffness against strain after relaxation of the nodes, divided by `unit_`
  Eigen::MatrixXd strains_;  // inverse of the block of `schur_` that belongs to the free strains
};

template <int Dim, int Size>
class BlockPreconditioner final : public SpringPreconditioner<Dim, Size> {
 public:
  using Block = Eigen::Matrix<double, Size, Size>;

  explicit BlockPreconditioner(const SpringRows<Dim, Size>& springs)
      : springs_(springs), shift_(kShift * largest_stiffness(springs)) {}

  void prepare(const std::vector<char>& active) override {
    std::vector<Block> sum(springs_.node.size(), shift_ * Block::Identity());
    affine_ = Eigen::MatrixXd::Zero(kSymmetric<Dim>, kSymmetric<Dim>);
    for (std::size_t r = 0; r < springs_.rows.size(); ++r) {
      if (!active[r]) continue;
      const auto& row = springs_.rows[r];
      sum[row.i] += row.stiffness * row.on_i * row.on_i.transpose();
      if (row.j != row.i) sum[row.j] += row.stiffness * row.on_j * row.on_j.transpose();
      affine_ += row.stiffness * springs_.on_strain[r] * springs_.on_strain[r].transpose();
    }
    inverse_.resize(sum.size());
    for (std::size_t k = 0; k < sum.size(); ++k) inverse_[k] = sum[k].llt().solve(Block::Identity());
    set_free(free_);
  }

  void set_free(const Eigen::Matrix<bool, kSymmetric<Dim>, 1>& free) override {
    free_ = free;
    if (affine_.size() > 0) strains_ = free_inverse(affine_, {free_.data(), kSymmetric<Dim>});
  }

  Eigen::VectorXd apply(const Eigen::VectorXd& residual) const override {
    Eigen::VectorXd out(residual.size());
    for (std::size_t k = 0; k < inverse_.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(Size * k);
      out.segment<Size>(at) = inverse_[k] * residual.segment<Size>(at);
    }
    out.tail(kSymmetric<Dim>) = strains_ * residual.tail(kSymmetric<Dim>);
    return out;
  }

  bool is_exact() const override { return false; }

 private:
  const SpringRows<Dim, Size>& springs_;
  double shift_;
  std::vector<Block> inverse_;
  Eigen::Matrix<bool, kSymmetric<Dim>, 1> free_ = Eigen::Matrix<bool, kSymmetric<Dim>, 1>::Constant(false);
  Eigen::MatrixXd affine_, strains_;
};

}  // namespace

template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> factor_preconditioner(const SpringRows<Dim, Size>& springs) {
  return std::make_unique<FactorPreconditioner<Dim, Size>>(springs);
}

template <int Dim, int Size>
std::unique_ptr<SpringPreconditioner<Dim, Size>> block_preconditioner(const SpringRows<Dim, Size>& springs) {
  return std::make_unique<BlockPreconditioner<Dim, Size>>(springs);
}

template std::unique_ptr<SpringPreconditioner<2, 2>> factor_preconditioner(const SpringRows<2, 2>&);
template std::unique_ptr<SpringPreconditioner<2, 3>> factor_preconditioner(const SpringRows<2, 3>&);
template std::unique_ptr<SpringPreconditioner<3, 3>> factor_preconditioner(const SpringRows<3, 3>&);
template std::unique_ptr<SpringPreconditioner<3, 6>> factor_preconditioner(const SpringRows<3, 6>&);
template std::unique_ptr<SpringPreconditioner<2, 2>> block_preconditioner(const SpringRows<2, 2>&);
template std::unique_ptr<SpringPreconditioner<2, 3>> block_preconditioner(const SpringRows<2, 3>&);
template std::unique_ptr<SpringPreconditioner<3, 3>> block_preconditioner(const SpringRows<3, 3>&);
template std::unique_ptr<SpringPreconditioner<3, 6>> block_preconditioner(const SpringRows<3, 6>&);

}  // namespace floc
