#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "floc/scene/read_scene.h"
#include "support/message_of.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Scene of cohesive disks with kappa = 1e5 and D0 = 1e-3 a. The softening may be at most 10 at low pressures, and at
/// most 5 if the pressure reaches P = 200.
std::string soft_scene(const std::string& more) {
  return R"([scene]
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "constant", value = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e5}
adhesion = {law = "tail", force = 1.0, range = 1e-3}
damping = {restitution = 0.1}
friction = {coefficient = 0.5, stiffness = 1e5}
[cell]
solid_fraction = 0.36
)" + more;
}

constexpr const char* kDirect = "[assembly]\nprotocol = \"direct\"\npressure = 1.0\n";

std::string softening_faults(const std::string& more, const std::vector<std::string>& overrides = {}) {
  return test::message_of([&] { (void)parse_scene(soft_scene(more), "s.toml", ".", overrides); });
}

TEST(CheckSoftening, TheLargestSofteningIsNamed) {
  const std::string scene =
      std::string(kDirect) + "[[load]]\nto = 200.0\nsteps_per_decade = 2\n[equilibrium]\nsoftening = ";
  EXPECT_THAT(softening_faults(scene + "5.0\n"), IsEmpty());
  EXPECT_THAT(softening_faults(scene + "6.0\n"),
              AllOf(HasSubstr("equilibrium.softening = 6"), HasSubstr("expected at most 5"),
                    HasSubstr("s.toml:21:"), Not(HasSubstr("expected at most 10"))));
}

TEST(CheckSoftening, EveryTableIsCheckedAgainstItsOwnSteps) {
  const std::string assembly = std::string(kDirect) + "softening = 10.0\n";
  EXPECT_THAT(softening_faults(assembly + "[[load]]\nto = 200.0\nsteps_per_decade = 2\nsoftening = 5\n"),
              IsEmpty());
  EXPECT_THAT(softening_faults(assembly + "[[load]]\nto = 200.0\nsteps_per_decade = 2\nsoftening = 5.1\n"),
              HasSubstr("load.0.softening = 5.1"));
  EXPECT_THAT(softening_faults(std::string(kDirect) + "softening = 11.0\n"),
              AllOf(HasSubstr("assembly.softening = 11"), HasSubstr("expected at most 10")));
  // The unloading stage starts at the high pressure, which therefore limits its softening.
  EXPECT_THAT(
      softening_faults(std::string(kDirect) + "[[load]]\nto = 200.0\nsteps_per_decade = 2\n"
                                              "[[load]]\nto = 1.0\nsteps_per_decade = 1\nsoftening = 6\n"),
      AllOf(HasSubstr("load.1.softening = 6"), HasSubstr("expected at most 5")));
}

TEST(CheckSoftening, StagesThatImposeAStrainAreNotSoftened) {
  const std::string oedometer =
      std::string(kDirect) + "[[load]]\ncontrol = \"oedometric\"\nto = 2.0\nsteps = 2\n";
  EXPECT_THAT(softening_faults(oedometer + "[equilibrium]\nsoftening = 2\n"), HasSubstr("imposes a strain"));
  EXPECT_THAT(softening_faults(oedometer + "softening = 1\n[equilibrium]\nsoftening = 2\n"), IsEmpty());
  EXPECT_THAT(softening_faults(std::string(kDirect) + "[[load]]\ncontrol = \"axes\"\nsteps = 2\nsoftening = 2\n"
                                                      "axes = [{stress = 2.0}, {stress = 3.0}]\n"),
              IsEmpty());
}

TEST(CheckSoftening, OtherScenesSayWhyNot) {
  const std::string soft = std::string(kDirect) + "[equilibrium]\nsoftening = 2\n";
  EXPECT_THAT(softening_faults(soft, {"contact.adhesion={law = \"constant\", force = 1.0}"}),
              HasSubstr("expected 1 (no softening)"));
  EXPECT_THAT(softening_faults(soft, {"contact.normal.stiffness=1e4"}), HasSubstr("expected 1 (no softening)"));
  EXPECT_THAT(softening_faults(soft + "[accuracy]\nphi = 0.05\n"), HasSubstr("without soft springs"));
  EXPECT_THAT(softening_faults(std::string(kDirect) + "[equilibrium]\nsoftening = 0.5\n"),
              HasSubstr("expected a number >= 1"));
  EXPECT_THAT(softening_faults(std::string(kDirect) + "[equilibrium]\nsoftening = 1\n"), IsEmpty());
}

TEST(CheckSoftening, TheSavedTextKeepsTheKeys) {
  const Scene scene =
      parse_scene(soft_scene(std::string(kDirect) + "softening = 3.0\n[equilibrium]\nsoftening = 2\n"),
                  "s.toml", ".", {"equilibrium.softening=4.0"});
  EXPECT_EQ(scene.relaxation.softening, 4.0);
  EXPECT_EQ(scene.assembly.cell.softening, 3.0);
  const Scene again = parse_scene(scene.text, "s.toml", ".");
  EXPECT_EQ(again.relaxation.softening, 4.0);
  EXPECT_EQ(again.assembly.cell.softening, 3.0);
}

}  // namespace
}  // namespace floc
