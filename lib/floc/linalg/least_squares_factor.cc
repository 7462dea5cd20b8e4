#include "floc/linalg/least_squares_factor.h"

#include <SuiteSparseQR.hpp>
#include <cassert>
#include <stdexcept>
#include <string>

#include "floc/linalg/blas.h"

namespace floc {

struct LeastSquaresFactor::Factor {
  cholmod_common common{};
  SuiteSparseQR_factorization<double>* qr = nullptr;

  Factor() {
    prepare_blas();
    cholmod_l_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.useGPU = 0;
  }
  ~Factor() {
    SuiteSparseQR_free(&qr, &common);
    cholmod_l_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  void check(bool made) const {
    if (!made || common.status < CHOLMOD_OK)
      throw std::runtime_error("SuiteSparseQR failed (status " + std::to_string(common.status) +
                               (common.status == CHOLMOD_OUT_OF_MEMORY ? ", out of memory)" : ")"));
  }

  cholmod_sparse* copy(const Eigen::SparseMatrix<double>& matrix) {
    cholmod_sparse* a = cholmod_l_allocate_sparse(matrix.rows(), matrix.cols(), matrix.nonZeros(), 1, 1, 0,
                                                  CHOLMOD_REAL, &common);
    check(a != nullptr);
    SuiteSparse_long at = 0;
    for (int c = 0; c < matrix.outerSize(); ++c) {
      static_cast<SuiteSparse_long*>(a->p)[c] = at;
      for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, c); it; ++it, ++at) {
        static_cast<SuiteSparse_long*>(a->i)[at] = it.row();
        static_cast<double*>(a->x)[at] = it.value();
      }
    }
    static_cast<SuiteSparse_long*>(a->p)[matrix.cols()] = at;
    return a;
  }

  cholmod_dense* solve(int system, cholmod_dense* b) {
    cholmod_dense* x = SuiteSparseQR_solve(system, qr, b, &common);
    check(x != nullptr);
    return x;
  }
};

LeastSquaresFactor::LeastSquaresFactor(const Eigen::SparseMatrix<double>& matrix, double rank_tolerance)
    : factor_(std::make_unique<Factor>()) {
  Factor& f = *factor_;
  cholmod_sparse* a = f.copy(matrix);
  f.qr = SuiteSparseQR_factorize<double>(SPQR_ORDERING_DEFAULT, rank_tolerance, a, &f.common);
  cholmod_l_free_sparse(&a, &f.common);
  f.check(f.qr != nullptr);
}
LeastSquaresFactor::~LeastSquaresFactor() = default;
LeastSquaresFactor::LeastSquaresFactor(LeastSquaresFactor&&) noexcept = default;
LeastSquaresFactor& LeastSquaresFactor::operator=(LeastSquaresFactor&&) noexcept = default;

int LeastSquaresFactor::rank() const {
  return static_cast<int>(factor_->qr->rank);
}

Eigen::VectorXd LeastSquaresFactor::solve(const Eigen::VectorXd& b) const {
  Factor& f = *factor_;
  cholmod_dense view{};
  view.nrow = view.nzmax = view.d = b.size();
  view.ncol = 1;
  view.x = const_cast<double*>(b.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* y = f.solve(SPQR_RTX_EQUALS_ETB, &view);
  cholmod_dense* x = f.solve(SPQR_RETX_EQUALS_B, y);
  Eigen::VectorXd solution = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x->x), b.size());
  cholmod_l_free_dense(&x, &f.common);
  cholmod_l_free_dense(&y, &f.common);
  return solution;
}

}  // namespace floc
