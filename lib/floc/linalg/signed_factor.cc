#include "floc/linalg/signed_factor.h"

#include <algorithm>
#include <cmath>

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*);
void dsyrk_(const char*, const char*, const int*, const int*, const double*, const double*, const int*,
            const double*, double*, const int*);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*,
            const double*, const int*, double*, const int*);
}

namespace floc {
namespace {

/// Blocks of at most this number of columns are eliminated column by column. Larger blocks are divided into halves,
/// because products of dense matrices are faster.
constexpr int kPanel = 32;

/// View of consecutive columns of a supernode, from one row of the supernode to its last row. The supernode belongs to
/// the factor L in A + shift * 1 = L S L^T.
struct Block {
  double* value;
  int stride;
  int n_columns;
  const double* sign;  // diagonal entry of S (1 or -1) for each of the columns
};

class SignedFactorization {
 public:
  SignedFactorization(const Supernodes& supernodes, double smallest_pivot)
      : l_(supernodes),
        smallest_pivot_(smallest_pivot),
        n_(static_cast<int>(supernodes.first_column.size()) - 1) {
    const auto n_columns = static_cast<std::size_t>(n_ == 0 ? 0 : l_.first_column[n_]);
    sign_.assign(n_columns, 1.0);
    place_.resize(n_columns);
    owner_.resize(n_columns);
    for (int s = 0; s < n_; ++s)
      std::fill(owner_.begin() + l_.first_column[s], owner_.begin() + l_.first_column[s + 1], s);
    first_waiting_.assign(n_, kNone);
    next_waiting_.assign(n_, kNone);
    next_row_.assign(n_, 0);
  }

  bool run(const LowerColumns& matrix, double shift) {
    for (int s = 0; s < n_; ++s) {
      for (int k = 0; k < n_rows(s); ++k) place_[row(s, k)] = k;
      take_columns(matrix, shift, s);
      for (int d = first_waiting_[s]; d != kNone;) {
        const int next = next_waiting_[d];
        subtract_descendant(d, s);
        d = next;
      }
      if (!eliminate(s, 0, n_columns(s))) return false;
      next_row_[s] = n_columns(s);
      wait(s);
    }
    return true;
  }
  std::vector<double> take_signs() { return std::move(sign_); }

 private:
  static constexpr int kNone = -1;

  int n_rows(int s) const { return static_cast<int>(l_.first_row[s + 1] - l_.first_row[s]); }
  int n_columns(int s) const { return static_cast<int>(l_.first_column[s + 1] - l_.first_column[s]); }
  std::int64_t row(int s, int k) const { return l_.row[l_.first_row[s] + k]; }
  /// Returns columns first, ..., first + count - 1 of supernode s, from its row k to the last.
  Block block(int s, int k, int first, int count) const {
    return {l_.value + l_.first_value[s] + static_cast<std::int64_t>(first) * n_rows(s) + k, n_rows(s), count,
            sign_.data() + l_.first_column[s] + first};
  }

  void take_columns(const LowerColumns& matrix, double shift, int s) {
    std::fill(l_.value + l_.first_value[s], l_.value + l_.first_value[s + 1], 0.0);
    for (int c = 0; c < n_columns(s); ++c) {
      const std::int64_t column = l_.first_column[s] + c;
      double* values = block(s, 0, c, 1).value;
      for (std::int64_t k = matrix.first[column]; k < matrix.first[column + 1]; ++k)
        values[place_[matrix.row[k]]] = matrix.value[k];
      values[c] += shift;
    }
  }

  /// Let r be the number of the first row of supernode d that has not been subtracted yet, and s the later supernode
  /// that contains column r. Adds d to the list of supernodes that will be subtracted from s.
  void wait(int d) {
    if (next_row_[d] == n_rows(d)) return;
    const int s = owner_[row(d, next_row_[d])];
    next_waiting_[d] = first_waiting_[s];
    first_waiting_[s] = d;
  }

  void subtract_descendant(int d, int s) {
    const int from = next_row_[d];
    int to = from;
    while (to < n_rows(d) && row(d, to) < l_.first_column[s + 1]) ++to;
    const int n_target_columns = to - from, n_target_rows = n_rows(d) - from;
    product_.resize(std::max(product_.size(), static_cast<std::size_t>(n_target_columns) * n_target_rows));
    multiply(block(d, from, 0, n_columns(d)), n_target_rows, n_target_columns, 1.0, 0.0, product_.data(),
             n_target_rows);
    relative_.resize(n_target_rows);
    for (int i = 0; i < n_target_rows; ++i) relative_[i] = place_[row(d, from + i)];
    for (int j = 0; j < n_target_columns; ++j) {
      double* target = block(s, 0, relative_[j], 1).value;
      const double* source = product_.data() + static_cast<std::size_t>(j) * n_target_rows;
      for (int i = j; i < n_target_rows; ++i) target[relative_[i]] -= source[i];
    }
    next_row_[d] = to;
    wait(d);
  }

  /// Computes out = alpha * X S Y^T + beta * out on and below the diagonal of `out`. X is the block `x` with `n_rows`
  /// rows, Y consists of the first `n_first` rows of X, and S is the diagonal matrix with the signs of the columns of
  /// X.
  /// @param stride  distance in memory between the first entries of neighbouring columns of `out`
  void multiply(const Block& x, int n_rows, int n_first, double alpha, double beta, double* out, int stride) {
    const int k = x.n_columns;
    const bool mixed = std::any_of(x.sign, x.sign + k, [](double s) { return s < 0.0; });
    if (!mixed) {
      dsyrk_("L", "N", &n_first, &k, &alpha, x.value, &x.stride, &beta, out, &stride);
      const int n_below = n_rows - n_first;
      if (n_below > 0)
        dgemm_("N", "T", &n_below, &n_first, &k, &alpha, x.value + n_first, &x.stride, x.value, &x.stride,
               &beta, out + n_first, &stride);
      return;
    }
    signed_.resize(static_cast<std::size_t>(n_first) * k);
    for (int c = 0; c < k; ++c)
      for (int i = 0; i < n_first; ++i)
        signed_[static_cast<std::size_t>(c) * n_first + i] =
            x.sign[c] * x.value[static_cast<std::size_t>(c) * x.stride + i];
    dgemm_("N", "T", &n_rows, &n_first, &k, &alpha, x.value, &x.stride, signed_.data(), &n_first, &beta, out,
           &stride);
  }

  /// Eliminates columns first, ..., first + count - 1 of supernode s, from which all earlier supernodes have already
  /// been subtracted. The columns are divided into halves recursively, so that most of the work consists of products of
  /// large blocks.
  /// @return false if a value is not finite
  bool eliminate(int s, int first, int count) {
    if (count <= kPanel) return eliminate_panel(s, first, count);
    const int left = (count / 2 + kPanel - 1) / kPanel * kPanel, middle = first + left;
    if (!eliminate(s, first, left)) return false;
    multiply(block(s, middle, first, left), n_rows(s) - middle, count - left, -1.0, 1.0,
             block(s, middle, middle, 1).value, n_rows(s));
    return eliminate(s, middle, count - left);
  }

  bool eliminate_panel(int s, int first, int count) {
    const Block panel = block(s, first, first, count);
    double* sign = sign_.data() + l_.first_column[s] + first;
    // Let a be the entries of the panel after columns 0, ..., j - 1 have been subtracted, s_j the sign of a_jj, and p
    // the smallest pivot. Column j of the factor is l_jj = sqrt(max(|a_jj|, p)) and l_ij = s_j a_ij/l_jj. The products
    // s_j l_ij l_kj are subtracted from the later columns k. A Cholesky factorization would fail at the first a_jj < 0.
    for (int j = 0; j < count; ++j) {
      double* column = panel.value + static_cast<std::size_t>(j) * panel.stride;
      if (!std::isfinite(column[j])) return false;
      sign[j] = column[j] < 0.0 ? -1.0 : 1.0;
      const double root = std::sqrt(std::max(std::abs(column[j]), smallest_pivot_));
      column[j] = root;
      for (int i = j + 1; i < count; ++i) column[i] *= sign[j] / root;
      for (int k = j + 1; k < count; ++k) {
        double* later = panel.value + static_cast<std::size_t>(k) * panel.stride;
        const double factor = sign[j] * column[k];
        for (int i = k; i < count; ++i) later[i] -= factor * column[i];
      }
    }
    const int n_below = n_rows(s) - first - count;
    if (n_below == 0) return true;
    constexpr double kOne = 1.0;
    // Let L be the factor of the square block at the top of the panel, and A the entries of the panel below this block.
    // The rows B of the factor below this block satisfy A = B S L^T. dtrsm_ computes X = B S from X L^T = A. To obtain
    // B from X, the columns with a negative sign are multiplied by -1.
    dtrsm_("R", "L", "T", "N", &n_below, &count, &kOne, panel.value, &panel.stride, panel.value + count,
           &panel.stride);
    for (int j = 0; j < count; ++j) {
      if (sign[j] > 0.0) continue;
      double* below = panel.value + static_cast<std::size_t>(j) * panel.stride + count;
      std::transform(below, below + n_below, below, [](double v) { return -v; });
    }
    return true;
  }

  const Supernodes& l_;
  double smallest_pivot_;
  int n_;  // number of supernodes
  std::vector<double> sign_;
  std::vector<int> place_;  // for each row of the matrix: place among the rows of the current supernode
  std::vector<int> owner_;  // for each column of the matrix: number of the supernode
  // for each supernode s, the first entry of the list of supernodes that will be subtracted from s
  std::vector<int> first_waiting_;
  std::vector<int> next_waiting_;
  // for each eliminated supernode: first row that has not been subtracted from a later supernode yet
  std::vector<int> next_row_;
  std::vector<int> relative_;
  std::vector<double> product_, signed_;
};

}  // namespace

std::vector<double> factorize_signed(const LowerColumns& matrix, double shift, double smallest_pivot,
                                     const Supernodes& factor) {
  SignedFactorization factorization(factor, smallest_pivot);
  if (!factorization.run(matrix, shift)) return {};
  return factorization.take_signs();
}

}  // namespace floc
