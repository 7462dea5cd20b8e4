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

/// Errors scale with the stiffness, so the measured errors apply only to scenes whose stiffness number differs at most
/// by this factor from that of the scene with which they were measured.
constexpr double kStiffnessRange = 10.0;

/// Keys of the table [accuracy] of a scene, each with the observables for which it stands: names in the column
/// "observable" of the table of measured errors.
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

/// Numerical settings from the table of measured errors, with the rows about them.
struct Candidate {
  std::string parameter, value;
  NumericalSettings settings;
  double cost_ratio;
  std::map<std::string, const MeasuredAccuracy*> of;  ///< rows of the table, by the names of the observables

  bool is_reference() const { return parameter == "strict"; }
};

/// Names, in the table of measured errors, of the mass of the cell and of the cap on its strain rate. Their values are
/// factors of the default values, for example "10 times".
constexpr const char* kMassOfCell = "cell_mass";
constexpr const char* kCapOfCell = "strain_rate_cap";

bool is_of_cell(const std::string& parameter) {
  return parameter == kMassOfCell || parameter == kCapOfCell;
}

/// Returns settings from the table of measured errors, the cheapest first.
/// @param of_cell  if true, settings of the mass of the cell and of the cap on its strain rate; otherwise numerical
/// settings of a scene
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

/// Returns the smallest relative error of an observable that settings guarantee; infinite if their error was not
/// measured.
double guaranteed_error(const Candidate& candidate, const std::string& observable) {
  const auto found = candidate.of.find(observable);
  if (found == candidate.of.end()) return std::numeric_limits<double>::infinity();
  const MeasuredAccuracy& row = *found->second;
  const double difference = std::abs(row.mean_difference), scatter = row.mean_error;
  if (std::isfinite(row.error)) return std::max(row.error, std::isfinite(scatter) ? difference - scatter : 0.0);
  return std::isfinite(scatter) ? difference + scatter : std::numeric_limits<double>::infinity();
}

/// Returns the factor of a setting of the cell, for example 10 for the value "10 times"; NaN if the value contains no
/// number.
double factor_of(const Candidate& of_cell) {
  return parse_number<double>(of_cell.value.substr(0, of_cell.value.find(' ')))
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Relative difference below which two factors, of the mass of the cell or of the cap on its strain rate, count as
/// equal. The factors of a scene are ratios and have rounding errors.
constexpr double kRoundingOfFactors = 1e-9;

bool is_default(double factor) {
  return std::abs(factor - 1.0) <= kRoundingOfFactors;
}

/// Returns the measured setting of the cell that covers a factor of a scene: its own factor lies on the same side of 1,
/// is at least as far from 1, and is the closest of these. Returns null if no setting covers the factor.
/// @param of_cell  measured settings of the mass of the cell and of the cap on its strain rate
/// @param parameter  quantity that the factor multiplies: "cell_mass" or "strain_rate_cap"
/// @param factor  value in the scene over the default value
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

/// Measured settings of the cell that cover the cell of a scene. Their errors are added to those of all numerical
/// settings.
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

/// Returns the relative error that settings guarantee for all observables of a key of [accuracy], including the errors
/// that the cell causes.
/// @param additions  settings of the cell whose errors are added
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
      if (std::isfinite(row.error)) text += fmt::format(" {:.1e} in 95 % of the states", row.error);
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
      "finish {}, time step {}, tolerance {:g}, patience {}: this takes {:.2f} of the processor time of the "
      "strictest settings. Measured errors: {}",
      finish_name(s.finish), s.time_step, s.tolerance, s.patience, chosen.cost_ratio,
      errors_of(chosen, wanted));
  for (const Candidate* addition : additions)
    reason += fmt::format(". Added to these are the errors measured with {} at {} its default value: {}",
                          addition->parameter, addition->value, errors_of(*addition, wanted));
  return reason;
}

std::vector<std::string> split_cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  if (line.ends_with(',')) cells.emplace_back();
  return cells;
}

/// One row of the table of measured errors. Its values are found by the names of their columns.
class Row {
 public:
  Row(const std::map<std::string, std::size_t>& columns, std::vector<std::string> cells, std::string place)
      : columns_(columns), cells_(std::move(cells)), place_(std::move(place)) {}

  const std::string& text(const std::string& column) const {
    const auto at = columns_.find(column);
    if (at == columns_.end() || at->second >= cells_.size())
      throw InputError(place_,
                       "column " + column + " is missing: the file must be a table written by floc tradeoff");
    return cells_[at->second];
  }
  /// Returns the number in a column of this row; NaN if the cell is empty.
  double number(const std::string& column) const {
    const std::string& cell = text(column);
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto value = parse_number<double>(cell);
    if (!value)
      throw InputError(place_, fmt::format("the value of column {} is {}: expected a number", column, cell));
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
  // Parameters of the table that a scene can give for more accuracy. All others change the physics, the number of
  // grains, or the analysis of the states, so their rows are left out.
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
            ? fmt::format(
                  "expected at least {:.2g}, which is the smallest error in the table shipped with floc for "
                  "this quantity{}",
                  floor,
                  additions.empty() ? ""
                                    : " with the mass and the strain rate of the cell that the scene gives")
            : "the table of measured errors shipped with floc has no error of this quantity; leave out the key";
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
      "no settings in the table of measured errors shipped with floc keep all requested errors at once; "
      "request larger errors";
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
