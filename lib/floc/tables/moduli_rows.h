#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/moduli_within.h"
#include "floc/io/state_file.h"
#include "floc/packing/state.h"
#include "floc/petsc/parallel_solver.h"
#include "floc/tables/increments.h"
#include "floc/tables/moduli_columns.h"
#include "floc/tables/remarks.h"

namespace floc {

/// Solver of the linear systems for moduli.
enum class ModuliSolver {
  automatic,  ///< CHOLMOD, or PETSc in this process if the factor would not fit into memory
  cholmod,
  petsc,
};

/// Options of the rows of `floc moduli`.
struct ModuliTableOptions {
  ModuliOptions moduli;
  std::optional<ModuliAccuracy> accuracy;  ///< replaces the method by the cheapest one that reaches it
  /// Values that replace the rolling stiffness of the states (force * length), with a row for each; empty: their own.
  std::vector<double> rolling_stiffness;
  ModuliSolver solver = ModuliSolver::automatic;
  /// Largest factor of the automatic solver (bytes); default: 0.7 of the free memory.
  std::optional<double> memory;
  bool increments = false;  ///< adds the table of the increments of every contact

  /// Lists every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Parses relative errors: "X" for both moduli, "B=X", "G=X". Returns nothing if there are no texts.
/// @throws InputError naming the text at fault
std::optional<ModuliAccuracy> moduli_accuracy(const std::vector<std::string>& texts);

/// Computes the rows of one state after the other, by a factorization or by the method that the options choose.
class ModuliRows {
 public:
  /// @pre options.validate() finds no fault
  explicit ModuliRows(const ModuliTableOptions& options);

  /// Computes the rows of one state: one for each rolling stiffness in the options, or a single one.
  /// @param file        name of the state in the table and in messages
  /// @param increments  receives a row for every contact; null: no such rows are computed
  /// @throws NoResult if the state has no moduli, InputError if the options cannot apply to it
  template <int Dim>
  std::vector<ModuliRow> of(const std::string& file, const State<Dim>& state, Table* increments = nullptr,
                            const Remarks& remarks = {});

 private:
  template <int Dim>
  std::vector<Moduli> compute(const std::string& file, const State<Dim>& state, ModuliOptions& options,
                              const Remarks& remarks);
  template <int Dim>
  std::vector<Moduli> without_factor(const std::string& file, const Packing<Dim>& packing, double bytes,
                                     const ModuliOptions& options, const Remarks& remarks);

  ModuliTableOptions options_;
  /// Solutions of earlier states, with which an iterative method starts.
  ModuliSequence<2> plane_;
  ModuliSequence<3> space_;
  double last_row_;                         // processor time at the end of the last row (s)
  std::unique_ptr<ParallelSolver> solver_;  // made when a factor is too large for memory
};

/// Computes the rows of a state by PETSc, on all processes of the solver. Every process passes the state, and all get
/// equal rows.
/// @param state  a copy, of which the contacts are freed as soon as possible
/// @throws NoResult if the state has no moduli
template <int Dim>
std::vector<ModuliRow> parallel_moduli_rows(const std::string& file, State<Dim> state,
                                            const ModuliTableOptions& options, ParallelSolver& solver,
                                            const Remarks& remarks = {});

/// Checks that the boundary of a state can impose these strains. @throws InputError if it cannot
void require_strains(const std::string& file, const AnyState& any, StrainSet strains);

/// Describes in words how a row misses the required accuracy; empty if it reaches it.
std::string accuracy_fault(const ModuliRow& row, const std::optional<ModuliAccuracy>& accuracy);

/// Returns the table of rows that were computed with these options.
Table moduli_table(const ModuliTableOptions& options, const std::vector<ModuliRow>& rows);

/// Computes the row of `floc moduli` of one state in one call; docs/columns.md describes its columns. A state that is
/// not an equilibrium has a row too, and a warning among the remarks. The increments of contacts need ModuliRows.
/// @param file  name of the state in the table and in messages
/// @throws InputError if an option is not valid or cannot apply to the state; NoResult if the state has no moduli
Table moduli_table(const AnyState& state, const ModuliTableOptions& options = {}, const std::string& file = "",
                   const Remarks& remarks = {});

}  // namespace floc
