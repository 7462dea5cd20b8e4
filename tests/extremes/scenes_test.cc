#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/box_scene.h"
#include "support/run_program.h"
#include "support/wet_scene.h"

/// Tests of small scenes with one parameter at an end of its range. The program runs each scene, verifies its
/// states and computes moduli: it must find valid equilibria with finite numbers, or fail with a message.
namespace floc::test {
namespace {

using ::testing::HasSubstr;

/// Scene of 40 grains that are similar to the grains of the shipped scenes. They are assembled under pressure in one
/// step.
const std::string kPowder = R"([scene]
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e5}
adhesion = {law = "tail", force = 1.0, range = 1e-3}
damping = {restitution = 0.015, mass = "effective"}
friction = {coefficient = 0.5, stiffness = 1e5}
rolling = {coefficient = 0.005, stiffness = 10.0}
[assembly]
protocol = "direct"
pressure = 0.01
[cell]
solid_fraction = 0.4
)";

/// kPowder with an additional stage that increases the pressure tenfold.
const std::string kScene = kPowder + R"(mass = 1.0
strain_rate_cap = 0.05
[[load]]
to = 0.1
steps = 1
)";

/// kPowder with an additional stage that compresses the sample along one axis.
const std::string kTriaxial = kPowder + R"([[load]]
control = "triaxial"
strain = 5e-3
strain_step = 1e-3
)";

/// Scene of 40 elastic spheres, assembled under pressure in one step and then loaded tenfold; stresses are in
/// units of E/(1 - nu^2).
const char* const kSpheres = R"([scene]
dimension = 3
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "hertz", modulus = 0.91, poisson = 0.3}
friction = {law = "mindlin", coefficient = 0.3}
damping = {critical_fraction = 0.5}
[cell]
solid_fraction = 0.4
mass = 1.0
inertial_number_cap = 0.05
[assembly]
protocol = "direct"
pressure = 1e-6
[[load]]
to = 1e-5
steps = 1
)";

struct Extreme {
  const char* name;
  std::vector<const char*> set;
  std::string scene = kScene;
};

std::string settings(const std::vector<const char*>& set) {
  std::string text;
  for (const char* s : set) text += std::string(" --set '") + s + "'";
  return text;
}

void PrintTo(const Extreme& extreme, std::ostream* out) {
  *out << extreme.name;
}

class Scene : public ::testing::TestWithParam<Extreme> {};

TEST_P(Scene, ReachesEquilibriaThatVerify) {
  const ScratchDirectory scratch;
  write_text(scratch.file("scene.toml"), GetParam().scene);
  const Outcome run = run_floc("run scene.toml -o out" + settings(GetParam().set), scratch.path());
  ASSERT_EQ(run.code, 0) << run.err;
  const Outcome verify = run_floc("verify out/state-*.h5", scratch.path());
  EXPECT_EQ(verify.code, 0) << verify.out << verify.err;
  const Outcome moduli = run_floc("moduli out/state-*.h5 --format csv", scratch.path());
  EXPECT_EQ(moduli.code, 0) << moduli.err;
  EXPECT_THAT(moduli.out, ::testing::Not(::testing::ContainsRegex(",-?nan,")));
}

const Extreme kExtremes[] = {
    {"kappa_1e2",
     {"contact.normal.stiffness=1e2", "contact.friction.stiffness=1e2", "contact.rolling.stiffness=1e-2"}},
    {"kappa_1e3",
     {"contact.normal.stiffness=1e3", "contact.friction.stiffness=1e3", "contact.rolling.stiffness=0.1"}},
    {"kappa_1e7",
     {"contact.normal.stiffness=1e7", "contact.friction.stiffness=1e7", "contact.rolling.stiffness=1e3"}},
    {"P_1e4", {"load.0.to=1e4", "load.0.steps=6"}},
    {"P_0", {"assembly.protocol=aggregation", "assembly.agitation=9.5", "load.0.to=0"}},
    {"P_1e_minus_6",
     {"assembly.protocol=aggregation", "assembly.agitation=9.5", "assembly.pressure=1e-6", "load.0.to=1e-5",
      "equilibrium.stress=1e-8"}},
    {"K_R_1e_minus_12", {"contact.rolling.stiffness=1e-7"}},
    {"K_R_1", {"contact.rolling.stiffness=1e5"}},
    {"K_T_1e_minus_6", {"contact.friction.stiffness=0.1"}},
    {"K_T_1e3", {"contact.friction.stiffness=1e8"}},
    {"D0_1e_minus_8", {"contact.adhesion.range=1e-8"}},
    {"D0_0_1", {"contact.adhesion.range=0.1"}},
    {"mu_0", {"contact.friction.coefficient=0"}},
    {"mu_10", {"contact.friction.coefficient=10"}},
    {"mu_R_0", {"contact.rolling.coefficient=0"}},
    // Without a loss in collisions there is no damping, and springs below their limits do not dissipate energy either.
    // The grains of the case collisions_without_loss therefore vibrate for ever, but an equilibrium can still be found.
    {"mu_R_10", {"contact.rolling.coefficient=10"}},
    {"collisions_without_loss", {"contact.damping.restitution=1", "grains.count=15"}},
    {"two_grains", {"grains.count=2"}},
    {"three_grains", {"grains.count=3"}},
    {"sizes_1_to_30",
     {"grains.diameter={distribution=\"bidisperse\",small=0.033,large=1.0,share_of_large=0.3}"}},
    {"spheres_kappa_31", {"assembly.pressure=1e-3", "load.0.to=5.7e-3"}, kSpheres},
    {"spheres_kappa_1e6", {"assembly.pressure=1e-9", "load.0.to=1e-8"}, kSpheres},
    {"spheres_mu_0", {"contact.friction.coefficient=0"}, kSpheres},
    {"spheres_mu_10", {"contact.friction.coefficient=10"}, kSpheres},
    {"spheres_nu_minus_0_9", {"contact.normal.poisson=-0.9"}, kSpheres},
    {"spheres_nu_0_49", {"contact.normal.poisson=0.49"}, kSpheres},
    {"spheres_hardly_damped", {"contact.damping.critical_fraction=0.01"}, kSpheres},
    {"spheres_critically_damped", {"contact.damping.critical_fraction=1"}, kSpheres},
    {"two_spheres", {"grains.count=2"}, kSpheres},
    {"spheres_1_to_5",
     {"grains.diameter={distribution=\"bidisperse\",small=0.2,large=1.0,share_of_large=0.3}"},
     kSpheres},
    {"wet_w_1e_minus_6", {"load.0.set.adhesion.water_content=1e-6"}, wet_scene()},
    {"wet_w_0_03", {"load.0.set.adhesion.water_content=0.03"}, wet_scene()},
    {"wet_angle_85", {"contact.adhesion.contact_angle=85"}, wet_scene()},
    {"wet_1_to_10",
     {"grains.diameter={distribution=\"bidisperse\",small=2e-4,large=2e-3,share_of_large=0.2}"},
     wet_scene()},
    {"wet_stiff", {"contact.normal.stiffness=1e5", "contact.friction.stiffness=1e5"}, wet_scene()},
    {"wet_P_1e_minus_4", {"load.1.to=0.02"}, wet_scene()},
    {"wet_P_10", {"load.1.to=2000"}, wet_scene()},
    {"wet_rational", {"contact.adhesion.form=rational"}, wet_scene()},
    {"wet_formed_on_contact", {"contact.adhesion.formation=contact"}, wet_scene()},
    {"wet_mu_0", {"contact.friction.coefficient=0"}, wet_scene()},
    {"two_wet_spheres", {"grains.count=2"}, wet_scene()},
    {"triaxial_steps_of_1e_minus_5", {"load.0.strain=5e-5", "load.0.strain_step=1e-5"}, kTriaxial},
    {"triaxial_P_1e_minus_4", {"assembly.pressure=1e-4"}, kTriaxial},
    {"triaxial_P_10", {"assembly.pressure=10"}, kTriaxial},
    {"constant_volume_P_10", {"assembly.pressure=10", "load.0.control=constant_volume"}, kTriaxial},
    {"box_of_disks_eta_1e_minus_3", {"contact.adhesion.force=1e-4"}, box_scene(2)},
    {"box_eta_1e_minus_3", {"contact.adhesion.force=1e-4"}, box_scene(3)},
    {"box_eta_1e4", {"box.pressure=1e-4", "contact.adhesion.force=1", "load.0.to=2e-4"}, box_scene(3)},
    {"box_stiff", {"contact.normal.stiffness=1e6", "contact.friction.stiffness=1.5e6"}, box_scene(3)},
    {"box_soft", {"contact.normal.stiffness=3", "contact.friction.stiffness=4.5"}, box_scene(3)},
    {"box_of_sticky_walls", {"box.adhesion=0.2"}, box_scene(3)},
    {"box_of_smooth_walls", {"box.friction=0"}, box_scene(3)},
    {"box_mu_0", {"contact.friction.coefficient=0", "box.friction=0"}, box_scene(3)},
    {"box_mu_10", {"contact.friction.coefficient=10", "box.friction=10"}, box_scene(3)},
    {"box_of_a_fast_gas", {"assembly.kinetic_pressure=10"}, box_scene(3)},
    {"box_of_two_disks", {"grains.count=2"}, box_scene(2)},
    {"box_of_sizes_1_to_10", {"grains.diameter={distribution=\"uniform\",min=0.1,max=1.0}"}, box_scene(3)},
};
INSTANTIATE_TEST_SUITE_P(AtTheEnds, Scene, ::testing::ValuesIn(kExtremes),
                         [](const auto& test) { return std::string(test.param.name); });

struct Refusal {
  const char* name;
  std::vector<const char*> set;
  int code;
  const char* message;
  std::string scene = kScene;
};
void PrintTo(const Refusal& refusal, std::ostream* out) {
  *out << refusal.name;
}

class Refused : public ::testing::TestWithParam<Refusal> {};

TEST_P(Refused, InWords) {
  const ScratchDirectory scratch;
  write_text(scratch.file("scene.toml"), GetParam().scene);
  const Outcome run = run_floc("run scene.toml -o out" + settings(GetParam().set), scratch.path());
  EXPECT_EQ(run.code, GetParam().code) << run.err;
  EXPECT_THAT(run.err, HasSubstr(GetParam().message));
}

const Refusal kRefusals[] = {
    {"one_grain",
     {"grains.count=1"},
     4,
     "grains.count = 1: expected the number of grains, a whole number from 2 to 1e8"},
    {"first_pressure_below_the_tolerance",
     {"assembly.pressure=1e-6"},
     4,
     "assembly.pressure = 1e-06: this pressure is not larger than the accepted error of a stress, "
     "equilibrium.stress * F0/a = 1e-05 (pull-off force F0, largest diameter a); "
     "expected a higher pressure or a smaller equilibrium.stress"},
    {"load_below_the_tolerance",
     {"load.0.to=1e-6"},
     4,
     "to = 1e-06: this pressure is not larger than the accepted error of a stress, equilibrium.stress * F0/a = "
     "1e-05"},
    {"contacts_stiffer_than_doubles_resolve",
     {"contact.normal.stiffness=1e12"},
     4,
     "contact.normal.stiffness = 1000000000000: the contacts are so stiff that rounding errors cause stresses "
     "of 4.4e-04 F1/a^(d-1), where F1 is the larger of the pull-off force and P a^(d-1) (first pressure P, "
     "largest diameter a, dimension d); expected errors below equilibrium.stress = 1.0e-05"},
    {"motion_that_cannot_resolve_its_tolerance",
     {"contact.normal.stiffness=1e9", "grains.count=1400", "equilibrium.finish=dynamic"},
     4,
     "equilibrium.finish = \"dynamic\": rounding errors of the positions cause net forces of 2.6e-05 F1 on "
     "grains, where F1 is the larger of the pull-off force and P a^(d-1) (first pressure P, largest diameter "
     "a, "
     "dimension d), but equilibrium.force = 1.0e-05"},
    {"too_little_time", {"equilibrium.max_time=1"}, 3, "did not converge: "},
    {"spheres_pressed_too_far",
     {"load.0.to=1e-2"},
     4,
     "kappa = (E~/P)^(2/3), with E~ = E/(1 - nu^2), is 21.5; expected at least 30",
     kSpheres},
    {"spheres_damped_beyond_critical",
     {"contact.damping.critical_fraction=5"},
     4,
     "expected a fraction zeta of critical damping, in (0, 1]",
     kSpheres},
    {"spheres_of_poisson_half",
     {"contact.normal.poisson=0.5"},
     4,
     "expected Poisson's ratio nu, in (-1, 0.5)",
     kSpheres},
    {"gas_faster_than_the_walls_hold",
     {"assembly.kinetic_pressure=300"},
     3,
     "and no grain touches them",
     box_scene(3)},
    {"walls_lighter_than_steps_can_follow",
     {"box.mass=0.01"},
     3,
     "the motion diverged: run.time_step is too large, or box.mass is too small for this time step",
     box_scene(3)},
    {"box_too_small_for_two_spheres",
     {"grains.count=2"},
     4,
     "assembly: solid_fraction is too large: the grains grow from smaller sizes, and overlaps remain when "
     "their diameters are",
     box_scene(3)},
};
INSTANTIATE_TEST_SUITE_P(AtTheEnds, Refused, ::testing::ValuesIn(kRefusals),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace floc::test
