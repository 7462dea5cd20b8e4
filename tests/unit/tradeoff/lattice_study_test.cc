#include "floc/tradeoff/lattice_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "floc/scene/read_scene.h"
#include "support/message_of.h"
#include "support/places.h"

namespace floc {
namespace {

using testing::HasSubstr;

Scene few_disks() {
  return read_scene(test::source_directory() + "/data/scenes/cemented2d.toml",
                    {"grains.count=20", "grains.diameter={distribution=\"uniform\", min=0.5, max=1.0}"});
}

/// The result must depend on the number of nodes per diameter, and hardly on the tolerance or the method of the solver.
TEST(LatticeStudy, NodesADiameterDecideAndTheToleranceDoesNot) {
  TradeoffOptions options;
  options.budget = 300.0;
  options.max_samples = 2;
  const Tradeoff tradeoff = study_lattice(few_disks(), {}, options);
  EXPECT_EQ(tradeoff.n_states, 1);
  EXPECT_GT(tradeoff.reference[kLatticeE], 0.0);
  EXPECT_GT(tradeoff.scatter[kLatticeE], 0.0);
  std::map<std::string, ObservableError> errors;
  for (const MeasuredSetting& m : tradeoff.settings)
    errors[m.setting.parameter + " " + m.setting.value] = m.errors[kLatticeE];
  EXPECT_EQ(errors.at("strict all").after.high, 0.0);
  const double plain = errors.at("scene as it is").after.high;
  for (const char* nodes : {"nodes_a_diameter 5", "nodes_a_diameter 8", "nodes_a_diameter 22"})
    EXPECT_GT(std::abs(errors.at(nodes).after.high - plain), 1e-3) << nodes;
  for (const char* solution : {"tolerance 1e-06", "tolerance 1e-08", "method factor", "method iterative"})
    EXPECT_NEAR(errors.at(solution).after.high, plain, 1e-5) << solution;
}

TEST(LatticeStudy, RefusesWhatItCannotCement) {
  const auto refusal = [](const Scene& scene, const LatticeStudyOptions& lattice) -> std::string {
    return test::message_of([&] { (void)study_lattice(scene, lattice, {}); });
  };
  EXPECT_THAT(refusal(few_disks(), {.matrix_content = 1.5}), HasSubstr("matrix content"));
  EXPECT_THAT(refusal(few_disks(), {.stiffness_ratio = 0.0}), HasSubstr("stiffness ratio"));
  const std::string scenes = test::source_directory() + "/data/scenes/";
  EXPECT_THAT(refusal(read_scene(scenes + "compaction_demo.toml"), {}), HasSubstr("in a periodic cell"));
  EXPECT_THAT(refusal(read_scene(scenes + "rigid_disks_demo.toml"), {}), HasSubstr("elastic disks or spheres"));
}

}  // namespace
}  // namespace floc
