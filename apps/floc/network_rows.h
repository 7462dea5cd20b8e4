#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "columns.h"
#include "floc/elasticity/force_correlation.h"
#include "floc/elasticity/network_mechanics.h"
#include "floc/structure/carrying_forces.h"
#include "floc/structure/coordination.h"
#include "floc/structure/force_distribution.h"
#include "floc/structure/force_moments.h"
#include "floc/structure/pressure_phases.h"
#include "network_bonds.h"

namespace floc {

/// What `floc network` is asked.
struct NetworkCommand {
  std::vector<std::string> files;
  std::optional<double> zero_force;   ///< in F1; the state's own tolerance when absent
  std::optional<int> least_contacts;  ///< of a grain that is held; least_contacts() when absent
  std::string distributions;          ///< file for the force distributions; empty: none
  std::string unit = "mean";
  double bin_width = 0.1;
  std::string pressures;  ///< file for the particle stresses; empty: none
  BondArguments bonds;
  std::vector<std::string> without;  ///< groups of columns left empty: "mechanics"
  std::string format;

  bool mechanics() const { return without.empty(); }
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

/// Rows that go to files beside the main table.
struct NetworkTables {
  Table distributions{{"file", "kind", "unit_force", "low", "high", "count", "n", "density", "n_outside"}, {}};
  Table pressures;
  Pooled pooled;
  BondTables bonds;
};

/// What is asked for of one state; rows of files go to `side`. Contacts with walls hold grains and press them, but
/// are not among the contacts counted, and the mechanics of a state with walls are left out.
template <int Dim>
NetworkRow network_row(const std::string& file, const State<Dim>& state, const NetworkCommand& command,
                       NetworkTables& side);

/// The columns of the table of `floc network`.
std::vector<Column<NetworkRow>> network_columns(const NetworkCommand& command);

/// Adds what the tables hold of all states together, where there are several. @param n_states  read
void add_pooled(const NetworkCommand& command, std::size_t n_states, NetworkTables& side);

}  // namespace floc
