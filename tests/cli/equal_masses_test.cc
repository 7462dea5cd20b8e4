#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "support/kill_and_resume.h"
#include "support/places.h"
#include "support/threaded_run.h"

namespace floc::test {
namespace {

std::string scene_of_equal_masses() {
  return small_scene() + "[equilibrium]\nmasses = \"equal\"\n";
}

TEST(EqualMasses, SurviveKillsWithoutATrace) {
  kill_and_resume(10, 37, scene_of_equal_masses());
}

TEST(EqualMasses, ThreadsLeaveNoTrace) {
  expect_no_trace_of_threads(scene_of_equal_masses());
}

/// Shipped scene of a kind, with changes after which a run takes about a second.
struct KindOfScene {
  const char* scene;
  std::string changes;
};

void PrintTo(const KindOfScene& kind, std::ostream* out) {
  *out << kind.scene;
}

class EqualMassesOfAKind : public testing::TestWithParam<KindOfScene> {};

/// floc verify compares the masses in a state with the density of its scene.
TEST_P(EqualMassesOfAKind, LeaveEquilibriaWithOwnMasses) {
  const ScratchDirectory scratch;
  const std::string scene = source_directory() + "/data/scenes/" + GetParam().scene + ".toml ";
  const Outcome made =
      run_floc("run " + scene + GetParam().changes + " --set equilibrium.masses=equal -o run", scratch.path());
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome verified = run_floc("verify run", scratch.path());
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, EqualMassesOfAKind,
    testing::Values(
        KindOfScene{"demo",
                    "--set grains.count=60 --set load.0.to=0.1 --set load.0.steps_per_decade=2 --until 2"},
        KindOfScene{"demo", "--set grains.count=60 --set equilibrium.softening=10 --until 2"},
        KindOfScene{"cohesionless_cycle", "--set grains.count=60 --until 1"},
        KindOfScene{"powder3d", "--set grains.count=60 --until 2"},
        KindOfScene{"wet_demo", "--set grains.count=60 --until 1"},
        KindOfScene{"spheres_demo",
                    "--set grains.count=60 --set "
                    "'grains.diameter={distribution=\"uniform\",min=5e-4,max=1e-3}' --until 1"},
        KindOfScene{"compaction_demo",
                    "--set grains.count=60 --set 'grains.diameter={distribution=\"uniform\",min=0.5,max=1}' "
                    "--set equilibrium.stop_time=1000"},
        KindOfScene{"biaxial_dense", "--set grains.count=60 --until 3"},
        KindOfScene{"constant_volume", "--set grains.count=60 --until 2"}),
    [](const auto& kind) { return std::string(kind.param.scene) + std::to_string(kind.index); });

}  // namespace
}  // namespace floc::test
