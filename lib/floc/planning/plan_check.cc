#include "floc/planning/plan_check.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/campaign/campaign_tables.h"
#include "floc/campaign/sample_mean.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Returns a table of the library in the form in which it is read from a file.
CsvTable as_csv(const Table& table, const std::string& place) {
  std::stringstream text;
  write_table(text, table, TableFormat::csv);
  return CsvTable::parse(place, text);
}

/// Returns the mean over states of a column for each sample that has one. The key is the seed.
std::map<std::string, double> means_of_samples(const CsvTable& runs, const std::string& column) {
  std::map<std::string, SampleMean> sums;
  if (!runs.has(column)) return {};
  for (int row = 0; row < runs.n_rows(); ++row)
    if (const auto value = parse_number<double>(runs.text(row, runs.column(column)))) {
      SampleMean& sum = sums[runs.text(row, runs.column("seed"))];
      sum.mean += *value;
      ++sum.n;
    }
  std::map<std::string, double> means;
  for (const auto& [seed, sum] : sums) means[seed] = sum.mean / sum.n;
  return means;
}

SampleMean mean_of_column(const CsvTable& runs, const std::string& column) {
  std::vector<double> values;
  for (const auto& [seed, mean] : means_of_samples(runs, column)) values.push_back(mean);
  return mean_of_samples(values);
}

/// Returns the size by which the error of a mean is divided: its absolute value. The errors of the coordination numbers
/// of contacts in compression and in tension are relative to their sum, because one of them may be near zero.
double size_of(const CsvTable& runs, const std::string& column, double mean) {
  if (column != "z_plus" && column != "z_minus") return std::abs(mean);
  const SampleMean other = mean_of_column(runs, column == "z_plus" ? "z_minus" : "z_plus");
  return std::abs(mean) + (other.n > 0 ? std::abs(other.mean) : 0.0);
}

PlanCheck check_column(const std::string& name, double promised, const CsvTable& runs) {
  const SampleMean mean = mean_of_column(runs, name);
  PlanCheck check{name, "1", promised, {}, {}, mean.n};
  if (mean.n == 0) return check;
  check.mean = mean.mean;
  if (const auto error = mean.standard_error())
    check.achieved = student_t_95(mean.n - 1) * *error / size_of(runs, name, mean.mean);
  return check;
}

/// Takes the fitted value and its interval, for all samples together, from the table of fits of a campaign.
void check_fit(const CsvTable& fits, PlanCheck& check) {
  for (int row = 0; row < fits.n_rows(); ++row) {
    const auto number = [&](const char* column) {
      return parse_number<double>(fits.text(row, fits.column(column)));
    };
    const std::string sample = fits.text(row, fits.column("sample"));
    if (fits.text(row, fits.column("parameter")) != check.quantity || (sample != "pooled" && sample != "mean"))
      continue;
    const auto value = number("value"), low = number("low95"), high = number("high95"), error = number("stderr");
    const auto n = number("n");
    if (!value || !n || *n < 2) continue;
    check.mean = *value;
    check.n_samples = static_cast<int>(*n);
    if (low && high)
      check.achieved = 0.5 * (*high - *low) / std::abs(*value);
    else if (error)
      check.achieved = student_t_95(check.n_samples - 1) * *error / std::abs(*value);
  }
}

}  // namespace

std::vector<PlanCheck> check_plan(const Campaign& campaign, const std::vector<CasePlan>& plans,
                                  const std::string& directory) {
  if (!campaign.promise)
    throw InputError(directory,
                     "the campaign has no table [plan]: expected the directory of a campaign file that floc plan -o "
                     "has written, and whose runs are made");
  const PlanPromise& promise = *campaign.promise;
  const CsvTable outcomes = as_csv(outcomes_of(campaign, plans, directory), directory);
  int n_done = 0;
  double seconds = 0.0;
  for (int row = 0; row < outcomes.n_rows(); ++row) {
    if (outcomes.text(row, outcomes.column("outcome")) != "done") continue;
    ++n_done;
    seconds += parse_number<double>(outcomes.text(row, outcomes.column("run_seconds"))).value_or(0.0);
  }
  if (n_done < 2)
    throw InputError(directory, fmt::format("{} of {} samples are done: expected at least two, because the achieved "
                                            "errors follow from the scatter between samples; run snakemake there",
                                            n_done, outcomes.n_rows()));
  const CsvTable runs = as_csv(collected_runs(campaign, plans, directory), directory);
  std::vector<PlanCheck> checks;
  const std::string fits = directory + "/fits.csv";
  for (const auto& [name, error] : promise.errors) {
    PlanCheck check = check_column(name, error, runs);
    if (check.n_samples == 0 && fs::is_regular_file(fits)) check_fit(CsvTable::read(fits), check);
    checks.push_back(check);
  }
  // Samples that have not succeeded have cost nothing yet.
  const double share = static_cast<double>(n_done) / outcomes.n_rows();
  checks.push_back({"cost", "s", promise.core_seconds * share,
                    seconds > 0.0 ? std::optional(seconds) : std::nullopt, {}, n_done});
  return checks;
}

}  // namespace floc
