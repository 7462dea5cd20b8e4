#include "floc/planning/plan_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/campaign/campaign_tables.h"
#include "floc/campaign/sample_mean.h"
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
    const auto window = fit_window(paths_);
    means_ = mean_values(paths_, window);
    if (window) errors_of_fits_ = sampling_errors_of_fits(paths_, *window);
    for (std::size_t k = 0; k < means_.size(); ++k)
      if (declared_observables()[k].source == ObservableSource::moduli) means_[k] = over_samples(k).difference;
  }

  PlanCheck check(const std::string& name, double promised) const {
    PlanCheck check{name, "1", promised, {}, {}, 0};
    const std::vector<std::string> names = observable_names();
    const auto k = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    if (k == names.size()) return check;
    // The half widths of fitted parameters are relative already. Those of means are divided by the mean.
    const bool is_fit = is_fitted(name);
    const MeanDifference found = is_fit ? errors_of_fits_[k - kLambda] : over_samples(k);
    check.n_samples = found.n;
    if (found.n == 0) return check;
    check.mean = means_[k];
    if (found.n > 1) check.achieved = found.error95 / (is_fit ? 1.0 : std::abs(means_[k]));
    return check;
  }

 private:
  /// Returns the mean of an observable over the samples that have a value, with its error.
  MeanDifference over_samples(std::size_t k) const {
    const DeclaredObservable& observable = declared_observables()[k];
    std::vector<double> values;
    if (observable.source == ObservableSource::moduli)
      for (const auto& [seed, mean] : means_of_samples(runs_, observable.name)) values.push_back(mean);
    else
      for (const SamplePath& sample : samples_) values.push_back(value_of_path(k, sample));
    return mean_of(values);
  }

  const CsvTable& runs_;
  std::vector<SamplePath> samples_;
  std::vector<const SamplePath*> paths_;
  Observation means_{};  ///< means over the samples and fitted parameters
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
