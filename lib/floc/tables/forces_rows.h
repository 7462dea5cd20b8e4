#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/io/table.h"
#include "floc/packing/state.h"
#include "floc/tables/column.h"
#include "floc/tables/remarks.h"

namespace floc {

/// Ways to select one of the sets of contact forces that balance a load.
enum class ForceSelection {
  kClosest,    ///< the set closest to the forces of the state
  kCanonical,  ///< the set of least elastic energy
};

/// Returns the selection of a name, "closest" or "canonical". @throws InputError for other names
ForceSelection force_selection_named(const std::string& name);

/// Numbers that a contact may have: the state tells whether it has a contact with this number.
inline constexpr WholeRange kAnyContact{.least = 0, .most = std::numeric_limits<int>::max()};
/// Largest gap, in units of the smallest diameter.
inline constexpr NumberRange kNearGap{.least = 0.0, .most = 1.0};

/// Options of the table of static forces.
struct ForcesTableOptions {
  std::optional<ForceSelection> selection;  ///< absent: closest; canonical if the state has no forces
  std::optional<double> friction;           ///< friction coefficient; absent: that of the contact law
  std::optional<double> kn, kt;             ///< K_N and K_T (force/length); absent: those of each contact
  /// Stress that the forces transmit (force/length^(d-1)): the pressure, the components along the axes, or all
  /// components in the order of Voigt. Empty: that of the forces of the state.
  std::vector<double> stress;
  /// Largest gap, in units of the smallest diameter, across which pairs of grains may carry a force; absent: only the
  /// contacts of the state carry forces.
  std::optional<double> gap;
  bool contacts = false;  ///< adds the contacts and their forces to `contacts`
  bool ranges = false;    ///< computes the range of the normal force of each contact
  /// Numbers of the contacts, from 0, to which the ranges are restricted; empty: all.
  std::vector<int> range_of;

  std::vector<std::string> validate() const;
};

/// Row of the table of static forces: one state.
struct ForcesRow {
  std::string file;
  int dimension = 0, n_grains = 0, n_contacts = 0, n_carrying = 0;
  ForceSelection selection = ForceSelection::kClosest;
  double friction = 0.0;
  std::optional<double> net_force_before;  ///< over the mean normal force; empty if the state has no forces
  double net_force = 0.0, net_moment = 0.0, stress_error = 0.0;
  double mean_normal_force = 0.0;  ///< over the contacts that carry a force (force)
  double mobilised = 0.0;          ///< share of the contacts that carry a force whose friction is at its limit
  std::optional<double> moved;     ///< relative distance from the forces of the state; empty if it has none
  double force_freedom = 0.0;      ///< relative distance of the forces from those of least elastic energy
  int n_factorizations = 0;
};

/// Returns the row of a state: its contact forces at rest, by the cone problem of StaticForces.
/// @param contacts  receives the forces of the contacts, and their ranges, if the options select them
/// @throws InputError if an option is not valid or the state has no such forces (force_balance())
/// @throws NoResult if no set of forces balances the load
template <int Dim>
ForcesRow forces_row(const std::string& file, const State<Dim>& state, const ForcesTableOptions& options,
                     Table& contacts, const Remarks& remarks = {});

/// Returns the columns of the table of static forces.
std::vector<Column<ForcesRow>> forces_columns();

}  // namespace floc
