// Module that floc loads to solve linear systems with PETSc. This is the only source file that includes PETSc's headers
// or calls PETSc.
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "floc/petsc/parallel_solver.h"

namespace floc {
namespace {

/// Conjugate gradients stop after kMostSteps steps, or after kPatience successive steps in which the norm of the
/// residual has not reached a new minimum.
constexpr PetscInt kMostSteps = 20000;
constexpr PetscInt kPatience = 2000;

void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  char* specific = nullptr;
  PetscErrorMessage(code, &text, &specific);
  throw std::runtime_error(std::string("PETSc failed: ") + (text != nullptr ? text : "unknown error") +
                           (specific != nullptr && *specific != '\0' ? std::string(": ") + specific : ""));
}

/// Owns a PETSc object; the destructor destroys the object.
template <class T, PetscErrorCode (*Destroy)(T*)>
class Owned {
 public:
  Owned() = default;
  ~Owned() { reset(); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  operator T() const { return object_; }
  T* fill() {
    reset();
    return &object_;
  }
  void reset() {
    if (object_ != nullptr) Destroy(&object_);
    object_ = nullptr;
  }

 private:
  T object_ = nullptr;
};

/// Makes a PETSc vector use an existing array, without a copy, while this object exists.
class Lent {
 public:
  Lent(Vec vector, const double* values) : vector_(vector) { check(VecPlaceArray(vector, values)); }
  ~Lent() { VecResetArray(vector_); }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;

 private:
  Vec vector_;
};

/// State of the convergence test during a solution: the required reduction of the residual, the first and the smallest
/// norm of the residual, and the step with the smallest norm.
struct Progress {
  double reduction = 0.0;
  double first = 0.0;
  double best = 0.0;
  PetscInt best_at = 0;
};

PetscErrorCode test_convergence(KSP, PetscInt step, PetscReal norm, KSPConvergedReason* reason, void* context) {
  auto& p = *static_cast<Progress*>(context);
  *reason = KSP_CONVERGED_ITERATING;
  if (step == 0) p.first = p.best = norm, p.best_at = 0;
  if (norm < p.best) p.best = norm, p.best_at = step;
  if (PetscIsInfOrNanReal(norm))
    *reason = KSP_DIVERGED_NANORINF;
  else if (norm <= p.reduction * p.first)
    *reason = KSP_CONVERGED_RTOL;
  else if (step - p.best_at > kPatience)
    *reason = KSP_DIVERGED_DTOL;
  else if (step >= kMostSteps)
    *reason = KSP_DIVERGED_ITS;
  return 0;
}

std::string words_for(KSPConvergedReason reason, PetscInt steps) {
  const std::string after = " after " + std::to_string(steps) + " steps of conjugate gradients";
  switch (reason) {
    case KSP_DIVERGED_INDEFINITE_MAT:
      return "the stiffness matrix is not positive definite (some motion of the grains releases energy); this "
             "was found" +
             after;
    case KSP_DIVERGED_INDEFINITE_PC:
      return "the preconditioner is not positive definite, probably because the stiffness matrix is not; this "
             "was found" +
             after;
    case KSP_DIVERGED_DTOL:
    case KSP_DIVERGED_ITS:
      return "the unbalanced forces no longer decrease" + after;
    default:
      return std::string("PETSc gave up (") + KSPConvergedReasons[reason] + ")" + after;
  }
}

class PetscSolver final : public ParallelSolver {
 public:
  PetscSolver() {
    // floc, not PETSc, handles signals and prints error messages.
    PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
    check(PetscInitializeNoArguments());
    check(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
    MPI_Comm_size(PETSC_COMM_WORLD, &size_);
  }
  ~PetscSolver() override {
    release();
    PetscFinalize();
  }
  PetscSolver(const PetscSolver&) = delete;
  PetscSolver& operator=(const PetscSolver&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void sum(std::span<double> values) override { reduce(values, MPI_SUM); }
  void maximum(std::span<double> values) override { reduce(values, MPI_MAX); }
  [[noreturn]] void abort(int code) override {
    MPI_Abort(PETSC_COMM_WORLD, code);
    std::abort();
  }

  void begin_matrix(int block_size, std::span<const int> own, std::span<const int> foreign) override {
    release();
    block_size_ = block_size;
    n_own_ = block_size * static_cast<PetscInt>(own.size());
    check(MatCreate(PETSC_COMM_WORLD, matrix_.fill()));
    check(MatSetSizes(matrix_, n_own_, n_own_, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetBlockSize(matrix_, block_size));
    check(MatSetType(matrix_, MATAIJ));
    check(MatXAIJSetPreallocation(matrix_, block_size, own.data(), foreign.data(), nullptr, nullptr));
    check(VecCreateMPIWithArray(PETSC_COMM_WORLD, block_size, n_own_, PETSC_DETERMINE, nullptr, x_.fill()));
    check(VecCreateMPIWithArray(PETSC_COMM_WORLD, block_size, n_own_, PETSC_DETERMINE, nullptr, b_.fill()));
  }

  void set_row(int row, std::span<const int> columns, std::span<const double> values) override {
    check(MatSetValuesBlocked(matrix_, 1, &row, static_cast<PetscInt>(columns.size()), columns.data(),
                              values.data(), INSERT_VALUES));
  }

  void finish_matrix(std::span<const double> near_null, int n_vectors) override {
    check(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
    check(MatSetOption(matrix_, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(matrix_, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
    attach(near_null, n_vectors);
    make_method();
  }

  void set_ghosts(std::span<const int> blocks) override {
    const auto n = static_cast<PetscInt>(blocks.size());
    Owned<IS, ISDestroy> places;
    check(ISCreateBlock(PETSC_COMM_SELF, block_size_, n, blocks.data(), PETSC_COPY_VALUES, places.fill()));
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, block_size_, block_size_ * n, nullptr, ghosts_.fill()));
    check(VecScatterCreate(x_, places, ghosts_, nullptr, fetch_.fill()));
  }

  void exchange(std::span<const double> own, std::span<double> ghosts) override {
    const Lent from(x_, own.data()), to(ghosts_, ghosts.data());
    check(VecScatterBegin(fetch_, x_, ghosts_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(fetch_, x_, ghosts_, INSERT_VALUES, SCATTER_FORWARD));
  }

  ParallelSolution solve(std::span<const double> b, std::span<double> x, double reduction) override {
    progress_ = {};
    progress_.reduction = reduction;
    const Lent load(b_, b.data()), solution(x_, x.data());
    check(KSPSolve(method_, b_, x_));
    ParallelSolution out;
    PetscInt steps = 0;
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetIterationNumber(method_, &steps));
    check(KSPGetConvergedReason(method_, &reason));
    out.iterations = steps;
    out.converged = reason > 0;
    if (!out.converged) out.failure = words_for(reason, steps);
    if (steps > 0) check(KSPComputeExtremeSingularValues(method_, &out.largest_ratio, &out.smallest_ratio));
    return out;
  }

  double preconditioned_square(std::span<const double> r) override {
    const Lent load(b_, r.data());
    Owned<Vec, VecDestroy> z;
    check(VecDuplicate(b_, z.fill()));
    PC preconditioner = nullptr;
    check(KSPGetPC(method_, &preconditioner));
    check(KSPSetUp(method_));
    check(PCApply(preconditioner, b_, z));
    double square = 0.0;
    check(VecDot(b_, z, &square));
    return square;
  }

 private:
  void reduce(std::span<double> values, MPI_Op operation) {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, operation,
                  PETSC_COMM_WORLD);
  }

  void release() {
    fetch_.reset();
    ghosts_.reset();
    method_.reset();
    b_.reset();
    x_.reset();
    matrix_.reset();
  }

  void attach(std::span<const double> near_null, int n_vectors) {
    std::vector<Vec> vectors(static_cast<std::size_t>(n_vectors));
    for (std::size_t k = 0; k < vectors.size(); ++k) {
      check(MatCreateVecs(matrix_, &vectors[k], nullptr));
      double* values = nullptr;
      check(VecGetArrayWrite(vectors[k], &values));
      std::copy_n(near_null.data() + k * static_cast<std::size_t>(n_own_), n_own_, values);
      check(VecRestoreArrayWrite(vectors[k], &values));
    }
    Owned<MatNullSpace, MatNullSpaceDestroy> space;
    check(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, n_vectors, vectors.data(), space.fill()));
    check(MatSetNearNullSpace(matrix_, space));
    for (Vec& vector : vectors) check(VecDestroy(&vector));
  }

  /// Sets up conjugate gradients and their preconditioner. The environment variable PETSC_OPTIONS overrides these
  /// settings.
  void make_method() {
    check(KSPCreate(PETSC_COMM_WORLD, method_.fill()));
    check(KSPSetOperators(method_, matrix_, matrix_));
    check(KSPSetType(method_, KSPCG));
    check(KSPSetNormType(method_, KSP_NORM_NATURAL));
    check(KSPSetComputeSingularValues(method_, PETSC_TRUE));
    check(KSPSetTolerances(method_, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, kMostSteps));
    check(KSPSetConvergenceTest(method_, test_convergence, &progress_, nullptr));
    PC preconditioner = nullptr;
    check(KSPGetPC(method_, &preconditioner));
    check(PCSetType(preconditioner, PCGAMG));
    // Plain aggregation takes more iterations than smoothed aggregation, but less time and memory (docs/petsc.md).
    check(PCGAMGSetNSmooths(preconditioner, 0));
    check(KSPSetFromOptions(method_));
  }

  int rank_ = 0;
  int size_ = 1;
  PetscInt block_size_ = 1;
  PetscInt n_own_ = 0;
  Progress progress_;
  Owned<Mat, MatDestroy> matrix_;
  Owned<Vec, VecDestroy> x_, b_, ghosts_;
  Owned<VecScatter, VecScatterDestroy> fetch_;
  Owned<KSP, KSPDestroy> method_;
};

}  // namespace
}  // namespace floc

extern "C" __attribute__((visibility("default"))) floc::ParallelSolver* floc_make_petsc_solver() {
  return new floc::PetscSolver;
}
