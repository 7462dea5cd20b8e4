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

/// Criterion by which one set of contact forces is selected from the many sets that balance a load.
enum class ForceSelection {
  kClosest,    ///< the set closest to the forces of the state
  kCanonical,  ///< the set of least elastic energy
};

/// Returns the selection with a name, "closest" or "canonical". @throws InputError for other names
ForceSelection force_selection_named(const std::string& name);

/// Contact numbers that an option accepts. A later check ensures that the state has a contact with the given number.
inline constexpr WholeRange kAnyContact{.least = 0, .most = std::numeric_limits<int>::max()};
/// Range of the option `gap`, in units of the smallest diameter.
inline constexpr NumberRange kNearGap{.least = 0.0, .most = 1.0};

/// Options of the table of static forces.
struct ForcesTableOptions {
  /// criterion of selection; if absent: kClosest if the state has forces, otherwise kCanonical
  std::optional<ForceSelection> selection;
  std::optional<double> friction;  ///< friction coefficient; if absent, the coefficient of the contact law
  /// Normal and tangential stiffness of all contacts (force/length). If absent, the stiffnesses of the contacts in the
  /// state are used.
  std::optional<double> kn, kt;
  /// Stress that the contact forces must balance (stress): the pressure, the components along the axes, or all
  /// components in Voigt order. If empty, the stress of the contact forces in the state.
  std::vector<double> stress;
  /// Pairs of grains may exert forces across a gap of at most this value, in units of the smallest diameter. If absent,
  /// forces act only at the contacts of the state.
  std::optional<double> gap;
  bool contacts = false;  ///< whether the table of the contacts and their forces is computed
  bool ranges = false;    ///< whether the smallest and largest normal force of each contact are computed
  /// Numbers (from 0) of the contacts for which `ranges` computes the smallest and largest force; empty: all contacts.
  std::vector<int> range_of;

  std::vector<std::string> validate() const;
};

/// Row of the table of static forces: one state.
struct ForcesRow {
  std::string file;
  int dimension = 0, n_grains = 0, n_contacts = 0, n_carrying = 0;
  ForceSelection selection = ForceSelection::kClosest;
  double friction = 0.0;
  /// largest net force on a grain, divided by the mean normal force; both are computed from the contact forces in the
  /// state. Absent if the state contains no forces
  std::optional<double> net_force_before;
  double net_force = 0.0, net_moment = 0.0, stress_error = 0.0;
  double mean_normal_force = 0.0;  ///< mean normal force over the contacts that carry a force (force)
  double mobilised = 0.0;          ///< fraction of the force-carrying contacts whose friction is at its limit
  /// relative distance of the computed forces from the forces in the state; absent if the state contains no forces
  std::optional<double> moved;
  /// relative distance of the computed forces from the forces of least elastic energy; absent if rounding errors ended
  /// the search for the latter
  std::optional<double> force_freedom;
  int n_factorizations = 0;
};

/// Computes contact forces that balance the load of a state at rest (see StaticForces), and returns the row of the
/// state.
/// @param contacts  receives the forces of the contacts, and the ranges of these forces, if the options select them
/// @throws InputError if an option is not valid, or if force_balance() refuses the packing
/// @throws NoResult if no set of forces balances the load
template <int Dim>
ForcesRow forces_row(const std::string& file, const State<Dim>& state, const ForcesTableOptions& options,
                     Table& contacts, const Remarks& remarks = {});

/// Returns the columns of the table of static forces.
std::vector<Column<ForcesRow>> forces_columns();

}  // namespace floc
