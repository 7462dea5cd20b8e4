#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floc/io/state_file.h"
#include "support/places.h"
#include "support/small_run.h"
#include "support/states.h"

namespace floc::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class PlotCommand : public SmallRun {};

TEST_F(PlotCommand, WritesDataAndScriptFromWhichGnuplotMakesThePictureAgain) {
  const Outcome o = floc("plot " + demo_tables() + " -o 'the curve.svg' --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json row = json::parse(o.out).at(0);
  EXPECT_EQ(row.at("shows"), "consolidation");
  EXPECT_EQ(row.at("data"), "the curve.dat");
  const std::string picture = content_of(file("the curve.svg"));
  EXPECT_THAT(picture, AllOf(HasSubstr("<svg"), HasSubstr("</svg>"), HasSubstr("unloading"), HasSubstr("III")));
  EXPECT_THAT(content_of(file("the curve.dat")), HasSubstr("# elastic lines: P_star 1/phi"));
  std::filesystem::remove(file("the curve.svg"));
  ASSERT_EQ(std::system(("cd '" + file("") + "' && gnuplot 'the curve.gp'").c_str()), 0);
  EXPECT_TRUE(content_of(file("the curve.svg")) == picture);
  EXPECT_FALSE(exists("the curve.svg.drawn"));
}

TEST_F(PlotCommand, GivesTheSameBytesAgainInEveryFormat) {
  for (const std::string ending : {"svg", "pdf", "png"}) {
    ASSERT_EQ(floc("plot " + demo_tables() + " -o one." + ending).code, 0);
    const std::string first = content_of(file("one." + ending));
    ASSERT_GT(first.size(), 1000u);
    EXPECT_THAT(first, ::testing::Not(HasSubstr("/CreationDate (D:")));
    ASSERT_EQ(floc("plot " + demo_tables() + " -o one." + ending).code, 0);
    EXPECT_TRUE(content_of(file("one." + ending)) == first) << ending;
  }
}

/// Returns the rows of numbers in one block of a data file.
std::vector<std::vector<double>> block(const std::string& text, const std::string& name) {
  std::istringstream lines(text.substr(text.find("# " + name)));
  std::vector<std::vector<double>> rows;
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line) && !line.empty();) {
    std::istringstream numbers(line);
    rows.emplace_back();
    for (std::string number; numbers >> number;) rows.back().push_back(std::atof(number.c_str()));
  }
  return rows;
}

TEST_F(PlotCommand, CoordinationGoesUpAndDownThePath) {
  ASSERT_EQ(floc("plot run -o z.svg --show coordination").code, 0);
  const std::string data = content_of(file("z.dat"));
  const auto loading = block(data, "loading"), unloading = block(data, "unloading");
  // The loading has seven pressures, not counting P = 0. The state at the largest pressure belongs to both the loading
  // and the unloading.
  ASSERT_EQ(loading.size(), 7u);
  ASSERT_EQ(unloading.size(), 2u);
  EXPECT_EQ(loading.back(), unloading.front());
  for (const auto& row : loading) EXPECT_NEAR(row[1], row[2] + row[3] + row[4], 1e-12);
}

TEST_F(PlotCommand, ModuliOfStatesAndOfTheirTableAreTheSame) {
  ASSERT_EQ(floc("plot run -o states.svg --show moduli").code, 0);
  const Outcome table = floc("moduli run/state-*.h5 --format csv");
  const Outcome piped = floc("plot - -o piped.svg --show moduli", table.out);
  ASSERT_EQ(piped.code, 0) << piped.err;
  const auto states = block(content_of(file("states.dat")), "loading");
  const auto rows = block(content_of(file("piped.dat")), "loading");
  ASSERT_EQ(states.size(), 7u);
  ASSERT_EQ(rows.size(), 7u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // The pressures in the table are computed from the contact forces; the pressures in the states are the imposed
    // ones. They agree within the tolerance of the stress.
    EXPECT_NEAR(rows[i][0], states[i][0], 1e-5);
    for (std::size_t k = 1; k < 7; ++k) {
      if (std::isnan(rows[i][k]) && std::isnan(states[i][k])) continue;
      EXPECT_NEAR(rows[i][k] / states[i][k], 1.0, 1e-9) << k;
    }
  }
  int n_bounded = 0;
  for (const auto& row : states) {
    EXPECT_LE(row[3], row[6]);  // Voigt bound of G
    EXPECT_EQ(std::isnan(row[4]), std::isnan(row[5]));
    if (std::isnan(row[4])) continue;  // there are no bounds for states with attractions at a distance
    ++n_bounded;
    EXPECT_LE(row[4], row[1]);  // Reuss bound of B
    EXPECT_LE(row[1], row[5]);  // Voigt bound of B
  }
  EXPECT_GT(n_bounded, 0);
}

TEST_F(PlotCommand, ForceDensitiesHoldAllForces) {
  const Outcome o = floc("plot run/state-0005.h5 -o f.svg --unit F0 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(json::parse(o.out).at(0).at("shows"), "forces");
  const json info = json::parse(floc("info run/state-0005.h5 --format json").out).at(0);
  double n = 0.0;
  for (const auto& row : block(content_of(file("f.dat")), "P* = ")) n += row[4];
  EXPECT_EQ(n, info.at("n_contacts").get<double>() + info.at("n_distant").get<double>());
  for (const std::string kind : {"tangential", "rolling"})
    EXPECT_EQ(floc("plot run --show forces --steps 2,6 --kind " + kind + " -o f.svg").code, 0) << kind;
}

TEST_F(PlotCommand, ScatteringIsPlottedAndWhatIsNotFittedIsSaid) {
  const Outcome o = floc("plot run --show scattering --steps 1,7 -o i.svg");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(content_of(file("i.svg")), HasSubstr("</svg>"));
  EXPECT_GT(block(content_of(file("i.dat")), "P* = ").size(), 5u);
}

TEST_F(PlotCommand, ScatteringOfSpheresIsInTheirVolume) {
  write_state(file("spheres.h5"), busy_state<3>());
  EXPECT_EQ(floc("plot spheres.h5 --show scattering -o i3.svg").code, 0);
  EXPECT_THAT(content_of(file("i3.gp")), HasSubstr("I(k)/a^3"));
  const Outcome mixed = floc("plot spheres.h5 run/state-0007.h5 --show scattering -o i3.svg");
  EXPECT_EQ(mixed.code, 4);
  EXPECT_THAT(mixed.err,
              HasSubstr("run/state-0007.h5: this is a state in 2D, but the states before it are not"));
}

TEST_F(PlotCommand, HasNoLegendOfWhatIsNotDrawn) {
  // Writes the path without the unloading to a file.
  std::istringstream lines(content_of(file("run/path.csv")));
  std::string up;
  for (std::string line; std::getline(lines, line);)
    if (line.find(",unload,") == std::string::npos) up += line + "\n";
  write_text(file("up.csv"), up);
  const std::string moduli = floc("moduli run/state-000[1-7].h5 --format csv").out;
  const std::pair<std::string, std::string> plots[] = {
      {"plot up.csv -o up.svg --show coordination", ""},
      {"plot - -o up.svg --show moduli", moduli},
      {"plot up.csv -o up.svg", ""},
  };
  for (const auto& [command, input] : plots) {
    const Outcome o = floc(command, input);
    EXPECT_EQ(o.code == 0 || o.code == 3, true) << o.err;
    EXPECT_THAT(content_of(file("up.svg")), ::testing::Not(HasSubstr("unloading"))) << command;
    EXPECT_THAT(o.err, ::testing::Not(HasSubstr("Skipping data file"))) << command;
  }
}

TEST_F(PlotCommand, WordsOfGnuplotStayWithItUnlessItFails) {
  // With two states, each curve has only one point, and gnuplot warns about this.
  const Outcome o = floc("plot run/state-0000.h5 run/state-0001.h5 -o few.svg --show moduli");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, ::testing::Not(HasSubstr("warning: Skipping"))) << o.err;
  EXPECT_FALSE(exists("few.svg.words"));
}

TEST_F(PlotCommand, RegimesAreNamedAboveTheCurveAndApart) {
  // The mean curve of these samples has all three regimes, and the plot must name each regime.
  ASSERT_EQ(floc("plot " + demo_tables() + " -o regimes.svg").code, 0);
  const std::string script = content_of(file("regimes.gp"));
  std::vector<double> places;
  for (std::size_t at = 0; (at = script.find("set label '", at)) != std::string::npos; ++at) {
    const std::string line = script.substr(at, script.find('\n', at) - at);
    EXPECT_THAT(line, HasSubstr("graph 1.03"));
    places.push_back(std::log10(std::atof(line.c_str() + line.find("first ") + 6)));
  }
  ASSERT_EQ(places.size(), 3u);
  // The axis covers 3.1 decades. Names that are 0.2 decades apart do not overlap.
  EXPECT_GT(places[1] - places[0], 0.2);
  EXPECT_GT(places[2] - places[1], 0.2);
}

TEST_F(PlotCommand, ModuliHaveAUnit) {
  const auto label = [](const std::string& script) {
    const std::size_t at = script.find("set ylabel");
    return script.substr(at, script.find('\n', at) - at);
  };
  ASSERT_EQ(floc("plot run -o u.svg --show moduli").code, 0);
  EXPECT_EQ(label(content_of(file("u.gp"))), "set ylabel 'modulus (F_0/a)'");
  const std::string table = floc("moduli run/state-000[1-7].h5 --format csv").out;
  ASSERT_EQ(floc("plot - -o u.svg --show moduli", table).code, 0);
  EXPECT_EQ(label(content_of(file("u.gp"))), "set ylabel 'modulus (F_0/a)'");
  std::string in_si = table;
  for (std::size_t at = 0; (at = in_si.find("reduced", at)) != std::string::npos;) in_si.replace(at, 7, "SI");
  ASSERT_EQ(floc("plot - -o u.svg --show moduli", in_si).code, 0);
  EXPECT_EQ(label(content_of(file("u.gp"))), "set ylabel 'modulus (N/m)'");
}

TEST_F(PlotCommand, ForcesAreThoseOfLoadingAndAllCurvesAreSeen) {
  const Outcome o = floc("plot run -o f.svg --show forces");
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string data = content_of(file("f.dat")), script = content_of(file("f.gp"));
  EXPECT_THAT(data, ::testing::Not(HasSubstr("P* = 0:")));  // the state without load is left out
  EXPECT_THAT(data, HasSubstr("# P* = 0.01:"));
  EXPECT_THAT(data, HasSubstr("# P* = 1:"));
  // The state without load has few contact forces, whose values are widely spread. The axis may be at most three times
  // as wide as the curve with the narrowest range needs. The legend gives the number of forces beyond the end of the
  // axis.
  ASSERT_EQ(floc("plot run -o wide.svg --show forces --steps 0,7").code, 0);
  const std::string wide = content_of(file("wide.gp"));
  double low = 0.0, high = 0.0;
  ASSERT_EQ(std::sscanf(wide.c_str() + wide.find("set xrange"), "set xrange [%lf:%lf]", &low, &high), 2)
      << wide;
  double narrowest = 1e9;
  for (const char* name : {"P* = 0:", "P* = 1:"}) {
    const auto rows = block(content_of(file("wide.dat")), name);
    narrowest = std::min(narrowest, rows.back()[0] - std::min(0.0, rows.front()[0]));
  }
  EXPECT_LE(high - low, 3.5 * 1.1 * narrowest);
  // If the states belong to different branches, the label of a state names its branch.
  ASSERT_EQ(floc("plot run -o two.svg --show forces --steps 7,8").code, 0);
  EXPECT_THAT(content_of(file("two.dat")), HasSubstr("# P* = 0.1, unload:"));
}

TEST_F(PlotCommand, TestsWithADrivenAxisBeginAtZeroStrainWithTheirOwnStresses) {
  // Table of an isotropic state, an oedometric stage along axis 2 and a biaxial stage along axis 1.
  write_text(file("tests.csv"),
             "step,branch,stress_1,stress_2,strain_1,strain_2,control,axis\n"
             "0,load,1,1,0,0.5,,\n"
             "1,load,1,2,0,0.6,oedometric,2\n"
             "2,load,2,4,0,0.65,oedometric,2\n"
             "3,triaxial,6,4,0.1,0.6,triaxial,1\n");
  const Outcome o = floc("plot tests.csv -o tests.svg --show test");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(content_of(file("tests.svg")), HasSubstr("</svg>"));
  const auto test = block(content_of(file("tests.dat")), "test"),
             lateral = block(content_of(file("tests.dat")), "lateral");
  ASSERT_EQ(test.size(), 6u);  // three points, a gap and two points
  ASSERT_EQ(lateral.size(), 6u);
  const std::vector<std::vector<double>> expected = {{0, 0, 0}, {0.1, 2.0 / 3, 0.1}, {0.15, 2.0 / 3, 0.15}};
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(test[k][c], expected[k][c], 1e-12) << k << c;
  EXPECT_EQ(lateral[2], (std::vector<double>{4, 0.5}));
  EXPECT_TRUE(std::isnan(test[3][0]));
  // The second stage starts from the stress on axis 1 at the end of the first stage.
  EXPECT_NEAR(test[4][1], -2.0 / 3, 1e-12);
  EXPECT_EQ(lateral[4], (std::vector<double>{2, 2}));
  EXPECT_NEAR(test[5][0], 0.1, 1e-12);
  EXPECT_NEAR(test[5][1], 0.4, 1e-12);
  EXPECT_NEAR(test[5][2], 0.05, 1e-12);
}

TEST_F(PlotCommand, ASimpleShearIsPlottedByItsOwnStrainAndStress) {
  write_text(file("shear.csv"),
             "step,branch,stress_1,stress_2,strain_1,strain_2,control,axis,shear_strain,shear_stress\n"
             "0,load,1,2,0,0.5,,,,\n"
             "1,simple_shear,1,2,0,0.4,simple_shear,2,0.1,0.5\n"
             "2,simple_shear,1,2,0,0.3,simple_shear,2,0.2,0.8\n");
  const Outcome o = floc("plot shear.csv -o shear.svg --show test");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto test = block(content_of(file("shear.dat")), "test");
  ASSERT_EQ(test.size(), 2u);
  EXPECT_EQ(test[1][0], 0.2);
  EXPECT_EQ(test[1][1], 0.4);
  EXPECT_NEAR(test[1][2], -0.2, 1e-12);
}

TEST_F(PlotCommand, WhatHasNoTestWithADrivenAxisSaysSo) {
  const Outcome isotropic = floc("plot run -o t.svg --show test");
  EXPECT_EQ(isotropic.code, 4);
  EXPECT_THAT(isotropic.err, HasSubstr("no row of the path belongs to a test with a driven axis"));
  write_text(file("wrong.csv"),
             "branch,stress_1,stress_2,strain_1,strain_2,axis\nload,1,1,0,0,\nload,1,2,0,0.1,3\n");
  EXPECT_THAT(floc("plot wrong.csv -o t.svg --show test").err,
              HasSubstr("wrong.csv:3: axis = 3: expected the number of an axis, 1 to 2"));
  EXPECT_EQ(floc("plot run run -o t.svg --show test").code, 4);
}

TEST_F(PlotCommand, RoseDiagramsHoldAllContactsThatPress) {
  const Outcome o = floc("plot run -o rose.svg --show fabric --steps 1,7");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(content_of(file("rose.svg")), HasSubstr("</svg>"));
  const auto rows = block(content_of(file("rose.dat")), "direction");
  ASSERT_EQ(rows.size(), 2u * 2u * 36u + 1u);
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < rows.size(); k += 2) {
    sum += rows[k][1] * std::numbers::pi / 36;  // each bin appears twice, with its lower and its upper edge
    EXPECT_LE(rows[k][2], rows[k][1]);
  }
  EXPECT_NEAR(sum, 2.0, 1e-12);
  write_state(file("spheres.h5"), busy_state<3>());
  const Outcome spheres = floc("plot spheres.h5 --show fabric -o rose.svg");
  EXPECT_EQ(spheres.code, 4);
  EXPECT_THAT(spheres.err,
              HasSubstr("this is a state of spheres, but rose diagrams show only states of disks"));
}

TEST_F(PlotCommand, BadInputIsNamed) {
  write_text(file("broken.csv"), "P_star,phi\n0.1,0.5\n0.2,much\n");
  const Outcome broken = floc("plot broken.csv " + demo_tables() + "/seed-1 -o some.svg");
  EXPECT_EQ(broken.code, 4);
  EXPECT_THAT(broken.err, HasSubstr("broken.csv:3"));
  EXPECT_THAT(content_of(file("some.svg")), HasSubstr("</svg>"));
  EXPECT_THAT(floc("plot run -o a.gif").err, HasSubstr("expected a name that ends in .svg, .pdf or .png"));
  EXPECT_THAT(floc("plot broken.csv -o a.svg --show coordination").err, HasSubstr("z"));
  EXPECT_EQ(floc("plot broken.csv -o a.svg --show moduli").code, 4);
  EXPECT_EQ(floc("plot " + demo_tables() + " -o a.svg --show coordination").code, 4);
  write_text(file("foreign.h5"), "no state");
  EXPECT_EQ(floc("plot foreign.h5 -o a.svg").code, 4);
  EXPECT_EQ(floc("plot run -o absent/a.svg").code, 1);
}

}  // namespace
}  // namespace floc::test
