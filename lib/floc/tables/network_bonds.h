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

/// Options of `floc network` for bonds of cohesive networks and for phases of positive and negative particle
/// pressure.
struct BondTableOptions {
  bool bonds = false, phases = false;  ///< whether the columns of bonds, and of phases, are added
  /// Normal force below which a bond counts as near zero, in units of the pull-off force F0.
  double near = 0.02;
  PhaseOptions phase_structure;
  /// Further tables to write.
  bool exponents = false, pressures = false, neighbours = false, clusters = false;
  double bin_width = 0.1;  ///< bin width of the histogram of particle pressures, in units of p0

  bool is_empty() const { return !bonds && !needs_values() && !needs_phases(); }
  bool needs_values() const { return exponents || pressures; }
  bool needs_phases() const { return phases || neighbours || clusters; }
};

/// Bonds and phases of particle pressure of one state.
struct BondRow {
  BondSigns bonds;
  double virial_strength = 0.0, rumpf_strength = 0.0;  ///< estimates of the tensile strength (stress)
  double unit_pressure = 0.0;                          ///< unit p0 of particle pressure (stress)
  std::optional<PhaseStructure> phases;
};

/// Further tables of `floc network` on bonds and phases of particle pressure.
struct BondTables {
  Table exponents{{"file", "quantity", "unit", "unit_size", "side", "from", "to", "n", "exponent", "stderr"},
                  {}};
  Table pressures{{"file", "unit_stress", "low", "high", "count", "n", "density", "n_outside"}, {}};
  Table neighbours{{"file", "phase", "like_low", "like_high", "n_grains", "mean_size", "stderr"}, {}};
  Table clusters{{"file", "phase", "n_grains", "count"}, {}};
  /// Values of all states, by the names of quantity and unit; every value is measured in the unit of its state.
  std::map<std::pair<std::string, std::string>, std::vector<double>> pooled;
};

/// Limits up to which forces cannot be distinguished from zero, because of the tolerance of equilibrium.
struct ForceLimits {
  double zero;      ///< largest normal force that counts as zero (force)
  double pressure;  ///< largest force P a^(Dim-1) that is too small to serve as a unit of force (force)
};

/// Computes the bonds and phases of particle pressure of one state, and adds its rows to the further tables.
/// @param pressure  pressure of each grain (stress)
template <int Dim>
BondRow bond_row(const std::string& file, const Packing<Dim>& packing, const std::vector<double>& pressure,
                 const ForceLimits& limits, const BondTableOptions& options, BondTables& tables,
                 const Remarks& remarks);

/// Returns the columns of bonds and phases that the options select.
std::vector<Column<BondRow>> bond_columns(const BondTableOptions& options);

/// Adds rows with the name "pooled" for all states together, as samples of one ensemble, if there are several
/// states.
/// @param n_states  number of states read
void add_pooled(const BondTableOptions& options, std::size_t n_states, BondTables& tables,
                const Remarks& remarks);

}  // namespace floc
