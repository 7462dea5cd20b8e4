#include "floc/planning/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "floc/base/error.h"
#include "floc/campaign/sample_mean.h"
#include "floc/planning/duration.h"
#include "floc/tradeoff/sample_path.h"
#include "floc/tradeoff/studied_setting.h"

namespace floc {
namespace {

/// Numbers of samples of the larger and of the smaller size. The scatter follows from the larger ones.
constexpr int kSamples = 6, kSmallSamples = 3;
/// Number of grains of the larger samples, of disks and of spheres, unless the scene has fewer.
constexpr int kDisks = 200, kSpheres = 150;
/// Limits of the exponent of the processor time. A few small samples tell it only roughly.
constexpr double kLeastExponent = 1.1, kLargestExponent = 1.5;

std::vector<SamplePath> samples(const Scene& scene, int n_grains, int n_samples, const Deadline& deadline,
                                double limit) {
  StudiedSetting setting = studied_settings(scene)[1];
  if (n_grains != scene.grains.count) setting.n_grains = n_grains;
  std::vector<SamplePath> paths;
  for (int k = 0; k < n_samples; ++k) {
    SamplePath path = make_sample(run_options(scene, setting, scene.seed + static_cast<std::uint64_t>(k)), {},
                                  nullptr, deadline);
    if (path.out_of_time)
      throw InputError("--pilot",
                       fmt::format("the samples of {} grains are not complete within {} of processor time: "
                                   "expected a larger budget, or a shorter load path",
                                   n_grains, duration_in_words(limit)));
    if (!path.whole())
      throw NoResult(
          fmt::format("--pilot: a sample of {} grains has no equilibrium: {}", n_grains, path.failure));
    for (ObservedState& state : path.states) state.state.packing.contacts.clear();
    paths.push_back(std::move(path));
  }
  return paths;
}

double mean_seconds(const std::vector<SamplePath>& paths) {
  double sum = 0.0;
  for (const SamplePath& path : paths) sum += path.core_seconds;
  return sum / static_cast<double>(paths.size());
}

/// Returns the mean of an observable over the states of a path that have a value; NaN if none has.
double mean_over_states(const SamplePath& path, const std::function<double(const Observation&)>& value) {
  double sum = 0.0;
  int n = 0;
  for (const ObservedState& state : path.states)
    if (const double x = value(state.observation); std::isfinite(x)) sum += x, ++n;
  return sum / n;
}

std::vector<ObservablePrice> scatter_between(const std::vector<SamplePath>& paths) {
  std::vector<ObservablePrice> prices;
  for (int k = 0; k < kObservables; ++k) {
    std::vector<double> means, sizes;
    for (const SamplePath& path : paths) {
      means.push_back(
          mean_over_states(path, [k](const Observation& o) { return o[static_cast<std::size_t>(k)]; }));
      sizes.push_back(mean_over_states(path, [k](const Observation& o) { return floc::size_of(k, o, o); }));
    }
    const SampleMean mean = mean_of_samples(means), size = mean_of_samples(sizes);
    const double scatter = mean.deviation.value_or(0.0) / size.mean;
    if (scatter > 0.0 && std::isfinite(scatter))
      prices.push_back({kObservableNames[static_cast<std::size_t>(k)], "", scatter, mean.n - 1, std::nullopt});
  }
  return prices;
}

}  // namespace

PilotResult run_pilot(const Scene& scene, double limit) {
  if (scene.starts_from_state())
    throw InputError(
        "assembly.protocol = \"state\"",
        "a plan needs samples with any number of grains, which requires a gas in place of a saved state: "
        "expected \"direct\" or \"aggregation\"");
  if (scene.dimension != 2 || scene.law.is_rigid())
    throw InputError("--pilot",
                     "a pilot measures the costs and the scatter only of elastic disks: expected a table of "
                     "prices (--prices FILE) for this scene");
  const bool is_listed = scene.grains.diameter.kind == DiameterDistribution::Kind::list;
  const int n_large =
      is_listed ? scene.grains.count : std::min(scene.grains.count, scene.dimension == 2 ? kDisks : kSpheres);
  const Deadline deadline(limit);
  const std::vector<SamplePath> large = samples(scene, n_large, kSamples, deadline, limit);
  PilotResult result{n_large, kSamples, mean_seconds(large), 0.5 * (kLeastExponent + kLargestExponent),
                     scatter_between(large)};
  if (!is_listed && n_large >= 4) {
    const std::vector<SamplePath> small = samples(scene, n_large / 2, kSmallSamples, deadline, limit);
    const double ratio = static_cast<double>(n_large) / (n_large / 2);
    result.cost_exponent = std::clamp(std::log(result.core_seconds / mean_seconds(small)) / std::log(ratio),
                                      kLeastExponent, kLargestExponent);
  }
  return result;
}

}  // namespace floc
