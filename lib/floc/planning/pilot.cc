#include "floc/planning/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/planning/duration.h"
#include "floc/prices/accuracy.h"
#include "floc/scene/cost_model.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/scene_softening.h"
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

/// Factor within which the expected processor time of a pilot is correct: of settings and grains for which a table of
/// prices or an estimate under pressures exists, and of other scenes (derived_groups.h).
constexpr double kUncertainty = 2.0, kUncertaintyOfStrains = 10.0;

/// Expected processor time of the samples that a pilot always runs.
struct ExpectedTime {
  double seconds;      ///< time of all these samples (s)
  double uncertainty;  ///< factor within which `seconds` is correct
};

/// Returns the expected processor time of samples of two sizes.
/// @param n_small  number of grains of a smaller sample; 0 if no such samples are run
ExpectedTime expected_time(const Scene& scene, int n_large, int n_small, const PriceTable* prices) {
  const auto of_samples = [&](const auto& seconds) {
    return kSamples * seconds(n_large) + (n_small > 0 ? kSmallSamples * seconds(n_small) : 0.0);
  };
  if (prices) {
    const CostModel model(scene, *prices);
    return {of_samples([&](int n) { return model.core_seconds(model.settings_of_scene(), n); }), kUncertainty};
  }
  const bool is_strained = std::ranges::count(strained_stages(scene), true) > 0;
  Scene sized = scene;
  const double seconds = of_samples([&](int n) {
    sized.grains.count = n;
    return expected_cost(sized);
  });
  return {seconds, is_strained && !scene.has_contact_dynamics() ? kUncertaintyOfStrains : kUncertainty};
}

/// Returns the budget, in words, of which a pilot may take `seconds`.
std::string budget_for(double seconds) {
  return duration_in_words(std::stod(rounded_up(seconds / kShareOfPilot)));
}

/// @throws InputError if the samples can clearly not be completed within the limit (s)
void require_time(const ExpectedTime& expected, double limit, int n_grains) {
  if (expected.seconds <= expected.uncertainty * limit) return;
  throw InputError(
      "--pilot",
      fmt::format("the samples of {} grains would not be complete within {} of processor time, because all "
                  "samples are expected to take {}: expected a --budget of at least {}, of which a pilot takes "
                  "at most a fifth, or a shorter load path",
                  n_grains, duration_in_words(limit), duration_in_words(expected.seconds),
                  budget_for(kUncertainty * expected.seconds)));
}

/// Runs the k-th sample with the settings of the scene.
SamplePath sample(const Scene& scene, int n_grains, int k, const Deadline& deadline) {
  StudiedSetting setting = studied_settings(scene)[1];
  if (n_grains != scene.grains.count) setting.n_grains = n_grains;
  return make_sample(run_options(scene, setting, scene.seed + static_cast<std::uint64_t>(k)), {}, nullptr,
                     deadline);
}

/// Limit of the processor time of a pilot, and what is known about the time that it needs.
struct PilotTime {
  Deadline deadline;
  double limit;     ///< processor time that the pilot may take (s)
  double expected;  ///< expected processor time (s)
  int n_done = 0;   ///< number of samples that are complete
};

/// Reports that the time of a pilot was used up, with a budget that is expected to be sufficient.
[[noreturn]] void refuse_limit(const PilotTime& time, int n_grains) {
  const double by_samples = time.limit * (kSamples + kSmallSamples) / (time.n_done + 1.0);
  throw InputError("--pilot",
                   fmt::format("the samples of {} grains are not complete within {} of processor time: "
                               "give a --budget of {}, of which a pilot takes at most a fifth, or a shorter "
                               "load path",
                               n_grains, duration_in_words(time.limit),
                               budget_for(kUncertainty * std::max(time.expected, by_samples))));
}

std::vector<SamplePath> samples(const Scene& scene, int n_grains, int n_samples, PilotTime& time) {
  std::vector<SamplePath> paths;
  for (int k = 0; k < n_samples; ++k) {
    SamplePath path = sample(scene, n_grains, k, time.deadline);
    if (path.out_of_time) refuse_limit(time, n_grains);
    if (!path.whole())
      throw NoResult(
          fmt::format("--pilot: a sample of {} grains did not reach equilibrium: {}", n_grains, path.failure));
    path.drop_packings();
    paths.push_back(std::move(path));
    ++time.n_done;
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

PilotResult run_pilot(const Scene& scene, double limit, const PriceTable* prices) {
  if (scene.starts_from_state())
    throw InputError("assembly.protocol = \"state\"",
                     "a plan chooses the number of grains, so the samples must be made from a gas and not from "
                     "a saved state: expected \"direct\" or \"aggregation\"");
  const bool is_listed = scene.grains.diameter.kind == DiameterDistribution::Kind::list;
  const int n_large =
      is_listed ? scene.grains.count : std::min(scene.grains.count, scene.dimension == 2 ? kDisks : kSpheres);
  const bool has_two_sizes = !is_listed && n_large >= 4;
  const ExpectedTime expected = expected_time(scene, n_large, has_two_sizes ? n_large / 2 : 0, prices);
  require_time(expected, limit, n_large);
  PilotTime time{Deadline(limit), limit, expected.seconds};
  const std::vector<SamplePath> large = samples(scene, n_large, kSamples, time);
  PilotResult result{n_large,
                     kSamples,
                     mean_seconds(large),
                     0.5 * (kLeastExponent + kLargestExponent),
                     scatter_between(scene, large),
                     n_large};
  if (has_two_sizes) {
    const std::vector<SamplePath> small = samples(scene, n_large / 2, kSmallSamples, time);
    const double ratio = static_cast<double>(n_large) / (n_large / 2);
    result.cost_exponent = std::clamp(exponent_between(mean_seconds(small), result.core_seconds, ratio),
                                      kLeastExponent, kLargestExponent);
    measure_many_grains(scene, time.deadline, result);
  }
  return result;
}

}  // namespace floc
