#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "floc/fitting/student_t.h"
#include "floc/planning/pilot.h"
#include "floc/planning/plan.h"
#include "floc/tradeoff/comparison.h"
#include "floc/tradeoff/lattice_study.h"
#include "floc/tradeoff/sample_path.h"
#include "floc/tradeoff/studied_setting.h"

/// Counts how often an error exceeds the promised error. The errors are promised by tables of prices and by plans. The
/// samples of the tests are not in the tables.
namespace floc::test {

/// Number of promised errors, and number of those that the samples did not exceed.
struct KeptPromises {
  int n = 0, kept = 0;

  void add(bool is_kept) { ++n, kept += is_kept; }
  /// Returns the probability that at most `kept` of n promises are kept. Each single promise is kept with the
  /// probability `confidence`.
  double probability(double confidence) const {
    double sum = 0.0;
    for (int k = 0; k <= kept; ++k)
      sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                      k * std::log(confidence) + (n - k) * std::log1p(-confidence));
    return std::min(1.0, sum);
  }
};

struct PromisesOfTable {
  KeptPromises states, means;
};

inline std::vector<const SamplePath*> pointers_to(const std::vector<SamplePath>& paths) {
  std::vector<const SamplePath*> all;
  for (const SamplePath& path : paths) all.push_back(&path);
  return all;
}

/// Returns the setting of a scene that a row of its table of prices describes.
/// @param name  parameter and value of the row
inline StudiedSetting studied(const Scene& scene, const std::string& name) {
  for (const StudiedSetting& setting : studied_settings(scene))
    if (setting.parameter + " " + setting.value == name) return setting;
  ADD_FAILURE() << "no study of " << name;
  return studied_settings(scene)[1];
}

/// Counts the states of a sample, and those states whose error does not exceed the error in the table.
inline void count_states(const PricedSettings& priced, const SamplePath& reference, const SamplePath& path,
                         KeptPromises& promises) {
  const std::vector<bool> same = before_collapse(reference, path);
  for (int k = 0; k < kObservables; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto row = priced.of.find(declared_observables()[at].name);
    if (row == priced.of.end() || !std::isfinite(row->second->error)) continue;
    for (std::size_t i = 0; i < path.states.size(); ++i) {
      const Observation& here = path.states[i].observation;
      const Observation& truth = same[i] ? reference.states[i].observation : path.states[i].settled;
      const double error = std::abs(here[at] - truth[at]);
      // Smaller errors come from rounding, not from the settings.
      constexpr double kRounding = 1e-9;
      if (std::isfinite(error))
        promises.add(error <= std::max(row->second->error, kRounding) * size_of(k, here, truth));
    }
  }
}

/// Runs samples of a scene with seeds that the table does not use. Counts the errors of single states and of means, and
/// how many of them do not exceed the errors of the table. An error of a mean may exceed the error of the table by the
/// confidence interval of the mean.
inline PromisesOfTable count_promises(const Scene& scene, const PriceTable& table,
                                      const std::vector<std::string>& names, std::uint64_t seed,
                                      int n_samples) {
  const Deadline never(1e6);
  const StudiedSetting strict = studied_settings(scene)[0];
  std::vector<SamplePath> references;
  for (int s = 0; s < n_samples; ++s) {
    references.push_back(make_sample(run_options(scene, strict, seed + s), {}, nullptr, never));
    EXPECT_TRUE(references.back().whole()) << references.back().failure;
    for (ObservedState& state : references.back().states) state.settled = state.observation;
  }
  PromisesOfTable promises;
  const std::vector<PricedSettings> priced = settable_prices(table);
  for (const std::string& name : names) {
    const auto one =
        std::find_if(priced.begin(), priced.end(), [&](const auto& p) { return p.name() == name; });
    if (one == priced.end()) continue;
    const StudiedSetting setting = studied(scene, name);
    std::vector<SamplePath> paths;
    for (int s = 0; s < n_samples; ++s) {
      const SamplePath* reference = setting.has_other_states() ? nullptr : &references[s];
      paths.push_back(make_sample(run_options(scene, setting, seed + s), {}, reference, never));
      settle(run_options(scene, strict, seed + s).relaxation, never, paths.back());
      EXPECT_TRUE(paths.back().whole()) << name << ": " << paths.back().failure;
      if (reference != nullptr) count_states(*one, references[s], paths.back(), promises.states);
    }
    const auto compared = setting.has_other_states() ? compare_means : compare;
    const ObservableErrors errors = compared(pointers_to(references), pointers_to(paths), std::nullopt);
    for (std::size_t k = 0; k < kObservables; ++k) {
      const MeanDifference& mean = errors[k].mean;
      const double promised = settings_error(*one, declared_observables()[k].name);
      if (mean.n < n_samples || !std::isfinite(promised)) continue;
      promises.means.add(std::abs(mean.difference) <=
                         promised + student_t_95(n_samples - 1) * mean.standard_error + 1e-12);
    }
  }
  return promises;
}

/// Makes lattices of cemented grains with seeds that the table does not use, for all numbers of nodes in the table.
/// Counts the errors, and how many of them do not exceed the errors of the table.
/// @param scene  scene of the packings
inline PromisesOfTable count_lattice_promises(Scene scene, const PriceTable& table, double matrix_content,
                                              std::uint64_t seed, int n_samples) {
  LatticeStudyOptions lattice;
  lattice.matrix_content = matrix_content;
  TradeoffOptions options;
  options.budget = 1e6;
  options.max_samples = 1;
  options.parameters = {"nodes_a_diameter"};
  PromisesOfTable promises;
  // key: row of the table; value: difference of each sample from the reference
  std::map<const PriceRow*, std::vector<double>> differences;
  for (int s = 0; s < n_samples; ++s) {
    scene.seed = seed + s;
    for (const MeasuredSetting& measured : study_lattice(scene, lattice, options).settings) {
      if (measured.setting.parameter == "strict") continue;
      for (int k = 0; k < kObservables; ++k) {
        const PriceRow* row =
            table.find(measured.setting.parameter, measured.setting.value, declared_observables()[k].name);
        const ObservableError& error = measured.errors[k];
        if (row == nullptr || !std::isfinite(row->error) || error.after.n == 0) continue;
        promises.states.add(error.after.error <= row->error);
        differences[row].push_back(error.mean.difference);
      }
    }
  }
  for (const auto& [row, values] : differences) {
    const PricedSettings priced{row->parameter, row->value, {}, 0.0, 0.0, {{row->observable, row}}};
    const MeanDifference mean = mean_of(values);
    promises.means.add(std::abs(mean.difference) <= settings_error(priced, row->observable) + mean.error95);
  }
  return promises;
}

/// Error that a plan promises for an observable, and the actual error: the difference between the samples of the plan
/// and a reference ensemble.
struct PlanOutcome {
  std::string observable;
  double promised, achieved;
  double promised_seconds, seconds;  ///< processor time of the samples of the plan (s)
};

/// Runs the samples of the best plan for a budget, and a reference ensemble with four times as many samples.
/// @param reference  settings of the reference ensemble
inline std::vector<PlanOutcome> outcome_of_plan(const Scene& scene, const PriceModel& model, double budget,
                                                const StudiedSetting& reference) {
  PlanRequest request;
  request.budget = budget;
  for (const ObservablePrice& o : model.observables())
    if (o.name == "phi" || o.name == "B") request.observables.push_back(o.name);
  const PlanChoice choice = choose_plans(model, request, 1);
  const Plan& plan = choice.plans.front();
  const Deadline never(1e6);
  const auto ensemble = [&](StudiedSetting setting, int n, std::uint64_t seed) {
    setting.n_grains = plan.n_grains == scene.grains.count ? 0 : plan.n_grains;
    std::vector<SamplePath> paths;
    for (int s = 0; s < n; ++s) {
      paths.push_back(make_sample(run_options(scene, setting, seed + s), {}, nullptr, never));
      EXPECT_TRUE(paths.back().whole()) << paths.back().failure;
      paths.back().drop_packings();
    }
    return paths;
  };
  const std::vector<SamplePath> own = ensemble(studied(scene, plan.settings.name()), plan.n_samples, 10'000);
  const std::vector<SamplePath> others = ensemble(reference, 4 * plan.n_samples, 20'000);
  const Observation mean = mean_values(pointers_to(own), std::nullopt);
  const Observation truth = mean_values(pointers_to(others), std::nullopt);
  double seconds = 0.0;
  for (const SamplePath& path : own) seconds += path.core_seconds;
  std::vector<PlanOutcome> outcomes;
  for (std::size_t o = 0; o < choice.observables.size(); ++o)
    for (int k = 0; k < kObservables; ++k)
      if (const auto at = static_cast<std::size_t>(k);
          declared_observables()[at].name == choice.observables[o].name)
        outcomes.push_back({choice.observables[o].name, plan.errors[o].total(),
                            std::abs(mean[at] - truth[at]) / size_of(k, mean, truth), plan.core_seconds,
                            seconds});
  return outcomes;
}

}  // namespace floc::test
