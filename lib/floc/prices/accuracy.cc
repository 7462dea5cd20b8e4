#include "floc/prices/accuracy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace floc {
namespace {

/// Errors depend on the stiffness. Therefore errors that were measured on one scene are used for another scene only if
/// the stiffness numbers of the two scenes differ by at most this factor.
constexpr double kStiffnessRange = 10.0;

/// Keys of the table [accuracy] of a scene. Each key stands for one or several observables. The observables have their
/// names in the column "observable" of a table of prices.
const std::vector<std::pair<std::string, std::vector<std::string>>> kKeys = {
    {"phi", {"phi"}},
    {"z", {"z_plus", "z_minus"}},
    {"moduli", {"B", "G"}},
    {"reuss", {"B_reuss"}},
    {"forces", {"tail_plus", "tail_minus"}},
    {"lambda", {"lambda"}},
    {"alpha", {"alpha"}},
    {"Phi_max", {"Phi_max"}}};

/// Names of two parameters in a table of prices: the mass of the cell and the cap on its strain rate. The table gives
/// their values as multiples of the default values, for example "10 times".
constexpr const char* kMassOfCell = "cell_mass";
constexpr const char* kCapOfCell = "strain_rate_cap";

bool is_of_cell(const std::string& parameter) {
  return parameter == kMassOfCell || parameter == kCapOfCell;
}

/// Whether a scene can set a parameter of a table of prices to change the accuracy. Some of these parameters apply to
/// elastic grains, others to rigid grains.
bool is_settable(const std::string& parameter) {
  static const std::vector<std::string> kSettable = {
      "strict",   "scene",           "finish",        "tolerance", "time_step",          "patience",
      "together", "sweep_tolerance", "gap_tolerance", "softening", "assembly_softening", "masses"};
  return std::find(kSettable.begin(), kSettable.end(), parameter) != kSettable.end();
}

/// Returns the tolerance of the sweeps of rigid grains that a row of a table gives. The result is absent for elastic
/// grains, and for rows with the tolerance of the scene of the table.
std::optional<double> sweep_tolerance_of(const PriceTable& table, const PriceRow& row) {
  if (row.parameter == "sweep_tolerance") return leading_number(row.value);
  if (row.parameter == "together" && table.is_of_rigid_grains())
    for (const RigidSettingsTogether& together : kRigidTogether)
      if (row.value == together.value) return together.sweep_tolerance;
  return std::nullopt;
}

/// Returns the settings in a table of prices, the cheapest first.
/// @param is_wanted  function that returns whether settings of a parameter are included; the argument is the name of
/// the parameter
std::vector<PricedSettings> candidates_of(const PriceTable& table, bool (*is_wanted)(const std::string&)) {
  std::vector<PricedSettings> candidates;
  for (const PriceRow& row : table.rows) {
    if (!is_wanted(row.parameter)) continue;
    auto at = std::find_if(candidates.begin(), candidates.end(), [&](const PricedSettings& c) {
      return c.parameter == row.parameter && c.value == row.value;
    });
    if (at == candidates.end())
      at = candidates.insert(candidates.end(), {row.parameter,
                                                row.value,
                                                row.settings,
                                                row.cost_ratio,
                                                row.core_seconds,
                                                {},
                                                sweep_tolerance_of(table, row)});
    at->of[row.observable] = &row;
  }
  std::stable_sort(candidates.begin(), candidates.end(), [](const PricedSettings& x, const PricedSettings& y) {
    return x.cost_ratio < y.cost_ratio;
  });
  return candidates;
}

/// Returns an upper bound of the relative error of an observable under given settings; infinite if the error was not
/// measured.
double guaranteed_error(const PricedSettings& candidate, const std::string& observable) {
  const auto found = candidate.of.find(observable);
  if (found == candidate.of.end()) return std::numeric_limits<double>::infinity();
  const PriceRow& row = *found->second;
  const double difference = std::abs(row.mean_difference), scatter = row.mean_error;
  if (std::isfinite(row.error)) return std::max(row.error, std::isfinite(scatter) ? difference - scatter : 0.0);
  return std::isfinite(scatter) ? difference + scatter : std::numeric_limits<double>::infinity();
}

/// Returns the factor of a setting of the cell, that is, its value divided by the default value: for example 10 for the
/// text "10 times"; NaN if the text contains no number.
double factor_of(const PricedSettings& of_cell) {
  return leading_number(of_cell.value);
}

/// Two factors of the mass of the cell, or of the cap on its strain rate, count as equal if their relative difference
/// is below this value. The factors of a scene are quotients and have rounding errors.
constexpr double kRoundingOfFactors = 1e-9;

bool is_default(double factor) {
  return std::abs(factor - 1.0) <= kRoundingOfFactors;
}

/// Returns the measured setting of the cell that covers a factor of a scene. A measured factor covers the factor of the
/// scene if both are above 1 or both below 1, and the measured factor is at least as far from 1. Of several settings
/// that cover the factor, the setting whose factor is closest to 1 is returned; null if no setting covers it.
/// @param of_cell  measured settings of the mass of the cell and of the cap on its strain rate
/// @param parameter  quantity that the factor multiplies: "cell_mass" or "strain_rate_cap"
/// @param factor  value in the scene, divided by the default value
const PricedSettings* nearest_beyond(const std::vector<PricedSettings>& of_cell, const std::string& parameter,
                                     double factor) {
  const auto distance = [&](double f) { return factor > 1.0 ? std::log(f) : -std::log(f); };
  const PricedSettings* nearest = nullptr;
  for (const PricedSettings& c : of_cell) {
    if (c.parameter != parameter || !(distance(factor_of(c)) >= distance(factor) - kRoundingOfFactors))
      continue;
    if (!nearest || distance(factor_of(c)) < distance(factor_of(*nearest))) nearest = &c;
  }
  return nearest;
}

/// Returns the observables of a key of [accuracy] that a table of prices contains.
std::vector<std::string> priced_observables(const PriceTable& table, const std::string& key) {
  std::vector<std::string> found;
  for (const std::string& observable : observables_of(key))
    if (std::any_of(table.rows.begin(), table.rows.end(),
                    [&](const PriceRow& row) { return row.observable == observable; }))
      found.push_back(observable);
  return found;
}

/// Chooses settings from a table of prices, for the requested errors and the cell of one scene.
class AccuracyChooser {
 public:
  AccuracyChooser(const PriceTable& table, const WantedAccuracy& wanted, const std::vector<CellFactors>& cells,
                  double tolerance_limit)
      : table_(table), candidates_(settable_prices(table)), additions_(cell_prices(table, cells)) {
    std::erase_if(candidates_, [&](const PricedSettings& c) {
      return c.settings.changes_path() || c.has_loose_sweeps() ||
             (!c.is_reference() && c.settings.tolerance >= tolerance_limit);
    });
    for (const auto& [key, asked] : wanted) wanted_.push_back({key, asked, priced_observables(table, key)});
  }

  AccuracyChoice choose() const {
    AccuracyChoice choice;
    for (const Wish& wish : wanted_) {
      choice.failure_reason = reason_against(wish);
      choice.refused_key = wish.key;
      if (!choice.failure_reason.empty()) return choice;
    }
    for (const PricedSettings& c : candidates_)
      if (std::all_of(wanted_.begin(), wanted_.end(),
                      [&](const Wish& w) { return guaranteed_error_of(c, w) <= w.error; }))
        return {"", "", c.name(), c.settings, reason_of(c)};
    choice.refused_key = wanted_.front().key;
    choice.failure_reason = fmt::format(
        "no settings in the {} achieve all requested errors at once; request larger errors", errors_table());
    return choice;
  }

 private:
  struct Wish {
    std::string key;
    double error;
    std::vector<std::string> observables;
  };

  std::string errors_table() const {
    return table_.is_shipped ? "table of measured errors shipped with floc" : table_.name();
  }

  /// Returns the relative error that the settings guarantee for all observables of a request, including the errors that
  /// the mass and the strain rate of the cell cause. The error is infinite if the table has none of the observables.
  double guaranteed_error_of(const PricedSettings& candidate, const Wish& wish) const {
    if (wish.observables.empty()) return std::numeric_limits<double>::infinity();
    double least = 0.0;
    for (const std::string& observable : wish.observables) {
      double sum = guaranteed_error(candidate, observable);
      for (const PricedSettings& addition : additions_) sum += guaranteed_error(addition, observable);
      least = std::max(least, sum);
    }
    return least;
  }

  /// Returns the reason why no settings achieve a requested error; empty if some settings achieve this error.
  std::string reason_against(const Wish& wish) const {
    double floor = std::numeric_limits<double>::infinity();
    for (const PricedSettings& c : candidates_)
      if (!c.is_reference()) floor = std::min(floor, guaranteed_error_of(c, wish));
    if (!std::isfinite(floor))
      return fmt::format("the {} has no error of this quantity; leave out the key", errors_table());
    if (wish.error >= floor) return "";
    return fmt::format("expected at least {}, which is the smallest error in the {} for this quantity{}",
                       rounded_up(floor), table_.name(),
                       additions_.empty() ? "" : " for the mass and the strain rate of the cell in the scene");
  }

  std::string errors_of(const PricedSettings& setting) const {
    std::vector<std::string> errors;
    for (const Wish& wish : wanted_)
      for (const std::string& observable : wish.observables) {
        const PriceRow& row = *setting.of.at(observable);
        std::string text = observable;
        if (std::isfinite(row.error)) text += fmt::format(" {:.1e} in 95 % of the states", row.error);
        if (std::isfinite(row.mean_error))
          text += fmt::format("{} {:+.1e} +- {:.1e} in the means over samples of the states after a collapse",
                              std::isfinite(row.error) ? "," : "", row.mean_difference, row.mean_error);
        errors.push_back(text);
      }
    return fmt::format("{}", fmt::join(errors, "; "));
  }

  std::string reason_of(const PricedSettings& chosen) const {
    const NumericalSettings& s = chosen.settings;
    std::string reason = fmt::format(
        "finish {}, time step {}, tolerance {:g}, patience {}: this takes {:.2f} of the processor time of the "
        "strictest settings. Measured errors: {}",
        finish_name(s.finish), s.time_step, s.tolerance, s.patience, chosen.cost_ratio, errors_of(chosen));
    for (const PricedSettings& addition : additions_)
      reason += fmt::format(". The total also includes the errors measured with {} at {} its default value: {}",
                            addition.parameter, addition.value, errors_of(addition));
    return reason;
  }

  const PriceTable& table_;
  std::vector<PricedSettings> candidates_, additions_;
  std::vector<Wish> wanted_;
};

}  // namespace

std::vector<std::string> accuracy_keys() {
  std::vector<std::string> keys;
  for (const auto& [key, observables] : kKeys) keys.push_back(key);
  return keys;
}

const std::vector<std::string>& observables_of(const std::string& key) {
  return std::find_if(kKeys.begin(), kKeys.end(), [&](const auto& k) { return k.first == key; })->second;
}

std::vector<PricedSettings> settable_prices(const PriceTable& table) {
  return candidates_of(table, is_settable);
}

std::vector<PricedSettings> cell_prices(const PriceTable& table, const std::vector<CellFactors>& cells) {
  const std::vector<PricedSettings> of_cell = candidates_of(table, is_of_cell);
  std::vector<PricedSettings> found;
  const auto add = [&](const char* parameter, double factor) {
    if (is_default(factor)) return;
    const PricedSettings* nearest = nearest_beyond(of_cell, parameter, factor);
    if (nearest && std::none_of(found.begin(), found.end(),
                                [&](const PricedSettings& p) { return p.name() == nearest->name(); }))
      found.push_back(*nearest);
  };
  for (const CellFactors& cell : cells) {
    add(kMassOfCell, cell.mass);
    add(kCapOfCell, cell.rate_cap);
  }
  return found;
}

double settings_error(const PricedSettings& settings, const std::string& observable) {
  const auto found = settings.of.find(observable);
  if (found == settings.of.end()) return std::numeric_limits<double>::quiet_NaN();
  const PriceRow& row = *found->second;
  // Soft springs and equal masses change the mean, perhaps by more than the measured difference. Therefore the half
  // width of the confidence interval is added to the difference in quadrature. For other settings, it is subtracted.
  if (settings.settings.changes_path()) return std::hypot(row.mean_difference, row.mean_error);
  const double detected = std::isfinite(row.mean_error)
                              ? std::max(0.0, std::abs(row.mean_difference) - row.mean_error)
                              : std::numeric_limits<double>::quiet_NaN();
  return std::fmax(row.error, detected);
}

AccuracyChoice choose_accuracy(const PriceTable& table, const WantedAccuracy& wanted,
                               const std::vector<CellFactors>& cells, double tolerance_limit) {
  return AccuracyChooser(table, wanted, cells, tolerance_limit).choose();
}

std::string rounded_up(double x, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) + 1.0 - digits);
  return fmt::format("{:.{}g}", unit * std::ceil(x / unit * (1.0 - 1e-12)), digits);
}

bool covers_stiffness(const PriceTable& table, double kappa) {
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const PriceRow& row) {
    return row.kappa <= kStiffnessRange * kappa && kappa <= kStiffnessRange * row.kappa;
  });
}

std::string problem_of_factors(const PriceTable& table, const CellFactors& cell) {
  const std::vector<PricedSettings> of_cell = candidates_of(table, is_of_cell);
  for (const auto& [parameter, factor] : {std::pair(kMassOfCell, cell.mass), {kCapOfCell, cell.rate_cap}}) {
    if (is_default(factor) || nearest_beyond(of_cell, parameter, factor)) continue;
    double least = 1.0, most = 1.0;
    for (const PricedSettings& measured : of_cell)
      if (measured.parameter == parameter) {
        least = std::min(least, factor_of(measured));
        most = std::max(most, factor_of(measured));
      }
    return fmt::format(
        "{} is {:.3g} times its default value on load paths, but the {} covers {:g} to {:g} times", parameter,
        factor, table.name(), least, most);
  }
  return "";
}

}  // namespace floc
