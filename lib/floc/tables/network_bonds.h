#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/table.h"
#include "floc/packing/state.h"
#include "floc/structure/bond_signs.h"
#include "floc/structure/phase_structure.h"
#include "floc/tables/column.h"
#include "floc/tables/remarks.h"

namespace floc {

/// Options of `floc network` for the columns and tables on two subjects: bonds, which are the interactions of grains in
/// a cohesive network, and phases, which are the grains of positive and those of negative particle pressure.
struct BondTableOptions {
  bool bonds = false, phases = false;  ///< whether the columns on bonds and those on phases are added
  /// Magnitude of the normal force below which a bond counts as near zero, in units of the pull-off force F0.
  double near = 0.02;
  PhaseOptions phase_structure;
  /// Whether each of these tables is computed in addition to the table of states; see BondTables.
  bool exponents = false, pressures = false, neighbours = false, clusters = false;
  double bin_width = 0.1;  ///< bin width of the histogram of particle pressures, in BondRow::unit_pressure

  bool is_empty() const { return !bonds && !needs_values() && !needs_phases(); }
  bool needs_values() const { return exponents || pressures; }
  bool needs_phases() const { return phases || neighbours || clusters; }
};

/// Bonds and phases of one state. The phases are the grains of positive and those of negative particle pressure.
struct BondRow {
  BondSigns bonds;
  double virial_strength = 0.0, rumpf_strength = 0.0;  ///< estimates of the tensile strength (stress)
  /// Unit p0 of particle pressures (stress): the pull-off force divided by the mean diameter to the power Dim - 1 or,
  /// without adhesion, the pressure of the state.
  double unit_pressure = 0.0;
  std::optional<PhaseStructure> phases;
};

/// Tables of `floc network` on bonds between grains and on the phases (grains of positive and of negative particle
/// pressure). They are written in addition to the table of states.
struct BondTables {
  Table exponents{{"file", "quantity", "unit", "unit_size", "side", "from", "to", "n", "exponent", "stderr"},
                  {}};
  Table pressures{{"file", "unit_stress", "low", "high", "count", "n", "density", "n_outside"}, {}};
  Table neighbours{{"file", "phase", "like_low", "like_high", "n_grains", "mean_size", "stderr"}, {}};
  Table clusters{{"file", "phase", "n_grains", "count"}, {}};
  /// Values of all states together, for each pair of a quantity and a unit. Each value is divided by the unit of its
  /// own state.
  std::map<std::pair<std::string, std::string>, std::vector<double>> pooled;
};

/// Limits below which forces in a state cannot be distinguished from zero, because its equilibrium is reached only to a
/// tolerance.
struct ForceLimits {
  double zero;      ///< largest normal force that counts as zero (force)
  double pressure;  ///< largest force P a^(Dim-1) that counts as zero (force); P: pressure, a: largest diameter
};

/// Computes the bonds and phases of one state, and adds its rows to the tables that the options select.
/// @param pressure  pressure of each grain (stress)
template <int Dim>
BondRow bond_row(const std::string& file, const Packing<Dim>& packing, const std::vector<double>& pressure,
                 const ForceLimits& limits, const BondTableOptions& options, BondTables& tables,
                 const Remarks& remarks);

/// Returns those columns on bonds and on phases that the options select.
std::vector<Column<BondRow>> bond_columns(const BondTableOptions& options);

/// Adds rows for all states together to the tables. In these rows, the name "pooled" replaces the name of a state. The
/// states are taken as samples of one ensemble. Does nothing if there are fewer than two states.
/// @param n_states  number of states
void add_pooled(const BondTableOptions& options, std::size_t n_states, BondTables& tables,
                const Remarks& remarks);

}  // namespace floc
