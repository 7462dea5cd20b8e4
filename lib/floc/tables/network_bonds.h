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

/// What is asked for of the bonds of cohesive networks and of the phases of particle pressure.
struct BondTableOptions {
  bool bonds = false, phases = false;  ///< groups of columns
  double near = 0.02;                  ///< normal forces below this are a class of their own (F0)
  PhaseOptions phase_structure;
  bool exponents = false, pressures = false, neighbours = false,
       clusters = false;   ///< tables beside the main one
  double bin_width = 0.1;  ///< of the particle pressures, in p0

  bool asks_nothing() const { return !bonds && !needs_values() && !needs_phases(); }
  bool needs_values() const { return exponents || pressures; }
  bool needs_phases() const { return phases || neighbours || clusters; }
};

/// Of one state.
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
  /// Values of all states by quantity and unit, each in its own unit.
  std::map<std::pair<std::string, std::string>, std::vector<double>> pooled;
};

/// Forces that equilibrium cannot tell from zero.
struct ForceLimits {
  double zero;      ///< largest normal force that counts as zero
  double pressure;  ///< largest P a^(Dim-1) that is no unit
};

/// @param pressure  of each grain (stress)
template <int Dim>
BondRow bond_row(const std::string& file, const Packing<Dim>& packing, const std::vector<double>& pressure,
                 const ForceLimits& limits, const BondTableOptions& options, BondTables& tables,
                 const Remarks& remarks);

/// The columns of the groups asked for.
std::vector<Column<BondRow>> bond_columns(const BondTableOptions& options);

/// Adds rows "pooled" for all states as samples of one, where there are several. @param n_states  read
void add_pooled(const BondTableOptions& options, std::size_t n_states, BondTables& tables,
                const Remarks& remarks);

}  // namespace floc
