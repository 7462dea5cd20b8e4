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

/// Solver of the linear systems from which moduli are computed.
enum class ModuliSolver {
  automatic,  ///< CHOLMOD, or PETSc in this process if the factor of CHOLMOD would not fit into memory
  cholmod,
  petsc,
};

/// Options of the table of `floc moduli`.
struct ModuliTableOptions {
  ModuliOptions moduli;
  /// Required relative errors; if given, the cheapest method that reaches them is used.
  std::optional<ModuliAccuracy> accuracy;
  /// Rolling stiffnesses in place of those of the states (force * length); each gives a row of its own. If
  /// empty, the stiffnesses of the states are used.
  std::vector<double> rolling_stiffness;
  ModuliSolver solver = ModuliSolver::automatic;
  /// Largest factor of the stiffness matrix that the automatic solver may compute (bytes); 0.7 of the free
  /// memory if absent.
  std::optional<double> memory;
  bool increments = false;  ///< adds the table of the force increments of every contact

  /// Returns the faults of the options, each as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Parses required relative errors of the moduli: "X" for both, "B=X" or "G=X" for one. Returns nothing if
/// there are no texts.
/// @throws InputError with the text that is not valid
std::optional<ModuliAccuracy> moduli_accuracy(const std::vector<std::string>& texts);

/// Computes the rows of `floc moduli` for one state after the other, by the method that the options select.
class ModuliRows {
 public:
  /// @pre options.validate() returns no faults
  explicit ModuliRows(const ModuliTableOptions& options);

  /// Computes the rows of one state: a row for each rolling stiffness in the options, or a single row if there
  /// are none.
  /// @param file        name of the state in the table and in messages
  /// @param increments  table that receives a row for every contact; null if it is not needed
  /// @throws NoResult if the state has no moduli, InputError if the options cannot be applied to it
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
  /// Solutions of earlier states, from which an iterative method starts.
  ModuliSequence<2> plane_;
  ModuliSequence<3> space_;
  double last_row_;                         // processor time at the end of the last row (s)
  std::unique_ptr<ParallelSolver> solver_;  // PETSc solver, created if a factor is too large for memory
};

/// Computes the rows of `floc moduli` for one state by PETSc, on all processes of the solver. All processes
/// must call it with the same state, and all obtain equal rows.
/// @param state  a copy of the state; its contacts are freed as soon as possible to save memory
/// @throws NoResult if the state has no moduli
template <int Dim>
std::vector<ModuliRow> parallel_moduli_rows(const std::string& file, State<Dim> state,
                                            const ModuliTableOptions& options, ParallelSolver& solver,
                                            const Remarks& remarks = {});

/// Checks that the boundary of a state can impose a set of strains: walls cannot impose shear. @throws
/// InputError if it cannot
void require_strains(const std::string& file, const AnyState& any, StrainSet strains);

/// Returns a message if the moduli of a row miss the required accuracy; empty if they reach it.
std::string accuracy_fault(const ModuliRow& row, const std::optional<ModuliAccuracy>& accuracy);

/// Returns the table of `floc moduli` with rows that were computed with the given options.
Table moduli_table(const ModuliTableOptions& options, const std::vector<ModuliRow>& rows);

/// Computes the table of `floc moduli` for one state in one call; docs/columns.md describes its columns. If the
/// state is not in equilibrium, the remarks contain a warning. The force increments of contacts require the
/// class ModuliRows.
/// @param file  name of the state in the table and in messages
/// @throws InputError if an option is not valid or cannot be applied to the state; NoResult if the state has no
/// moduli
Table moduli_table(const AnyState& state, const ModuliTableOptions& options = {}, const std::string& file = "",
                   const Remarks& remarks = {});

}  // namespace floc
