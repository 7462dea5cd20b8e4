#include "floc/tradeoff/tradeoff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "floc/scene/cell_defaults.h"
#include "floc/scene/read_scene.h"
#include "support/places.h"

namespace floc {
namespace {

using testing::HasSubstr;

Scene small_scene(int n_grains) {
  return read_scene(
      test::source_directory() + "/data/scenes/type1_rolling_small.toml",
      {"grains.count=" + std::to_string(n_grains), "load.0.to=0.05", "load.0.steps_per_decade=2"});
}

TEST(Tradeoff, KeepsItsBudgetAndSaysWhatItLeftOut) {
  for (const double budget : {0.05, 1.0}) {
    TradeoffOptions options;
    options.budget = budget;
    const double start = processor_seconds();
    const Tradeoff tradeoff = study_tradeoff(small_scene(60), options);
    // The budget may be exceeded a little: a run can be interrupted only between chunks of 500 steps, which take a few
    // ms here, and the moduli of the sample are still computed after an interruption.
    EXPECT_LT(processor_seconds() - start, budget + 0.2);
    EXPECT_FALSE(tradeoff.left_out.empty());
  }
}

TEST(Tradeoff, SettingsThatDoNotFitAreLeftOutByName) {
  TradeoffOptions options;
  options.budget = 1.0;
  const Tradeoff tradeoff = study_tradeoff(small_scene(400), options);
  EXPECT_EQ(tradeoff.n_grains, 40);
  EXPECT_THAT(
      tradeoff.left_out.front(),
      HasSubstr("the samples have 40 grains instead of 400, because more grains do not fit into the budget"));
}

TEST(Tradeoff, ComparesOnlySettingsThatLeaveThePhysicsAlone) {
  const Scene scene = small_scene(100);
  const auto settings = studied_settings(scene);
  EXPECT_TRUE(settings.front().is_reference());
  for (const StudiedSetting& setting : settings) {
    const RunOptions options = run_options(scene, setting, 7);
    EXPECT_EQ(options.law, scene.law) << setting.parameter;
    EXPECT_EQ(options.seed, 7u);
    EXPECT_EQ(options.grains.count, setting.n_grains > 0 ? setting.n_grains : 100) << setting.parameter;
    EXPECT_GE(options.relaxation.time_step, settings.front().numerical.time_step)
        << "nothing is finer than the reference";
    EXPECT_GE(options.relaxation.tolerance.force, settings.front().numerical.tolerance);
  }
}

TEST(Tradeoff, ShortensTheTimeStepsOfPartsWithThatOfTheRun) {
  const Scene scene = read_scene(test::source_directory() + "/data/scenes/spheres_demo.toml",
                                 {"run.time_step=0.2", "assembly.time_step=0.7", "load.0.time_step=0.1"});
  const auto steps = [&](double time_step) {
    StudiedSetting setting;
    setting.numerical.time_step = time_step;
    const RunOptions options = run_options(scene, setting, 1);
    return std::vector<double>{*options.assembly.cell.time_step, *options.load[0].cell.time_step};
  };
  EXPECT_THAT(steps(0.05), testing::ElementsAre(testing::DoubleEq(0.175), testing::DoubleEq(0.025)));
  EXPECT_THAT(steps(0.36), testing::ElementsAre(0.7, 0.1)) << "longer steps of these parts may be unstable";
}

TEST(Tradeoff, ScalesTheCapsOfEveryPartAndTheMassOfTheLoadAlone) {
  const Scene scene =
      read_scene(test::source_directory() + "/data/scenes/type1_rolling_small.toml",
                 {"assembly.strain_rate_cap=0.04", "load.0.cell_mass=0.2", "load.1.inertial_number_cap=1e-3"});
  StudiedSetting setting;
  setting.rate_cap_factor = 5.0;
  setting.cell_mass_factor = 0.1;
  const RunOptions options = run_options(scene, setting, 1);
  const auto of = [&](const CellResponse& cell) { return cell.applied_to(options.relaxation); };
  EXPECT_DOUBLE_EQ(of(options.assembly.cell).strain_rate_cap.value(), 0.2);
  EXPECT_DOUBLE_EQ(of(options.assembly.cell).cell_mass, 1.0);
  EXPECT_DOUBLE_EQ(of(options.load[0].cell).strain_rate_cap.value(), 0.25);
  EXPECT_DOUBLE_EQ(of(options.load[0].cell).cell_mass, 0.02);
  EXPECT_DOUBLE_EQ(of(options.load[1].cell).inertial_number_cap.value(), 5e-3);
  EXPECT_DOUBLE_EQ(of(options.load[1].cell).cell_mass, 0.1 * kLoadCellMass);
}

TEST(Tradeoff, PairedPathsStartFromTheSameStatesAndTheReferenceEqualsItself) {
  const Scene scene = small_scene(40);
  const auto settings = studied_settings(scene);
  const Deadline never(1e6);
  const RunOptions options = run_options(scene, settings[0], 3);
  SamplePath reference = make_sample(options, {}, nullptr, never);
  ASSERT_TRUE(reference.whole()) << reference.failure;
  settle(options.relaxation, never, reference);
  // With the same initial states and the same options, results must be identical bit for bit.
  const SamplePath again = make_sample(options, {}, &reference, never);
  ASSERT_EQ(again.states.size(), reference.states.size());
  for (std::size_t k = 0; k < again.states.size(); ++k) {
    EXPECT_EQ(again.states[k].observation[kPhi], reference.states[k].observation[kPhi]) << k;
    EXPECT_EQ(again.states[k].observation[kB], reference.states[k].observation[kB]) << k;
    // The states of the reference were made with strict settings, so they do not change when they are settled.
    EXPECT_EQ(reference.states[k].settled[kPhi], reference.states[k].observation[kPhi]) << k;
  }
  const ObservableErrors errors = compare({&reference}, {&again}, std::nullopt);
  EXPECT_EQ(errors[kPhi].before.high, 0.0);
  EXPECT_EQ(errors[kPhi].mean.difference, 0.0);
}

}  // namespace
}  // namespace floc
