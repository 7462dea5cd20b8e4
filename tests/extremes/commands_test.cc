#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/run_program.h"

/// Tests every command that reads states on packings with extreme values. Each command must print finite numbers or an
/// error message, and no command may hang.
namespace floc::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

const double kHeight = std::sqrt(0.75);

/// Packing as csv, and the options with which `floc convert` reads this csv file.
struct Given {
  const char* name;
  std::string grains;  ///< csv
  std::string cell;
  std::string law = "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800";
};
void PrintTo(const Given& given, std::ostream* out) {
  *out << given.name;
}

/// Four disks of a triangular lattice.
/// @param unit     lattice spacing (length)
/// @param overlap  overlap of neighbours, divided by the lattice spacing
Given crystal(const char* name, double unit, double overlap, double stiffness) {
  const double r = 0.5 * (1.0 + overlap) * unit;
  std::string grains = "x,y,r\n";
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.5, kHeight}, {1.5, kHeight}})
    grains += fmt::format("{},{},{}\n", x * unit, y * unit, r);
  return {
      name, grains, fmt::format("{},0;0,{}", 2.0 * unit, 2.0 * kHeight * unit),
      fmt::format("normal.stiffness={},friction.coefficient=0.5,friction.stiffness={}", stiffness, stiffness)};
}

Given row(const char* name, int n, const std::string& cell, const char* header, const char* rest) {
  std::string grains = header;
  for (int k = 0; k < n; ++k) grains += fmt::format("{}{}", k, rest);
  return {name, grains, cell};
}

/// A row of a thousand small disks, and one disk that is a thousand times larger. The large disk lies between the row
/// and the periodic image of the row, and touches both.
Given large_and_small() {
  std::string grains = "x,y,r\n0.5,0.5,0.4995\n";
  for (int k = 0; k < 1000; ++k) grains += fmt::format("{},1,0.000500001\n", 0.001 * k);
  return {"large_and_small", grains, "1,0;0,1.000000001"};
}

std::vector<Given> given() {
  return {{"grain_on_its_own_images", "x,y,r\n0.2,0.3,0.5005\n", "1,0;0,1"},
          {"grain_on_hundreds_of_its_images", "x,y,r\n0.2,0.3,5.1\n", "1,0;0,1"},
          {"sphere_on_its_own_images", "x,y,z,r\n0,0,0,0.5005\n", "1,0,0;0,1,0;0,0,1"},
          {"no_contacts", "x,y,r\n0.5,0.5,0.1\n2.5,2.5,0.1\n", "4,0;0,4"},
          {"rattlers", "x,y,r\n0,0,0.5\n0.999,0,0.5\n5,5,0.5\n5.999,5,0.5\n", "10,0;0,10"},
          row("cell_of_aspect_100", 100, "100,0;0,1", "x,y,r\n", ",0.3,0.5005\n"),
          {"cell_slanted_by_a_million", "x,y,r\n0.2,0.3,0.5005\n", "1,0;1000000,1"},
          row("chain_of_spheres", 5, "5,0,0;0,3,0;0,0,3", "x,y,z,r\n", ",0,0,0.5005\n"),
          large_and_small(),
          crystal("units_of_1e_minus_30", 1e-30, 1e-3, 1e-30),
          crystal("units_of_1e30", 1e30, 1e-3, 1e30),
          crystal("kappa_1e9", 1.0, 1e-9, 1e9)};
}

class Command : public ::testing::TestWithParam<Given> {};

TEST_P(Command, AnswersInNumbersOrWords) {
  const ScratchDirectory scratch;
  write_text(scratch.file("grains.csv"), GetParam().grains);
  const Outcome convert = run_floc(
      "convert grains.csv p.h5 --columns radius=r --cell '" + GetParam().cell + "' --law " + GetParam().law,
      scratch.path());
  if (std::string(GetParam().name) == "grain_on_hundreds_of_its_images") {  // its solid fraction exceeds 1
    EXPECT_EQ(convert.code, 4);
    EXPECT_THAT(convert.err, HasSubstr("floc: grains.csv: the solid fraction is 81.71: expected at most 1"));
    return;
  }
  ASSERT_EQ(convert.code, 0) << convert.err;
  for (const char* command :
       {"info p.h5", "verify p.h5", "modes p.h5", "network p.h5", "moduli p.h5 --force",
        "moduli p.h5 --force --strains full --prestress", "moduli p.h5 --force --accuracy 0.1",
        "moduli p.h5 --force --increments i.csv", "compare p.h5 p.h5",
        "structure p.h5 --pores pores.csv --pair-correlation g.csv --gaps z.csv"}) {
    const Outcome o = run_floc(std::string(command) + " --format csv", scratch.path());
    EXPECT_THAT(o.code, ::testing::AnyOf(0, 4, 5)) << command << ": " << o.err;
    EXPECT_THAT(o.out, Not(ContainsRegex("(^|[,\n])-?(nan|inf)"))) << command;
    if (o.code == 4) {
      EXPECT_THAT(o.err, HasSubstr("floc: p.h5: ")) << command;
    }
  }
  for (const char* forces : {"equilibrium", "increment", "particle-pressure"}) {
    const Outcome o = run_floc(std::string("draw p.h5 -o p.svg --forces ") + forces, scratch.path());
    EXPECT_THAT(o.code, ::testing::AnyOf(0, 4)) << forces << ": " << o.err;
    if (o.code == 4) {
      EXPECT_THAT(o.err, HasSubstr("floc: p.h5: ")) << forces;
    }
  }
  EXPECT_EQ(run_floc("convert p.h5 p.vtu", scratch.path()).code, 0);
}

INSTANTIATE_TEST_SUITE_P(AtTheEnds, Command, ::testing::ValuesIn(given()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace floc::test
