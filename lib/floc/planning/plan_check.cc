#include "floc/planning/plan_check.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <sstream>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/campaign/campaign_tables.h"
#include "floc/campaign/sample_mean.h"
#include "floc/fitting/student_t.h"
#include "floc/planning/plan_file.h"
#include "floc/tables/consolidation_fits.h"

namespace floc {
namespace {

/// Writes a table of the library as CSV text, and returns the table that is read from this text.
CsvTable as_csv(const Table& table, const std::string& place) {
  std::stringstream text;
  write_table(text, table, TableFormat::csv);
  return CsvTable::parse(place, text);
}

/// For each sample with values in a column, returns the mean of the column over the states of the sample. The key is
/// the seed of the sample.
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

/// Returns the number by which the error of a mean is divided to make the error relative: the absolute value of the
/// mean. The errors of the coordination numbers z_plus and z_minus (contacts in compression and in tension) are divided
/// by the sum of the two numbers, because one of them may be near zero.
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

/// Returns the value of a parameter of a fit; absent if the data do not determine it.
std::optional<double> value_of(const ConsolidationFit& fit, const std::string& name) {
  for (const FittedParameter& p : fit.parameters)
    if (p.name == name) return p.value;
  return std::nullopt;
}

/// Fits of the full consolidation law to the mean of the samples of a plan, made in the same way as for tables of
/// prices. One fit uses all samples and determines the range of pressures. Each of the other fits leaves out one sample
/// and uses this range.
class SampleFits {
 public:
  explicit SampleFits(const std::vector<std::string>& directories) {
    ConsolidationFitOptions options;
    options.law = "full";
    options.weights = "uniform";
    whole_ = consolidation_fit(directories, options);
    if (!whole_.found() || directories.size() < 3) return;
    options.window = {whole_.window_low, whole_.window_high};
    for (std::size_t k = 0; k < directories.size(); ++k) {
      std::vector<std::string> others = directories;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      without_.push_back(consolidation_fit(others, options));
    }
  }

  /// Stores in `check` the fitted value and the half width of its 95 % interval, which is computed by the jackknife.
  /// Consider n fits, each of which leaves out one of the n samples. The standard error is n - 1 times the standard
  /// error of the mean of these fits.
  void check(PlanCheck& check) const {
    check.mean = value_of(whole_, check.quantity);
    if (!check.mean) return;
    std::vector<double> values;
    for (const ConsolidationFit& fit : without_)
      if (const auto value = value_of(fit, check.quantity)) values.push_back(*value);
    if (values.empty() || values.size() < without_.size()) return;
    check.n_samples = static_cast<int>(values.size());
    const double error = (check.n_samples - 1) * *mean_of_samples(values).standard_error();
    check.achieved = student_t_95(check.n_samples - 1) * error / std::abs(*check.mean);
  }

 private:
  ConsolidationFit whole_;
  std::vector<ConsolidationFit> without_;
};

}  // namespace

std::vector<PlanCheck> check_plan(const Campaign& campaign, const std::vector<CasePlan>& plans,
                                  const std::string& directory) {
  if (!campaign.promise)
    throw InputError(directory,
                     "the campaign has no table [plan]: expected the directory of a campaign that was planned "
                     "from a file written by floc plan -o, and whose runs have been made");
  const PlanPromise& promise = *campaign.promise;
  const CsvTable outcomes = as_csv(outcomes_of(campaign, plans, directory), directory);
  std::vector<std::string> done;
  double seconds = 0.0;
  for (int row = 0; row < outcomes.n_rows(); ++row) {
    if (outcomes.text(row, outcomes.column("outcome")) != "done") continue;
    done.push_back(directory + "/" + outcomes.text(row, outcomes.column("directory")));
    seconds += parse_number<double>(outcomes.text(row, outcomes.column("processor_seconds"))).value_or(0.0);
  }
  const int n_done = static_cast<int>(done.size());
  if (n_done < 2)
    throw InputError(
        directory, fmt::format("{} of {} samples are done: expected at least two, because the achieved errors "
                               "are computed from the scatter between samples; run snakemake in this directory",
                               n_done, outcomes.n_rows()));
  const CsvTable runs = as_csv(collected_runs(campaign, plans, directory), directory);
  std::vector<PlanCheck> checks;
  std::optional<SampleFits> fits;
  for (const auto& [name, error] : promise.errors) {
    PlanCheck check = check_column(name, error, runs);
    if (is_fitted(name)) {
      if (!fits) fits.emplace(done);
      fits->check(check);
    }
    checks.push_back(check);
  }
  // The promised cost is multiplied by the fraction of samples that have succeeded, because `seconds` does not include
  // the processor time of the other samples.
  const double share = static_cast<double>(n_done) / outcomes.n_rows();
  checks.push_back({"cost",
                    "s",
                    promise.core_seconds * share,
                    seconds > 0.0 ? std::optional(seconds) : std::nullopt,
                    {},
                    n_done});
  return checks;
}

}  // namespace floc
