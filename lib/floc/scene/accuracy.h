#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/scene/numerical_settings.h"

namespace floc {

/// Measured error of one observable at one numerical setting, as given by a row of the table of `floc tradeoff`. All
/// errors are relative.
struct MeasuredAccuracy {
  std::string parameter, value;  ///< name and value of the varied setting, for example "time_step" and "0.2"
  NumericalSettings settings;
  std::string observable;
  double cost_ratio;  ///< processor time, relative to the time of the run with the strictest settings
  double error;       ///< upper limit of the errors of 95 % of the states; NaN if states were not compared
  /// difference of the mean over samples after a collapse from the mean with the strictest settings; NaN if not
  /// compared
  double mean_difference;
  double mean_error;  ///< half width of the 95 % confidence interval of mean_difference
  /// stiffness number a K_N/F0 of the scene that was run (diameter a, stiffness K_N, adhesion F0)
  double kappa;
};

/// Mass of the cell and cap on its strain rate in one part of a run, both divided by their default values for a
/// cohesive scene (cell_defaults.h). The table of measured errors belongs to a scene with the default values.
struct CellFactors {
  double mass = 1.0, rate_cap = 1.0;
};

/// Reads a table of measured errors that `floc tradeoff` writes in CSV format. Only rows about settings that a scene
/// can have are kept.
/// @param place  name of the table, for messages
/// @throws InputError if a column is missing or a value is not a number
std::vector<MeasuredAccuracy> read_accuracy_table(const std::string& csv, const std::string& place);

/// Returns the table of measured errors that is shipped with the program, data/tables/tradeoff/tradeoff.csv.
const std::vector<MeasuredAccuracy>& shipped_accuracy_table();

/// Requested accuracy: keys of observables or groups of observables ("phi", "z", "moduli", "reuss", "forces", "lambda",
/// "alpha", "Phi_max"), each with the largest accepted relative error.
using WantedAccuracy = std::vector<std::pair<std::string, double>>;

/// Returns the keys of all observables whose accuracy can be requested.
std::vector<std::string> accuracy_keys();

/// Result of choose_accuracy(): the cheapest setting whose errors do not exceed the requested ones, or the reason why
/// there is no such setting.
struct AccuracyChoice {
  /// key of the observable for which no setting was found; empty if a setting was chosen
  std::string refused_key;
  std::string failure_reason;  ///< reason why no setting was chosen; empty if one was
  std::string name;            ///< parameter and value of the setting
  NumericalSettings settings;
  std::string reason;  ///< cost and measured errors of the setting, in words

  bool found() const { return failure_reason.empty(); }
};

/// Chooses the cheapest setting of the table that meets the requested errors. For every requested observable, the
/// errors of single states must be at most the requested error, and the difference of the means over samples must not
/// exceed the requested error by more than its sampling error (the 95 % interval). For quantities fitted to a path
/// there are only means: the sum of their difference and its sampling error must be at most the requested error. An
/// error below every measured error cannot be requested, because the error of the reference run itself is unknown. If
/// the cell of the scene is heavier, lighter, faster or slower than by default, the errors measured for such a cell are
/// added to the errors of every setting.
/// @param wanted  requested errors, at least one; keys must be from accuracy_keys() and errors positive
/// @param cells  mass and cap of the cell in each part of the run
/// @pre covers_cell(table, cell) holds for each cell
[[nodiscard]] AccuracyChoice choose_accuracy(const std::vector<MeasuredAccuracy>& table,
                                             const WantedAccuracy& wanted,
                                             const std::vector<CellFactors>& cells = {});

/// Whether the table was measured on grains whose stiffness number differs from `kappa` by at most a factor of ten.
/// Errors scale with the stiffness.
/// @param kappa  stiffness number a K_N/F0 of the scene
bool covers_stiffness(const std::vector<MeasuredAccuracy>& table, double kappa);

/// Whether the table has errors measured for a cell whose mass and cap on the strain rate differ from the defaults at
/// least as much as those of `cell`.
bool covers_cell(const std::vector<MeasuredAccuracy>& table, const CellFactors& cell);

}  // namespace floc
