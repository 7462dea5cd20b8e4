#include "floc/prices/price_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/io/csv.h"

namespace floc {
namespace {

/// Columns that every version of `floc tradeoff` writes.
const std::vector<std::string> kColumns = {
    "knob",   "value",    "observable",        "cost_ratio",       "tolerance",       "time_step",
    "finish", "patience", "error_before_high", "error_after_high", "mean_difference", "mean_error95",
    "kappa"};

/// Reads cells of a table of prices. Columns are found by their names.
class Cells {
 public:
  Cells(const CsvTable& table, int row) : table_(table), row_(row) {}

  /// Returns the text in a column; empty if the table does not have the column.
  std::string text(const std::string& column) const {
    return table_.has(column) ? table_.text(row_, table_.column(column)) : "";
  }
  /// Returns the number in a column; NaN if the cell is empty, or if the table does not have the column.
  double number(const std::string& column) const {
    const std::string cell = text(column);
    if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto value = parse_number<double>(cell);
    if (!value) refuse(column, "a number");
    return *value;
  }
  /// Returns the number in a column, as number() does. @throws InputError if it is less than `least`, or equal to it
  /// unless `may_be_least`
  double at_least(const std::string& column, double least, bool may_be_least) const {
    const double value = number(column);
    if (value < least || (value == least && !may_be_least))
      refuse(column, fmt::format("a number {} {:g}", may_be_least ? ">=" : ">", least));
    return value;
  }
  /// @throws InputError that names the value in a column and what is expected there
  [[noreturn]] void refuse(const std::string& column, const std::string& expected) const {
    throw InputError(table_.place(row_),
                     fmt::format("the value of column {} is {}: expected {}", column, text(column), expected));
  }
  double positive(const std::string& column) const { return at_least(column, 0.0, false); }
  double magnitude(const std::string& column) const { return at_least(column, 0.0, true); }
  /// Returns the whole number in a column; 0 if the cell is empty, or if the table does not have the column.
  int count(const std::string& column) const {
    const double value = number(column);
    if (std::isnan(value)) return 0;
    if (!(value >= 0.0 && value <= 1e9 && value == std::floor(value))) refuse(column, "a whole number >= 0");
    return static_cast<int>(value);
  }

 private:
  const CsvTable& table_;
  int row_;
};

/// Returns a factor by which springs are softer; 1 if the table does not contain it.
double softening_in(const Cells& cells, const std::string& column) {
  const double factor = cells.at_least(column, 1.0, true);
  return std::isnan(factor) ? 1.0 : factor;
}

/// Returns whether the grains of a row move with equal masses; false if the table does not contain it.
bool equal_masses_in(const Cells& cells) {
  const std::string word = cells.text("masses");
  if (!word.empty() && word != masses_name(false) && word != masses_name(true))
    cells.refuse("masses", fmt::format("{} or {}", masses_name(false), masses_name(true)));
  return word == masses_name(true);
}

/// Returns the finish of the relaxation in a row. Rows for rigid grains and for lattices have other words in this
/// column, which name no finish of a relaxation.
Finish finish_in(const Cells& cells) {
  static const std::vector<std::string> kOthers = {"",       "closest",   "canonical", "none",
                                                   "factor", "automatic", "iterative"};
  const std::string word = cells.text("finish");
  std::vector<std::string> names;
  for (const Finish finish : {Finish::automatic, Finish::dynamic, Finish::statics}) {
    if (word == finish_name(finish)) return finish;
    names.emplace_back(finish_name(finish));
  }
  if (std::ranges::count(kOthers, word) == 0)
    cells.refuse("finish", fmt::format("one of {}", fmt::join(names, ", ")));
  return Finish::automatic;
}

NumericalSettings settings_in(const Cells& cells) {
  return {cells.positive("tolerance"),
          cells.positive("time_step"),
          finish_in(cells),
          cells.positive("patience"),
          {softening_in(cells, "assembly_softening"), softening_in(cells, "softening")},
          equal_masses_in(cells)};
}

PriceRow row_of(const Cells& cells) {
  PriceRow row;
  row.parameter = cells.text("knob");
  row.value = cells.text("value");
  row.settings = settings_in(cells);
  row.observable = cells.text("observable");
  row.unit = cells.text("unit");
  row.cost_ratio = cells.positive("cost_ratio");
  row.core_seconds = cells.positive("core_seconds");
  row.memory_mb = cells.magnitude("memory_mb");
  row.error = std::fmax(cells.magnitude("error_before_high"), cells.magnitude("error_after_high"));
  row.mean_difference = cells.number("mean_difference");
  row.mean_stderr = cells.magnitude("mean_stderr");
  row.mean_error = cells.magnitude("mean_error95");
  row.sample_scatter = cells.magnitude("sample_scatter");
  row.reference_value = cells.number("reference_value");
  row.n_grains = cells.count("n_grains");
  row.n_samples = cells.count("n_samples");
  row.n_states = cells.count("n_states");
  // Older tables do not contain the number of states of one sample, but the number of compared states in all samples
  // together.
  if (row.n_states == 0 && row.n_samples > 0)
    row.n_states = (cells.count("n_before") + cells.count("n_after")) / row.n_samples;
  row.kappa = cells.number("kappa");
  return row;
}

}  // namespace

const PriceRow* PriceTable::find(const std::string& parameter, const std::string& value,
                                 const std::string& observable) const {
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const PriceRow& row) {
    return row.parameter == parameter && row.value == value && row.observable == observable;
  });
  return at == rows.end() ? nullptr : &*at;
}

std::vector<const PriceRow*> PriceTable::find_all(const std::string& parameter,
                                                  const std::string& observable) const {
  std::vector<const PriceRow*> found;
  for (const PriceRow& row : rows)
    if (row.parameter == parameter && row.observable == observable) found.push_back(&row);
  return found;
}

double leading_number(const std::string& value) {
  return parse_number<double>(value.substr(0, value.find(' ')))
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

std::vector<std::string> PriceTable::observables() const {
  std::vector<std::string> names;
  for (const PriceRow& row : rows)
    if (std::find(names.begin(), names.end(), row.observable) == names.end()) names.push_back(row.observable);
  return names;
}

PriceTable read_price_table(const std::string& csv, const std::string& place) {
  std::istringstream in(csv);
  const CsvTable cells = CsvTable::parse(place, in, kColumns);
  // Columns that later versions of floc have added may be missing, so that older tables can still be read. For a
  // missing column, row_of() stores a value that stands for an unknown number, or a default value.
  for (const std::string& column : kColumns)
    if (!cells.has(column))
      throw InputError(place, "column " + column +
                                  " is missing: expected a table that floc tradeoff --format csv of this "
                                  "version of floc has written");
  PriceTable table;
  table.place = place;
  for (int row = 0; row < cells.n_rows(); ++row) {
    const Cells one(cells, row);
    if (const double version = one.number("version"); version != kPriceTableVersion && !std::isnan(version))
      one.refuse("version", fmt::format("{}, the version of the tables that this version of floc reads and "
                                        "floc tradeoff writes",
                                        kPriceTableVersion));
    const std::string kind = one.text("kind");
    if (row > 0 && kind != table.kind)
      throw InputError(cells.place(row),
                       fmt::format("the value of column kind is {}: expected {}, as in the rows before, "
                                   "because a table describes scenes of one kind",
                                   kind, table.kind));
    table.kind = kind;
    PriceRow next = row_of(one);
    if (table.find(next.parameter, next.value, next.observable) != nullptr)
      throw InputError(
          cells.place(row),
          fmt::format("a row above has the same knob, value and observable ({}, {}, {}): expected one row "
                      "for each",
                      next.parameter, next.value, next.observable));
    table.rows.push_back(std::move(next));
    const PriceRow& read = table.rows.back();
    for (const std::string column : {"softening", "assembly_softening", "masses"})
      if (read.parameter == column && !cells.has(column))
        throw InputError(cells.place(row),
                         fmt::format("this row is of the knob {0}, but the column {0} is missing: expected "
                                     "a table that floc tradeoff --format csv of this version of floc "
                                     "has written",
                                     column));
  }
  if (table.rows.empty())
    throw InputError(place, "the table has no rows: expected those that floc tradeoff has written");
  return table;
}

}  // namespace floc
