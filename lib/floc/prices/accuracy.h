#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/prices/price_table.h"
#include "floc/relaxation/contact_dynamics_options.h"

namespace floc {

/// Mass of the periodic cell, and cap on its strain rate, during the assembly or one stage of the load path. Both are
/// divided by their default values for the scene (cell_defaults.h), with which the prices of all other settings were
/// measured.
struct CellFactors {
  double mass = 1.0, rate_cap = 1.0;
};

/// Requested accuracy: a list of keys of the table [accuracy] of a scene ("phi", "z", "moduli", "reuss", "forces",
/// "lambda", "alpha", "Phi_max"). Each key stands for one or several observables. The number beside the key is the
/// largest accepted relative error of these observables.
using WantedAccuracy = std::vector<std::pair<std::string, double>>;

/// Returns all keys with which a scene can request an accuracy.
std::vector<std::string> accuracy_keys();

/// Returns the observables for which a key of [accuracy] stands, by their names in tables of prices.
/// @param key  one of accuracy_keys()
const std::vector<std::string>& observables_of(const std::string& key);

/// Numerical settings from a table of prices, with the rows of the table for these settings, one row for each
/// observable.
struct PricedSettings {
  std::string parameter, value;
  NumericalSettings settings;
  double cost_ratio;    ///< processor time divided by the processor time of the strictest settings
  double core_seconds;  ///< processor time of a sample (s)
  std::map<std::string, const PriceRow*> of;  ///< rows of the table; the key is the name of the observable
  /// tolerance of the sweeps of rigid grains (ContactDynamicsOptions::sweep_tolerance), if it is known
  std::optional<double> sweep_tolerance = {};

  bool is_reference() const { return parameter == "strict"; }
  std::string name() const { return parameter + " " + value; }
  /// Whether the sweeps of rigid grains end earlier than by default. Sweeps that end early compact large packings by
  /// more than small ones: 1000 disks to 0.832 instead of 0.799 with a tolerance of 1e-2. Such settings are never
  /// chosen, because the small samples of a table of prices do not resolve this error.
  bool has_loose_sweeps() const {
    return sweep_tolerance && *sweep_tolerance > ContactDynamicsOptions{}.sweep_tolerance;
  }
};

/// Returns the numerical settings in a table of prices that a scene can contain, the cheapest first. Rows of parameters
/// that change the physics, the number of grains, the cell, or the analysis of the states are left out.
std::vector<PricedSettings> settable_prices(const PriceTable& table);

/// Returns the measured settings of the cell that cover the cells of a scene. A setting covers a factor in `cells` that
/// differs from 1 if the factor of the setting is on the same side of 1 and at least as far from 1. For each factor,
/// the covering setting with the nearest factor is returned. The errors of these settings are added to the errors of
/// the numerical settings.
std::vector<PricedSettings> cell_prices(const PriceTable& table, const std::vector<CellFactors>& cells);

/// Returns a bound of the relative error that settings cause in the mean of an observable over states. Let d be the
/// difference between this mean and the mean with the strictest settings, and h the half width of the 95 % confidence
/// interval of d. The bound is the larger of two numbers: the error that 95 % of the single states do not exceed, and
/// |d| - h (at least 0). Soft springs result in other packings; for settings with soft springs, the bound is sqrt(d^2 +
/// h^2). The result is NaN if nothing was measured.
double settings_error(const PricedSettings& settings, const std::string& observable);

/// Result of choose_accuracy(): the cheapest numerical settings whose errors do not exceed the requested errors or, if
/// there are no such settings, the reason.
struct AccuracyChoice {
  /// key of [accuracy] for which no settings achieve the requested error; empty if settings were chosen
  std::string refused_key;
  std::string failure_reason;  ///< reason why no settings were chosen; empty if settings were chosen
  std::string name;            ///< name and value of the parameter that was varied, e.g. "time_step 0.2"
  NumericalSettings settings;
  std::string reason;  ///< sentence with the cost and the measured errors of the chosen settings

  bool found() const { return failure_reason.empty(); }
};

/// Chooses, in a table of measured errors, the cheapest numerical settings that achieve the requested errors. Every
/// observable of a requested key must satisfy one of these conditions:
/// 1. If single states were compared: the error of the states is at most the requested error, and the difference of the
/// means over samples is at most the requested error plus the sampling error (half width of the 95 % confidence
/// interval).
/// 2. If only means were compared, because the quantity is fitted to a whole path: the difference of the means plus its
/// sampling error is at most the requested error.
///
/// Settings with soft springs are never chosen: soft springs result in other packings, but a key of [accuracy] limits
/// the errors of single states. Settings with loose sweeps are not chosen either (PricedSettings::has_loose_sweeps()).
///
/// If a requested error is below all measured errors, no settings are chosen: the reference run would be the only
/// candidate, and its own error is unknown. If the mass or the strain rate of the cell differs from its default, the
/// errors that were measured for such a cell are added to the errors of all settings.
/// @param wanted  requested errors, at least one; each key is from accuracy_keys(), each error is positive
/// @param cells  mass of the cell and cap on its strain rate in the assembly and in each stage of the load path
/// @param tolerance_limit  settings with a tolerance of this value or more are left out
/// @pre problem_of_factors(table, cell) is empty for each of `cells`
[[nodiscard]] AccuracyChoice choose_accuracy(const PriceTable& table, const WantedAccuracy& wanted,
                                             const std::vector<CellFactors>& cells = {},
                                             double tolerance_limit = std::numeric_limits<double>::infinity());

/// Returns a positive number as text with a few significant digits, rounded upwards: a message that asks for at least
/// this number would otherwise ask for less than what is accepted.
std::string rounded_up(double x, int digits = 2);

/// Whether the table of errors was measured on grains whose stiffness number differs from `kappa` by at most a factor
/// of ten. Otherwise the errors do not apply, because errors depend on the stiffness.
/// @param kappa  stiffness number a K_N/F0 of the scene (largest diameter a, normal stiffness K_N, pull-off force F0)
bool covers_stiffness(const PriceTable& table, double kappa);

/// Returns the reason why a table does not cover the mass and the cap of `cell`; empty if it covers them. A value is
/// covered if it is the default. It is also covered if the table contains errors measured with a value that differs
/// from the default in the same direction and by at least the same factor.
std::string problem_of_factors(const PriceTable& table, const CellFactors& cell);

}  // namespace floc
