#include "floc/scene/scene_kind.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "floc/scene/read_scene.h"
#include "support/places.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

std::string scene_folder() {
  return test::source_directory() + "/data/scenes";
}

std::string kind_of(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return scene_kind(read_scene(scene_folder() + "/" + name + ".toml", overrides));
}

const std::map<std::string, std::string>& kinds_of_shipped_scenes() {
  static const std::map<std::string, std::string> kinds = {
      {"bed_demo", "disks-cohesionless-walls-gravity"},
      {"biaxial_cohesive", "disks-cohesive-biaxial"},
      {"biaxial_dense", "disks-cohesionless-biaxial"},
      {"biaxial_loose", "disks-cohesionless-biaxial"},
      {"cemented2d", "disks-cohesionless"},
      {"cemented3d", "spheres-cohesionless"},
      {"cohesionless_cycle", "disks-cohesionless"},
      {"compaction", "spheres-cohesive-walls"},
      {"compaction_demo", "spheres-cohesive-walls"},
      {"constant_volume", "disks-cohesionless-constant-volume"},
      {"demo", "disks-cohesive"},
      {"disks_shear_demo", "rigid-disks-simple-shear"},
      {"oedometer", "disks-cohesive-oedometer"},
      {"pentagons", "rigid-polygons-simple-shear"},
      {"pentagons_box_demo", "rigid-polygons-walls-gravity"},
      {"pentagons_demo", "rigid-polygons"},
      {"pentagons_shear_demo", "rigid-polygons-simple-shear"},
      {"polyhedra", "rigid-polyhedra"},
      {"polyhedra_demo", "rigid-polyhedra"},
      {"powder3d", "spheres-cohesive"},
      {"rigid_disks_demo", "rigid-disks"},
      {"rigid_spheres", "rigid-spheres-triaxial"},
      {"rolling_shear", "disks-cohesionless-simple-shear"},
      {"spheres_a", "beads-hertz"},
      {"spheres_a0", "beads-hertz"},
      {"spheres_b", "beads-hertz"},
      {"spheres_c", "beads-hertz"},
      {"spheres_d", "beads-hertz"},
      {"spheres_demo", "beads-hertz"},
      {"stiff_contacts", "disks-cohesive"},
      {"type1_no_rolling", "disks-cohesive"},
      {"type1_rolling_small", "disks-cohesive"},
      {"type2_no_rolling", "disks-cohesive"},
      {"type2_rolling_large", "disks-cohesive"},
      {"type2_rolling_small", "disks-cohesive"},
      {"wet_demo", "spheres-wet"},
      {"wet_spheres", "spheres-wet"},
      {"wet_tension", "spheres-wet-axes"},
      {"wide_span", "rigid-disks-simple-shear"},
  };
  return kinds;
}

TEST(SceneKind, IsKnownForEveryShippedScene) {
  for (const auto& entry : fs::directory_iterator(scene_folder())) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().stem().string();
    ASSERT_TRUE(kinds_of_shipped_scenes().contains(name)) << name;
    EXPECT_EQ(kind_of(name), kinds_of_shipped_scenes().at(name)) << name;
  }
}

TEST(SceneKind, NumbersOfASceneDoNotChangeIt) {
  EXPECT_EQ(kind_of("demo", {"grains.count=50", "contact.normal.stiffness=1e6", "load.0.to=1"}),
            kind_of("demo"));
  EXPECT_EQ(kind_of("spheres_a", {"contact.friction.coefficient=0.1"}), kind_of("spheres_a"));
}

TEST(SceneKind, CohesionThatAStageSwitchesOffCounts) {
  EXPECT_EQ(kind_of("demo", {"load.1.set={adhesion.force=0}"}), "disks-cohesive");
}

TEST(SceneKind, LoadsAreNamedOnceInOrder) {
  EXPECT_EQ(kind_of("oedometer"), "disks-cohesive-oedometer");  // has three stages
  EXPECT_EQ(kind_of("biaxial_dense", {"load.0.control=simple_shear"}), "disks-cohesionless-simple-shear");
}

}  // namespace
}  // namespace floc
