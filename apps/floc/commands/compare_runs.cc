#include "commands/compare_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "floc/io/csv.h"
#include "floc/io/table_units.h"
#include "floc/tables/column.h"
#include "process/command.h"
#include "process/output.h"
#include "process/run_states.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Name of the column of path.csv with the wall times of the steps. This column is not compared, because wall times
/// differ between any two runs.
constexpr const char* kTiming = "seconds";

/// The files of one run that are compared: the state file of each step, and the table path.csv with one row for each
/// step.
struct RunFiles {
  std::map<int, std::string> states;
  CsvTable path;
  std::map<int, int> rows;

  explicit RunFiles(const std::string& directory) : path(CsvTable::read(table_of_run(directory))) {
    const std::vector<std::string> files = states_of_run(directory);
    for (std::size_t k = 0; k < files.size(); ++k) states[static_cast<int>(k)] = files[k];
    const int step = path.column("step");
    for (int row = 0; row < path.n_rows(); ++row) rows[static_cast<int>(path.integer(row, step))] = row;
  }
};

/// One row of the output table: the comparison of one step in both runs.
struct StepComparison {
  int step = 0;
  std::string before, after;  ///< state files of the step in the two runs; empty if there is none
  bool identical = false;
  bool has_both_rows = false;          ///< whether the tables path.csv of both runs have a row for this step
  std::vector<std::string> differing;  ///< columns of path.csv whose values differ in this step
  /// Largest relative difference between the two values of a column; absent if no numbers differ.
  std::optional<double> largest;
};

/// A column that the tables path.csv of both runs contain: its index in the second table. The factor converts the
/// values of the second run to the unit of the first run.
struct Counterpart {
  int column;
  double factor;
};
std::optional<Counterpart> counterpart(const CsvTable& of, const std::string& header, const CsvTable& in) {
  if (in.has(header)) return Counterpart{in.column(header), 1.0};
  const auto [name, unit] = name_and_unit(header);
  for (const std::string& other : in.columns())
    if (const auto [its_name, its_unit] = name_and_unit(other); its_name == name)
      return Counterpart{in.column(other), unit_factor(fmt::format("{}, column {}", in.place(), name), its_unit,
                                                       of.place(), unit)};
  return std::nullopt;
}

/// Compares the values `a` and `b` of one column of path.csv in the first and the second run. If they differ, adds the
/// column to `row.differing`.
/// @param factor  factor that converts b to the unit of a
void compare_values(const std::string& column, const std::string& a, const std::string& b, double factor,
                    StepComparison& row) {
  // Relative rounding error that is tolerated after b is converted to the unit of a.
  constexpr double kConverted = 1e-12;
  if (a == b && factor == 1.0) return;
  const auto x = parse_number<double>(a), its = parse_number<double>(b);
  const double y = factor * its.value_or(0.0);
  if (factor != 1.0 && x && its && std::abs(*x - y) <= kConverted * std::abs(*x)) return;
  row.differing.push_back(column);
  if (!x || !its) return;
  const double difference = std::abs(*x - y) / std::max(std::abs(*x), std::abs(y));
  row.largest = std::max(row.largest.value_or(0.0), difference);
}

StepComparison compare_step(int step, const RunFiles& before, const RunFiles& after) {
  StepComparison row;
  row.step = step;
  if (before.states.contains(step)) row.before = before.states.at(step);
  if (after.states.contains(step)) row.after = after.states.at(step);
  row.identical = !row.before.empty() && !row.after.empty() && read_file(row.before) == read_file(row.after);
  row.has_both_rows = before.rows.contains(step) && after.rows.contains(step);
  if (!row.has_both_rows) return row;
  for (const std::string& column : before.path.columns()) {
    if (column == kTiming) continue;
    const auto other = counterpart(before.path, column, after.path);
    if (!other) continue;
    compare_values(column, before.path.text(before.rows.at(step), before.path.column(column)),
                   after.path.text(after.rows.at(step), other->column), other->factor, row);
  }
  return row;
}

/// Returns a sentence about the result of the comparison, which begins with "equal" or "different".
std::string verdict(const std::vector<StepComparison>& rows) {
  const auto n_same = std::ranges::count_if(rows, &StepComparison::identical);
  const auto n_both = std::ranges::count_if(rows, &StepComparison::has_both_rows);
  const auto n_rows = std::ranges::count_if(
      rows, [](const StepComparison& r) { return r.has_both_rows && r.differing.empty(); });
  const auto first = std::ranges::find_if(rows, [](const StepComparison& r) { return !r.identical; });
  if (first == rows.end() && n_rows == static_cast<std::ptrdiff_t>(rows.size()))
    return fmt::format(
        "equal: all {} states are equal byte by byte, and the tables path.csv are equal except for the column "
        "{}",
        rows.size(), kTiming);
  return fmt::format(
      "different{}: {} of {} states are equal byte by byte; of the {} rows that both tables path.csv have, {} "
      "are equal except for the column {}",
      first == rows.end() ? "" : fmt::format(" from step {} on", first->step), n_same, rows.size(), n_both,
      n_rows, kTiming);
}

}  // namespace

int compare_runs(const std::string& before, const std::string& after, const Printing& printing) {
  const RunFiles a(before), b(after);
  std::vector<StepComparison> rows;
  const int n = static_cast<int>(std::max(a.states.size(), b.states.size()));
  for (int step = 0; step < n; ++step) rows.push_back(compare_step(step, a, b));
  const std::vector<Column<StepComparison>> columns = {
      {"step", [](const StepComparison& r) { return count(r.step); }},
      {"before", [](const StepComparison& r) { return or_undefined(r.before); }},
      {"after", [](const StepComparison& r) { return or_undefined(r.after); }},
      {"identical", [](const StepComparison& r) { return r.identical; }},
      {"n_values",
       [](const StepComparison& r) { return TableValue{static_cast<std::int64_t>(r.differing.size())}; }},
      {"differing",
       [](const StepComparison& r) { return or_undefined(fmt::format("{}", fmt::join(r.differing, " "))); }},
      {"largest", [](const StepComparison& r) { return or_undefined(r.largest); }}};
  print_table(to_table(columns, rows), printing);
  const std::string words = verdict(rows);
  std::cerr << fmt::format("floc: {} and {}: {}\n", before, after, words);
  return words.starts_with("equal") ? kDone : kVerificationFailed;
}

}  // namespace floc
