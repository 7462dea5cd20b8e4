#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/scene/numerical_settings.h"

namespace floc {

/// One observable at one setting, as a row of the table of `floc tradeoff`. Errors are relative.
struct MeasuredAccuracy {
  std::string parameter, value;  ///< name of the setting
  NumericalSettings settings;
  std::string observable;
  double cost_ratio;       ///< relative to the strictest settings
  double error;            ///< error of single states: upper limit for 95 % of them; NaN if not compared
  double mean_difference;  ///< difference of means after a collapse; NaN if not compared
  double mean_error;       ///< half width of its 95 % interval
  double kappa;            ///< a K_N/F0 of the scene that was run
};

/// Response of the cell in one part of a run: its mass and the cap on its strain rate, relative to the defaults for a
/// cohesive scene (cell_defaults.h). The scene of the table uses these defaults.
struct CellFactors {
  double mass = 1.0, rate_cap = 1.0;
};

/// Reads a table that `floc tradeoff` writes as csv. Only settings that a scene can have are kept.
/// @throws InputError if a column is missing or a value is not a number
std::vector<MeasuredAccuracy> read_accuracy_table(const std::string& csv, const std::string& place);

/// Returns the table shipped with the program, data/tables/tradeoff/tradeoff.csv.
const std::vector<MeasuredAccuracy>& shipped_accuracy_table();

/// Requested accuracy: observables or groups of them ("phi", "z", "moduli", "reuss", "forces", "lambda", "alpha",
/// "Phi_max"), each with its largest relative error.
using WantedAccuracy = std::vector<std::pair<std::string, double>>;

/// Returns the keys that a requested accuracy may have.
std::vector<std::string> accuracy_keys();

/// The cheapest setting within the requested errors, or the reason why there is none.
struct AccuracyChoice {
  std::string refused_key;     ///< key that the reason is about; empty if a setting was chosen
  std::string failure_reason;  ///< reason why no setting was chosen; empty if one was
  std::string name;            ///< parameter and value of the setting
  NumericalSettings settings;
  std::string reason;  ///< cost and measured errors of the setting, in words

  bool found() const { return failure_reason.empty(); }
};

/// Chooses the cheapest setting of the table that meets the requested errors. For every requested observable, its
/// errors of single states must be at most the requested error, and its difference of means must not exceed that
/// error by more than the sampling error (the 95 % interval). Quantities fitted to a path have means alone: the sum
/// of their difference and its sampling error must be at most the requested error. An error below every measured one
/// cannot be requested, because the error of the reference itself is unknown. The errors measured for cells as heavy
/// and as fast as those of the scene are added to the errors of every setting.
/// @param wanted  not empty, known keys, errors > 0
/// @param cells  cell factors of the parts of the run
/// @pre covers_cell(table, cell) for each
[[nodiscard]] AccuracyChoice choose_accuracy(const std::vector<MeasuredAccuracy>& table,
                                             const WantedAccuracy& wanted,
                                             const std::vector<CellFactors>& cells = {});

/// Whether the table was measured on grains of similar stiffness, within a factor of ten, because errors scale with
/// the stiffness.
/// @param kappa  a K_N/F0 of the scene
bool covers_stiffness(const std::vector<MeasuredAccuracy>& table, double kappa);

/// Whether the table has measurements for a cell at least as far from the defaults.
bool covers_cell(const std::vector<MeasuredAccuracy>& table, const CellFactors& cell);

}  // namespace floc
