#include "floc/scene/read_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "floc/base/error.h"
#include "floc/scene/cell_defaults.h"
#include "support/contact_laws.h"
#include "support/places.h"

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
  try {
    read(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
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
  // The stored text alone makes the same scene, to the last bit.
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

/// Options of the relaxations of a stage of the load path; of_assembly() has those of the assembly.
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
    EXPECT_EQ(of_load(s, 1).cell_mass, text == silent ? kLoadCellMass : 1.0);  // said of the first stage alone
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

/// The scene with liquid bridges in place of its tail, compressed at once.
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

/// A cap in units of the pressure is none that grains could follow without pressure, however they came to adhere.
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
  const std::filesystem::path dir = std::filesystem::path(testing::TempDir()) / "floc_read_scene_test";
  std::filesystem::create_directories(dir);
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
  std::filesystem::remove_all(dir);
}

TEST(ReadScene, WhatIsNoListOfDiametersIsRefusedWithTheReason) {
  const std::filesystem::path dir = std::filesystem::path(testing::TempDir()) / "floc_diameters_test";
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
  std::filesystem::remove_all(dir);
}

/// Scene with a table of sieves beside it.
class SievedScene : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(dir_); }
  void TearDown() override { std::filesystem::remove_all(dir_); }

  Scene read_with(const std::string& table, const std::string& keys = "",
                  const std::string& units = "reduced") {
    std::ofstream(dir_ / "sand.csv") << table;
    std::string text = with("{distribution = \"uniform\", min = 0.5, max = 1.0}",
                            "{distribution = \"sieve\", file = \"sand.csv\"" + keys + "}");
    text.replace(text.find("units = \"reduced\""), 17, "units = \"" + units + "\"");
    if (units == "SI") text.replace(text.find("count = 40"), 10, "count = 40\ndensity = 1.0");
    std::ofstream(dir_ / "s.toml") << text;
    return read_scene((dir_ / "s.toml").string());
  }
  std::string refusal(const std::string& table, const std::string& keys = "",
                      const std::string& units = "reduced") {
    try {
      read_with(table, keys, units);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const std::filesystem::path dir_ = std::filesystem::path(testing::TempDir()) / "floc_sieved_scene_test";
};

TEST_F(SievedScene, ReadsPercentAndFractionsFromFineToCoarseAndBack) {
  for (const char* table :
       {"size,passing\n0.25,0\n0.5,40\n1,100\n", "passing [%],sieve\n100,1\n40,0.5\n0,0.25\n",
        "Sieve Size,Percent finer\n1,100\n0.5,40\n0.25,0\n"}) {
    const DiameterDistribution d = read_with(table).grains.diameter;
    EXPECT_EQ(d.kind, DiameterDistribution::Kind::sieve);
    EXPECT_EQ(d.curve.sizes, (std::vector<double>{0.25, 0.5, 1.0})) << table;
    EXPECT_EQ(d.curve.passing, (std::vector<double>{0.0, 40.0, 100.0})) << table;
    EXPECT_EQ(d.min, 0.25);
    EXPECT_EQ(d.max, 1.0);
    EXPECT_EQ(d.dimension, 2);
  }
  EXPECT_NEAR(read_with("size,passing [-]\n0.25,0\n0.5,0.4\n1,1\n").grains.diameter.curve.passing[1], 40.0,
              1e-13);
}

TEST_F(SievedScene, IsKeptInItsTextBitByBit) {
  for (const char* keys : {"", ", scale = 0.7", ", min = 0.3, max = 0.95", ", scale = 0.7, min = 0.3"}) {
    const Scene s = read_with("size,passing\n0.25,0\n0.5,41.3\n0.7,77.7\n1,100\n", keys);
    const Scene again = read(s.text);
    EXPECT_EQ(again.grains.diameter.curve.sizes, s.grains.diameter.curve.sizes) << keys;
    EXPECT_EQ(equally_spaced_diameters(again.grains.diameter, 40),
              equally_spaced_diameters(s.grains.diameter, 40));
    EXPECT_EQ(again.text, s.text);
  }
}

TEST_F(SievedScene, HasSizesInTheUnitOfTheScene) {
  const std::string table = "size [mm],passing [%]\n0.25,0\n2,100\n";
  EXPECT_NEAR(read_with(table, ", scale = 0.5").grains.diameter.max, 1.0, 1e-15);
  EXPECT_THAT(refusal(table),
              HasSubstr("the sizes are in mm, but the scene is in reduced units: expected the key "
                        "grains.diameter.scale"));
  EXPECT_NEAR(read_with(table, "", "SI").grains.diameter.max, 2e-3, 1e-18);
  EXPECT_THAT(refusal("size,passing\n0.25,0\n2,100\n", "", "SI"), HasSubstr("found no unit here"));
  EXPECT_THAT(refusal("size [kPa],passing\n0.25,0\n2,100\n", "", "SI"), HasSubstr("found the unit kPa here"));
}

TEST_F(SievedScene, ThatIsNoGradingCurveIsRefusedWithLineAndReason) {
  const struct {
    const char *table, *keys, *words;
  } scenes[] = {
      {"size,passing\n1,0\n2,60\n3,50\n4,100\n", "",
       "sand.csv:4: 50 % of the mass pass the sieve of size 3, but 60 % pass the finer sieve of size 2"},
      {"size,passing\n1,3\n4,100\n", "", "sand.csv:2: 3 % of the mass are finer than the finest sieve, 1"},
      {"size,passing\n4,98\n1,0\n", "", "sand.csv:2: only 98 % of the mass pass the coarsest sieve, 4"},
      {"size,passing\n0,0\n4,100\n", "", "sand.csv:2: the size of a sieve is 0: expected a positive size"},
      {"size,passing\n1,0\n4,101\n", "", "sand.csv:3: 101 % of the mass pass the sieve of size 4"},
      {"size,passing\n1,0\n1,50\n4,100\n", "", "sand.csv:3: two rows have the size 1"},
      {"size,passing\n1,100\n", "", "there is one sieve"},
      {"mesh,passing\n1,0\n4,100\n", "", "there is no column with the sizes of the sieves"},
      {"size,retained\n1,0\n4,100\n", "", "there is no column with the percentage of the mass that passes"},
      {"size,passing [g]\n1,0\n4,100\n", "", "column passing [g]: found the unit g here: expected a number without unit, or in %"},
      {"size,passing\n1,0\n4,100\n", ", min = 5", "grains.diameter.min = 5: expected a size within the curve"},
      {"size,passing\n1,0\n2,50\n3,50\n4,100\n", ", min = 2.1, max = 2.9",
       "no grains are between the sizes 2.1"},
      {"size,passing\n1,0\n4,x\n", "", "sand.csv:3"},
      {"size,passing\n1,0\n4,100\n", ", scale = 0", "grains.diameter.scale = 0"},
  };
  for (const auto& [table, keys, words] : scenes) EXPECT_THAT(refusal(table, keys), HasSubstr(words)) << table;
  EXPECT_EQ(refusal("size,passing\n1,3\n4,98\n", ", min = 1, max = 4"), "accepted");
  std::filesystem::remove(dir_ / "sand.csv");
  EXPECT_THAT([&] { read_scene((dir_ / "s.toml").string()); },
              testing::ThrowsMessage<InputError>(HasSubstr("sand.csv: No such file or directory")));
}

TEST(ReadScene, SievesInTheSceneAreArraysOfOneLength) {
  const std::string uniform = "{distribution = \"uniform\", min = 0.5, max = 1.0}";
  const auto sieve = [&](const std::string& keys) {
    return with(uniform, "{distribution = \"sieve\", " + keys + "}");
  };
  EXPECT_EQ(read(sieve("sizes = [0.5, 1], passing = [0, 100]")).grains.diameter.curve.sizes.size(), 2u);
  EXPECT_THAT(
      faults(sieve("sizes = [0.5, 1], passing = [0, 50, 100]")),
      HasSubstr("grains.diameter.passing has 3 numbers, but grains.diameter.sizes has 2: expected as many"));
  EXPECT_THAT(faults(sieve("sizes = [0.5, 1]")), HasSubstr("grains.diameter.passing is missing"));
  EXPECT_THAT(faults(sieve("quantiles = \"ends\", sizes = [0.5, 1], passing = [0, 100]")),
              HasSubstr("unknown key grains.diameter.quantiles"));
}

TEST(ReadScene, ALognormalByMassHasItsMedianByMass) {
  const std::string uniform = "{distribution = \"uniform\", min = 0.5, max = 1.0}";
  const std::string keys = "{distribution = \"lognormal\", median = 1, sigma = 0.3, min = 0.1, max = 10";
  EXPECT_EQ(read(with(uniform, keys + ", by = \"number\"}")).grains.diameter.median, 1.0);
  const DiameterDistribution d =
      read(with(uniform, keys + ", by = \"mass\", quantiles = \"middle\"}")).grains.diameter;
  // Half of the mass of many disks is in those below the median.
  double below = 0.0, all = 0.0;
  for (const double x : equally_spaced_diameters(d, 200'000)) all += x * x, below += x < 1.0 ? x * x : 0.0;
  EXPECT_NEAR(below / all, 0.5, 1e-4);
  EXPECT_NEAR(*volume_share_below(d, 2, std::exp(0.3)), 0.8413447460685429, 1e-9);
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
  EXPECT_EQ(n, 30);
  EXPECT_EQ(n_cycles, 18);
}

}  // namespace
}  // namespace floc
