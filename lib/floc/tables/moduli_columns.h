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

/// A method by the keyword of `floc moduli --method`.
/// @pre there is one
ModuliMethod moduli_method(const std::string& keyword);

/// One row: what a state is and its moduli.
struct ModuliRow {
  std::string file;
  std::string units;
  int dimension;
  std::int64_t n_grains;
  std::int64_t n_contacts;
  std::int64_t n_distant;
  double z;
  double pressure;  ///< of the contacts
  double reduced_pressure;
  std::optional<double> wall_pressure;  ///< of boxes alone
  double solid_fraction;
  Moduli moduli;
  std::optional<NetworkMechanics> network;  ///< where moduli are solved for in full
  std::optional<ErrorBudget> budget;        ///< likewise
  std::optional<int> n_near_mechanisms;
  std::optional<double> B_prestress;  ///< where near-mechanisms make it count
  std::optional<double> G_prestress;
  std::optional<double> rolling_stiffness;
  MeanFieldEstimates mean_field;
  double seconds;            ///< of the moduli
  double seconds_row = 0.0;  ///< of the whole row, the reading of the state included
};

/// What rows were asked for, where that decides on their columns.
struct ModuliColumnChoice {
  bool rolling_stiffness = false;  ///< rows of several of them
  bool prestress = false;
};

/// The columns of a table of these rows: those of the contract first.
std::vector<Column<ModuliRow>> moduli_columns(const ModuliColumnChoice& choice,
                                              const std::vector<ModuliRow>& rows);

}  // namespace floc
