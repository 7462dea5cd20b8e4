#pragma once

#include <memory>
#include <span>
#include <string>

namespace floc {

/// Result of the solution of one linear system, identical on every process.
struct ParallelSolution {
  bool converged = false;
  std::string failure;  ///< reason why the solution did not converge, as a sentence
  int iterations = 0;
  /// Estimates (Ritz values) of the extreme eigenvalues of M^-1 A, with the matrix A and the preconditioner M, among
  /// the modes that the load excites; 0 if no step was taken.
  double smallest_ratio = 0.0;
  double largest_ratio = 0.0;
};

/// Solver of symmetric linear systems whose rows are distributed over the processes of an MPI run, or are all on a
/// single process. The method is preconditioned conjugate gradients of PETSc, in a module that is loaded when needed.
/// Rows come in blocks of one size (the unknowns of a grain); each process has consecutive blocks. All members are
/// collective unless stated otherwise: all processes have to call them in the same order.
///
/// Members throw std::runtime_error with PETSc's message on the process that failed. The other processes may then wait
/// for it, so that abort() has to be called.
class ParallelSolver {
 public:
  virtual ~ParallelSolver() = default;

  virtual int rank() const = 0;  ///< number of this process, from 0; not collective
  virtual int size() const = 0;  ///< number of processes; not collective
  /// Replace each value by its sum, or by its maximum, over all processes.
  virtual void sum(std::span<double> values) = 0;
  virtual void maximum(std::span<double> values) = 0;
  /// Terminates all processes immediately with the given exit code. Not collective.
  [[noreturn]] virtual void abort(int code) = 0;

  /// Begins a new matrix, which replaces the previous one.
  /// @param own      number of blocks in each block row of this process whose columns belong to this process
  /// @param foreign  number of blocks in each block row of this process whose columns belong to other processes
  virtual void begin_matrix(int block_size, std::span<const int> own, std::span<const int> foreign) = 0;
  /// Sets one block row of this process. Not collective.
  /// @param row      number of the block row in the whole matrix
  /// @param columns  numbers of the block columns, ascending
  /// @param values   values row by row: block_size x (block_size * columns.size())
  virtual void set_row(int row, std::span<const int> columns, std::span<const double> values) = 0;
  /// Completes the matrix A and sets up its preconditioner.
  /// @param near_null  vectors v with A v close to zero, one after another, each with the rows of this process; coarse
  ///                   grids of the preconditioner have to represent them
  /// @param n_vectors  number of vectors in `near_null`
  virtual void finish_matrix(std::span<const double> near_null, int n_vectors) = 0;

  /// Selects the blocks of other processes whose values this process needs.
  /// @param blocks  numbers of the blocks in the whole matrix
  virtual void set_ghosts(std::span<const int> blocks) = 0;
  /// Obtains the values of the blocks selected by set_ghosts().
  /// @param own     values in the rows of this process
  /// @param ghosts  receives the values of the selected blocks, in their order
  virtual void exchange(std::span<const double> own, std::span<double> ghosts) = 0;

  /// Solves A x = b, starting from x = 0, until sqrt(r^T M^-1 r) for the residual r and the preconditioner M has
  /// decreased to `reduction` times its initial value. The vectors contain the rows of this process.
  virtual ParallelSolution solve(std::span<const double> b, std::span<double> x, double reduction) = 0;
  /// Returns r^T M^-1 r for the preconditioner M of the current matrix.
  virtual double preconditioned_square(std::span<const double> r) = 0;
};

/// Loads the PETSc module, which joins the processes of `mpirun` or runs on a single process. This is possible once per
/// process, because destroying the solver ends MPI.
/// @throws std::runtime_error if floc was built without PETSc or the module cannot be loaded
std::unique_ptr<ParallelSolver> load_parallel_solver();

/// Returns whether floc was built with PETSc.
bool has_parallel_solver();

}  // namespace floc
