#include "floc/planning/plan_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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
#include "floc/run_directory/one_run.h"
#include "floc/tradeoff/path_fits.h"
#include "floc/tradeoff/sample_path.h"

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

/// Values of observables in the samples of a plan that are done. They are computed as for tables of prices, from the
/// states of the runs. Elastic moduli, which take longer, come from the table that the campaign has collected.
class ObservedSamples {
 public:
  ObservedSamples(const Scene& scene, const std::vector<std::string>& directories, const CsvTable& runs)
      : runs_(runs) {
    for (const std::string& directory : directories) {
      std::vector<std::string> files;
      for (const auto& [step, file] : numbered_states(directory)) files.push_back(file);
      samples_.push_back(read_sample(scene, files));
    }
    for (const SamplePath& sample : samples_) paths_.push_back(&sample);
    if ((window_ = fit_window(paths_))) {
      fitted_ = fitted_consolidation(paths_, *window_);
      errors_of_fits_ = sampling_errors_of_fits(paths_, *window_);
    }
  }

  PlanCheck check(const std::string& name, double promised) const {
    PlanCheck check{name, "1", promised, {}, {}, 0};
    const std::vector<std::string> names = observable_names();
    const auto k = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (k == names.size()) return check;
    if (is_fitted(name))
      check_fit(k - kLambda, check);
    else
      check_mean(k, check);
    return check;
  }

 private:
  SampleMean mean_of(std::size_t k) const {
    const DeclaredObservable& observable = declared_observables()[k];
    std::vector<double> values;
    if (observable.source == ObservableSource::moduli) {
      for (const auto& [seed, mean] : means_of_samples(runs_, observable.name)) values.push_back(mean);
    } else {
      for (const SamplePath& sample : samples_)
        if (const double value = value_of_path(k, sample); std::isfinite(value)) values.push_back(value);
    }
    return mean_of_samples(values);
  }

  /// Returns the number by which the error of a mean is divided to make the error relative: the absolute value of the
  /// mean. The errors of the coordination numbers z_plus and z_minus (contacts in compression and in tension) are
  /// divided by the sum of the two numbers, because one of them may be near zero.
  double size_of(std::size_t k, double mean) const {
    if (k != kZPlus && k != kZMinus) return std::abs(mean);
    const SampleMean other = mean_of(k == kZPlus ? kZMinus : kZPlus);
    return std::abs(mean) + (other.n > 0 ? std::abs(other.mean) : 0.0);
  }

  void check_mean(std::size_t k, PlanCheck& check) const {
    const SampleMean mean = mean_of(k);
    check.n_samples = mean.n;
    if (mean.n == 0) return;
    check.mean = mean.mean;
    if (const auto error = mean.standard_error())
      check.achieved = student_t_95(mean.n - 1) * *error / size_of(k, mean.mean);
  }

  /// Stores the value of a parameter of the consolidation law, fitted to the mean of all samples, and the half width of
  /// its 95 % interval by the jackknife.
  /// @param p  number of the parameter in ConsolidationValues
  void check_fit(std::size_t p, PlanCheck& check) const {
    if (!window_ || errors_of_fits_[p].n == 0) return;
    check.mean = fitted_[p];
    check.achieved = errors_of_fits_[p].error95;
    check.n_samples = errors_of_fits_[p].n;
  }

  const CsvTable& runs_;
  std::vector<SamplePath> samples_;
  std::vector<const SamplePath*> paths_;
  std::optional<PressureWindow> window_;
  ConsolidationValues fitted_{};
  std::array<MeanDifference, 3> errors_of_fits_{};
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
  const ObservedSamples samples(scene_of(campaign, campaign.cases.front()), done, runs);
  std::vector<PlanCheck> checks;
  for (const auto& [name, error] : promise.errors) checks.push_back(samples.check(name, error));
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
