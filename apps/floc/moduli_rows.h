#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/moduli_within.h"
#include "floc/packing/state.h"
#include "floc/petsc/parallel_solver.h"
#include "increments.h"
#include "moduli_columns.h"

namespace floc {

/// What solves for moduli.
enum class ModuliSolver {
  automatic,  ///< CHOLMOD, or PETSc in this process where its factor would not fit into memory
  cholmod,
  petsc,
};

/// How moduli are asked for.
struct ModuliRequest {
  ModuliOptions options;
  std::optional<ModuliAccuracy> accuracy;  ///< instead of a method
  std::vector<double> rolling_stiffness;   ///< in place of the states' own, a row for each; empty: their own
  ModuliSolver solver = ModuliSolver::automatic;
};

/// Rows of one state after the other, by a factor or what is asked for in its place.
class ModuliRows {
 public:
  explicit ModuliRows(const ModuliRequest& request);

  /// A row for each rolling stiffness asked for, or one.
  /// @param increments  takes those of every contact; null: none are wanted
  /// @throws NoResult
  template <int Dim>
  std::vector<ModuliRow> of(const std::string& file, const State<Dim>& state, Table* increments);

 private:
  template <int Dim>
  std::vector<Moduli> compute(const std::string& file, const State<Dim>& state, ModuliOptions& options);
  template <int Dim>
  std::vector<Moduli> without_factor(const std::string& file, const Packing<Dim>& packing, double bytes,
                                     const ModuliOptions& options);

  ModuliRequest request_;
  /// Of the states so far, which an iterative method goes on from.
  ModuliSequence<2> plane_;
  ModuliSequence<3> space_;
  double last_row_;                         // processor time when it was done
  std::unique_ptr<ParallelSolver> solver_;  // once a factor was too large
};

/// The same by PETSc, on all processes of the solver: each is given the state, and all get the same rows.
/// @param state  its contacts are let go of as soon as they can be
/// @throws NoResult
template <int Dim>
std::vector<ModuliRow> parallel_moduli_rows(const std::string& file, State<Dim> state,
                                            const ModuliRequest& request, ParallelSolver& solver);

}  // namespace floc
