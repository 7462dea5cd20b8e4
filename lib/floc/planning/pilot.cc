#include "floc/planning/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/planning/duration.h"
#include "floc/tradeoff/path_fits.h"
#include "floc/tradeoff/sample_path.h"
#include "floc/tradeoff/studied_setting.h"
#include "floc/tradeoff/tradeoff.h"

namespace floc {
namespace {

/// Numbers of samples of two sizes: kSamples larger samples, on which the scatter is measured, and kSmallSamples
/// smaller samples.
constexpr int kSamples = 6, kSmallSamples = 3;
/// Numbers of grains of a larger sample: of disks, and of spheres. A larger sample never has more grains than the
/// scene.
constexpr int kDisks = 200, kSpheres = 150;
/// Limits of the exponent of the processor time. The limits are needed because a few small samples determine the
/// exponent only roughly.
constexpr double kLeastExponent = 1.1, kLargestExponent = 1.5;
/// Limits of the exponent if one sample with many more grains determines it.
constexpr double kLeastFarExponent = 0.8, kLargestFarExponent = 2.0;
/// Expected processor time of the sample with many more grains, divided by the time that the pilot has left.
constexpr double kShareOfManyGrains = 0.5;
/// Limits of the number of grains of the sample with many more grains, divided by the number of grains of a larger
/// sample.
constexpr double kLeastGrowth = 2.0, kLargestGrowth = 20.0;

/// Runs the k-th sample with the settings of the scene.
SamplePath sample(const Scene& scene, int n_grains, int k, const Deadline& deadline) {
  StudiedSetting setting = studied_settings(scene)[1];
  if (n_grains != scene.grains.count) setting.n_grains = n_grains;
  return make_sample(run_options(scene, setting, scene.seed + static_cast<std::uint64_t>(k)), {}, nullptr,
                     deadline);
}

std::vector<SamplePath> samples(const Scene& scene, int n_grains, int n_samples, const Deadline& deadline,
                                double limit) {
  std::vector<SamplePath> paths;
  for (int k = 0; k < n_samples; ++k) {
    SamplePath path = sample(scene, n_grains, k, deadline);
    if (path.out_of_time)
      throw InputError("--pilot",
                       fmt::format("the samples of {} grains are not complete within {} of processor time: "
                                   "give a larger --budget, or a shorter load path",
                                   n_grains, duration_in_words(limit)));
    if (!path.whole())
      throw NoResult(
          fmt::format("--pilot: a sample of {} grains did not reach equilibrium: {}", n_grains, path.failure));
    path.drop_packings();
    paths.push_back(std::move(path));
  }
  return paths;
}

/// Returns the exponent with which the processor time grows between two numbers of grains.
double exponent_between(double seconds, double more_seconds, double ratio_of_grains) {
  return std::log(more_seconds / seconds) / std::log(ratio_of_grains);
}

/// Runs one sample with as many grains as the remaining time allows, and computes the exponent of the processor time
/// from this sample. This is needed because small samples do not show that, in large packings, many equilibria are
/// found more slowly. Nothing changes if the time does not suffice for many grains, or if the run stops early.
void measure_many_grains(const Scene& scene, const Deadline& deadline, PilotResult& result) {
  const double seconds = kShareOfManyGrains * deadline.left();
  if (!(seconds > result.core_seconds)) return;
  const double growth =
      std::min(std::pow(seconds / result.core_seconds, 1.0 / result.cost_exponent), kLargestGrowth);
  if (growth < kLeastGrowth) return;
  const int n_grains = static_cast<int>(result.n_grains * growth);
  const SamplePath path = sample(scene, n_grains, 0, deadline);
  if (!path.whole()) return;
  result.largest_grains = n_grains;
  result.cost_exponent = std::clamp(
      exponent_between(result.core_seconds, path.core_seconds, static_cast<double>(n_grains) / result.n_grains),
      kLeastFarExponent, kLargestFarExponent);
}

double mean_seconds(const std::vector<SamplePath>& paths) {
  double sum = 0.0;
  for (const SamplePath& path : paths) sum += path.core_seconds;
  return sum / static_cast<double>(paths.size());
}

std::vector<ObservablePrice> scatter_between(const Scene& scene, const std::vector<SamplePath>& paths) {
  std::vector<const SamplePath*> all;
  for (const SamplePath& path : paths) all.push_back(&path);
  Tradeoff described;
  describe_reference(all, fit_window(all), described);
  std::vector<ObservablePrice> prices;
  for (std::size_t k = 0; k < kObservables; ++k) {
    const DeclaredObservable& declared = declared_observables()[k];
    if (const double scatter = described.scatter[k]; scatter > 0.0 && std::isfinite(scatter))
      prices.push_back(
          {declared.name, unit_of(declared, scene), scatter, static_cast<int>(paths.size()) - 1, std::nullopt});
  }
  return prices;
}

}  // namespace

PilotResult run_pilot(const Scene& scene, double limit) {
  if (scene.starts_from_state())
    throw InputError("assembly.protocol = \"state\"",
                     "a plan chooses the number of grains, so the samples must be made from a gas and not from "
                     "a saved state: expected \"direct\" or \"aggregation\"");
  const bool is_listed = scene.grains.diameter.kind == DiameterDistribution::Kind::list;
  const int n_large =
      is_listed ? scene.grains.count : std::min(scene.grains.count, scene.dimension == 2 ? kDisks : kSpheres);
  const Deadline deadline(limit);
  const std::vector<SamplePath> large = samples(scene, n_large, kSamples, deadline, limit);
  PilotResult result{n_large,
                     kSamples,
                     mean_seconds(large),
                     0.5 * (kLeastExponent + kLargestExponent),
                     scatter_between(scene, large),
                     n_large};
  if (!is_listed && n_large >= 4) {
    const std::vector<SamplePath> small = samples(scene, n_large / 2, kSmallSamples, deadline, limit);
    const double ratio = static_cast<double>(n_large) / (n_large / 2);
    result.cost_exponent = std::clamp(exponent_between(mean_seconds(small), result.core_seconds, ratio),
                                      kLeastExponent, kLargestExponent);
    measure_many_grains(scene, deadline, result);
  }
  return result;
}

}  // namespace floc
