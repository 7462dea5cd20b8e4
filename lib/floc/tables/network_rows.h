#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/force_correlation.h"
#include "floc/elasticity/network_mechanics.h"
#include "floc/io/state_file.h"
#include "floc/structure/carrying_forces.h"
#include "floc/structure/contact_statistics.h"
#include "floc/structure/coordination.h"
#include "floc/structure/force_distribution.h"
#include "floc/structure/force_moments.h"
#include "floc/structure/pressure_phases.h"
#include "floc/tables/column.h"
#include "floc/tables/network_bonds.h"

namespace floc {

/// Options of the tables of `floc network`.
struct NetworkTableOptions {
  /// Largest normal force that counts as zero, in units of the force scale F1 = max(F0, P a^(Dim-1)) (F0: pull-off
  /// force, P: pressure, a: largest diameter). If absent, the force tolerance of the state.
  std::optional<double> zero_force;
  /// Smallest number of contacts that a grain needs to belong to the force-carrying structure. If absent,
  /// least_contacts().
  std::optional<int> least_contacts;
  bool mechanics = true;             ///< whether the columns that need the elastic moduli are computed
  bool distributions = false;        ///< whether the table of force distributions is written
  ForceUnit unit = ForceUnit::mean;  ///< unit of the forces in the table of force distributions
  double bin_width = 0.1;            ///< bin width of the force distributions, in the unit `unit`
  bool pressures = false;            ///< whether the table of particle stresses is written
  BondTableOptions bonds;
};

/// Returns the unit of force that a keyword of `floc network --unit` denotes: "mean", "F0" or "P".
/// @pre the keyword is valid
ForceUnit force_unit_named(const std::string& keyword);

/// One row of the table of `floc network`: properties of the contact network of a state.
struct NetworkRow {
  std::string file;
  std::string units;
  int dimension;
  int n_grains;
  double pressure;
  double reduced_pressure;
  double driven_stress;  ///< stress that the contacts carry on the driven axis, see stress_on_driven_axis()
  double reduced_driven_stress;
  int n_bonds = 0;                      ///< number of contacts that act at any gap (Contact::bonded)
  std::optional<double> wall_pressure;  ///< mean pressure on the walls (stress); absent if there are no walls
  double solid_fraction;
  Coordination coordination;
  ForceMoments moments;
  PressurePhases phases;
  /// Mechanics of the contact network; absent if NetworkTableOptions::mechanics is false, or if the contacts are rigid.
  std::optional<NetworkMechanics> mechanics;
  /// Indeterminacy of the forces of rigid contacts; absent for elastic contacts.
  std::optional<Indeterminacy> rigid_indeterminacy;
  /// Correlation of the contact forces of the state with their increments under isotropic stress; computed only if
  /// `mechanics` is present.
  ForceCorrelation correlation;
  std::optional<Indeterminacy> hyperstaticity;
  CarryingForces carrying;
  double energy = 0.0;  ///< elastic energy of all contacts, divided by the number of grains
  std::optional<double> contact_pressure;
  double stress_spread;
  BondRow bonds;
  double seconds;
  std::optional<ContactKinds> kinds;  ///< kinds of the contacts of grains with corners; absent for round grains
  std::optional<ContactAnisotropy> anisotropy;
  ForceShape force_by_points;
  /// distribution of the forces by pairs of grains; absent for round grains, because a pair of round grains has only
  /// one contact point
  std::optional<ForceShape> force_by_pairs;
  std::optional<double> mobilisation;
  std::optional<double> long_axes_order;
  std::vector<double> long_axis;  ///< mean direction of long axes; empty if no grain is elongated
};

/// Distributions of the contact forces of all states together. The key is the kind of force: normal, tangential,
/// rolling moment.
using Pooled = std::map<ForceKind, ForceDistribution>;

/// Tables that `floc network` writes to files, in addition to the table of states that it prints.
struct NetworkTables {
  Table distributions{{"file", "kind", "unit_force", "low", "high", "count", "n", "density", "n_outside"}, {}};
  Table pressures;
  Pooled pooled;
  BondTables bonds;
};

/// Computes the row of one state, and adds rows to the tables in `side` that the options select. In a state with walls,
/// the contacts with walls support grains and contribute to the pressure of the grains, but are not counted as
/// contacts. The network mechanics are not computed for such a state.
template <int Dim>
NetworkRow network_row(const std::string& file, const State<Dim>& state, const NetworkTableOptions& options,
                       NetworkTables& side, const Remarks& remarks = {});

/// Returns the columns of the table of `floc network`.
std::vector<Column<NetworkRow>> network_columns(const NetworkTableOptions& options);

/// Computes the table of `floc network` for one state in a single call; docs/columns.md describes its columns.
/// @param file     name of the state in the table and in messages
/// @param further  receives the tables that the options select in addition to the returned table; null if they are not
/// needed
Table network_table(const AnyState& state, const NetworkTableOptions& options = {},
                    const std::string& file = "", NetworkTables* further = nullptr,
                    const Remarks& remarks = {});

/// Adds rows for all states together to the tables in `side`; the name in these rows is "pooled" instead of the name of
/// a state. Does nothing if there are fewer than two states.
/// @param n_states  number of states
void add_pooled(const NetworkTableOptions& options, std::size_t n_states, NetworkTables& side,
                const Remarks& remarks = {});

}  // namespace floc
