#pragma once

#include <memory>
#include <span>
#include <string>

namespace floc {

/// Outcome of the solution of one linear system A x = b. The values are equal on all processes.
struct ParallelSolution {
  bool converged = false;
  std::string failure;  ///< reason why the iteration did not converge, as a sentence; empty if it converged
  int iterations = 0;
  /// Estimates (Ritz values) of the smallest and the largest eigenvalue of M^-1 A, where M is the preconditioner; 0 if
  /// no step was taken. Eigenvectors that do not contribute to b are missed.
  double smallest_ratio = 0.0;
  double largest_ratio = 0.0;
};

/// Solver of symmetric linear systems A x = b by PETSc's preconditioned conjugate gradients, in a module that is loaded
/// when needed. The rows are distributed over the processes of an MPI run, or all belong to a single process. The rows
/// of A form blocks of equal size, one block for the unknowns of each grain. Each process has consecutive blocks.
/// Unless a comment says otherwise, members are collective: all processes must call them in the same order.
///
/// Members throw std::runtime_error with PETSc's message on the process that failed. The other processes may then wait
/// for this process forever; abort() must be called to end them.
class ParallelSolver {
 public:
  virtual ~ParallelSolver() = default;

  virtual int rank() const = 0;  ///< number of this process, from 0; not collective
  virtual int size() const = 0;  ///< number of processes; not collective
  /// Replace each value by the sum, or by the maximum, of the values of all processes.
  virtual void sum(std::span<double> values) = 0;
  virtual void maximum(std::span<double> values) = 0;
  /// Terminates all processes immediately with the given exit code. Not collective.
  [[noreturn]] virtual void abort(int code) = 0;

  /// Begins a new matrix, which replaces the previous one. A block row consists of the rows of one grain, and a block
  /// column of the columns of one grain.
  /// @param block_size  number of rows and columns of a block
  /// @param own         for each block row of this process: number of nonzero blocks whose block column belongs to this
  /// process
  /// @param foreign     for each block row of this process: number of nonzero blocks whose block column belongs to
  /// another process
  virtual void begin_matrix(int block_size, std::span<const int> own, std::span<const int> foreign) = 0;
  /// Sets one block row of this process in the matrix that begin_matrix() has begun. Not collective.
  /// @param row      number of the block row in the whole matrix
  /// @param columns  numbers, in the whole matrix, of the block columns with nonzero blocks in this block row;
  /// ascending
  /// @param values   entries of the nonzero blocks, row by row: a matrix of block_size rows and block_size *
  /// columns.size() columns
  virtual void set_row(int row, std::span<const int> columns, std::span<const double> values) = 0;
  /// Completes the matrix A and sets up its preconditioner.
  /// @param near_null  vectors v for which A v is close to zero, one after another, each with its entries in the rows
  ///                   of this process. The coarse grids of the preconditioner have to represent these vectors
  /// @param n_vectors  number of vectors in `near_null`
  virtual void finish_matrix(std::span<const double> near_null, int n_vectors) = 0;

  /// Selects the blocks of a distributed vector that this process needs although they belong to other processes
  /// (ghosts).
  /// @param blocks  numbers of the selected blocks in the whole vector
  virtual void set_ghosts(std::span<const int> blocks) = 0;
  /// Fetches, from other processes, the entries of a distributed vector in the blocks that set_ghosts() has selected.
  /// @param own     entries of the vector in the rows of this process
  /// @param ghosts  receives the entries in the selected blocks, in the order given to set_ghosts()
  virtual void exchange(std::span<const double> own, std::span<double> ghosts) = 0;

  /// Solves A x = b, starting from x = 0. The iteration ends when sqrt(r^T M^-1 r) has decreased to `reduction` times
  /// its initial value, with the residual r and the preconditioner M. `b` and `x` contain the entries in the rows of
  /// this process.
  virtual ParallelSolution solve(std::span<const double> b, std::span<double> x, double reduction) = 0;
  /// Returns r^T M^-1 r, with the preconditioner M of the current matrix.
  /// @param r  entries of r in the rows of this process
  virtual double preconditioned_square(std::span<const double> r) = 0;
};

/// Loads floc's PETSc module. Under `mpirun`, the solver uses all processes of the run; otherwise it uses a single
/// process. A process can load the module only once, because the destructor of the solver ends MPI.
/// @throws std::runtime_error if floc was built without PETSc or the module cannot be loaded
std::unique_ptr<ParallelSolver> load_parallel_solver();

/// Returns whether floc was built with PETSc.
bool has_parallel_solver();

}  // namespace floc
