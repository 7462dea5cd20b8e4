#include "floc/scene/scene_softening.h"

#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/scene/read_scene.h"
#include "support/places.h"

namespace floc {
namespace {

Scene softened_scene(const std::string& name, const std::vector<std::string>& changes = {}) {
  return read_scene(test::source_directory() + "/data/scenes/" + name + ".toml", changes);
}

/// Returns the softening in the assembly and in each stage of a run.
std::vector<double> factors_of(const RunOptions& run) {
  std::vector<double> factors = {run.assembly.cell.applied_to(run.relaxation).softening};
  for (const LoadStage& stage : run.load) factors.push_back(stage.cell.applied_to(run.relaxation).softening);
  return factors;
}

TEST(SceneSoftening, IsThatOfItsParts) {
  EXPECT_EQ(softening_of(softened_scene("demo")), (Softening{1.0, 1.0}));
  EXPECT_EQ(softening_of(softened_scene("demo", {"equilibrium.softening=5"})), (Softening{5.0, 5.0}));
  EXPECT_EQ(softening_of(softened_scene("demo", {"assembly.softening=10"})), (Softening{10.0, 1.0}));
  EXPECT_EQ(softening_of(softened_scene("demo", {"load.0.softening=3"})), (Softening{1.0, 3.0}));
}

TEST(SceneSoftening, TheLargestCanBeGivenAndAnyLargerIsRefused) {
  // Disks with kappa = 1e5 and D0 = 1e-3 a. With springs that are softer by a factor of 10, the overlap is a tenth of
  // D0; a larger overlap is not allowed.
  EXPECT_NEAR(largest_softening(softened_scene("demo")).load, 10.0, 1e-9);
  for (const char* name : {"demo", "cohesionless_cycle", "spheres_demo", "powder3d", "oedometer"}) {
    const Softening largest = largest_softening(softened_scene(name));
    const auto with = [&](const std::string& key, double factor) {
      return std::vector<std::string>{key + "=" + std::to_string(factor)};
    };
    ASSERT_GT(largest.assembly, 1.0) << name;
    EXPECT_NO_THROW((void)softened_scene(name, with("assembly.softening", 0.999 * largest.assembly))) << name;
    EXPECT_THROW((void)softened_scene(name, with("assembly.softening", 1.001 * largest.assembly)), InputError)
        << name;
  }
  for (const char* name : {"rigid_disks_demo", "compaction_demo"})
    EXPECT_EQ(largest_softening(softened_scene(name)), Softening{}) << name;
  // The assembly is dry. Liquid bridges cannot be softened, so the loading has no softening.
  EXPECT_EQ(largest_softening(softened_scene("wet_demo")).load, 1.0);
}

TEST(SceneSoftening, StagesThatImposeAStrainKeepTheirSprings) {
  Scene scene = softened_scene("oedometer");
  const std::vector<bool> strained = strained_stages(scene);
  give_softening({4.0, 2.0}, scene);
  const std::vector<double> factors = factors_of(scene);
  ASSERT_EQ(factors.size(), strained.size() + 1);
  EXPECT_EQ(factors[0], 4.0);
  bool any = false;
  for (std::size_t k = 0; k < strained.size(); ++k) {
    EXPECT_EQ(factors[k + 1], strained[k] ? 1.0 : 2.0) << k;
    any = any || strained[k];
  }
  EXPECT_TRUE(any) << "an oedometer imposes strains";
}

TEST(SceneSoftening, SettingsKeepThePartsWhoseSofteningIsTheirs) {
  Scene scene = softened_scene("demo", {"assembly.softening=10", "load.0.softening=3"});
  const std::vector<double> before = factors_of(scene);
  NumericalSettings settings = settings_of(scene);
  EXPECT_EQ(settings.softening, (Softening{10.0, 3.0}));
  settings.time_step = 0.2;
  apply_settings(settings, scene);
  EXPECT_EQ(scene.relaxation.time_step, 0.2);
  EXPECT_EQ(factors_of(scene), before);
  settings.softening = {};
  apply_settings(settings, scene);
  EXPECT_EQ(factors_of(scene), std::vector<double>(before.size(), 1.0));
}

}  // namespace
}  // namespace floc
