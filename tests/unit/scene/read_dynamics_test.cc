#include "floc/scene/read_dynamics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/assembly/box_options.h"
#include "floc/scene/cell_defaults.h"
#include "floc/scene/derived_groups.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_warnings.h"
#include "support/message_of.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kRigidScene = R"([scene]
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "rigid"}
friction = {coefficient = 0.5}
[cell]
solid_fraction = 0.4
[assembly]
protocol = "direct"
pressure = 1.0
[[load]]
to = 2.0
steps = 1
)";

const std::string kElasticScene = R"([scene]
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e5}
[cell]
solid_fraction = 0.4
[assembly]
protocol = "direct"
pressure = 1.0
)";

Scene parsed(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "s.toml", ".", overrides);
}

std::string dynamics_faults(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return test::message_of([&] { parsed(text, overrides); });
}

TEST(ReadDynamics, EveryKeyArrives) {
  const ContactDynamicsOptions o = parsed(kRigidScene + R"([dynamics]
method = "contact_dynamics"
time_step = 0.025
sweep_tolerance = 1e-4
max_sweeps = 300
restitution = 0.5
finish = "canonical"
gap_tolerance = 2e-4
)")
                                       .relaxation.contact_dynamics;
  EXPECT_EQ(o.time_step, 0.025);
  EXPECT_EQ(o.sweep_tolerance, 1e-4);
  EXPECT_EQ(o.max_sweeps, 300);
  EXPECT_EQ(o.restitution, 0.5);
  EXPECT_EQ(o.forces, RigidForces::canonical);
  EXPECT_EQ(o.gap_tolerance, 2e-4);
}

TEST(ReadDynamics, KeysLeftOutKeepTheirDefaults) {
  const ContactDynamicsOptions o = parsed(kRigidScene).relaxation.contact_dynamics, defaults;
  EXPECT_EQ(o.time_step, defaults.time_step);
  EXPECT_EQ(o.sweep_tolerance, defaults.sweep_tolerance);
  EXPECT_EQ(o.max_sweeps, defaults.max_sweeps);
  EXPECT_EQ(o.restitution, defaults.restitution);
  EXPECT_EQ(o.forces, RigidForces::closest);
  EXPECT_FALSE(o.gap_tolerance);
}

TEST(ReadDynamics, EveryWordForTheForcesIsKnown) {
  const auto forces = [](const std::string& word) {
    return parsed(kRigidScene, {"dynamics.finish=" + word}).relaxation.contact_dynamics.forces;
  };
  EXPECT_EQ(forces("closest"), RigidForces::closest);
  EXPECT_EQ(forces("canonical"), RigidForces::canonical);
  EXPECT_EQ(forces("none"), RigidForces::stepped);
}

TEST(ReadDynamics, TheMethodMayBeNamed) {
  EXPECT_EQ(dynamics_faults(kRigidScene, {"dynamics.method=contact_dynamics"}), "");
  EXPECT_EQ(dynamics_faults(kElasticScene, {"dynamics.method=smooth"}), "");
}

TEST(ReadDynamics, RigidGrainsHaveDefaultsOfTheirOwn) {
  const Scene scene = parsed(kRigidScene);
  EXPECT_EQ(scene.assembly.gas, GasKind::sequential_addition);
  EXPECT_EQ(scene.relaxation.inertial_number_cap, 0.02);
  EXPECT_EQ(scene.relaxation.cell_mass, 1.0);
  EXPECT_EQ(scene.load[0].cell.inertial_number_cap, 0.02);
  EXPECT_EQ(scene.load[0].cell.cell_mass, 0.1);
  EXPECT_EQ(parsed(kRigidScene, {"assembly.gas=equilibrated"}).assembly.gas, GasKind::equilibrated);
  // Adhesion does not change the default cap of the strain rate.
  const Scene sticky = parsed(kRigidScene, {"contact.adhesion={law=\"constant\", force=1.0}"});
  EXPECT_EQ(sticky.relaxation.inertial_number_cap, 0.02);
  EXPECT_FALSE(sticky.relaxation.strain_rate_cap);
  EXPECT_EQ(parsed(kElasticScene).relaxation.inertial_number_cap, kLargestInertialNumber);
  EXPECT_EQ(parsed(kElasticScene).assembly.gas, GasKind::equilibrated);
}

struct BadKey {
  const char* set;
  const char* fault;
};
void PrintTo(const BadKey& bad, std::ostream* out) {
  *out << bad.set;
}

class BadRigidScenes : public testing::TestWithParam<BadKey> {};

TEST_P(BadRigidScenes, AreRefusedWithPlaceKeyAndExpectation) {
  const std::string words = dynamics_faults(kRigidScene, {GetParam().set});
  EXPECT_THAT(words, AllOf(HasSubstr("--set "), HasSubstr(GetParam().fault))) << words;
  EXPECT_THAT(words, Not(HasSubstr("\n"))) << words;
}

INSTANTIATE_TEST_SUITE_P(
    Values, BadRigidScenes,
    testing::Values(
        BadKey{"dynamics=3", "dynamics = 3: expected a table [dynamics]"},
        BadKey{"dynamics.method=fast", "dynamics.method = 'fast': expected \"smooth\" or \"contact_dynamics\""},
        BadKey{"dynamics.method=1", "dynamics.method = 1: expected \"smooth\""},
        BadKey{"dynamics.time_step=0", "dynamics.time_step = 0: expected a number in (0, 1]"},
        BadKey{"dynamics.time_step=1.1", "dynamics.time_step = 1.1: expected"},
        BadKey{"dynamics.time_step=long", "dynamics.time_step = 'long': expected a number"},
        BadKey{"dynamics.sweep_tolerance=0", "dynamics.sweep_tolerance = 0: expected a number in (0, 0.1]"},
        BadKey{"dynamics.sweep_tolerance=0.2", "dynamics.sweep_tolerance = 0.2: expected"},
        BadKey{"dynamics.max_sweeps=0", "dynamics.max_sweeps = 0: expected"},
        BadKey{"dynamics.max_sweeps=10.5", "dynamics.max_sweeps = 10.5: expected"},
        BadKey{"dynamics.max_sweeps=10.0", "written without a decimal point"},
        BadKey{"dynamics.restitution=-0.1", "dynamics.restitution = -0.1: expected a number from 0 to 1"},
        BadKey{"dynamics.restitution=1.1", "dynamics.restitution = 1.1: expected"},
        BadKey{"dynamics.finish=auto",
               "dynamics.finish = 'auto': expected \"closest\", \"canonical\" or \"none\""},
        BadKey{"dynamics.gap_tolerance=0", "dynamics.gap_tolerance = 0: expected a number in (0, 0.1]"},
        BadKey{"dynamics.gap_tolerance=inf", "dynamics.gap_tolerance = inf: expected"},
        BadKey{"dynamics.max_sweep=3",
               "unknown key dynamics.max_sweep; the nearest valid key in [dynamics] is max_sweeps"}));

INSTANTIATE_TEST_SUITE_P(
    Refused, BadRigidScenes,
    testing::Values(
        BadKey{"dynamics.method=smooth", "dynamics.method = \"smooth\": rigid contacts have no stiffness"},
        BadKey{"run.time_step=0.1",
               "run.time_step is not allowed with rigid contacts: the time step of contact "
               "dynamics is given by dynamics.time_step"},
        BadKey{"run.skin=0.1", "run.skin is not allowed with rigid contacts"},
        BadKey{"equilibrium.finish=auto",
               "equilibrium.finish is not allowed with rigid contacts: dynamics.finish chooses among the "
               "possible forces of rigid grains at rest"},
        BadKey{"equilibrium.masses=own", "equilibrium.masses is not allowed with rigid contacts"},
        BadKey{"equilibrium.patience=2", "equilibrium.patience is not allowed with rigid contacts"},
        BadKey{"accuracy.phi=0.1", "[accuracy] is not allowed with rigid contacts"},
        BadKey{"assembly.vibration={dilation=1.1, collisions=10}",
               "assembly.vibration is not allowed with rigid"},
        BadKey{"assembly.protocol=aggregation", "assembly.protocol = \"aggregation\": rigid grains are not"},
        BadKey{"assembly.pressure=0", "assembly.pressure = 0: expected a positive number"},
        BadKey{"load.0.to=0", "load.0.to = 0: rigid grains need a positive pressure"},
        BadKey{"equilibrium.end=settled", "it defines when the compaction between walls ends, but"},
        BadKey{"contact.damping={restitution=0.5}", "rigid contacts have no dashpots"},
        BadKey{"contact.rolling={coefficient=0.1, stiffness=1}", "do not resist rolling or twisting"},
        BadKey{"contact.adhesion={law=\"tail\", force=1, range=0.1}", "adhere only by a constant force"}));

TEST(ReadDynamics, ZeroPressureIsRefusedWithAdhesionToo) {
  EXPECT_THAT(dynamics_faults(kRigidScene, {"contact.adhesion={law=\"constant\", force=1.0}", "load.0.to=0"}),
              AllOf(HasSubstr("load.0.to = 0: rigid grains need a positive pressure"), Not(HasSubstr("\n"))));
}

const std::string kRigidBox = R"([scene]
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "rigid"}
[box]
sides = [10, 20]
boundary = {x = "fixed", y = "lid"}
gravity = [0, -1]
pressure = 2
mass = 5
friction = 0.3
adhesion = 0
[assembly]
protocol = "direct"
)";

TEST(ReadDynamics, RigidGrainsAreLoadedByWalls) {
  EXPECT_EQ(dynamics_faults(kRigidBox), "");
  const Scene scene = parse_scene(kRigidBox, "s.toml", "");
  EXPECT_EQ(scene.relaxation.inertial_number_cap, kInertialNumberOfContactDynamics);
  EXPECT_EQ(wall_law(scene.law, *scene.assembly.box).friction_coefficient(), 0.3);
  for (const DerivedGroup& group : derived_groups(scene)) EXPECT_TRUE(std::isfinite(group.value)) << group.name;
  for (const char* key : {"end=settled", "stop_time=3", "energy_ratio=1e-3"})
    EXPECT_THAT(
        dynamics_faults(kRigidBox, {std::string("equilibrium.") + key}),
        HasSubstr("the compaction of rigid grains ends when the forces on all grains and walls balance"));
}

TEST(ReadDynamics, GasInABoxIsNoDenserThanCircumscribedCircles) {
  const std::vector<std::string> shaped = {"grains.shape={kind=\"polygon\", sides=3}",
                                           "assembly.solid_fraction=0.3"};
  EXPECT_THAT(dynamics_faults(kRigidBox, shaped),
              HasSubstr("assembly.solid_fraction = 0.3: the gas is made of the "
                        "circumscribed circles"));
}

/// Replaces the loading stage of the scene of rigid grains by another stage, and returns the faults of the scene.
std::string stage_faults(const std::string& stage) {
  return dynamics_faults(kRigidScene.substr(0, kRigidScene.find("to = 2.0")) + stage);
}

TEST(ReadDynamics, StagesWithADirectionKeepAStress) {
  struct Stage {
    const char *control, *keys;
    bool keeps_a_stress;
  };
  constexpr Stage kStages[] = {{"triaxial", "strain = 0.1\nsteps = 5\n", true},
                               {"triaxial", "to = 2.0\nsteps = 5\n", true},
                               {"oedometric", "to = 2.0\nsteps = 5\n", true},
                               {"oedometric", "strain = 0.1\nsteps = 5\n", false},
                               {"constant_volume", "strain = 0.1\nsteps = 5\n", false},
                               {"simple_shear", "strain = 0.1\nsteps = 5\n", true},
                               {"axes", "axes = [{stress = 1.0}, {stress = 2.0}]\nsteps = 5\n", true},
                               {"axes", "axes = [{strain = 0.1}, {stress = 2.0}]\nsteps = 5\n", true},
                               {"axes", "axes = [{strain = 0.1}, {strain = 0.2}]\nsteps = 5\n", false}};
  for (const auto& [control, keys, keeps_a_stress] : kStages)
    EXPECT_EQ(stage_faults(std::string("control = \"") + control + "\"\n" + keys),
              keeps_a_stress
                  ? ""
                  : std::string("s.toml:16: load.0.control = \"") + control +
                        "\": this stage imposes the lengths of all axes, but rigid grains need a stress on at "
                        "least one axis, because otherwise their forces have no scale; expected a stage "
                        "that keeps or imposes a stress");
}

TEST(ReadDynamics, StrainRatesAreThoseOfRigidGrains) {
  const std::string shear = "control = \"simple_shear\"\nstrain = 0.1\nsteps = 5\n";
  EXPECT_EQ(stage_faults(shear + "inertial_number = 1e-3\n"), "");
  EXPECT_THAT(stage_faults(shear + "inertial_number = 0.2\n"), HasSubstr("expected a number in (0, 0.1]"));
  EXPECT_THAT(stage_faults("to = 2.0\nsteps = 1\ninertial_number = 1e-3\n"),
              HasSubstr("the stage imposes no strain"));
  EXPECT_THAT(dynamics_faults(kElasticScene + "[[load]]\n" + shear + "inertial_number = 1e-3\n"),
              HasSubstr("expected inertial_number_cap in its place"));
}

TEST(ReadDynamics, EqualStressesOnAllAxesAreAPressure) {
  EXPECT_EQ(stage_faults("control = \"axes\"\naxes = [{stress = 3.0}, {stress = 3.0}]\nsteps = 1\n"), "");
}

class BadElasticScenes : public testing::TestWithParam<BadKey> {};

TEST_P(BadElasticScenes, NameTheKeyThatTakesThePlace) {
  const std::string words = dynamics_faults(kElasticScene, {GetParam().set});
  EXPECT_THAT(words, AllOf(HasSubstr("--set "), HasSubstr(GetParam().fault))) << words;
  EXPECT_THAT(words, Not(HasSubstr("\n"))) << words;
}

INSTANTIATE_TEST_SUITE_P(
    Keys, BadElasticScenes,
    testing::Values(BadKey{"dynamics.method=contact_dynamics",
                           "contact dynamics moves only rigid grains and grains with shapes"},
                    BadKey{"dynamics.time_step=0.1",
                           "the contacts are elastic; expected run.time_step in its place"},
                    BadKey{"dynamics.finish=closest", "expected equilibrium.finish in its place"},
                    BadKey{"dynamics.restitution=0.1", "expected contact.damping in its place"},
                    BadKey{"dynamics.sweep_tolerance=0.1", "expected no key sweep_tolerance"},
                    BadKey{"dynamics.max_sweeps=5", "expected no key max_sweeps"},
                    BadKey{"dynamics.gap_tolerance=0.01", "expected no key gap_tolerance"},
                    BadKey{"dynamics.finsh=closest", "the nearest valid key in [dynamics] is finish"}));

TEST(ReadDynamics, AFaultyNormalLawCausesNoFurtherFaults) {
  const std::string words =
      dynamics_faults(kRigidScene + "[dynamics]\nmethod = \"contact_dynamics\"\ntime_step = 0.01\n",
                      {"contact.normal.law=rigit"});
  EXPECT_THAT(words, AllOf(HasSubstr("contact.normal.law = 'rigit'"), Not(HasSubstr("dynamics")))) << words;
}

/// With a faulty shape or saved start, it is not known whether the elastic grains have shapes.
TEST(ReadDynamics, FaultyShapesCauseNoFurtherFaults) {
  const std::vector<std::string> faults = {
      "grains.shape={kind=\"polygn\", sides=5}", "grains.shape={kind=\"polygon\", sides=2}",
      "grains.shape={kind=\"polygon\", sides=5, rounding=-1}", "grains.shape=\"polygon\"",
      "grains.shape={kind=\"file\", file=\"none.csv\"}"};
  for (const std::string& fault : faults) {
    const std::string words = dynamics_faults(kElasticScene, {fault, "dynamics.method=contact_dynamics"});
    EXPECT_THAT(words, AllOf(HasSubstr("shape"), Not(HasSubstr("dynamics.method")))) << words;
  }
  const std::string start = kElasticScene.substr(0, kElasticScene.find("[grains]")) +
                            "[contact]\nnormal = {law = \"linear\", stiffness = 1e5}\n"
                            "[assembly]\nprotocol = \"state\"\nstate = \"none.h5\"\n"
                            "[dynamics]\nmethod = \"contact_dynamics\"\n";
  EXPECT_THAT(dynamics_faults(start), AllOf(HasSubstr("none.h5"), Not(HasSubstr("dynamics.method"))));
}

/// Walls press elastic grains with shapes together, at the rate of contact dynamics; they may rub, but not stick.
TEST(ReadDynamics, ElasticGrainsWithShapesInABox) {
  const std::string box = kElasticScene.substr(0, kElasticScene.find("[cell]")) +
                          "[box]\nsides = [20, 20]\nfriction = 0\nadhesion = 0\npressure = 1\nmass = 5\n"
                          "[assembly]\nprotocol = \"direct\"\n";
  const std::vector<std::string> shape = {"grains.shape={kind=\"polygon\", sides=5}"};
  EXPECT_EQ(parsed(box, shape).relaxation.inertial_number_cap, 0.02);
  EXPECT_THAT(dynamics_faults(box, {shape[0], "box.adhesion=0.1"}),
              HasSubstr("the contacts of these grains only repel; expected box.adhesion = 0"));
}

TEST(ReadDynamics, GroupsOfRigidGrainsAreFinite) {
  for (const std::vector<std::string>& changes :
       {std::vector<std::string>{}, {"contact.adhesion={law=\"constant\", force=2.0}"}}) {
    const Scene scene = parsed(kRigidScene, changes);
    for (const DerivedGroup& g : derived_groups(scene)) {
      EXPECT_TRUE(std::isfinite(g.value)) << g.name;
      EXPECT_THAT(g.name, Not(HasSubstr("kappa")));
      EXPECT_THAT(g.name, Not(HasSubstr("K_N")));
    }
    EXPECT_THAT(scene_warnings(scene), IsEmpty());
  }
  // With m = 1 and P = 1, the time scale T is 1, and the longest time step is 0.05 T.
  EXPECT_EQ(time_step_of_scene(parsed(kRigidScene)), 0.05);
  EXPECT_EQ(time_step_of_scene(parsed(kRigidScene, {"assembly.pressure=4.0"})), 0.025);
}

}  // namespace
}  // namespace floc
