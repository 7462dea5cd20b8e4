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
  automatic,  ///< CHOLMOD or, if its Cholesky factor would not fit into memory, PETSc in this process
  cholmod,
  petsc,
};

/// Options of the table of `floc moduli`.
struct ModuliTableOptions {
  ModuliOptions moduli;
  /// Required relative errors of the moduli. If given, the cheapest method with these errors is used.
  std::optional<ModuliAccuracy> accuracy;
  /// Rolling stiffnesses (force * length). For each of them, the table has one row per state, computed with this
  /// rolling stiffness in place of the rolling stiffness of the state. If empty, the rolling stiffness of the state is
  /// used.
  std::vector<double> rolling_stiffness;
  ModuliSolver solver = ModuliSolver::automatic;
  /// Memory that a Cholesky factor of the stiffness matrix may take with ModuliSolver::automatic (bytes). If absent,
  /// 0.7 times the free memory.
  std::optional<double> memory;
  /// Stiffnesses of the contacts of rigid grains (force/length). They are required for states of rigid grains, and
  /// refused for other states.
  std::optional<double> kn, kt;
  /// Whether each contact point has the stiffnesses `kn` and `kt`, or all contact points of a pair of grains together.
  StiffnessPer stiffness_per = StiffnessPer::point;
  bool increments = false;  ///< whether a table of the force increments of every contact is added

  /// Returns the faults of the options as texts "name of the option: requirement", some with the value of the option.
  /// The result is empty if there are no faults.
  std::vector<std::string> validate() const;
};

/// Parses the values of the option --accuracy: "X" is the required relative error of both B and G, "B=X" or "G=X" of
/// one of them. Returns nothing if `texts` is empty.
/// @throws InputError with the text that is not valid
std::optional<ModuliAccuracy> moduli_accuracy(const std::vector<std::string>& texts);

/// Computes the rows of the table of `floc moduli` for one state after another, by the method that the options select.
class ModuliRows {
 public:
  /// @pre options.validate() returns no faults
  explicit ModuliRows(const ModuliTableOptions& options);

  /// Computes the rows of one state: one row for each rolling stiffness in the options, or a single row if there are
  /// none.
  /// @param file        name of the state in the table and in messages
  /// @param increments  table that receives a row for every contact; null if the options select no such table
  /// @throws NoResult if the state has no moduli
  /// @throws InputError if the options cannot be applied to the state
  template <int Dim>
  std::vector<ModuliRow> of(const std::string& file, const State<Dim>& state, Table* increments = nullptr,
                            const Remarks& remarks = {});

 private:
  template <int Dim>
  std::vector<ModuliRow> of_elastic(const std::string& file, const State<Dim>& state, Table* increments,
                                    const Remarks& remarks);
  template <int Dim>
  std::vector<Moduli> compute(const std::string& file, const State<Dim>& state, ModuliOptions& options,
                              const Remarks& remarks);
  template <int Dim>
  std::vector<Moduli> without_factor(const std::string& file, const Packing<Dim>& packing, double bytes,
                                     const ModuliOptions& options, const Remarks& remarks);

  ModuliTableOptions options_;
  /// Moduli of successive states in 2D (plane_) and in 3D (space_). An iterative method starts from the solution for
  /// the previous state.
  ModuliSequence<2> plane_;
  ModuliSequence<3> space_;
  double last_row_;  // processor time of this process when the last row was complete (s)
  // PETSc solver, created when a Cholesky factor does not fit into memory
  std::unique_ptr<ParallelSolver> solver_;
};

/// Computes the rows of the table of `floc moduli` for one state, on all processes of the PETSc solver. All processes
/// must call this function with the same state, and all obtain the same rows.
/// @param state  the state, passed by value so that its contacts can be freed early, to save memory
/// @throws NoResult if the state has no moduli
template <int Dim>
std::vector<ModuliRow> parallel_moduli_rows(const std::string& file, State<Dim> state,
                                            const ModuliTableOptions& options, ParallelSolver& solver,
                                            const Remarks& remarks = {});

/// Checks that a state can have moduli: its contacts have stiffnesses, their own or the stiffnesses of the options, and
/// its boundary can impose the strains. Walls cannot impose shear strains.
/// @throws InputError if the state cannot have moduli
void require_moduli_of(const std::string& file, const AnyState& any, const ModuliTableOptions& options);

/// Returns a message if the moduli in a row do not have the required accuracy, otherwise an empty text.
std::string accuracy_fault(const ModuliRow& row, const std::optional<ModuliAccuracy>& accuracy);

/// Returns the table of `floc moduli`.
/// @param options  options with which the rows were computed
Table moduli_table(const ModuliTableOptions& options, const std::vector<ModuliRow>& rows);

/// Computes the table of `floc moduli` for one state in a single call; docs/columns.md describes its columns. If the
/// state is not in equilibrium, `remarks` receives a warning. For the table of the force increments of contacts, use
/// the class ModuliRows.
/// @param file  name of the state in the table and in messages
/// @throws InputError if an option is not valid or cannot be applied to the state
/// @throws NoResult if the state has no moduli
Table moduli_table(const AnyState& state, const ModuliTableOptions& options = {}, const std::string& file = "",
                   const Remarks& remarks = {});

}  // namespace floc
