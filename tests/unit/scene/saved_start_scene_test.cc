#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/base/sha256.h"
#include "floc/io/state_file.h"
#include "floc/loading/run_plan.h"
#include "floc/scene/cell_defaults.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "support/dynamics.h"
#include "support/message_of.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const kSavedStartScene = R"([scene]
dimension = 2
units = "reduced"
[contact]
normal = {law = "linear", stiffness = 1e5}
adhesion = {law = "tail", force = 1.0, range = 1e-3}
damping = {restitution = 0.015}
friction = {coefficient = 0.5, stiffness = 1e5}
rolling = {coefficient = 0.005, stiffness = 10}
[cell]
mass = 1
strain_rate_cap = 0.05
[assembly]
protocol = "state"
state = "saved.h5"
copies = [3, 2]
pressure = 0.01
[[load]]
to = 1.0
steps = 2
)";

/// Fixture: a directory with a state of 30 disks, whose masses are half of the default masses.
class SceneOfAState : public testing::Test {
 protected:
  SceneOfAState() {
    saved_.packing = test::gas_of(30, test::cohesive_law(), 0.5);
    for (double& m : saved_.packing.grains.mass) m *= 0.5;
    save(saved_);
  }

  template <int Dim>
  void save(const State<Dim>& state) const {
    write_state(scratch_.file("saved.h5"), state);
  }
  Scene read(const std::vector<std::string>& overrides = {}, const std::string& text = kSavedStartScene) const {
    return parse_scene(text, "s.toml", scratch_.path(), overrides);
  }
  std::string faults(const std::vector<std::string>& overrides = {}) const {
    return test::message_of([&] { read(overrides); });
  }

  State<2> saved_;
  test::ScratchDirectory scratch_;
};

/// At the first pressure, a run from a state has the mass of the cell that is the default for loading stages. With
/// vibration, the sample is assembled again, and the default for the assembly applies.
TEST_F(SceneOfAState, TakesTheResponseOfLoadsWhereNoneIsSaid) {
  const std::string cell = "[cell]\nmass = 1\nstrain_rate_cap = 0.05\n";
  std::string text = kSavedStartScene;
  text.erase(text.find(cell), cell.size());
  const auto mass_of_first = [&](const std::string& scene) {
    const Scene s = read({}, scene);
    return s.assembly.cell.applied_to(s.relaxation).cell_mass;
  };
  EXPECT_EQ(mass_of_first(text), kLoadCellMass);
  EXPECT_EQ(mass_of_first(kSavedStartScene), 1.0);
  text.insert(text.find("pressure"), "vibration = {dilation = 1.01, collisions = 5}\n");
  EXPECT_EQ(mass_of_first(text), kAssemblyCellMass);
}

TEST_F(SceneOfAState, HasTheGrainsThatTheRunWillHave) {
  const Scene s = read();
  EXPECT_TRUE(s.starts_from_state());
  EXPECT_EQ(s.grains.count, 180);
  EXPECT_EQ(s.grains.diameter.min, 0.5);
  EXPECT_EQ(s.grains.diameter.max, 1.0);
  EXPECT_NEAR(s.assembly.solid_fraction, 0.5, 1e-12);
  EXPECT_EQ(s.assembly.saved.copies_along<2>(), (Vec<2, int>(3, 2)));
  EXPECT_EQ(s.assembly.saved.read_packing<2>().grains.position, saved_.packing.grains.position);
  for (const DerivedGroup& g : derived_groups(s)) {
    if (g.name == "N") {
      EXPECT_EQ(g.value, 180.0);
    }
    if (g.name == "T0") {  // T0 = sqrt(a m/F0) with m = 1/2
      EXPECT_NEAR(g.value, std::sqrt(0.5), 1e-12);
    }
    if (g.name == "equilibria") {
      EXPECT_EQ(g.value, 3.0);
    }
  }
}

TEST_F(SceneOfAState, IsTheStateItselfWithoutCopies) {
  std::string text = kSavedStartScene;
  const std::string copies = "copies = [3, 2]\n";
  text.erase(text.find(copies), copies.size());
  EXPECT_EQ(read({}, text).grains.count, 30);
}

TEST_F(SceneOfAState, NamesTheStateByItsChecksumInItsText) {
  const Scene s = read();
  EXPECT_EQ(s.assembly.saved.sha256, sha256_of_file(scratch_.file("saved.h5")));
  EXPECT_THAT(s.text, HasSubstr(s.assembly.saved.sha256));
  EXPECT_EQ(read({}, s.text).text, s.text);
  saved_.packing.grains.mass[0] *= 2.0;
  save(saved_);
  EXPECT_THAT([&] { read({}, s.text); }, testing::ThrowsMessage<InputError>(
                                             AllOf(HasSubstr("assembly.state_sha256"), HasSubstr("saved.h5"),
                                                   HasSubstr("expected the file with the given SHA-256"))));
  EXPECT_THAT(
      [&] { s.assembly.saved.read(); },
      testing::ThrowsMessage<InputError>(HasSubstr("saved.h5: the file has changed since the scene was read")));
}

TEST_F(SceneOfAState, SaysWhatItStartsFrom) {
  EXPECT_THAT(read().start, AllOf(HasSubstr("saved.h5, 30 grains at the solid fraction 0.5"),
                                  HasSubstr("3 x 2 copies; contact law as in")));
  EXPECT_THAT(read({"contact.friction.coefficient=0.3"}).start,
              HasSubstr("contact law of the scene, in place of the contact law in the state file: "
                        "normal.stiffness=100000, "));
}

TEST_F(SceneOfAState, IsRandomOnlyWhereItIsAgitated) {
  EXPECT_FALSE(read().is_random());
  const Scene agitated = read({"assembly.agitation=0.1"});
  EXPECT_TRUE(agitated.is_random());
  EXPECT_EQ(agitated.assembly.agitation, 0.1);
}

TEST_F(SceneOfAState, RefusesWhatContradictsTheState) {
  const std::vector<std::pair<std::vector<std::string>, const char*>> cases = {
      {{"grains.count=180"}, "[grains] is not allowed here: the grains come from the file assembly.state"},
      {{"cell.solid_fraction=0.5"},
       "cell.solid_fraction is not allowed here: the cell comes from the file assembly.state"},
      {{"assembly.gas=equilibrated"},
       "assembly.gas is not allowed here: the grains come from the file assembly.state"},
      {{"scene.units=SI"}, "the units of the state are \"reduced\": expected the units of the scene, \"SI\""},
      {{"assembly.copies=[2]"}, "assembly.copies has 1 numbers: expected two"},
      {{"assembly.copies=[2.5, 1]"},
       "assembly.copies = [ 2.5, 1 ]: expected the numbers of copies along the two axes, two whole numbers"},
      {{"assembly.copies=[0, 1]"}, "expected the numbers of copies along the two axes, two whole numbers"},
      {{"assembly.copies=[10000, 10000]"},
       "assembly.copies: all copies together have 3e+09 grains, expected 2 to 1e8 grains"},
      {{"assembly.copies=4"}, "expected the numbers of copies along the two axes, two whole numbers"},
      {{"assembly.state=absent.h5"}, "absent.h5: No such file"},
      {{"assembly.state=4"}, "assembly.state = 4: expected the name of a state file"},
      {{"assembly.pressure=0"}, "assembly.pressure = 0: expected a positive number"},
      {{"assembly.agitation=-1"}, "assembly.agitation = -1: expected a positive number"}};
  for (const auto& [overrides, message] : cases) {
    const std::string all = faults(overrides);
    EXPECT_THAT(all, HasSubstr(message));
    EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 0) << "one mistake, several faults:\n" << all;
  }
}

TEST_F(SceneOfAState, WithoutAPressureKeepsItsStresses) {
  std::string text = kSavedStartScene;
  const std::size_t at = text.find("pressure = ");
  text.erase(at, text.find('\n', at) - at);
  saved_.target_stress << 0.3, 0.5;
  saved_.path.turn.control = "oedometric";
  saved_.path.turn.axis = 1;
  save(saved_);
  const Scene again = read({}, text);
  EXPECT_DOUBLE_EQ(again.assembly.pressure, 0.4);
  ASSERT_TRUE(again.assembly.saved.kept.has_value());
  EXPECT_EQ(again.assembly.saved.kept->stress, (std::vector<double>{0.3, 0.5}));
  const PlannedEquilibrium first = plan_run(again.assembly, again.law, {}, 2).front();
  EXPECT_EQ(first.control, "axes");
  EXPECT_EQ(first.axis, 1);
  EXPECT_EQ(first.axes[0].load, (AxisLoad{AxisLoad::stress, 0.3}));
  EXPECT_EQ(first.axes[1].load, (AxisLoad{AxisLoad::stress, 0.5}));
  // Equal stresses on all axes are a pressure.
  saved_.target_stress << 0.4, 0.4;
  save(saved_);
  EXPECT_FALSE(read({}, text).assembly.saved.kept.has_value());
  EXPECT_DOUBLE_EQ(read({}, text).assembly.pressure, 0.4);
  // A pressure in the scene replaces the stress that the state had.
  EXPECT_FALSE(read({}).assembly.saved.kept.has_value());
  saved_.target_stress << 0.4, -0.5;
  save(saved_);
  try {
    read({}, text);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("assembly.pressure is missing: expected a positive number (first pressure of the "
                          "packing), because the mean stress of the state is -0.05"));
  }
}

TEST_F(SceneOfAState, TakesSkewedCellsButNoRotatedOnes) {
  saved_.packing.cell.matrix(1, 0) = 0.1;
  save(saved_);
  EXPECT_EQ(read({}).grains.count, 3 * 2 * 30);
  saved_.packing.cell.matrix(0, 1) = 0.1;
  save(saved_);
  EXPECT_THAT(faults(), AllOf(HasSubstr("s.toml:15: assembly.state: "),
                              HasSubstr("the cell of the state (cell/matrix) is rotated")));
}

TEST_F(SceneOfAState, RefusesSpheres) {
  State<3> spheres;
  spheres.packing.law = test::cohesive_law();
  spheres.packing.cell.matrix *= 3.0;
  spheres.packing.grains = Grains<3>::with_size(2);
  spheres.packing.grains.position[1].setConstant(1.5);
  spheres.packing.grains.radius = spheres.packing.grains.mass = {1.0, 1.0};
  save(spheres);
  EXPECT_THAT(faults(), HasSubstr("the state has dimension 3: expected a state of disks"));
}

TEST_F(SceneOfAState, RefusesKeysOfAStateInOtherScenes) {
  std::string text = kSavedStartScene;
  text.replace(text.find("protocol = \"state\""), 18, "protocol = \"direct\"");
  try {
    read({"grains.count=30", "grains.diameter={distribution=\"constant\", value=1}", "cell.solid_fraction=0.4"},
         text);
    ADD_FAILURE() << "was read";
  } catch (const InputError& error) {
    EXPECT_THAT(
        error.what(),
        AllOf(HasSubstr("s.toml:15: assembly.state is not allowed here: expected protocol = \"state\""),
              HasSubstr("s.toml:16: assembly.copies is not allowed here: expected protocol = \"state\"")));
  }
}

}  // namespace
}  // namespace floc
