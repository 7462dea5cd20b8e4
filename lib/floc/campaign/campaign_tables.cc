#include "floc/campaign/campaign_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/campaign/sample_mean.h"
#include "floc/campaign/snakefile.h"

namespace floc {
namespace {

namespace fs = std::filesystem;
using Row = std::vector<TableValue>;
/// Collected values of one state of one run, as texts. The key is the name of the column.
using StateCells = std::map<std::string, std::string>;

TableValue as_value(const std::string& text) {
  if (text.empty()) return {};
  if (const auto number = parse_number<double>(text)) return *number;
  return text;
}

/// Returns the cells with which each row about a case begins in the tables of results: the label of the case, and the
/// values that the case gives to the keys in which the cases differ.
Row case_cells(const Campaign& campaign, const CampaignCase& one) {
  Row row = {one.label};
  for (const std::string& key : campaign.keys) row.push_back(as_value(value_of(one, key)));
  return row;
}

std::vector<std::string> with_case_columns(const Campaign& campaign, std::vector<std::string> others) {
  std::vector<std::string> columns = {"case"};
  columns.insert(columns.end(), campaign.keys.begin(), campaign.keys.end());
  columns.insert(columns.end(), others.begin(), others.end());
  return columns;
}

/// Returns the number of the state that a row of a table describes. The number follows from the name of the state file
/// in `column`; for state-0012.h5, it is 12.
int step_of(const CsvTable& table, int row, const std::string& column) {
  const std::string name = fs::path(table.text(row, table.column(column))).stem().string();
  const auto step = parse_number<int>(name.substr(std::min(name.size(), name.rfind('-') + 1)));
  if (!step)
    throw InputError(
        table.place(row),
        fmt::format("{} = {}: this is not the name of a state file of a run (state-NNNN.h5)", column, name));
  return *step;
}

void take_columns(const CsvTable& table, int row, const Collection& collection, StateCells& cells) {
  for (const std::string& column : collection.columns) cells[column] = table.text(row, table.column(column));
}

/// Reads the columns of one collection for one run, and copies their values at the states `steps` into `states`. The
/// key of `states` is the number of a state.
/// @param number  number of the collection, counted from 0
/// @param directory  directory of the run
/// @param path  table path.csv of the run
void collect(const Campaign& campaign, int number, const std::vector<int>& steps, const std::string& directory,
             const CsvTable& path, std::map<int, StateCells>& states) {
  const Collection& collection = campaign.collections[static_cast<std::size_t>(number)];
  const std::string file = collected_file(campaign, number);
  for (const int step : steps) states[step];
  if (collection.table == "path") {
    for (const int step : steps) take_columns(path, step, collection, states.at(step));
  } else if (collection.table == "compare") {
    for (const int step : steps)
      take_columns(CsvTable::read(fmt::format("{}/{:04}-{}", directory, step, file)), 0, collection,
                   states.at(step));
  } else {
    const CsvTable table = CsvTable::read(directory + "/" + file);
    for (int row = 0; row < table.n_rows(); ++row)
      if (const auto state = states.find(step_of(table, row, "file")); state != states.end())
        take_columns(table, row, collection, state->second);
  }
}

/// Returns the names of the collected columns, each once, in the order of the campaign file.
std::vector<std::string> collected_columns(const Campaign& campaign) {
  std::vector<std::string> columns;
  for (const Collection& c : campaign.collections)
    for (const std::string& column : c.columns)
      if (std::count(columns.begin(), columns.end(), column) == 0) columns.push_back(column);
  return columns;
}

/// Columns that the table of runs always has, even if the campaign does not collect them.
const std::set<std::string> kOfState = {"case", "seed", "step", "branch", "P_star"};

/// Returns the reference for a value in a table of results; null if the campaign has no reference for it. The value is
/// that of a column at a state of a case, or that of a parameter of a fit to a case.
/// @param step  number of the state; -1 for a parameter of a fit
const Reference* reference_of(const Campaign& campaign, const CampaignCase& one, const CasePlan* plan, int step,
                              const std::string& fit, const std::string& quantity) {
  for (const Reference& r : campaign.references)
    if (r.quantity == quantity && r.fit == fit && is_meant(r, one) &&
        (step < 0 || chosen_states(r.state, one, *plan).front() == step))
      return &r;
  return nullptr;
}

const std::vector<std::string> kReferenceColumns = {
    "reference", "reference_deviation", "reference_n", "difference", "allowed", "agrees", "source"};

/// Adds the cells of the columns kReferenceColumns to a row: the reference value and its comparison with the mean. If
/// `reference` is null, these cells are empty.
void add_reference(const Reference* reference, const SampleMean& mean, Row& row) {
  if (reference == nullptr) {
    row.resize(row.size() + kReferenceColumns.size());
    return;
  }
  const Difference d = difference_of(mean, {reference->n_samples, reference->value, reference->deviation});
  row.insert(row.end(), {reference->value, reference->deviation, std::int64_t{reference->n_samples}, d.value,
                         or_undefined(d.allowed)});
  row.push_back(d.allowed ? TableValue(d.agrees) : TableValue());
  row.emplace_back(reference->source);
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Reads a file with the outcome of a run or of a fit; absent if there is no such file.
/// @throws InputError if the file is not valid
std::optional<RunOutcome> read_outcome(const std::string& file) {
  if (!fs::is_regular_file(file)) return std::nullopt;
  const CsvTable table = CsvTable::read(file);
  if (table.n_rows() != 1)
    throw InputError(
        file, fmt::format("this file has {} rows: expected one row, with the outcome of a run or of a fit",
                          table.n_rows()));
  return RunOutcome{static_cast<int>(table.integer(0, table.column("exit_code"))),
                    table.text(0, table.column("command")), table.text(0, table.column("words")),
                    table.number(0, table.column("seconds")),
                    table.has("run_seconds") ? parse_number<double>(table.text(0, table.column("run_seconds")))
                                             : std::nullopt};
}

}  // namespace

Table table_of(const RunOutcome& outcome) {
  return {{"exit_code", "command", "words", "seconds", "run_seconds"},
          {{std::int64_t{outcome.exit_code}, or_undefined(outcome.command), or_undefined(outcome.words),
            outcome.seconds, or_undefined(outcome.run_seconds)}}};
}

std::optional<RunOutcome> outcome_of(const std::string& directory) {
  const std::string file = directory + "/" + kOutcomeFile;
  return read_outcome(fs::is_regular_file(file) ? file : directory + "/" + kFailureFile);
}

std::string path_of_fit(const Campaign& campaign, int case_number, int fit_number,
                        const std::string& directory) {
  return fmt::format("{}/fits/{}-{}-{}", directory, campaign.cases[static_cast<std::size_t>(case_number)].label,
                     fit_number + 1, campaign.fits[static_cast<std::size_t>(fit_number)].law);
}

std::vector<UnsuccessfulFit> unsuccessful_fits(const Campaign& campaign, const std::string& directory) {
  std::vector<UnsuccessfulFit> fits;
  for (int k = 0; k < static_cast<int>(campaign.cases.size()); ++k)
    for (int fit = 0; fit < static_cast<int>(campaign.fits.size()); ++fit) {
      const auto outcome = read_outcome(path_of_fit(campaign, k, fit, directory) + kFitOutcome);
      if (outcome && !is_done(outcome)) fits.push_back({k, fit, *outcome});
    }
  return fits;
}

bool is_done(const std::optional<RunOutcome>& outcome) {
  return outcome && outcome->exit_code == 0;
}

const char* word_of(const std::optional<RunOutcome>& outcome) {
  if (!outcome) return "missing";
  return is_done(outcome) ? "done" : "failed";
}

Table collected_runs(const Campaign& campaign, const std::vector<CasePlan>& plans,
                     const std::string& directory) {
  std::vector<std::string> columns;
  for (const std::string& column : collected_columns(campaign))
    if (!kOfState.contains(column)) columns.push_back(column);
  Table table{joined(with_case_columns(campaign, {"seed", "step", "branch", "P_star"}), columns), {}};
  for (const CampaignRun& run : runs_of(campaign)) {
    const std::string place = directory + "/" + run.directory;
    // Runs that failed or have not ended are left out, so that the results of the other runs can be collected.
    if (!is_done(outcome_of(place))) continue;
    const CampaignCase& one = campaign.cases[static_cast<std::size_t>(run.case_number)];
    const CasePlan& plan = plans[static_cast<std::size_t>(run.case_number)];
    const CsvTable path = CsvTable::read(place + "/path.csv");
    // The plan gives the numbers of the states to collect, and these numbers are used as row numbers of path.csv. With
    // another number of rows, a number may denote another state than the user has selected.
    if (path.n_rows() != static_cast<int>(plan.states.size()))
      throw InputError(
          path.place(),
          fmt::format("this run has {} states, but the plan of the campaign has {}: run floc campaign "
                      "plan again, with another directory if the scene has changed",
                      path.n_rows(), plan.states.size()));
    // Each collection may select other states. The map joins the cells of all collections by state, so that each state
    // has one row.
    std::map<int, StateCells> states;
    for (int k = 0; k < static_cast<int>(campaign.collections.size()); ++k)
      collect(campaign, k, chosen_states(campaign.collections[static_cast<std::size_t>(k)].states, one, plan),
              place, path, states);
    for (const auto& [step, cells] : states) {
      Row row = case_cells(campaign, one);
      row.insert(row.end(), {static_cast<std::int64_t>(run.seed), std::int64_t{step},
                             or_undefined(path.text(step, path.column("branch"))),
                             as_value(path.text(step, path.column("P_star")))});
      for (const std::string& column : columns)
        row.push_back(cells.contains(column) ? as_value(cells.at(column)) : TableValue());
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

Table means_of(const Campaign& campaign, const std::vector<CasePlan>& plans, const CsvTable& runs) {
  Table table{joined(with_case_columns(campaign, {"step", "branch", "P_star", "quantity", "n", "mean", "stderr",
                                                  "deviation", "low", "high"}),
                     kReferenceColumns),
              {}};
  const int label = runs.column("case"), step = runs.column("step");
  for (std::size_t k = 0; k < campaign.cases.size(); ++k) {
    const CampaignCase& one = campaign.cases[k];
    std::map<int, std::vector<int>> rows;  // key: number of a state; value: rows about this state of the case
    for (int row = 0; row < runs.n_rows(); ++row)
      if (runs.text(row, label) == one.label) rows[static_cast<int>(runs.integer(row, step))].push_back(row);
    for (const auto& [number, those] : rows) {
      const auto numbers = [&, &those = those](const std::string& column) {
        std::vector<double> values;
        for (const int row : those)
          if (const auto x = parse_number<double>(runs.text(row, runs.column(column)))) values.push_back(*x);
        return values;
      };
      for (const std::string& quantity : collected_columns(campaign)) {
        const SampleMean mean = mean_of_samples(numbers(quantity));
        if (mean.n == 0) continue;
        Row row = case_cells(campaign, one);
        const SampleMean P_star = mean_of_samples(numbers("P_star"));
        row.insert(
            row.end(),
            {std::int64_t{number}, or_undefined(runs.text(those.front(), runs.column("branch"))),
             P_star.n == 0 ? TableValue() : TableValue(P_star.mean), quantity, std::int64_t{mean.n}, mean.mean,
             or_undefined(mean.standard_error()), or_undefined(mean.deviation), mean.low, mean.high});
        add_reference(reference_of(campaign, one, &plans[k], number, "", quantity), mean, row);
        table.rows.push_back(std::move(row));
      }
    }
  }
  return table;
}

Table empty_fits(const Campaign& campaign) {
  return {joined(with_case_columns(campaign, {"fit", "sample", "parameter", "value", "stderr", "low95",
                                              "high95", "identified", "n"}),
                 kReferenceColumns),
          {}};
}

void add_fit(const Campaign& campaign, const CampaignCase& one, const CampaignFit& fit, const CsvTable& printed,
             Table& table) {
  // Identified values of each fitted parameter, one per sample; the key is the name of the parameter.
  std::map<std::string, std::vector<double>> values;
  // Number of rows of each sample and parameter.
  std::map<std::pair<std::string, std::string>, int> n_of_sample;
  std::set<std::string> samples;
  std::vector<std::string> parameters;  // names of the parameters, in the order of the printed table
  std::set<std::string> pooled;
  const auto cell = [&](int row, const char* column) { return printed.text(row, printed.column(column)); };
  std::set<std::string> tests;  // kinds of mechanical tests; the parameters have the same names for all kinds
  for (int row = 0; printed.has("test") && row < printed.n_rows(); ++row) tests.insert(cell(row, "test"));
  const auto parameter_of = [&](int row) {
    const bool of_state = printed.has("source") && cell(row, "source") == "state";
    return cell(row, "parameter") + (of_state ? "_state" : "") +
           (tests.size() > 1 ? "_" + cell(row, "test") : "");
  };
  for (int row = 0; row < printed.n_rows(); ++row) {
    std::string parameter = parameter_of(row);
    const std::string sample = cell(row, "sample");
    if (sample == "pooled") {
      pooled.insert(parameter);
    } else {
      // A sample with several branches has a row for each branch. Only values of the same branch have a mean.
      const int branch = ++n_of_sample[{sample, parameter}];
      if (branch > 1) parameter += "_" + std::to_string(branch);
      samples.insert(sample);
      const auto value = parse_number<double>(cell(row, "value"));
      if (value && cell(row, "identified") == "true") values[parameter].push_back(*value);
    }
    if (std::count(parameters.begin(), parameters.end(), parameter) == 0) parameters.push_back(parameter);
  }
  const auto add_row = [&](const std::string& sample, const std::string& parameter, const Row& cells,
                           const SampleMean* mean) {
    Row row = case_cells(campaign, one);
    row.insert(row.end(), {fit.law, sample, parameter});
    row.insert(row.end(), cells.begin(), cells.end());
    const Reference* reference =
        mean == nullptr ? nullptr : reference_of(campaign, one, nullptr, -1, fit.law, parameter);
    add_reference(reference, mean == nullptr ? SampleMean{} : *mean, row);
    table.rows.push_back(std::move(row));
  };
  for (int row = 0; row < printed.n_rows(); ++row) {
    const std::string parameter = parameter_of(row);
    const bool all = cell(row, "sample") == "pooled";
    const std::string sample = all ? "pooled" : fs::path(cell(row, "sample")).parent_path().filename().string();
    const Row cells = {as_value(cell(row, "value")),
                       as_value(cell(row, "stderr")),
                       as_value(cell(row, "low95")),
                       as_value(cell(row, "high95")),
                       or_undefined(cell(row, "identified")),
                       all ? TableValue(static_cast<std::int64_t>(samples.size())) : TableValue()};
    const auto value = parse_number<double>(cell(row, "value")),
               error = parse_number<double>(cell(row, "stderr"));
    const SampleMean mean = value ? SampleMean{1, *value, error, *value, *value} : SampleMean{};
    add_row(sample, parameter, cells, all && value ? &mean : nullptr);
  }
  for (const std::string& parameter : parameters) {
    const SampleMean mean = mean_of_samples(values[parameter]);
    if (pooled.contains(parameter) || mean.n == 0) continue;
    add_row("mean", parameter,
            {mean.mean, or_undefined(mean.standard_error()), {}, {}, {}, std::int64_t{mean.n}}, &mean);
  }
}

Table outcomes_of(const Campaign& campaign, const std::vector<CasePlan>& plans, const std::string& directory) {
  Table table{with_case_columns(campaign,
                                {"seed", "outcome", "exit_code", "command", "words", "n_states", "run_seconds",
                                 "analysis_seconds", "expected_seconds", "directory", "processor_seconds"}),
              {}};
  for (const CampaignRun& run : runs_of(campaign)) {
    const std::string place = directory + "/" + run.directory;
    const auto outcome = outcome_of(place);
    Row row = case_cells(campaign, campaign.cases[static_cast<std::size_t>(run.case_number)]);
    row.insert(row.end(), {static_cast<std::int64_t>(run.seed), word_of(outcome)});
    row.push_back(outcome ? TableValue(std::int64_t{outcome->exit_code}) : TableValue());
    row.push_back(outcome ? or_undefined(outcome->command) : TableValue());
    row.push_back(outcome ? or_undefined(outcome->words) : TableValue());
    const bool has_path = fs::is_regular_file(place + "/path.csv");
    const CsvTable path = has_path ? CsvTable::read(place + "/path.csv") : CsvTable();
    row.emplace_back(std::int64_t{path.n_rows()});
    row.push_back(has_path ? TableValue(sum_of(path, "seconds")) : TableValue());
    row.push_back(outcome ? TableValue(outcome->seconds) : TableValue());
    row.emplace_back(plans[static_cast<std::size_t>(run.case_number)].cost);
    row.emplace_back(run.directory);
    row.push_back(outcome ? or_undefined(outcome->run_seconds) : TableValue());
    table.rows.push_back(std::move(row));
  }
  return table;
}

double sum_of(const CsvTable& table, const std::string& column) {
  double sum = 0.0;
  for (int row = 0; row < table.n_rows(); ++row)
    sum += parse_number<double>(table.text(row, table.column(column))).value_or(0.0);
  return sum;
}

}  // namespace floc
