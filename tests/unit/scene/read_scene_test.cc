#include "floc/scene/read_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "floc/base/error.h"
#include "floc/scene/cell_defaults.h"
#include "support/contact_laws.h"
#include "support/message_of.h"
#include "support/places.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const char* const kScene = R"([scene]
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e5}
adhesion = {law = "tail", force = 1.0, range = 1e-3}
damping = {restitution = 0.015}
friction = {coefficient = 0.5, stiffness = 1e5}
rolling = {coefficient = 0.005, stiffness = 10}
[cell]
solid_fraction = 0.36
mass = 1
strain_rate_cap = 0.05
[assembly]
protocol = "aggregation"
agitation = 9.5
pressure = 0.01
[[load]]
to = 1.0
steps_per_decade = 8
)";

std::string with(const std::string& line, const std::string& instead) {
  std::string text = kScene;
  const auto at = text.find(line);
  EXPECT_NE(at, std::string::npos) << line;
  return text.replace(at, line.size(), instead);
}

Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "s.toml", ".", overrides);
}

std::string faults(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return test::message_of([&] { read(text, overrides); });
}

TEST(ReadScene, EveryValueArrives) {
  const Scene s = read(std::string(kScene) + R"([equilibrium]
force = 1e-6
moment = 2e-6
stress = 3e-6
energy = 4e-8
finish = "static"
[run]
seed = 7
threads = 2
time_step = 0.1
skin = 0.2
checkpoint_every = 5
)");
  EXPECT_EQ(s.name, "s");
  EXPECT_EQ(s.grains.count, 40);
  EXPECT_EQ(s.grains.diameter.min, 0.5);
  EXPECT_EQ(s.grains.diameter.max, 1.0);
  EXPECT_EQ(s.law, test::cohesive_law());
  EXPECT_EQ(s.assembly.protocol, AssemblyOptions::Protocol::aggregation);
  EXPECT_EQ(s.assembly.solid_fraction, 0.36);
  EXPECT_EQ(s.assembly.agitation, 9.5);
  EXPECT_EQ(s.assembly.pressure, 0.01);
  EXPECT_EQ(s.relaxation.cell_mass, 1.0);
  EXPECT_EQ(s.relaxation.strain_rate_cap, 0.05);
  EXPECT_FALSE(s.relaxation.inertial_number_cap);
  EXPECT_EQ(s.relaxation.tolerance, (EquilibriumTolerance{1e-6, 2e-6, 3e-6, 4e-8}));
  EXPECT_EQ(s.relaxation.finish, Finish::statics);
  EXPECT_EQ(s.relaxation.threads, 2);
  EXPECT_EQ(s.relaxation.time_step, 0.1);
  EXPECT_EQ(s.relaxation.skin, 0.2);
  EXPECT_EQ(s.checkpoint_every, 5);
  EXPECT_EQ(s.seed, 7u);
  ASSERT_EQ(s.load.size(), 1u);
  EXPECT_EQ(s.load[0].name, "load");
  EXPECT_EQ(s.load[0].to, 1.0);
  EXPECT_EQ(s.load[0].steps_per_decade, 8);
}

TEST(ReadScene, TheGasIsEquilibratedUnlessGrainsAreAddedOneByOne) {
  EXPECT_EQ(read(kScene).assembly.gas, GasKind::equilibrated);
  std::string text = kScene;
  text.replace(text.find("agitation = 9.5"), 15, "agitation = 9.5\ngas = \"sequential_addition\"");
  EXPECT_EQ(read(text).assembly.gas, GasKind::sequential_addition);
}

TEST(ReadScene, APhysicalTableLeftOutIsPhysicsLeftOut) {
  const Scene s = read(with("rolling = {coefficient = 0.005, stiffness = 10}\n", ""));
  EXPECT_FALSE(s.law.has_rolling());
  EXPECT_TRUE(s.law.has_friction());
}

TEST(ReadScene, WithoutOverridesTheTextIsTheFile) {
  EXPECT_EQ(read(kScene).text, kScene);
}

TEST(ReadScene, OverridesChangeTheSceneAndItsText) {
  const Scene s = read(kScene, {"contact.rolling.coefficient=0.1234567890123456789", "run.seed=9",
                                "load.0.to=3", "assembly.protocol = aggregation", "run.seed=11"});
  EXPECT_EQ(test::law_number(s.law, "rolling.coefficient"), 0.1234567890123456789);
  EXPECT_EQ(s.seed, 11u);
  EXPECT_EQ(s.load[0].to, 3.0);
  // The stored text alone gives the same scene, bit for bit.
  const Scene again = read(s.text);
  EXPECT_EQ(again.law, s.law);
  EXPECT_EQ(again.seed, s.seed);
  EXPECT_EQ(again.load[0].to, 3.0);
}

TEST(ReadScene, FaultyOverridesAreNamed) {
  EXPECT_THAT(faults(kScene, {"contact.rolling.coeficient=0.5"}),
              AllOf(HasSubstr("--set contact.rolling.coeficient=0.5"), HasSubstr("is coefficient")));
  EXPECT_THAT(faults(kScene, {"contact.normal.stiffness=-1"}),
              AllOf(HasSubstr("--set contact.normal.stiffness=-1"), HasSubstr("expected a positive number")));
  EXPECT_THAT(faults(kScene, {"run.seeed=1"}), AllOf(HasSubstr("--set run.seeed=1"), HasSubstr("is seed")));
  EXPECT_THAT(faults(kScene, {"contact"}), HasSubstr("an override must have the form key.path=value"));
  EXPECT_THAT(faults(kScene, {"load.3.to=1"}), HasSubstr("'3'"));
  EXPECT_THAT(faults(kScene, {"cell.mass.x=1"}), HasSubstr("'mass'"));
}

TEST(ReadScene, UnknownKeysNameLineAndNearestValidKey) {
  EXPECT_THAT(faults(with("stiffness = 1e5}\nadhesion", "stifness = 1e5}\nadhesion")),
              AllOf(HasSubstr("s.toml:8: unknown key contact.normal.stifness"), HasSubstr("is stiffness")));
  EXPECT_THAT(faults(with("[cell]", "[cel]")),
              AllOf(HasSubstr("unknown key cel"), HasSubstr("is cell"), HasSubstr("cell is missing")));
  EXPECT_THAT(
      faults(with("steps_per_decade = 8", "steps_per_decad = 8")),
      AllOf(HasSubstr("s.toml:23: unknown key load.0.steps_per_decad"), HasSubstr("is steps_per_decade")));
}

TEST(ReadScene, AllFaultsAreListedInTheOrderOfTheFile) {
  std::string text = with("count = 40", "count = 1");
  text.replace(text.find("mass = 1\n"), 9, "mass = -1\n");
  const std::string all = faults(text + "[run]\nspeed = 3\n");
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 2) << all;
  const auto first = all.find("s.toml:5: grains.count = 1"), second = all.find("s.toml:15: cell.mass = -1"),
             third = all.find("s.toml:25: unknown key run.speed");
  EXPECT_LT(first, second) << all;
  EXPECT_LT(second, third) << all;
  EXPECT_NE(third, std::string::npos) << all;
}

struct BadScene {
  const char* line;
  const char* instead;
  const char* message;
};

class RefusedScene : public testing::TestWithParam<BadScene> {};

TEST_P(RefusedScene, SaysWhereWhatAndWhatWasExpected) {
  const auto& [line, instead, message] = GetParam();
  const std::string text = with(line, instead);
  const std::string all = faults(text);
  EXPECT_THAT(all, HasSubstr(message));
  EXPECT_THAT(all, HasSubstr("s.toml"));
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 0) << "one mistake, several faults:\n" << all;
}

INSTANTIATE_TEST_SUITE_P(
    ReadScene, RefusedScene,
    testing::Values(
        BadScene{"mass = 1\n", "mass = 0\n", "cell.mass = 0: expected a positive number"},
        BadScene{", stiffness = 10}", "}", "contact.rolling.stiffness is missing"},
        BadScene{"agitation = 9.5\n", "agitation = 9.5\ngas = \"dense\"\n",
                 "assembly.gas = 'dense': expected \"equilibrated\" or \"sequential_addition\""},
        BadScene{"force = 1.0, ", "", "contact.adhesion.force is missing"},
        BadScene{"pressure = 0.01", "pressure = \"low\"",
                 "assembly.pressure = 'low': expected a positive number"},
        BadScene{"pressure = 0.01", "pressure = true", "assembly.pressure = true: expected"},
        BadScene{"pressure = 0.01", "pressure = nan", "assembly.pressure = nan: expected"},
        BadScene{"stiffness = 1e5}\nadhesion", "stiffness = inf}\nadhesion", "contact.normal.stiffness = inf"},
        BadScene{"stiffness = 1e5}\nadhesion", "stiffness = -1e5}\nadhesion",
                 "expected a positive number (normal stiffness K_N, force per length)"},
        BadScene{"min = 0.5", "min = 1.5",
                 "grains.diameter.min = 1.5: expected at most grains.diameter.max = 1"},
        BadScene{"count = 40", "count = 40.5",
                 "grains.count = 40.5: expected the number of grains, a whole number"},
        BadScene{"solid_fraction = 0.36", "solid_fraction = 0.75", "cell.solid_fraction = 0.75: expected"},
        BadScene{"solid_fraction = 0.36", "solid_fraction = 0", "cell.solid_fraction = 0: expected"},
        BadScene{"restitution = 0.015", "restitution = 1.5", "contact.damping.restitution = 1.5: expected"},
        BadScene{"coefficient = 0.5, ", "coefficient = -0.5, ",
                 "contact.friction.coefficient = -0.5: expected"},
        BadScene{"friction = {coefficient = 0.5, stiffness = 1e5}\n", "",
                 "contact.rolling: rolling resistance needs friction, because grains without friction do not "
                 "rotate; give contact.friction"},
        BadScene{"law = \"tail\", force = 1.0, range = 1e-3", "law = \"tail\", force = 1.0, range = 0",
                 "contact.adhesion.range = 0: expected"},
        BadScene{"[cell]", "range = 1e-3\n[cell]", "unknown key contact.range"},
        BadScene{"dimension = 2", "dimension = 4", "scene.dimension = 4: expected 2 or 3"},
        BadScene{"dimension = 2", "dimension = 2.0",
                 "scene.dimension = 2.0: expected 2 or 3, written without a decimal point"},
        BadScene{"units = \"reduced\"\n", "", "scene.units is missing: expected \"reduced\" or \"SI\""},
        BadScene{"strain_rate_cap = 0.05", "strain_rate_cap = 0.05\ninertial_number_cap = 1e-3",
                 "expected only one of them"},
        BadScene{"pressure = 0.01", "pressure = 0.01\nstrain_rate_cap = 0",
                 "assembly.strain_rate_cap = 0: expected a positive number"},
        BadScene{
            "[[load]]", "[[load]]\ninertial_number_cap = 1e-3\nstrain_rate_cap = 0.05",
            "load.0.inertial_number_cap is given together with strain_rate_cap: expected only one of them"},
        BadScene{"[[load]]", "[[load]]\nset = {adhesion.force = 0}\nstrain_rate_cap = 0.05",
                 "load.0.strain_rate_cap is not allowed here: its unit 1/T0"},
        BadScene{
            "protocol = \"aggregation\"", "protocol = \"direct\"",
            "assembly.agitation is not allowed here: with protocol = \"direct\" cohesive grains start at rest"},
        BadScene{"agitation = 9.5\n", "", "assembly.agitation is missing"},
        BadScene{"to = 1.0", "to = -1.0", "load.0.to = -1: expected a pressure"},
        BadScene{"steps_per_decade = 8", "", "load.0.steps_per_decade is missing"},
        BadScene{"steps_per_decade = 8", "steps_per_decade = 8\nsteps = 3",
                 "load.0.steps is given together with steps_per_decade"},
        BadScene{"steps_per_decade = 8", "steps_per_decade = 8\nset = {adhesion = {forc = 0}}",
                 "load.0.set.adhesion.forc: the contact law of the scene has no such parameter; its parameter "
                 "with the most similar name is adhesion.force"},
        BadScene{"steps_per_decade = 8", "steps_per_decade = 8\nset = {normal.stiffness = -2}",
                 "contact.normal.stiffness = -2: must be positive"},
        BadScene{"steps_per_decade = 8", "steps_per_decade = 1e9",
                 "load.0.steps_per_decade = 1000000000: expected the number of steps per decade of "
                 "pressure, a number in (0, 1000]"},
        BadScene{"steps_per_decade = 8", "steps = 1000000000",
                 "load.0.steps = 1000000000: expected the number of steps, a whole number"},
        BadScene{"count = 40", "count = 99999999999",
                 "grains.count = 99999999999: expected the number of grains, a whole number from 2 to 1e8"},
        BadScene{"{distribution = \"uniform\", min = 0.5, max = 1.0}", "{distribution = \"list\", values = []}",
                 "grains.diameter.values = []: expected an array of positive numbers"},
        BadScene{"[[load]]", "[load]", "load = a table: expected tables [[load]]"},
        BadScene{"[cell]", "[cell", "s.toml:13"}));

/// Returns the relaxation options of a loading stage; of_assembly() returns those of the assembly.
RelaxationOptions of_load(const Scene& scene, std::size_t stage = 0) {
  return scene.load.at(stage).cell.applied_to(scene.relaxation);
}
RelaxationOptions of_assembly(const Scene& scene) {
  return scene.assembly.cell.applied_to(scene.relaxation);
}

TEST(ReadScene, WhatTheCellDoesIsSaidByTheStageElseByTheCellElseBuiltIn) {
  const std::string silent = with("mass = 1\nstrain_rate_cap = 0.05\n", "");
  const Scene built_in = read(silent);
  EXPECT_EQ(of_assembly(built_in).cell_mass, kAssemblyCellMass);
  EXPECT_EQ(of_load(built_in).cell_mass, kLoadCellMass);
  EXPECT_NE(kAssemblyCellMass, kLoadCellMass);
  EXPECT_EQ(of_assembly(built_in).strain_rate_cap, kStrainRateCap);
  EXPECT_EQ(of_load(built_in).strain_rate_cap, kStrainRateCap);

  const Scene of_cell =
      read(with("mass = 1\nstrain_rate_cap = 0.05\n", "mass = 0.3\nstrain_rate_cap = 0.07\n"));
  for (const RelaxationOptions& options : {of_assembly(of_cell), of_load(of_cell)}) {
    EXPECT_EQ(options.cell_mass, 0.3);
    EXPECT_EQ(options.strain_rate_cap, 0.07);
  }

  const std::string stages = "[[load]]\nto = 2.0\nsteps = 1\n";
  for (const std::string& text : {silent, std::string(kScene)}) {
    const Scene s = read(text + stages, {"load.0.cell_mass=0.02", "load.0.strain_rate_cap=0.03",
                                         "assembly.cell_mass=2", "assembly.strain_rate_cap=0.04"});
    EXPECT_EQ(of_assembly(s).cell_mass, 2.0);
    EXPECT_EQ(of_assembly(s).strain_rate_cap, 0.04);
    EXPECT_EQ(of_load(s).cell_mass, 0.02);
    EXPECT_EQ(of_load(s).strain_rate_cap, 0.03);
    EXPECT_EQ(of_load(s, 1).cell_mass,
              text == silent ? kLoadCellMass : 1.0);  // only the first stage sets a mass
  }
}

TEST(ReadScene, ACapOfAStageTakesThePlaceOfTheOtherKind) {
  const RelaxationOptions options = of_load(read(kScene, {"load.0.inertial_number_cap=1e-4"}));
  EXPECT_EQ(options.inertial_number_cap, 1e-4);
  EXPECT_FALSE(options.strain_rate_cap);
}

TEST(ReadScene, WithoutAdhesionTheBuiltInCapIsAnInertialNumber) {
  std::string text = with("adhesion = {law = \"tail\", force = 1.0, range = 1e-3}\n", "");
  text.replace(text.find("protocol = \"aggregation\"\nagitation = 9.5"), 40, "protocol = \"direct\"       \n");
  text.replace(text.find("strain_rate_cap = 0.05\n"), 23, "");
  const Scene s = read(text);
  for (const RelaxationOptions& options : {of_assembly(s), of_load(s)}) {
    EXPECT_EQ(options.inertial_number_cap, kLargestInertialNumber);
    EXPECT_FALSE(options.strain_rate_cap);
  }
}

TEST(ReadScene, CohesionlessScenesNeedACapThatDoesNotCountInAdhesionTimes) {
  std::string text = with("adhesion = {law = \"tail\", force = 1.0, range = 1e-3}\n", "");
  text.replace(text.find("protocol = \"aggregation\"\nagitation = 9.5"), 40, "protocol = \"direct\"       \n");
  EXPECT_THAT(faults(text), HasSubstr("cell.strain_rate_cap is not allowed here: its unit 1/T0"));
  text.replace(text.find("strain_rate_cap"), 15, "inertial_number_cap");
  EXPECT_EQ(faults(text), "");
  EXPECT_THAT(faults(text, {"load.0.to=0"}), HasSubstr("without adhesion nothing holds the grains together"));
}

TEST(ReadScene, AggregationNeedsAnAdhesionWithATail) {
  EXPECT_THAT(faults(with("law = \"tail\", force = 1.0, range = 1e-3", "law = \"constant\", force = 1.0")),
              HasSubstr("grains stick to each other only by an adhesion that acts across a gap"));
  EXPECT_THAT(faults(with("law = \"tail\", force", "law = \"constant\", force")),
              HasSubstr("the model \"constant\" of contact.adhesion has no range"));
}

/// Returns the scene with liquid bridges instead of the tail adhesion, and with the compression in a single step.
std::string wet_scene(const std::string& adhesion) {
  std::string text =
      with("adhesion = {law = \"tail\", force = 1.0, range = 1e-3}", "adhesion = {" + adhesion + "}");
  text.replace(text.find("protocol = \"aggregation\"\nagitation = 9.5"), 40, "protocol = \"direct\"       \n");
  const std::size_t rolling = text.find("rolling = ");
  text.erase(rolling, text.find('\n', rolling) - rolling);
  return text;
}

TEST(ReadScene, LiquidBridgesAreRead) {
  const std::string numbers =
      "law = \"capillary\", surface_tension = 0.072, contact_angle = 10, water_content = 0.007, density_ratio "
      "= 2.6";
  EXPECT_EQ(faults(wet_scene(numbers)), "");
  const Law read_law = read(wet_scene(numbers)).law;
  Law law = read_law;
  law += test::liquid(0.072, 10.0, 0.007, 2.6);
  EXPECT_EQ(read_law, law);
  law += test::liquid(0.072, 10.0, 0.007, 2.6, "rational", "contact");
  EXPECT_EQ(read(wet_scene(numbers + ", form = \"rational\", formation = \"contact\"")).law, law);
  EXPECT_NE(read_law, law);
}

TEST(ReadScene, LiquidThatCannotBeIsRefusedInWords) {
  const auto faults_of = [](const std::string& tension, const std::string& angle, const std::string& water) {
    return faults(wet_scene("law = \"capillary\", surface_tension = " + tension + ", contact_angle = " + angle +
                            ", water_content = " + water + ", density_ratio = 2.6"));
  };
  EXPECT_THAT(faults_of("0", "10", "0.007"),
              HasSubstr("contact.adhesion.surface_tension = 0: expected a positive"));
  EXPECT_THAT(faults_of("0.072", "91", "0.007"),
              HasSubstr("contact.adhesion.contact_angle = 91: expected an angle in degrees, in [0, 90]"));
  EXPECT_THAT(faults_of("0.072", "-1", "0.007"), HasSubstr("contact.adhesion.contact_angle = -1: expected"));
  EXPECT_THAT(faults_of("0.072", "10", "-1"),
              HasSubstr("contact.adhesion.water_content = -1: expected a number >= 0"));
  EXPECT_THAT(
      faults(wet_scene("law = \"tail\", force = 1.0, range = 1e-3, water_content = 0.1")),
      HasSubstr("the model \"tail\" of contact.adhesion has no water_content; expected law = \"capillary\""));
  EXPECT_THAT(faults(wet_scene("law = \"capillary\", surface_tension = 0.072, contact_angle = 10, "
                               "water_content = 0.007, density_ratio = 2.6, form = \"linear\"")),
              HasSubstr("form = 'linear'"));
}

/// If the cap of the strain rate is proportional to the pressure, it vanishes at zero pressure, and nothing could move.
/// Such a scene is refused for every kind of adhesion.
TEST(ReadScene, ZeroPressureIsRefusedWhereTheCapOnRatesVanishes) {
  std::string text = wet_scene(
      "law = \"capillary\", surface_tension = 0.072, contact_angle = 10, water_content = 0, density_ratio = "
      "2.6");
  const std::vector<std::string> unload = {"load.0.to=0", "load.0.set={adhesion.water_content = 0.01}"};
  EXPECT_EQ(faults(text, unload), "");
  const std::size_t cap = text.find("strain_rate_cap");
  text.replace(cap, text.find('=', cap) - cap, "inertial_number_cap ");
  EXPECT_EQ(faults(text), "");
  EXPECT_THAT(faults(text, unload),
              HasSubstr("to = 0: at zero pressure cell.inertial_number_cap allows no motion; "
                        "expected cell.strain_rate_cap in its place"));
}

TEST(ReadScene, ChangesOfATurnAreFlattenedHoweverTheyAreWritten) {
  for (const char* set :
       {"set = {adhesion = {force = 0}}", "set = {adhesion.force = 0}", "set = {\"adhesion.force\" = 0}"}) {
    const Scene s = read(std::string(kScene) + "[[load]]\nto = 1.0\n" + set + "\n");
    ASSERT_EQ(s.load.size(), 2u);
    EXPECT_EQ(s.load[1].name, "hold");
    EXPECT_EQ(s.load[1].set, (std::vector<std::pair<std::string, double>>{{"adhesion.force", 0.0}})) << set;
  }
}

TEST(ReadScene, EveryDistributionOfDiametersIsRead) {
  using Kind = DiameterDistribution::Kind;
  const std::string uniform = "{distribution = \"uniform\", min = 0.5, max = 1.0}";
  const Scene constant = read(with(uniform, "{distribution = \"constant\", value = 2}"));
  EXPECT_EQ(constant.grains.diameter.kind, Kind::constant);
  EXPECT_EQ(constant.grains.diameter.max, 2.0);
  const Scene two =
      read(with(uniform, "{distribution = \"bidisperse\", small = 0.7, large = 1, share_of_large = 0.4}"));
  EXPECT_EQ(two.grains.diameter.min, 0.7);
  EXPECT_EQ(two.grains.diameter.max, 1.0);
  EXPECT_EQ(two.grains.diameter.share_of_large, 0.4);
  EXPECT_THAT(
      faults(with(uniform, "{distribution = \"constant\", min = 2}")),
      AllOf(HasSubstr("grains.diameter.value is missing"), HasSubstr("unknown key grains.diameter.min")));
}

TEST(ReadScene, DistributionsOverWideRangesAreRead) {
  using Kind = DiameterDistribution::Kind;
  const std::string uniform = "{distribution = \"uniform\", min = 0.5, max = 1.0}";
  const Scene volume = read(with(uniform, "{distribution = \"uniform_by_volume\", min = 0.05, max = 1}"));
  EXPECT_EQ(volume.grains.diameter.kind, Kind::power_law);
  EXPECT_EQ(volume.grains.diameter.exponent, 3.0);
  const Scene area = read(with(uniform, "{distribution = \"uniform_by_area\", min = 0.05, max = 1}"));
  EXPECT_EQ(area.grains.diameter.exponent, 2.0);
  const Scene power = read(with(uniform, "{distribution = \"power_law\", min = 0.05, max = 1, exponent = -1}"));
  EXPECT_EQ(power.grains.diameter.exponent, -1.0);
  const Scene normal =
      read(with(uniform, "{distribution = \"lognormal\", median = 0.4, sigma = 0.3, min = 0.1, max = 1}"));
  EXPECT_EQ(normal.grains.diameter.kind, Kind::lognormal);
  EXPECT_EQ(normal.grains.diameter.median, 0.4);
  EXPECT_EQ(normal.grains.diameter.sigma, 0.3);
}

TEST(ReadScene, FaultyDistributionsAreNamedWithTheirLine) {
  const std::string uniform = "{distribution = \"uniform\", min = 0.5, max = 1.0}";
  const auto refused = [&](const std::string& diameter) { return faults(with(uniform, diameter)); };
  EXPECT_THAT(refused("{distribution = \"uniform_by_volume\", min = 2, max = 1}"),
              testing::ContainsRegex(
                  "[a-z]+:[0-9]+.*grains.diameter.min = 2: expected at most grains.diameter.max = 1"));
  EXPECT_THAT(refused("{distribution = \"uniform_by_volume\", min = 0.1, max = 1, exponent = 3}"),
              HasSubstr("unknown key grains.diameter.exponent"));
  EXPECT_THAT(refused("{distribution = \"power_law\", min = 0.1, max = 1}"),
              HasSubstr("grains.diameter.exponent is missing"));
  EXPECT_THAT(refused("{distribution = \"power_law\", min = 0.1, max = 1, exponent = 300}"),
              HasSubstr("expected a number from -100 to 100"));
  EXPECT_THAT(refused("{distribution = \"lognormal\", median = 0.4, sigma = 0, min = 0.1, max = 1}"),
              HasSubstr("grains.diameter.sigma = 0"));
  EXPECT_THAT(refused("{distribution = \"lognormal\", median = 100, sigma = 0.1, min = 0.1, max = 1}"),
              HasSubstr("grains.diameter.median = 100: only the fraction 0 of this distribution lies between"));
}

TEST(ReadScene, AListOfDiametersIsReadBesideTheSceneAndKeptInItsText) {
  const test::ScratchDirectory scratch;
  const std::filesystem::path dir = scratch.path();
  std::ofstream(dir / "d.txt") << "# diameters\n0.5 0.75\n1.0\n";
  const std::string uniform = "{distribution = \"uniform\", min = 0.5, max = 1.0}";
  std::string text = with(uniform, "{distribution = \"list\", file = \"d.txt\"}");
  text.replace(text.find("count = 40"), 10, "count = 3");
  std::ofstream(dir / "s.toml") << text;
  const Scene s = read_scene((dir / "s.toml").string());
  EXPECT_EQ(s.grains.diameter.values, (std::vector<double>{0.5, 0.75, 1.0}));
  EXPECT_EQ(s.grains.diameter.max, 1.0);
  EXPECT_EQ(read(s.text).grains.diameter.values, s.grains.diameter.values);
  std::ofstream(dir / "d.txt") << "0.5 0.75\n-1.0\n";
  EXPECT_THAT([&] { read_scene((dir / "s.toml").string()); },
              testing::ThrowsMessage<InputError>(
                  HasSubstr("d.txt:2: '-1.0' is not a diameter: expected a positive number")));
  std::ofstream(dir / "d.txt") << "# nothing yet\n";
  EXPECT_THAT([&] { read_scene((dir / "s.toml").string()); },
              testing::ThrowsMessage<InputError>(HasSubstr("d.txt: the file contains no diameters")));
}

TEST(ReadScene, WhatIsNoListOfDiametersIsRefusedWithTheReason) {
  const test::ScratchDirectory scratch;
  const std::filesystem::path dir = scratch.path();
  std::filesystem::create_directories(dir / "directory");
  const auto scene_with = [&](const std::string& file) {
    std::string text = with("{distribution = \"uniform\", min = 0.5, max = 1.0}",
                            "{distribution = \"list\", file = \"" + file + "\"}");
    text.replace(text.find("count = 40"), 10, "count = 2");
    std::ofstream(dir / "s.toml") << text;
    return read_scene((dir / "s.toml").string());
  };
  std::ofstream(dir / "marked.txt") << "\xef\xbb\xbf"
                                       "0.5\n0.75\n";
  EXPECT_EQ(scene_with("marked.txt").grains.diameter.values, (std::vector<double>{0.5, 0.75}));
  std::ofstream(dir / "utf16.txt", std::ios::binary) << std::string(
      "\xff\xfe"
      "0\0.\0"
      "5\0\n\0",
      10);
  std::ofstream(dir / "comma.txt") << "0,5\n0,75\n";
  std::ofstream(dir / "empty.txt");
  std::ofstream(dir / "hexadecimal.txt") << "0x10\n0.5\n";
  for (const auto& [file, words] :
       {std::pair{"directory", "directory: this is a directory, but a file is expected"},
        {"missing.txt", "missing.txt: No such file or directory"},
        {"utf16.txt", "utf16.txt: the file is in the encoding UTF-16: save it as UTF-8"},
        {"comma.txt",
         "comma.txt:1: '0,5' is not a diameter: expected a positive number with a decimal point, not a comma"},
        {"empty.txt", "empty.txt: the file contains no diameters"},
        {"hexadecimal.txt", "hexadecimal.txt:1: '0x10' is not a diameter: expected a positive number"}})
    EXPECT_THAT(([&scene_with, name = file] { scene_with(name); }),
                testing::ThrowsMessage<InputError>(HasSubstr(words)));
}

TEST(ReadScene, AFileThatIsNotThereIsNamed) {
  EXPECT_THAT([] { read_scene("no-such-scene.toml"); },
              testing::ThrowsMessage<InputError>(HasSubstr("no-such-scene.toml: there is no such file")));
}

TEST(ShippedScenes, AllAreValidAndNamedAfterTheirFiles) {
  int n = 0, n_cycles = 0;
  for (const auto& file : std::filesystem::directory_iterator(test::source_directory() + "/data/scenes")) {
    if (file.path().extension() != ".toml") continue;
    const Scene s = read_scene(file.path().string());
    EXPECT_EQ(s.name, file.path().stem());
    ++n;
    if (s.load.empty() || !s.load.back().is_isotropic()) continue;
    EXPECT_EQ(s.load.size(), s.name == "stiff_contacts" ? 8u : 2u);
    EXPECT_EQ(s.load.back().to, s.assembly.pressure);
    ++n_cycles;
  }
  EXPECT_EQ(n, 39);
  EXPECT_EQ(n_cycles, 19);
}

}  // namespace
}  // namespace floc
