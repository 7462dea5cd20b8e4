#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "floc/prices/price_table.h"

namespace floc {

/// Mass of the periodic cell, and cap on its strain rate, during the assembly or one stage of the load path. Both are
/// divided by the default values for the scene (cell_defaults.h). Tables of prices are measured with these default
/// values.
struct CellFactors {
  double mass = 1.0, rate_cap = 1.0;
};

/// Requested accuracy: a list of keys of the table [accuracy] of a scene ("phi", "z", "moduli", "reuss", "forces",
/// "lambda", "alpha", "Phi_max"), each with the largest accepted relative error of the observables that the key stands
/// for.
using WantedAccuracy = std::vector<std::pair<std::string, double>>;

/// Returns all keys with which a scene can request an accuracy.
std::vector<std::string> accuracy_keys();

/// Returns the names of the observables that a key of [accuracy] stands for, as they are written in tables of prices.
/// @param key  one of accuracy_keys()
const std::vector<std::string>& observables_of(const std::string& key);

/// Numerical settings from a table of prices, with the rows of the table that describe them, one row for each
/// observable.
struct PricedSettings {
  std::string parameter, value;
  NumericalSettings settings;
  double cost_ratio;                          ///< ratio of the processor time to that of the strictest settings
  double core_seconds;                        ///< processor time of a sample (s)
  std::map<std::string, const PriceRow*> of;  ///< rows of the table; the key is the name of the observable

  bool is_reference() const { return parameter == "strict"; }
  std::string name() const { return parameter + " " + value; }
};

/// Returns the numerical settings in a table of prices that can be written into a scene, the cheapest first. Rows about
/// other parameters are left out, because these parameters change the physics, the number of grains, the cell, or the
/// analysis of the states.
std::vector<PricedSettings> settable_prices(const PriceTable& table);

/// Returns the rows of a table of prices that cover the cells of a scene. For each factor of the mass and of the cap on
/// the strain rate that differs from 1, this is the row with the nearest factor that is at least as far from 1. The
/// errors in these rows are added to the errors of the numerical settings.
std::vector<PricedSettings> cell_prices(const PriceTable& table, const std::vector<CellFactors>& cells);

/// Returns the bound of the relative error of a mean over states that the choice of settings causes: the error of 95 %
/// of single states, or the difference of the means from the strictest settings as far as it exceeds the half width of
/// its 95 % interval, whichever is larger. With soft springs, which lead to other packings, it is the root of the sum of
/// the squares of the difference and of the half width of its interval. NaN if neither was measured.
double settings_error(const PricedSettings& settings, const std::string& observable);

/// Result of choose_accuracy(): the cheapest numerical settings whose errors do not exceed the requested errors, or the
/// reason why there are no such settings.
struct AccuracyChoice {
  /// key of [accuracy] whose requested error no settings achieve; empty if settings were chosen
  std::string refused_key;
  std::string failure_reason;  ///< reason why no settings were chosen; empty if settings were chosen
  std::string name;            ///< name and value of the parameter that was varied, e.g. "time_step 0.2"
  NumericalSettings settings;
  std::string reason;  ///< sentence with the cost and the measured errors of the chosen settings

  bool found() const { return failure_reason.empty(); }
};

/// Chooses the cheapest numerical settings in a table of measured errors that keep the requested errors. Every
/// observable of a requested key must satisfy one of these conditions:
/// 1. If single states were compared: their error is at most the requested error, and the difference of the means over
/// samples exceeds the requested error by at most the sampling error (half width of the 95 % confidence interval).
/// 2. If only means were compared, because the quantity is fitted to a whole path: the difference of the means plus its
/// sampling error is at most the requested error.
///
/// Settings with soft springs are never chosen: they lead to other packings, and [accuracy] speaks of single states.
///
/// A requested error below all measured errors is refused, because the error of the reference run itself is unknown. If
/// the mass or the strain rate of the cell differs from its default, the errors that were measured for such a cell are
/// added to the errors of all settings.
/// @param wanted  requested errors, at least one; each key is from accuracy_keys(), each error is positive
/// @param cells  mass of the cell and cap on its strain rate in the assembly and in each stage of the load path
/// @pre covers_cell(table, cell) is true for each of `cells`
[[nodiscard]] AccuracyChoice choose_accuracy(const PriceTable& table, const WantedAccuracy& wanted,
                                             const std::vector<CellFactors>& cells = {});

/// Whether the table of errors was measured on grains whose stiffness number differs from `kappa` by at most a factor
/// of ten. Beyond this factor the errors do not apply, because they scale with the stiffness.
/// @param kappa  stiffness number a K_N/F0 of the scene (largest diameter a, normal stiffness K_N, pull-off force F0)
bool covers_stiffness(const PriceTable& table, double kappa);

/// Whether the table contains errors measured with a mass of the cell, and with a cap on its strain rate, that differ
/// from the defaults in the same direction as the values of `cell`, and by at least the same factor.
bool covers_cell(const PriceTable& table, const CellFactors& cell);

}  // namespace floc
