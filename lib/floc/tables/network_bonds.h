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

/// Options of the columns and tables on bonds of cohesive networks and on phases of particle pressure.
struct BondTableOptions {
  bool bonds = false, phases = false;  ///< groups of columns
  double near = 0.02;                  ///< largest normal force of the class near zero, in units of F0
  PhaseOptions phase_structure;
  bool exponents = false, pressures = false, neighbours = false,
       clusters = false;   ///< tables beside the main one
  double bin_width = 0.1;  ///< bin width of the particle pressures, in units of p0

  bool is_empty() const { return !bonds && !needs_values() && !needs_phases(); }
  bool needs_values() const { return exponents || pressures; }
  bool needs_phases() const { return phases || neighbours || clusters; }
};

/// Bonds and phases of one state.
struct BondRow {
  BondSigns bonds;
  double virial_strength = 0.0, rumpf_strength = 0.0;  ///< (stress)
  double unit_pressure = 0.0;                          ///< p0 (stress)
  std::optional<PhaseStructure> phases;
};

/// Tables beside the main one.
struct BondTables {
  Table exponents{{"file", "quantity", "unit", "unit_size", "side", "from", "to", "n", "exponent", "stderr"},
                  {}};
  Table pressures{{"file", "unit_stress", "low", "high", "count", "n", "density", "n_outside"}, {}};
  Table neighbours{{"file", "phase", "like_low", "like_high", "n_grains", "mean_size", "stderr"}, {}};
  Table clusters{{"file", "phase", "n_grains", "count"}, {}};
  /// Values of all states by quantity and unit; every value is in the unit of its own state.
  std::map<std::pair<std::string, std::string>, std::vector<double>> pooled;
};

/// Limits below which the tolerance of equilibrium does not distinguish forces from zero.
struct ForceLimits {
  double zero;      ///< largest normal force that counts as zero
  double pressure;  ///< largest P a^(Dim-1) that is too small to serve as a unit of force
};

/// Computes the bonds and phases of one state, and adds its rows to `tables`.
/// @param pressure  pressure of each grain (stress)
template <int Dim>
BondRow bond_row(const std::string& file, const Packing<Dim>& packing, const std::vector<double>& pressure,
                 const ForceLimits& limits, const BondTableOptions& options, BondTables& tables,
                 const Remarks& remarks);

/// Returns the columns of the groups that the options select.
std::vector<Column<BondRow>> bond_columns(const BondTableOptions& options);

/// Adds rows "pooled", which take all states as samples of one ensemble, if there are several.
/// @param n_states  number of states read
void add_pooled(const BondTableOptions& options, std::size_t n_states, BondTables& tables,
                const Remarks& remarks);

}  // namespace floc
