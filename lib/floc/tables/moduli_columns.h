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

/// Returns the method that a keyword of `floc moduli --method` names.
/// @pre the keyword is valid
ModuliMethod moduli_method(const std::string& keyword);
/// Returns the strains that a keyword of `floc moduli --strains` names: "diagonal" or "full".
/// @pre the keyword is valid
StrainSet strain_set(const std::string& keyword);

/// One row: properties of a state and its moduli.
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
  std::optional<double> wall_pressure;  ///< mean pressure on the walls (stress); only in boxes
  double solid_fraction;
  Moduli moduli;
  std::optional<NetworkMechanics> network;  ///< present if the moduli were solved for in full
  std::optional<ErrorBudget> budget;        ///< present if the moduli were solved for in full
  std::optional<int> n_near_mechanisms;
  std::optional<double>
      B_prestress;  ///< bulk modulus with prestress (stress); only if there are near-mechanisms
  std::optional<double> G_prestress;
  std::optional<double> rolling_stiffness;
  MeanFieldEstimates mean_field;
  double seconds;            ///< processor time of the moduli (s)
  double seconds_row = 0.0;  ///< processor time of the whole row, including the reading of the state (s)
};

/// Options of the rows on which their columns depend.
struct ModuliColumnChoice {
  bool rolling_stiffness = false;  ///< the rows have rolling stiffnesses given in place of those of the states
  bool prestress = false;
};

/// Returns the columns of a table of these rows. The first ones keep their order, on which scripts may rely.
std::vector<Column<ModuliRow>> moduli_columns(const ModuliColumnChoice& choice,
                                              const std::vector<ModuliRow>& rows);

}  // namespace floc
