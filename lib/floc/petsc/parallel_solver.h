#pragma once

#include <memory>
#include <span>
#include <string>

namespace floc {

/// Outcome of one solution, the same on every process.
struct ParallelSolution {
  bool converged = false;
  std::string failure;  ///< reason why it did not converge, in words
  int iterations = 0;
  /// Estimates of the extreme eigenvalues of M^-1 A among the modes that the load excites (Ritz values), for
  /// the preconditioner M; 0 if no step was taken.
  double smallest_ratio = 0.0;
  double largest_ratio = 0.0;
};

/// Symmetric linear systems whose rows are shared out among the processes of an MPI run, or held by one process
/// alone: conjugate gradients with a preconditioner, by PETSc, in a module that is loaded when needed. Rows
/// come in blocks of one size (a grain's unknowns); each process holds consecutive blocks. Every call is
/// collective unless it says otherwise: all processes make it, in the same order.
///
/// Members throw std::runtime_error with PETSc's words, on the process that failed; the others may then wait
/// for it, so abort() has to follow.
class ParallelSolver {
 public:
  virtual ~ParallelSolver() = default;

  virtual int rank() const = 0;  ///< number of this process, from 0; not collective
  virtual int size() const = 0;  ///< number of processes; not collective
  /// Each value becomes its sum, or its maximum, over all processes.
  virtual void sum(std::span<double> values) = 0;
  virtual void maximum(std::span<double> values) = 0;
  /// Ends all processes at once, with this exit code. Not collective.
  [[noreturn]] virtual void abort(int code) = 0;

  /// Begins a matrix, which replaces any other.
  /// @param own      number of blocks that each row of blocks of this process has within its own columns
  /// @param foreign  number of blocks that each of these rows has within the columns of other processes
  virtual void begin_matrix(int block_size, std::span<const int> own, std::span<const int> foreign) = 0;
  /// Sets one row of blocks of this process. Not collective.
  /// @param row      its number among all
  /// @param columns  numbers of the blocks in it, ascending
  /// @param values   row by row: block_size x (block_size * columns.size())
  virtual void set_row(int row, std::span<const int> columns, std::span<const double> values) = 0;
  /// @param near_null  vectors that A nearly annihilates, one after another, each with the rows of this
  ///                   process; coarse grids have to represent them
  /// @param n_vectors  number of vectors in `near_null`
  virtual void finish_matrix(std::span<const double> near_null, int n_vectors) = 0;

  /// Names blocks of other processes whose values this one needs. @param blocks  numbers among all
  virtual void set_ghosts(std::span<const int> blocks) = 0;
  /// Fetches the values of the blocks named by set_ghosts().
  /// @param own     values in the rows of this process
  /// @param ghosts  receives the values of those blocks, in their order
  virtual void exchange(std::span<const double> own, std::span<double> ghosts) = 0;

  /// Solves A x = b from x = 0 until sqrt(r^T M^-1 r) has fallen to `reduction` of its initial value. All
  /// vectors are the rows of this process.
  virtual ParallelSolution solve(std::span<const double> b, std::span<double> x, double reduction) = 0;
  /// Returns r^T M^-1 r for the preconditioner M of the last matrix.
  virtual double preconditioned_square(std::span<const double> r) = 0;
};

/// Loads the module, which joins the processes of `mpirun` or runs alone. Possible once in the life of a
/// process: destroying the solver ends MPI.
/// @throws std::runtime_error if floc was built without PETSc or the module cannot be loaded
std::unique_ptr<ParallelSolver> load_parallel_solver();

/// Whether floc was built with PETSc.
bool has_parallel_solver();

}  // namespace floc
