#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/scene/numerical_settings.h"

namespace floc {

/// One observable at one setting, as a table of `floc tradeoff` gives it. Errors are relative.
struct MeasuredAccuracy {
  std::string parameter, value;  ///< name of the setting
  NumericalSettings settings;
  std::string observable;
  double cost_ratio;       ///< relative to the strictest settings
  double error;            ///< of single states: upper limit for 95 % of them; not a number where not compared
  double mean_difference;  ///< of means over samples after a collapse; not a number where not compared
  double mean_error;       ///< half width of its 95 % interval
  double kappa;            ///< a K_N/F0 of the scene that was run
};

/// How a part of a run moves its cell: mass and cap on the strain rate in units of what a cohesive scene that
/// gives none takes (cell_defaults.h), as the scene of the table does.
struct CellFactors {
  double mass = 1.0, rate_cap = 1.0;
};

/// Reads such a table (csv, its own output). Only settings that a scene can have are kept.
/// @throws InputError if a column is missing or a value is not a number
std::vector<MeasuredAccuracy> read_accuracy_table(const std::string& csv, const std::string& place);

/// The table shipped with the program, data/tables/tradeoff/tradeoff.csv.
const std::vector<MeasuredAccuracy>& shipped_accuracy_table();

/// What a user asks for: an observable or a group of them ("phi", "z", "moduli", "reuss", "forces", "lambda",
/// "alpha", "Phi_max") and its relative error.
using WantedAccuracy = std::vector<std::pair<std::string, double>>;

/// What can be asked for.
std::vector<std::string> accuracy_keys();

/// The cheapest setting within the errors asked for, or why there is none.
struct AccuracyChoice {
  std::string refused_key;     ///< the first that no setting reaches; empty when there is a choice
  std::string failure_reason;  ///< what was expected of it
  std::string name;            ///< parameter and value of the setting
  NumericalSettings settings;
  std::string reason;  ///< its cost and measured errors, in words

  bool found() const { return failure_reason.empty(); }
};

/// Takes the cheapest setting of the table whose errors of single states, for every observable asked for, are
/// at most what is asked, and whose differences of means do not exceed it by more than their sampling error
/// explains (its 95 % interval). For quantities fitted to a path there are means alone: their difference and
/// that error together then have to be below what is asked. An error below every one measured is refused: the
/// reference's own error is not known, so it is no measure of itself.
/// To the errors of every setting come those measured for cells as heavy and as fast as the scene's.
/// @param wanted  not empty, known keys, errors > 0
/// @param cells  of the parts of the run
/// @pre covers_cell(table, cell) for each
[[nodiscard]] AccuracyChoice choose_accuracy(const std::vector<MeasuredAccuracy>& table,
                                             const WantedAccuracy& wanted,
                                             const std::vector<CellFactors>& cells = {});

/// Whether the table was measured on grains as stiff as these, to a factor of ten: errors scale with the
/// stiffness.
bool covers_stiffness(const std::vector<MeasuredAccuracy>& table, double kappa);

/// Whether cells at least as far from the defaults were measured.
bool covers_cell(const std::vector<MeasuredAccuracy>& table, const CellFactors& cell);

}  // namespace floc
