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
  std::optional<double> zero_force;   ///< in F1; without it the tolerance of the state
  std::optional<int> least_contacts;  ///< of a grain that is held; without it least_contacts()
  bool mechanics = true;              ///< columns that need the moduli
  bool distributions = false;         ///< also the table of force distributions
  ForceUnit unit = ForceUnit::mean;   ///< of these distributions
  double bin_width = 0.1;             ///< of these distributions, in that unit
  bool pressures = false;             ///< also the table of particle stresses
  BondTableOptions bonds;
};

/// One row: what the contact network of a state is like.
struct NetworkRow {
  std::string file;
  std::string units;
  int dimension;
  int n_grains;
  double pressure;
  double reduced_pressure;
  std::optional<double> wall_pressure;  ///< of boxes alone
  double solid_fraction;
  Coordination coordination;
  ForceMoments moments;
  PressurePhases phases;
  std::optional<NetworkMechanics> mechanics;  ///< absent, as the next two, where they are left out
  ForceCorrelation correlation;
  std::optional<Indeterminacy> hyperstaticity;
  CarryingForces carrying;
  double energy;
  std::optional<double> contact_pressure;
  double stress_spread;
  BondRow bonds;
  double seconds;
};

/// Counts of forces by kind, of all states together.
using Pooled = std::map<ForceKind, ForceDistribution>;

/// Tables beside the main one.
struct NetworkTables {
  Table distributions{{"file", "kind", "unit_force", "low", "high", "count", "n", "density", "n_outside"}, {}};
  Table pressures;
  Pooled pooled;
  BondTables bonds;
};

/// The row of one state; `side` takes the rows of the other tables that are asked for. Contacts with walls hold grains and press them, but
/// are not among the contacts counted, and the mechanics of a state with walls are left out.
template <int Dim>
NetworkRow network_row(const std::string& file, const State<Dim>& state, const NetworkTableOptions& options,
                       NetworkTables& side, const Remarks& remarks = {});

/// The columns of the table of `floc network`.
std::vector<Column<NetworkRow>> network_columns(const NetworkTableOptions& options);

/// The row of `floc network` of one state, in one call: see docs/columns.md for its columns.
/// @param file     name of the state in the table and in messages
/// @param further  takes the other tables that are asked for; null: none is kept
Table network_table(const AnyState& state, const NetworkTableOptions& options = {},
                    const std::string& file = "", NetworkTables* further = nullptr,
                    const Remarks& remarks = {});

/// Adds what the tables hold of all states together, where there are several. @param n_states  read
void add_pooled(const NetworkTableOptions& options, std::size_t n_states, NetworkTables& side,
                const Remarks& remarks = {});

}  // namespace floc
