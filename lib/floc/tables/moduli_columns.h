#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/error_budget.h"
#include "floc/elasticity/mean_field.h"
#include "floc/elasticity/moduli.h"
#include "floc/elasticity/network_mechanics.h"
#include "floc/tables/column.h"

namespace floc {

/// Returns the method with the given keyword of `floc moduli --method`.
/// @pre the keyword is valid
ModuliMethod moduli_method(const std::string& keyword);
/// Returns the set of strains with the given keyword of `floc moduli --strains`: "diagonal" or "full".
/// @pre the keyword is valid
StrainSet strain_set(const std::string& keyword);

/// One row of `floc moduli`: properties of a state and its moduli.
struct ModuliRow {
  std::string file;
  std::string units;
  int dimension;
  std::int64_t n_grains;
  std::int64_t n_contacts;
  std::int64_t n_distant;
  double z;
  double pressure;  ///< mean normal stress of the contacts (stress)
  double reduced_pressure;
  std::optional<double> wall_pressure;  ///< mean pressure on the walls (stress); absent without walls
  double solid_fraction;
  Moduli moduli;
  std::optional<NetworkMechanics> network;  ///< present if the method "factor" computed the moduli
  std::optional<ErrorBudget> budget;        ///< present if the method "factor" computed the moduli
  std::optional<int> n_near_mechanisms;
  /// Bulk modulus with prestress (stress); only with --prestress or if there are near-mechanisms.
  std::optional<double> B_prestress;
  std::optional<double> G_prestress;
  std::optional<double> rolling_stiffness;
  MeanFieldEstimates mean_field;
  double seconds;            ///< processor time for the moduli (s)
  double seconds_row = 0.0;  ///< processor time for the whole row, including reading the state (s)
};

/// Options on which the columns of the table of `floc moduli` depend.
struct ModuliColumnChoice {
  bool rolling_stiffness = false;  ///< rolling stiffnesses were given in place of those of the states
  bool prestress = false;
};

/// Returns the columns of the table of `floc moduli` for these rows. The order of the first columns never
/// changes, because scripts may rely on it.
std::vector<Column<ModuliRow>> moduli_columns(const ModuliColumnChoice& choice,
                                              const std::vector<ModuliRow>& rows);

}  // namespace floc
