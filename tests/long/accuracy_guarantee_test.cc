#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "floc/prices/accuracy.h"
#include "floc/scene/read_scene.h"
#include "floc/tradeoff/comparison.h"
#include "support/places.h"

// Tests of the errors that the table [accuracy] of a scene guarantees. The scenes and seeds are not among the data of
// the shipped table. To run only these tests:
//   build/release/tests/long_tests --gtest_filter='AccuracyGuarantee.*'

namespace floc {
namespace {

struct HeldOut {
  const char* scene;
  std::uint64_t seed;
};
constexpr HeldOut kHeldOut[] = {{"demo", 501},
                                {"type2_no_rolling", 502},
                                {"type2_rolling_large", 503},
                                {"type1_rolling_small", 504},
                                {"type1_no_rolling", 505}};
constexpr int kSamplesOfStudy = 4;

/// Accuracy that a scene requests, and the error that is guaranteed for each observable (given by its index).
struct Guarantee {
  WantedAccuracy wanted;
  std::vector<std::pair<int, double>> of_observables;

  // Sums over all scenes. n and n_means count the values of single states and of sample means; kept and means_kept
  // count those of these values whose error does not exceed the guaranteed error.
  int n = 0, kept = 0, n_means = 0, means_kept = 0;
  double core_seconds = 0.0, strict_seconds = 0.0;

  double kept_share() const { return static_cast<double>(kept) / n; }
  double gain() const { return strict_seconds / core_seconds; }
};

std::vector<const SamplePath*> pointers(const std::vector<SamplePath>& paths) {
  std::vector<const SamplePath*> all;
  for (const SamplePath& p : paths) all.push_back(&p);
  return all;
}

/// Counts the values of observable `k` in the states of a sample, and how many of these values have an error of at most
/// the guaranteed error.
void count_states(int k, double guaranteed_error, const SamplePath& reference, const SamplePath& path,
                  Guarantee& guarantee) {
  const std::vector<bool> same = before_collapse(reference, path);
  for (std::size_t i = 0; i < path.states.size(); ++i) {
    const ObservedState& state = path.states[i];
    const Observation& truth = same[i] ? reference.states[i].observation : state.settled;
    const double error = std::abs(state.observation[k] - truth[k]);
    if (!std::isfinite(error)) continue;
    ++guarantee.n;
    guarantee.kept += error <= guaranteed_error * size_of(k, state.observation, truth);
  }
}

void count_means(const std::vector<SamplePath>& references, const std::vector<SamplePath>& paths,
                 Guarantee& guarantee) {
  const ObservableErrors errors = compare(pointers(references), pointers(paths), std::nullopt);
  for (const auto& [k, guaranteed_error] : guarantee.of_observables) {
    const MeanDifference& mean = errors[static_cast<std::size_t>(k)].mean;
    if (mean.n < kSamplesOfStudy) continue;
    constexpr double kStudent = 3.18;  // Student's t for four samples at 95 %
    ++guarantee.n_means;
    guarantee.means_kept += std::abs(mean.difference) <= guaranteed_error + kStudent * mean.standard_error;
  }
}

Scene scene_of(const HeldOut& held, const WantedAccuracy& wanted) {
  std::vector<std::string> changes = {"grains.count=60", "load.0.steps_per_decade=3",
                                      "load.1.steps_per_decade=1"};
  for (const auto& [key, error] : wanted) changes.push_back("accuracy." + key + "=" + std::to_string(error));
  return read_scene(test::source_directory() + "/data/scenes/" + held.scene + ".toml", changes);
}

/// Makes a complete sample. Also relaxes each of its states to an equilibrium under strict settings.
SamplePath sample(const RunOptions& options, const RelaxationOptions& strict, const SamplePath* reference) {
  const Deadline never(1e6);
  SamplePath path = make_sample(options, {}, reference, never);
  if (path.whole()) settle(strict, never, path);
  EXPECT_TRUE(path.whole()) << path.failure;
  return path;
}

void hold_out(const HeldOut& held, std::vector<Guarantee>& guarantees) {
  StudiedSetting finest;
  finest.numerical = strict_settings();
  const Scene scene = scene_of(held, {});
  std::vector<SamplePath> references;
  for (int s = 0; s < kSamplesOfStudy; ++s) {
    const RunOptions options = run_options(scene, finest, held.seed + s);
    references.push_back(sample(options, options.relaxation, nullptr));
  }
  for (Guarantee& guarantee : guarantees) {
    StudiedSetting chosen;
    chosen.numerical = NumericalSettings::of(scene_of(held, guarantee.wanted).relaxation);
    std::vector<SamplePath> paths;
    for (int s = 0; s < kSamplesOfStudy; ++s) {
      const RelaxationOptions strict = run_options(scene, finest, held.seed + s).relaxation;
      paths.push_back(sample(run_options(scene, chosen, held.seed + s), strict, &references[s]));
      guarantee.strict_seconds += references[s].core_seconds;
      guarantee.core_seconds += paths[s].core_seconds;
      for (const auto& [k, error] : guarantee.of_observables)
        count_states(k, error, references[s], paths[s], guarantee);
    }
    count_means(references, paths, guarantee);
  }
}

void print(const Guarantee& guarantee) {
  for (const auto& [key, error] : guarantee.wanted) std::printf("%s = %g, ", key.c_str(), error);
  std::printf(
      "kept by %d of %d values of states (%.1f %%) and %d of %d means; %.1f times cheaper than strict\n",
      guarantee.kept, guarantee.n, 100.0 * guarantee.kept_share(), guarantee.means_kept, guarantee.n_means,
      guarantee.gain());
}

TEST(AccuracyGuarantee, HoldsForScenesAndSeedsThatDidNotMakeTheTable) {
  std::vector<Guarantee> guarantees = {
      {{{"phi", 1e-3}, {"moduli", 0.01}}, {{kPhi, 1e-3}, {kB, 0.01}, {kG, 0.01}}},
      {{{"phi", 0.01}, {"moduli", 0.05}}, {{kPhi, 0.01}, {kB, 0.05}, {kG, 0.05}}}};
  for (const HeldOut& held : kHeldOut) hold_out(held, guarantees);
  for (const Guarantee& guarantee : guarantees) {
    print(guarantee);
    EXPECT_GE(guarantee.kept_share(), 0.95);
  }
  // If a scene requests an accuracy of 1 % in phi and 5 % in the moduli, at least four fifths of the processor time
  // must be saved.
  EXPECT_GE(guarantees.back().gain(), 5.0);
}

}  // namespace
}  // namespace floc
