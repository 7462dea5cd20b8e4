#include "floc/scene/accuracy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "accuracy_table.h"
#include "floc/base/error.h"
#include "floc/base/parse_number.h"

namespace floc {
namespace {

/// Factor between the kappa of a scene and that of the table up to which the table applies.
constexpr double kStiffnessRange = 10.0;

/// Observables that each key stands for.
const std::vector<std::pair<std::string, std::vector<std::string>>> kKeys = {
    {"phi", {"phi"}},
    {"z", {"z_plus", "z_minus"}},
    {"moduli", {"B", "G"}},
    {"reuss", {"B_reuss"}},
    {"forces", {"tail_plus", "tail_minus"}},
    {"lambda", {"lambda"}},
    {"alpha", {"alpha"}},
    {"Phi_max", {"Phi_max"}}};

const std::vector<std::string>& observables_of(const std::string& key) {
  return std::find_if(kKeys.begin(), kKeys.end(), [&](const auto& k) { return k.first == key; })->second;
}

/// A setting of the table and its rows, by observable.
struct Candidate {
  std::string parameter, value;
  NumericalSettings settings;
  double cost_ratio;
  std::map<std::string, const MeasuredAccuracy*> of;

  bool is_reference() const { return parameter == "strict"; }
};

/// Parameters of the motion of the cell, whose values are factors: "10 times".
constexpr const char* kMassOfCell = "cell_mass";
constexpr const char* kCapOfCell = "strain_rate_cap";

bool is_of_cell(const std::string& parameter) {
  return parameter == kMassOfCell || parameter == kCapOfCell;
}

/// Returns the settings in the order of their cost: either those that a scene can have, or those of its cell.
std::vector<Candidate> candidates_of(const std::vector<MeasuredAccuracy>& table, bool of_cell = false) {
  std::vector<Candidate> candidates;
  for (const MeasuredAccuracy& row : table) {
    if (is_of_cell(row.parameter) != of_cell) continue;
    auto at = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& c) {
      return c.parameter == row.parameter && c.value == row.value;
    });
    if (at == candidates.end())
      at = candidates.insert(candidates.end(), {row.parameter, row.value, row.settings, row.cost_ratio, {}});
    at->of[row.observable] = &row;
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& x, const Candidate& y) { return x.cost_ratio < y.cost_ratio; });
  return candidates;
}

/// Returns the smallest error that a setting guarantees for an observable; infinite if it was not measured.
double guaranteed_error(const Candidate& candidate, const std::string& observable) {
  const auto found = candidate.of.find(observable);
  if (found == candidate.of.end()) return std::numeric_limits<double>::infinity();
  const MeasuredAccuracy& row = *found->second;
  const double difference = std::abs(row.mean_difference), scatter = row.mean_error;
  if (std::isfinite(row.error)) return std::max(row.error, std::isfinite(scatter) ? difference - scatter : 0.0);
  return std::isfinite(scatter) ? difference + scatter : std::numeric_limits<double>::infinity();
}

/// Returns the factor of a setting of the cell.
double factor_of(const Candidate& of_cell) {
  return parse_number<double>(of_cell.value.substr(0, of_cell.value.find(' ')))
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Relative error below which two factors of the cell count as equal: a factor computed as a ratio is rounded.
constexpr double kRoundingOfFactors = 1e-9;

bool is_default(double factor) {
  return std::abs(factor - 1.0) <= kRoundingOfFactors;
}

/// Returns the measured factor of a parameter that is closest to `factor` among those at least as far from 1 on the
/// same side; null if there is none.
const Candidate* nearest_beyond(const std::vector<Candidate>& of_cell, const std::string& parameter,
                                double factor) {
  const auto distance = [&](double f) { return factor > 1.0 ? std::log(f) : -std::log(f); };
  const Candidate* nearest = nullptr;
  for (const Candidate& c : of_cell) {
    if (c.parameter != parameter || !(distance(factor_of(c)) >= distance(factor) - kRoundingOfFactors))
      continue;
    if (!nearest || distance(factor_of(c)) < distance(factor_of(*nearest))) nearest = &c;
  }
  return nearest;
}

/// Settings of the cell whose errors are added to those of every other setting.
using Additions = std::vector<const Candidate*>;

Additions additions_of(const std::vector<Candidate>& of_cell, const std::vector<CellFactors>& cells) {
  Additions additions;
  const auto add = [&](const char* parameter, double factor) {
    if (is_default(factor)) return;
    const Candidate* nearest = nearest_beyond(of_cell, parameter, factor);
    if (nearest && std::find(additions.begin(), additions.end(), nearest) == additions.end())
      additions.push_back(nearest);
  };
  for (const CellFactors& cell : cells) {
    add(kMassOfCell, cell.mass);
    add(kCapOfCell, cell.rate_cap);
  }
  return additions;
}

/// Returns the largest of the errors that a setting guarantees for the observables of a key, with the errors of the
/// cell added.
double guaranteed_error_of_key(const Candidate& candidate, const Additions& additions, const std::string& key) {
  double least = 0.0;
  for (const std::string& observable : observables_of(key)) {
    double sum = guaranteed_error(candidate, observable);
    for (const Candidate* addition : additions) sum += guaranteed_error(*addition, observable);
    least = std::max(least, sum);
  }
  return least;
}

std::string errors_of(const Candidate& setting, const WantedAccuracy& wanted) {
  std::vector<std::string> errors;
  for (const auto& [key, asked] : wanted)
    for (const std::string& observable : observables_of(key)) {
      const MeasuredAccuracy& row = *setting.of.at(observable);
      std::string text = observable;
      if (std::isfinite(row.error)) text += fmt::format(" {:.1e} in 95 % of states", row.error);
      if (std::isfinite(row.mean_error))
        text += fmt::format("{} {:+.1e} +- {:.1e} in means over samples after a collapse",
                            std::isfinite(row.error) ? "," : "", row.mean_difference, row.mean_error);
      errors.push_back(text);
    }
  return fmt::format("{}", fmt::join(errors, "; "));
}

std::string reason_of(const Candidate& chosen, const Additions& additions, const WantedAccuracy& wanted) {
  const NumericalSettings& s = chosen.settings;
  std::string reason = fmt::format(
      "finish {}, time step {}, tolerance {:g}, patience {}: {:.2f} of the cost of the strictest settings. "
      "Measured errors: {}",
      finish_name(s.finish), s.time_step, s.tolerance, s.patience, chosen.cost_ratio,
      errors_of(chosen, wanted));
  for (const Candidate* addition : additions)
    reason += fmt::format(". To these come the errors of {} {} the default: {}", addition->parameter,
                          addition->value, errors_of(*addition, wanted));
  return reason;
}

std::vector<std::string> split_cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

/// One line of the table; its values are found by the names of the columns.
class Row {
 public:
  Row(const std::map<std::string, std::size_t>& columns, std::vector<std::string> cells, std::string place)
      : columns_(columns), cells_(std::move(cells)), place_(std::move(place)) {}

  const std::string& text(const std::string& column) const {
    const auto at = columns_.find(column);
    if (at == columns_.end() || at->second >= cells_.size())
      throw InputError(place_, "column " + column + " is missing: expected a table of floc tradeoff");
    return cells_[at->second];
  }
  /// Returns a number; NaN if the table has none.
  double number(const std::string& column) const {
    const std::string& cell = text(column);
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto value = parse_number<double>(cell);
    if (!value) throw InputError(place_, fmt::format("{} = {}: expected a number", column, cell));
    return *value;
  }

 private:
  const std::map<std::string, std::size_t>& columns_;
  std::vector<std::string> cells_;
  std::string place_;
};

MeasuredAccuracy accuracy_of(const Row& row) {
  const std::string& finish = row.text("finish");
  const NumericalSettings settings{row.number("tolerance"), row.number("time_step"),
                                   finish == finish_name(Finish::dynamic)   ? Finish::dynamic
                                   : finish == finish_name(Finish::statics) ? Finish::statics
                                                                            : Finish::automatic,
                                   row.number("patience")};
  const double before = row.number("error_before_high"), after = row.number("error_after_high");
  return {row.text("knob"),
          row.text("value"),
          settings,
          row.text("observable"),
          row.number("cost_ratio"),
          std::fmax(before, after),
          row.number("mean_difference"),
          row.number("mean_error95"),
          row.number("kappa")};
}

}  // namespace

std::vector<std::string> accuracy_keys() {
  std::vector<std::string> keys;
  for (const auto& [key, observables] : kKeys) keys.push_back(key);
  return keys;
}

std::vector<MeasuredAccuracy> read_accuracy_table(const std::string& csv, const std::string& place) {
  // Settings of other kinds change the physics, the size of the system, or the use made of its states.
  const std::vector<std::string> kSettable = {"strict",   "scene",    "finish",    "tolerance", "time_step",
                                              "patience", "together", kMassOfCell, kCapOfCell};
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  std::map<std::string, std::size_t> columns;
  for (const std::string& name : split_cells(line)) columns.emplace(name, columns.size());
  std::vector<MeasuredAccuracy> table;
  for (int number = 2; std::getline(in, line); ++number) {
    const MeasuredAccuracy row =
        accuracy_of(Row(columns, split_cells(line), fmt::format("{}:{}", place, number)));
    if (std::find(kSettable.begin(), kSettable.end(), row.parameter) != kSettable.end()) table.push_back(row);
  }
  return table;
}

const std::vector<MeasuredAccuracy>& shipped_accuracy_table() {
  static const std::vector<MeasuredAccuracy> table =
      read_accuracy_table(kAccuracyTable, "data/tables/tradeoff/tradeoff.csv");
  return table;
}

AccuracyChoice choose_accuracy(const std::vector<MeasuredAccuracy>& table, const WantedAccuracy& wanted,
                               const std::vector<CellFactors>& cells) {
  const std::vector<Candidate> candidates = candidates_of(table), of_cell = candidates_of(table, true);
  const Additions additions = additions_of(of_cell, cells);
  AccuracyChoice choice;
  for (const auto& [key, asked] : wanted) {
    double floor = std::numeric_limits<double>::infinity();
    for (const Candidate& c : candidates)
      if (!c.is_reference()) floor = std::min(floor, guaranteed_error_of_key(c, additions, key));
    if (asked >= floor && floor < std::numeric_limits<double>::infinity()) continue;
    choice.refused_key = key;
    choice.failure_reason =
        std::isfinite(floor)
            ? fmt::format("expected at least {:.2g}, the smallest error that the shipped table has for it{}",
                          floor, additions.empty() ? "" : " with a cell that moves as the scene says")
            : "expected another observable: the shipped table has no error for it";
    return choice;
  }
  for (const Candidate& c : candidates)
    if (std::all_of(wanted.begin(), wanted.end(), [&](const auto& w) {
          return guaranteed_error_of_key(c, additions, w.first) <= w.second;
        })) {
      choice.name = c.parameter + " " + c.value;
      choice.settings = c.settings;
      choice.reason = reason_of(c, additions, wanted);
      return choice;
    }
  choice.refused_key = wanted.front().first;
  choice.failure_reason =
      "expected larger errors: no setting of the shipped table has errors below all of these at once";
  return choice;
}

bool covers_stiffness(const std::vector<MeasuredAccuracy>& table, double kappa) {
  return std::any_of(table.begin(), table.end(), [&](const MeasuredAccuracy& row) {
    return row.kappa <= kStiffnessRange * kappa && kappa <= kStiffnessRange * row.kappa;
  });
}

bool covers_cell(const std::vector<MeasuredAccuracy>& table, const CellFactors& cell) {
  const std::vector<Candidate> of_cell = candidates_of(table, true);
  const auto covers = [&](const char* parameter, double factor) {
    return is_default(factor) || nearest_beyond(of_cell, parameter, factor);
  };
  return covers(kMassOfCell, cell.mass) && covers(kCapOfCell, cell.rate_cap);
}

}  // namespace floc
