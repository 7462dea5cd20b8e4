#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/scene/read_scene.h"
#include "support/message_of.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string scene_of(int dimension, const std::string& load) {
  return "[scene]\ndimension = " + std::to_string(dimension) +
         "\nunits = \"reduced\"\n"
         "[grains]\ncount = 40\ndiameter = {distribution = \"constant\", value = 1.0}\n"
         "[contact]\nnormal = {law = \"linear\", stiffness = 1e3}\ndamping = {restitution = 0.1}\n"
         "friction = {coefficient = 0.5, stiffness = 1e3}\n"
         "[cell]\nsolid_fraction = 0.36\nmass = 1\ninertial_number_cap = 1e-3\n"
         "[assembly]\nprotocol = \"direct\"\npressure = 1.0\n" +
         load;
}

std::vector<LoadStage> read(int dimension, const std::string& load) {
  return parse_scene(scene_of(dimension, load), "s.toml", ".").load;
}

std::string faults(int dimension, const std::string& load) {
  return test::message_of([&] { read(dimension, load); });
}

constexpr AxisLoad kept{AxisLoad::kept_stress, 0.0};
AxisLoad stress(double end) {
  return {AxisLoad::stress, end};
}
AxisLoad strain(double end) {
  return {AxisLoad::strain, end};
}

TEST(ReadLoad, TestsSayWhatEachAxisIsLoadedWith) {
  const auto load = read(3, R"([[load]]
control = "oedometric"
to = 10.0
steps_per_decade = 4
[[load]]
control = "triaxial"
axis = 1
strain = 0.1
strain_step = 0.03
[[load]]
control = "constant_volume"
strain = -0.1
steps = 2
[[load]]
control = "axes"
axes = [{stress = 2.0}, {strain = 0.1}, {as = 1}]
steps = 3
)");
  ASSERT_EQ(load.size(), 4u);
  EXPECT_EQ(load[0].axes, (std::vector{strain(0), strain(0), stress(10)}));
  EXPECT_EQ(load[0].axis, 2);
  EXPECT_EQ(load[0].name, "load");
  EXPECT_EQ(load[1].axes, (std::vector{strain(0.1), kept, kept}));
  EXPECT_EQ(load[1].steps, 4);
  EXPECT_EQ(load[1].name, "triaxial");
  EXPECT_EQ(load[2].axes, (std::vector{strain(0.05), strain(0.05), strain(-0.1)}));
  EXPECT_EQ(load[3].axes, (std::vector{stress(2), strain(0.1), stress(2)}));
}

TEST(ReadLoad, ASimpleShearKeepsTheStressOfItsPlanesAndEveryOtherLength) {
  const auto load = read(3, R"([[load]]
control = "simple_shear"
strain = 0.5
strain_step = 0.1
[[load]]
control = "simple_shear"
axis = 2
strain = -2.5
steps = 3
)");
  ASSERT_EQ(load.size(), 2u);
  EXPECT_EQ(load[0].axes, (std::vector{strain(0), strain(0), kept}));
  EXPECT_EQ(load[0].axis, 2);
  EXPECT_EQ(load[0].shear, 0.5);
  EXPECT_EQ(load[0].steps, 5);
  EXPECT_EQ(load[0].name, "simple_shear");
  EXPECT_EQ(load[1].axes, (std::vector{strain(0), kept, strain(0)}));
  EXPECT_EQ(load[1].shear, -2.5);
  const std::string shear = "[[load]]\ncontrol = \"simple_shear\"\nsteps = 2\n";
  EXPECT_THAT(faults(2, shear), HasSubstr("load.0.strain"));
  EXPECT_THAT(faults(2, shear + "strain = 0.1\nto = 2\n"), HasSubstr("expected the key strain"));
  EXPECT_THAT(faults(2, shear + "strain = 0.1\naxis = 1\n"),
              HasSubstr("perpendicular to the planes that are sheared"));
  EXPECT_THAT(faults(2, shear + "strain = 1000\n"), HasSubstr("from -100 to 100"));
}

TEST(ReadLoad, TheSameStressOnEveryAxisIsTheIsotropicLoad) {
  const auto load = read(2, R"([[load]]
control = "axes"
axes = [{stress = 10.0}, {stress = 10.0}]
steps_per_decade = 4
)");
  EXPECT_TRUE(load[0].is_isotropic());
  EXPECT_EQ(load[0].to, 10.0);
  EXPECT_EQ(load[0].name, "load");
}

TEST(ReadLoad, FaultsSayWhatWasExpected) {
  const std::string oedometer = "[[load]]\ncontrol = \"oedometric\"\n";
  EXPECT_THAT(faults(2, oedometer + "to = 2\nstrain = 0.1\nsteps = 1\n"),
              AllOf(HasSubstr("s.toml:"), HasSubstr("load.0.strain"), HasSubstr("is given together with to")));
  EXPECT_THAT(faults(2, oedometer + "steps = 1\n"), HasSubstr("expected either to or strain"));
  EXPECT_THAT(faults(2, oedometer + "to = 2\n"), HasSubstr("expected steps or steps_per_decade"));
  EXPECT_THAT(faults(2, oedometer + "to = 2\naxis = 3\nsteps = 1\n"), HasSubstr("1 or 2"));
  EXPECT_THAT(faults(2, oedometer + "to = -2\nsteps = 1\n"), HasSubstr("a stress >= 0"));
  EXPECT_THAT(faults(2, oedometer + "to = 0\nsteps = 1\n"), HasSubstr("without adhesion"));
  EXPECT_THAT(faults(2, oedometer + "strain = 2.5\nsteps = 1\n"), HasSubstr("the cell would nearly vanish"));
  EXPECT_THAT(faults(2, oedometer + "strain = 0.5\nstrain_step = 1e-6\n"), HasSubstr("at most 10000"));
  EXPECT_THAT(faults(2, oedometer + "to = 5\nstrain_step = 0.1\n"), HasSubstr("expected steps"));
  EXPECT_THAT(faults(2, oedometer + "strain = 0.5\nsteps = 1\nstrain_step = 0.1\n"),
              HasSubstr("expected only one of"));
  EXPECT_THAT(faults(2, "[[load]]\ncontrol = \"constant_volume\"\nto = 2\nsteps = 1\n"),
              HasSubstr("expected the key strain"));
  EXPECT_THAT(faults(2, "[[load]]\ncontrol = \"axes\"\naxes = [{stress = 1}, {stress = 1}, {stress = 1}]\n"),
              HasSubstr("has 3 tables: expected 2"));
  EXPECT_THAT(faults(2, "[[load]]\ncontrol = \"axes\"\naxes = [{stress = 1, strain = 0.1}, {stress = 1}]\n"),
              HasSubstr("is given together with stress: expected only one of them"));
  EXPECT_THAT(faults(2, "[[load]]\ncontrol = \"axes\"\naxes = [{as = 1}, {stress = 1}]\nsteps = 1\n"),
              HasSubstr("the number of an earlier axis"));
  EXPECT_THAT(faults(2, "[[load]]\nto = 2\nsteps = 1\nstrain = 0.1\n"),
              HasSubstr("the load of this stage is isotropic"));
  EXPECT_THAT(faults(2, "[[load]]\ncontrol = \"round\"\nto = 2\n"), HasSubstr("oedometric"));
}

TEST(ReadLoad, StrainsTogetherDoNotCloseTheCell) {
  EXPECT_THAT(
      faults(3, "[[load]]\ncontrol = \"axes\"\naxes = [{strain = 0.9}, {as = 1}, {as = 1}]\nsteps = 9\n"),
      AllOf(HasSubstr("add up to 2.7"), HasSubstr("the cell would nearly vanish")));
  const std::string thinner =
      "[[load]]\ncontrol = \"axes\"\naxes = [{strain = 1.9}, {stress = 2}]\nsteps = 9\n";
  EXPECT_EQ(faults(2, thinner), "");
}

/// The sample is unloaded to zero stress. If a later stage keeps this stress on an axis, it cannot also remove the
/// adhesion.
TEST(ReadLoad, AStressOfZeroIsNotKeptWithoutAdhesion) {
  std::string cohesive =
      scene_of(2, "[[load]]\nto = 0\n[[load]]\ncontrol = \"triaxial\"\nstrain = 0.1\nsteps = 2\n");
  const auto replace = [&](const std::string& what, const std::string& by) {
    cohesive.replace(cohesive.find(what), what.size(), by);
  };
  replace("damping", "adhesion = {law = \"tail\", force = 1.0, range = 1e-2}\ndamping");
  replace("inertial_number_cap = 1e-3", "strain_rate_cap = 0.05");
  EXPECT_NO_THROW(parse_scene(cohesive, "s.toml", "."));
  try {
    parse_scene(cohesive + "set = {adhesion.force = 0}\n", "s.toml", ".");
    FAIL() << "expected a fault";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("would keep a stress of 0"), HasSubstr("without adhesion")));
  }
}

/// If a stage gives a number of steps per decade, the stress at its start must be known. The stress on a strained axis
/// becomes known only during the run.
TEST(ReadLoad, StepsADecadeNeedAStressThatIsKnown) {
  const std::string first = "[[load]]\ncontrol = \"triaxial\"\nstrain = 0.1\nsteps = 2\n";
  EXPECT_THAT(faults(2, first + "[[load]]\nto = 2\nsteps_per_decade = 4\n"), HasSubstr("expected steps"));
  EXPECT_THAT(faults(2, first + "[[load]]\ncontrol = \"oedometric\"\nto = 2\nsteps_per_decade = 4\n"),
              HasSubstr("not known before the run"));
  EXPECT_EQ(read(2, first + "[[load]]\nto = 2\nsteps = 4\n")[1].steps, 4);
}

}  // namespace
}  // namespace floc
