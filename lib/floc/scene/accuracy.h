#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/scene/numerical_settings.h"

namespace floc {

/// Measured error of one observable (such as the solid fraction) with one numerical setting: one row of the table that
/// `floc tradeoff` writes. All errors are relative.
struct MeasuredAccuracy {
  /// name and value of the parameter that was varied, e.g. "time_step" and "0.2"
  std::string parameter, value;
  NumericalSettings settings;
  std::string observable;
  double cost_ratio;  ///< processor time over that of the run with the strictest settings
  double error;       ///< upper limit of the errors of 95 % of the states; NaN if no states were compared
  /// Difference of the observable from the run with the strictest settings, as a mean over samples and over the states
  /// after a collapse (a sudden rearrangement of grains); NaN if no means were compared.
  double mean_difference;
  double mean_error;  ///< half width of the 95 % confidence interval of mean_difference
  /// stiffness number a K_N/F0 of the scene with which the error was measured (largest diameter a, normal stiffness
  /// K_N, pull-off force F0)
  double kappa;
};

/// Mass of the periodic cell, and cap on its strain rate, during the assembly or one stage of the load path. Both are
/// divided by their default values for a cohesive scene (cell_defaults.h), with which the table of errors was measured.
struct CellFactors {
  double mass = 1.0, rate_cap = 1.0;
};

/// Reads a table of measured errors that `floc tradeoff` has written in CSV format. Rows about parameters that a scene
/// cannot give are left out.
/// @param csv  text of the table
/// @param place  name of the table, for messages
/// @throws InputError if a column is missing or a value is not a number
std::vector<MeasuredAccuracy> read_accuracy_table(const std::string& csv, const std::string& place);

/// Returns the table of measured errors that is shipped with the program, data/tables/tradeoff/tradeoff.csv.
const std::vector<MeasuredAccuracy>& shipped_accuracy_table();

/// Requested accuracy: for each key of the table [accuracy] of a scene ("phi", "z", "moduli", "reuss", "forces",
/// "lambda", "alpha", "Phi_max"), the largest accepted relative error of the observables for which the key stands.
using WantedAccuracy = std::vector<std::pair<std::string, double>>;

/// Returns all keys with which a scene can request an accuracy.
std::vector<std::string> accuracy_keys();

/// Result of choose_accuracy(): the cheapest numerical settings whose errors do not exceed the requested ones, or the
/// reason why there are none.
struct AccuracyChoice {
  /// key whose requested error no settings keep; empty if settings were chosen
  std::string refused_key;
  std::string failure_reason;  ///< reason why no settings were chosen; empty if some were
  std::string name;            ///< name and value of the parameter that was varied, e.g. "time_step 0.2"
  NumericalSettings settings;
  std::string reason;  ///< cost and measured errors of the chosen settings, in words

  bool found() const { return failure_reason.empty(); }
};

/// Chooses the cheapest numerical settings in a table of measured errors that keep the requested errors. Every
/// observable of a requested key must satisfy:
/// 1. If single states were compared, their error is at most the requested one, and the difference of the means over
/// samples does not exceed it by more than the sampling error (half width of the 95 % confidence interval).
/// 2. For a quantity fitted to a whole path, of which there are only means, the difference of the means plus its
/// sampling error is at most the requested error.
///
/// A requested error below all measured ones is refused, because the error of the reference run itself is unknown. If
/// the mass or the strain rate of the cell differs from its default, the errors that were measured for such a cell are
/// added to those of all settings.
/// @param wanted  requested errors, at least one; each key is from accuracy_keys(), each error is positive
/// @param cells  mass of the cell and cap on its strain rate in the assembly and in each stage of the load path
/// @pre covers_cell(table, cell) is true for each of `cells`
[[nodiscard]] AccuracyChoice choose_accuracy(const std::vector<MeasuredAccuracy>& table,
                                             const WantedAccuracy& wanted,
                                             const std::vector<CellFactors>& cells = {});

/// Whether the table of errors was measured on grains whose stiffness number differs from `kappa` by at most a factor
/// of ten. Errors scale with the stiffness.
/// @param kappa  stiffness number a K_N/F0 of the scene (largest diameter a, normal stiffness K_N, pull-off force F0)
bool covers_stiffness(const std::vector<MeasuredAccuracy>& table, double kappa);

/// Whether the table contains errors measured with a mass of the cell, and with a cap on its strain rate, that differ
/// from the defaults in the same direction as those of `cell`, and at least as much.
bool covers_cell(const std::vector<MeasuredAccuracy>& table, const CellFactors& cell);

}  // namespace floc
