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

/// The solver of the linear systems for moduli.
enum class ModuliSolver {
  automatic,  ///< CHOLMOD, or PETSc in this process where the factor would not fit into memory
  cholmod,
  petsc,
};

/// Options of the rows of `floc moduli`.
struct ModuliTableOptions {
  ModuliOptions moduli;
  std::optional<ModuliAccuracy> accuracy;  ///< replaces the method: the cheapest one that keeps it is taken
  std::vector<double>
      rolling_stiffness;  ///< replaces that of the states, a row for each value; empty: their own
  ModuliSolver solver = ModuliSolver::automatic;
  std::optional<double>
      memory;               ///< largest factor of the automatic solver (bytes); without it 0.7 of what is free
  bool increments = false;  ///< also the table of the increments of every contact

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Reads relative errors as a user writes them: "X" for both moduli, "B=X", "G=X"; no texts: no accuracy is asked for.
/// @throws InputError naming the text
std::optional<ModuliAccuracy> moduli_accuracy(const std::vector<std::string>& texts);

/// Computes the rows of one state after the other, by a factorization or by what the options ask for in its place.
class ModuliRows {
 public:
  /// @pre options.validate() finds no fault
  explicit ModuliRows(const ModuliTableOptions& options);

  /// One row for each rolling stiffness asked for, or one row.
  /// @param file        name of the state in the table and in messages
  /// @param increments  receives those of every contact; null: none are wanted
  /// @throws NoResult where the state has no moduli, InputError where it cannot have those asked for
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
  /// Of the states so far, which an iterative method goes on from.
  ModuliSequence<2> plane_;
  ModuliSequence<3> space_;
  double last_row_;                         // processor time when it was done
  std::unique_ptr<ParallelSolver> solver_;  // once a factor was too large
};

/// Computes these rows by PETSc, on all processes of the solver: each is given the state, and all get the same rows.
/// @param state  its contacts are let go of as soon as they can be
/// @throws NoResult where the state has no moduli
template <int Dim>
std::vector<ModuliRow> parallel_moduli_rows(const std::string& file, State<Dim> state,
                                            const ModuliTableOptions& options, ParallelSolver& solver,
                                            const Remarks& remarks = {});

/// @throws InputError where the boundary of the state cannot impose the strains asked for
void require_strains(const std::string& file, const AnyState& any, StrainSet strains);

/// Says in words how a row misses the accuracy asked for; empty where it keeps it.
std::string accuracy_fault(const ModuliRow& row, const std::optional<ModuliAccuracy>& accuracy);

/// The table of rows that were computed with these options.
Table moduli_table(const ModuliTableOptions& options, const std::vector<ModuliRow>& rows);

/// The row of `floc moduli` of one state, in one call: see docs/columns.md for its columns.
/// @param file  name of the state in the table and in messages
/// @throws InputError for options that are no options, or that the state cannot have; NoResult where the state has no
/// moduli
Table moduli_table(const AnyState& state, const ModuliTableOptions& options = {}, const std::string& file = "",
                   const Remarks& remarks = {});

}  // namespace floc
