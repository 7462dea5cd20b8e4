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

/// Options of `floc network` for columns and tables about bonds and phases. Bonds are the interactions of grains in a
/// cohesive network. The two phases are the grains with positive and the grains with negative particle pressure.
struct BondTableOptions {
  /// whether the columns about bonds and the columns about phases are added
  bool bonds = false, phases = false;
  /// A bond counts as near zero if the magnitude of its normal force is below this value, in units of the pull-off
  /// force F0.
  double near = 0.02;
  PhaseOptions phase_structure;
  /// Whether each of the tables in BondTables is computed in addition to the table of states.
  bool exponents = false, pressures = false, neighbours = false, clusters = false;
  /// bin width of the histogram of particle pressures, in units of BondRow::unit_pressure
  double bin_width = 0.1;

  bool is_empty() const { return !bonds && !needs_values() && !needs_phases(); }
  bool needs_values() const { return exponents || pressures; }
  bool needs_phases() const { return phases || neighbours || clusters; }
};

/// Bonds and phases of one state. The two phases are the grains with positive and the grains with negative particle
/// pressure.
struct BondRow {
  BondSigns bonds;
  double virial_strength = 0.0, rumpf_strength = 0.0;  ///< estimates of the tensile strength (stress)
  /// Unit p0 of particle pressures (stress): the pull-off force divided by the mean diameter to the power Dim - 1 or,
  /// without adhesion, the pressure of the state.
  double unit_pressure = 0.0;
  std::optional<PhaseStructure> phases;
};

/// Tables of `floc network` about bonds between grains and about the phases (grains with positive and with negative
/// particle pressure). They are written in addition to the table of states.
struct BondTables {
  Table exponents{{"file", "quantity", "unit", "unit_size", "side", "from", "to", "n", "exponent", "stderr"},
                  {}};
  Table pressures{{"file", "unit_stress", "low", "high", "count", "n", "density", "n_outside"}, {}};
  Table neighbours{{"file", "phase", "like_low", "like_high", "n_grains", "mean_size", "stderr"}, {}};
  Table clusters{{"file", "phase", "n_grains", "count"}, {}};
  /// Values from all states together; the key consists of quantity and unit. Each value is divided by the size of the
  /// unit in the state from which the value comes.
  std::map<std::pair<std::string, std::string>, std::vector<double>> pooled;
};

/// Limits below which a force cannot be distinguished from zero, because the state is in equilibrium only to a
/// tolerance.
struct ForceLimits {
  double zero;  ///< largest normal force that counts as zero (force)
  /// largest value of P a^(Dim-1) that counts as zero (force), with the pressure P and the largest diameter a
  double pressure;
};

/// Computes the bonds and phases of one state, and adds its rows to the tables that the options select.
/// @param pressure  pressure of each grain (stress)
template <int Dim>
BondRow bond_row(const std::string& file, const Packing<Dim>& packing, const std::vector<double>& pressure,
                 const ForceLimits& limits, const BondTableOptions& options, BondTables& tables,
                 const Remarks& remarks);

/// Returns the columns about bonds and about phases that the options select.
std::vector<Column<BondRow>> bond_columns(const BondTableOptions& options);

/// Adds rows for all states together to the tables; the name in these rows is "pooled" instead of the name of a state.
/// All states are treated as samples of one ensemble. Does nothing if there are fewer than two states.
/// @param n_states  number of states
void add_pooled(const BondTableOptions& options, std::size_t n_states, BondTables& tables,
                const Remarks& remarks);

}  // namespace floc
