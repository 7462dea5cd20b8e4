#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/error_budget.h"
#include "floc/elasticity/mean_field.h"
#include "floc/elasticity/moduli.h"
#include "floc/elasticity/network_mechanics.h"
#include "floc/packing/law/named_stiffness.h"
#include "floc/tables/column.h"

namespace floc {

/// Returns the method that a keyword of `floc moduli --method` denotes.
/// @pre the keyword is valid
ModuliMethod moduli_method(const std::string& keyword);
/// Returns the set of strains that a keyword of `floc moduli --strains` denotes: "diagonal" or "full".
/// @pre the keyword is valid
StrainSet strain_set(const std::string& keyword);

/// One row of the table of `floc moduli`: properties of a state, and its moduli.
struct ModuliRow {
  std::string file;
  std::string units;
  int dimension;
  std::int64_t n_grains;
  std::int64_t n_contacts;
  std::int64_t n_distant;
  double z;
  double pressure;  ///< mean normal stress that the contacts carry (stress)
  double reduced_pressure;
  double driven_stress;  ///< stress that the contacts carry on the driven axis, see stress_on_driven_axis()
  double reduced_driven_stress;
  std::optional<double> wall_pressure;  ///< mean pressure on the walls (stress); absent if there are no walls
  double solid_fraction;
  Moduli moduli;
  /// Mechanics of the contact network. Absent unless the moduli were computed by --method factor.
  std::optional<NetworkMechanics> network;
  /// Contributions to the error of the bulk modulus. Absent unless the moduli were computed by --method factor.
  std::optional<ErrorBudget> budget;
  std::optional<int> n_near_mechanisms;
  /// Bulk modulus (stress) that includes the effect of the contact forces on the stiffness (prestress). Absent unless
  /// --prestress is given or the network has near-mechanisms.
  std::optional<double> B_prestress;
  std::optional<double> G_prestress;
  std::optional<double> rolling_stiffness;
  std::optional<double> kn_named,
      /// stiffnesses --kn and --kt that the user gave for the contacts of rigid grains (force/length)
      kt_named;
  std::optional<StiffnessPer> stiffness_per;  ///< whether these stiffnesses belong to points or to pairs
  MeanFieldEstimates mean_field;
  double seconds;            ///< processor time for computing the moduli (s)
  double seconds_row = 0.0;  ///< processor time for the whole row, including reading the state (s)
};

/// Options that determine the columns of the table of `floc moduli`.
struct ModuliColumnChoice {
  /// Whether the user gave rolling stiffnesses, which replace the rolling stiffnesses in the states.
  bool rolling_stiffness = false;
  bool prestress = false;
};

/// Returns the columns of the table of `floc moduli`. The order of the first columns never changes, because scripts may
/// rely on it.
/// @param rows  all rows of the table; a column exists for each entry of the largest stiffness matrix in them
std::vector<Column<ModuliRow>> moduli_columns(const ModuliColumnChoice& choice,
                                              const std::vector<ModuliRow>& rows);

}  // namespace floc
