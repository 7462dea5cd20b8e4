#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "floc/base/error.h"
#include "floc/scene/check_masses.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_softening.h"
#include "floc/tradeoff/comparison.h"
#include "support/places.h"

namespace floc {
namespace {

using testing::HasSubstr;

/// Shipped scene of a kind, with changes after which a sample takes a fraction of a second.
struct SmallScene {
  const char* kind;
  const char* scene;
  std::vector<std::string> overrides;
};

const std::vector<SmallScene>& small_scenes() {
  static const std::vector<SmallScene> scenes = {
      {"disks-cohesive", "demo", {"grains.count=40", "load.0.to=0.1", "load.0.steps_per_decade=2"}},
      {"disks-cohesionless",
       "cohesionless_cycle",
       {"grains.count=40", "load.0.to=1e-4", "load.0.steps_per_decade=2", "load.1.steps_per_decade=1"}},
      {"beads-hertz", "spheres_demo", {"grains.count=60", "load.0.to=1e5"}},
      {"spheres-cohesive",
       "powder3d",
       {"grains.count=60", "load.0.to=0.02", "load.0.steps_per_decade=2", "load.1.steps_per_decade=1"}},
      {"spheres-wet", "wet_demo", {"grains.count=60"}},
      {"spheres-cohesive-walls", "compaction_demo", {"grains.count=60"}},
      {"disks-cohesive-oedometer",
       "oedometer",
       {"grains.count=40", "load.0.to=0.1", "load.0.steps_per_decade=4", "load.1.to=0.05", "load.2.to=0.1"}},
      {"disks-cohesionless-biaxial",
       "biaxial_dense",
       {"grains.count=60", "load.0.strain=0.05", "load.0.strain_step=4e-3"}},
      {"disks-cohesionless-simple-shear",
       "biaxial_dense",
       {"grains.count=60", "load.0.control=simple_shear", "load.0.strain=0.05", "load.0.strain_step=4e-3"}},
      {"disks-cohesionless-constant-volume",
       "constant_volume",
       {"grains.count=60", "load.0.strain=0.03", "load.0.strain_step=2e-3"}},
      {"rigid-disks", "rigid_disks_demo", {"grains.count=40"}},
      {"rigid-polygons", "pentagons_demo", {"grains.count=30"}},
      {"rigid-polyhedra", "polyhedra_demo", {"grains.count=20"}},
  };
  return scenes;
}

Scene scene_of(const SmallScene& small) {
  return read_scene(test::source_directory() + "/data/scenes/" + small.scene + ".toml", small.overrides);
}

class EveryKind : public testing::TestWithParam<SmallScene> {
 protected:
  void SetUp() override {
    scene = scene_of(GetParam());
    settings = studied_settings(scene);
  }

  /// Makes a sample with the settings of the scene.
  SamplePath sample() const {
    SamplePath path = make_sample(run_options(scene, settings[1], scene.seed), {}, nullptr, Deadline(1e6));
    EXPECT_TRUE(path.whole()) << path.failure;
    return path;
  }

  Scene scene;
  std::vector<StudiedSetting> settings;
};

TEST_P(EveryKind, HasItsName) {
  EXPECT_EQ(scene_kind(scene), GetParam().kind);
}

TEST_P(EveryKind, HasAValueOfEachObservableAndNoErrorAgainstItself) {
  SamplePath path = sample();
  // A small sample may have no tensile forces, too few forces for a tail, or no bend in its consolidation
  // curve.
  const std::set<std::string> rare = {"tail_plus", "tail_minus", "lambda", "alpha", "Phi_max", "M_oedometer"};
  const Observation mean = mean_values({&path}, std::nullopt);
  for (std::size_t k = 0; k < kObservables; ++k) {
    const DeclaredObservable& o = declared_observables()[k];
    if (!applies(o, scene, Subject::states)) continue;
    if (!rare.contains(o.name)) {
      EXPECT_TRUE(std::isfinite(mean[k])) << o.name;
    }
  }
  for (ObservedState& s : path.states) s.settled = s.observation;
  const ObservableErrors errors = compare({&path}, {&path}, std::nullopt);
  for (std::size_t k = 0; k < kObservables; ++k) {
    EXPECT_EQ(errors[k].before.high, 0.0) << declared_observables()[k].name;
    EXPECT_EQ(errors[k].after.high, 0.0) << declared_observables()[k].name;
    EXPECT_EQ(errors[k].mean.difference, 0.0) << declared_observables()[k].name;
  }
  EXPECT_GT(errors[kPhi].before.n + errors[kPhi].after.n, 0);
}

TEST_P(EveryKind, ObservablesOfRigidGrainsAreTheirsAlone) {
  for (const char* rigid : {"z_pairs", "indeterminacy", "force_freedom"})
    EXPECT_EQ(testing::Value(observable_names(scene, Subject::states), testing::Contains(rigid)),
              scene.law.is_rigid())
        << rigid;
  for (const char* elastic : {"B", "G", "B_reuss"})
    EXPECT_EQ(testing::Value(observable_names(scene, Subject::states), testing::Contains(elastic)),
              !scene.law.is_rigid())
        << elastic;
}

TEST_P(EveryKind, SettingsAreThoseOfItsDynamics) {
  std::set<std::string> parameters;
  for (const StudiedSetting& s : settings) parameters.insert(s.parameter);
  for (const char* common : {"strict", "scene", "together", "time_step"})
    EXPECT_TRUE(parameters.contains(common)) << common;
  EXPECT_EQ(parameters.contains("sweep_tolerance"), scene.law.is_rigid());
  EXPECT_EQ(parameters.contains("gap_tolerance"), scene.law.is_rigid());
  EXPECT_EQ(parameters.contains("tolerance"), !scene.law.is_rigid());
  EXPECT_EQ(parameters.contains("moduli"), !scene.law.is_rigid());
  EXPECT_EQ(parameters.contains("strain_rate_cap"), !scene.assembly.box.has_value());
  EXPECT_EQ(parameters.contains("softening"), largest_softening(scene).load >= 3.0);
  const bool has_sizes = scene.grains.smallest() < scene.grains.largest();
  EXPECT_EQ(parameters.contains("masses"), has_sizes && allows_equal_masses(scene));
}

TEST_P(EveryKind, EachSettingChangesItsOptionsAlone) {
  const RunOptions plain = run_options(scene, settings[1], 3);
  EXPECT_EQ(plain.relaxation.tolerance, scene.relaxation.tolerance);
  for (const StudiedSetting& s : settings) {
    const RunOptions options = run_options(scene, s, 3);
    EXPECT_EQ(options.law, scene.law) << s.parameter;
    EXPECT_EQ(options.load.size(), scene.load.size()) << s.parameter;
    EXPECT_EQ(options.relaxation.threads, 1);
    if (s.n_grains == 0) {
      EXPECT_EQ(options.grains.count, scene.grains.count) << s.parameter;
    }
    EXPECT_GE(time_step_of(scene, s), time_step_of(scene, settings[0])) << s.parameter << " " << s.value;
  }
}

TEST_P(EveryKind, AnObservableOfOtherScenesIsRefusedWithTheNearest) {
  for (const DeclaredObservable& o : declared_observables()) {
    if (applies(o, scene, Subject::states)) {
      EXPECT_NO_THROW(require_observables({o.name}, scene, Subject::states)) << o.name;
      continue;
    }
    try {
      require_observables({"phi", o.name}, scene, Subject::states);
      ADD_FAILURE() << o.name << " is not refused";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string("--observables ") + o.name));
      EXPECT_THAT(error.what(), HasSubstr(GetParam().kind));
      EXPECT_THAT(error.what(), HasSubstr("most similar name is "));
    }
  }
}

std::string name_of_kind(const testing::TestParamInfo<SmallScene>& info) {
  std::string name = info.param.kind;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryKind, testing::ValuesIn(small_scenes()), name_of_kind);

}  // namespace
}  // namespace floc
