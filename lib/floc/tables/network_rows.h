#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/force_correlation.h"
#include "floc/elasticity/network_mechanics.h"
#include "floc/io/state_file.h"
#include "floc/structure/carrying_forces.h"
#include "floc/structure/coordination.h"
#include "floc/structure/force_distribution.h"
#include "floc/structure/force_moments.h"
#include "floc/structure/pressure_phases.h"
#include "floc/tables/column.h"
#include "floc/tables/network_bonds.h"

namespace floc {

/// Options of the rows of `floc network`.
struct NetworkTableOptions {
  /// Largest normal force that counts as zero, in F1; default: tolerance of the state.
  std::optional<double> zero_force;
  std::optional<int> least_contacts;  ///< fewest contacts of a grain that carries; default: least_contacts()
  bool mechanics = true;              ///< adds the columns that need the moduli
  bool distributions = false;         ///< adds the table of force distributions
  ForceUnit unit = ForceUnit::mean;   ///< unit of these distributions
  double bin_width = 0.1;             ///< bin width of these distributions, in that unit
  bool pressures = false;             ///< adds the table of particle stresses
  BondTableOptions bonds;
};

/// Returns the unit that a keyword of `floc network --unit` names: "mean", "F0" or "P".
/// @pre the keyword is valid
ForceUnit force_unit_named(const std::string& keyword);

/// One row: the contact network of a state.
struct NetworkRow {
  std::string file;
  std::string units;
  int dimension;
  int n_grains;
  double pressure;
  double reduced_pressure;
  std::optional<double> wall_pressure;  ///< mean pressure on the walls (stress); only in boxes
  double solid_fraction;
  Coordination coordination;
  ForceMoments moments;
  PressurePhases phases;
  std::optional<NetworkMechanics> mechanics;  ///< absent without NetworkTableOptions::mechanics
  ForceCorrelation correlation;               ///< needs the mechanics, as does hyperstaticity
  std::optional<Indeterminacy> hyperstaticity;
  CarryingForces carrying;
  double energy;
  std::optional<double> contact_pressure;
  double stress_spread;
  BondRow bonds;
  double seconds;
};

/// Distributions of forces by kind, of all states together.
using Pooled = std::map<ForceKind, ForceDistribution>;

/// Tables beside the main one.
struct NetworkTables {
  Table distributions{{"file", "kind", "unit_force", "low", "high", "count", "n", "density", "n_outside"}, {}};
  Table pressures;
  Pooled pooled;
  BondTables bonds;
};

/// Computes the row of one state, and adds the rows of the other tables that the options select to `side`. Contacts
/// with walls support grains and contribute to their pressure, but are not counted as contacts. The mechanics of a
/// state with walls are left out.
template <int Dim>
NetworkRow network_row(const std::string& file, const State<Dim>& state, const NetworkTableOptions& options,
                       NetworkTables& side, const Remarks& remarks = {});

/// Returns the columns of the table of `floc network`.
std::vector<Column<NetworkRow>> network_columns(const NetworkTableOptions& options);

/// Computes the row of `floc network` of one state in one call; docs/columns.md describes its columns.
/// @param file     name of the state in the table and in messages
/// @param further  receives the other tables that the options select; null: they are dropped
Table network_table(const AnyState& state, const NetworkTableOptions& options = {},
                    const std::string& file = "", NetworkTables* further = nullptr,
                    const Remarks& remarks = {});

/// Adds the rows of all states together to the tables, if there are several states.
/// @param n_states  number of states read
void add_pooled(const NetworkTableOptions& options, std::size_t n_states, NetworkTables& side,
                const Remarks& remarks = {});

}  // namespace floc
