#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "support/places.h"
#include "support/run_arguments.h"

/// Tests of contact lists that contradict the positions of the grains, or that do not contain the contacts that the
/// positions give.
namespace floc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string kPackings = source_directory() + "/data/packings/";
const std::string kLammpsLaw = "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800";

/// Returns the value of the option --columns for a file of the LAMMPS command `dump local`.
/// @param pair, force  names of the two computes of LAMMPS whose output is in the file
std::string lammps_columns(const std::string& pair, const std::string& force) {
  return "id1=c_" + pair + "[1],id2=c_" + pair + "[2],force1=c_" + force + "[1],force2=c_" + force +
         "[2],shear_force1=c_" + force + "[4],shear_force2=c_" + force + "[5]";
}

class ConvertLists : public testing::Test {
 protected:
  /// Converts four disks in a 4 x 4 cell: pairs 1-3 and 2-4 touch, pairs 1-2 and 3-4 have a gap.
  Outcome convert(const std::string& contacts, const std::string& law, std::vector<std::string> more = {},
                  const std::string& x = "2.01") {
    write_text(scratch_.file("g.csv"),
               "id,x,y,radius\n1,1,1,0.5\n2," + x + ",1,0.5\n3,1,1.95,0.5\n4," + x + ",1.95,0.5\n");
    write_text(scratch_.file("c.csv"), contacts);
    std::vector<std::string> arguments = {"convert",
                                          scratch_.file("g.csv"),
                                          scratch_.file("s.h5"),
                                          "--overwrite",
                                          "--contacts",
                                          scratch_.file("c.csv"),
                                          "--cell",
                                          "4,0;0,4",
                                          "--law",
                                          law};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return floc_arguments(arguments);
  }
  json row(const std::string& command, const std::string& state) {
    std::vector<std::string> arguments = {command, scratch_.file(state), "--format", "json"};
    if (command == "moduli") arguments.emplace_back("--force");
    return json::parse(floc_arguments(arguments).out).at(0);
  }
  bool written() const { return std::filesystem::exists(scratch_.file("s.h5")); }

  ScratchDirectory scratch_;
};

TEST_F(ConvertLists, WithNeighboursThatDoNotTouchGiveTheModuliOfTheContactsAlone) {
  const auto convert_disks = [&](const std::string& out, const std::string& list, const std::string& columns) {
    return floc_arguments({"convert", kPackings + "lammps/disks.dump", scratch_.file(out), "--law", kLammpsLaw,
                           "--contacts", kPackings + "lammps/" + list, "--contact-columns", columns});
  };
  const Outcome all = convert_disks("all.h5", "disks.neighbors", lammps_columns("neighbor", "neighborforce"));
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_THAT(all.err,
              AllOf(HasSubstr("60 grains in 2D, 87 contacts"),
                    HasSubstr("of the 136 listed contacts are left out, because the grains do not touch")));
  ASSERT_EQ(convert_disks("cut.h5", "disks.contacts", lammps_columns("pair", "force")).code, 0);
  for (const char* column : {"B", "G", "z", "n_at_cap"})
    EXPECT_EQ(row("moduli", "all.h5")[column], row("moduli", "cut.h5")[column]) << column;
}

TEST_F(ConvertLists, OfIdentifiersAloneWithWhatDoesNotTouchAreRefused) {
  const Outcome o = convert("id1,id2\n1,2\n1,3\n2,4\n3,4\n", "normal.stiffness=50");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("c.csv:2: the gap is 0.00999"));
}

TEST_F(ConvertLists, KeepNeighboursThatTheLawAttractsAndNoneOfThemIsAtACap) {
  const std::string law =
      "normal.stiffness=50,adhesion.law=tail,adhesion.force=1,adhesion.range=0.02,"
      "friction.coefficient=0.5,friction.stiffness=30,rolling.coefficient=0.1,rolling.stiffness=1";
  const Outcome o = convert(
      "id1,id2,normal_force,shear_force1,shear_force2,rolling_moment\n1,2,-0.5,0,0,0\n3,4,-0.5,0,0,0\n"
      "1,3,1.5,0,0,0\n2,4,1.5,0,0,0\n",
      law);
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(
      o.err,
      HasSubstr("contacts: 2 have a gap, 2 are tensile, 0 have a tangential force or moment at its limit"));
  const json moduli = row("moduli", "s.h5");
  EXPECT_EQ(moduli["n_distant"], 2);
  EXPECT_EQ(moduli["n_at_cap"], 0);
}

TEST_F(ConvertLists, ThatPullNeedAdhesionInTheLaw) {
  const std::string list = "id1,id2,normal_force\n1,2,-0.1\n3,4,-0.1\n1,3,2.5\n2,4,2.5\n";
  const Outcome refused = convert(list, "normal.stiffness=50", {}, "1.999");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err,
              AllOf(HasSubstr("c.csv:2: the contact of grains 1 and 2 carries a tensile force of 0.1, "
                              "and 2 of the 4 listed contacts are tensile"),
                    HasSubstr("adhesion.force"), HasSubstr("--drop-tensile")));
  EXPECT_FALSE(written());
  const Outcome hertz = convert(list, "normal.modulus=50,normal.poisson=0.2", {"--dimension", "2"}, "1.999");
  EXPECT_THAT(hertz.err,
              AllOf(HasSubstr("adhesion is possible with the linear law"), HasSubstr("--drop-tensile")));
  const Outcome dropped = convert(list, "normal.stiffness=50", {"--drop-tensile"}, "1.999");
  EXPECT_EQ(dropped.code, 0) << dropped.err;
  EXPECT_THAT(dropped.err, HasSubstr("2 of the 4 listed contacts have a tensile force and are left out"));
  EXPECT_EQ(row("info", "s.h5")["n_contacts"], 2);
  EXPECT_EQ(convert(list, "normal.stiffness=50,adhesion.law=constant,adhesion.force=0.2", {}, "1.999").code, 0);
  EXPECT_EQ(row("info", "s.h5")["n_contacts"], 4);
}

TEST_F(ConvertLists, WithImagesThatContradictPositionsAreTakenAtTheNearestImage) {
  const auto convert_spheres = [&](const std::string& grains, const std::string& out) {
    return floc_arguments({"convert", kPackings + "yade/" + grains, scratch_.file(out), "--units", "SI",
                           "--contacts", kPackings + "yade/spheres.interactions"});
  };
  const Outcome wrapped = convert_spheres("wrapped.txt", "wrapped.h5");
  ASSERT_EQ(wrapped.code, 0) << wrapped.err;
  EXPECT_THAT(wrapped.err,
              AllOf(HasSubstr("of the 92 listed images contradict the positions"),
                    HasSubstr("40 grains in 3D, 92 contacts"), Not(HasSubstr("not in equilibrium"))));
  ASSERT_EQ(convert_spheres("spheres.txt", "own.h5").code, 0);
  for (const char* column : {"B", "G"}) {
    const double own = row("moduli", "own.h5")[column];
    EXPECT_NEAR(row("moduli", "wrapped.h5")[column].get<double>(), own, 1e-10 * own) << column;
  }
}

TEST_F(ConvertLists, WithAForceBetweenGrainsThatNoImageBringsTogetherAreRefused) {
  const Outcome o =
      convert("id1,id2,image1,image2,normal_force\n1,2,1,0,0.3\n", "normal.stiffness=50", {}, "2.5");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err,
              HasSubstr("c.csv:2: grains 1 and 2 carry a force of 0.3, but even their nearest images have a "
                        "gap of 0.5 (radii 0.5 and 0.5)"));
  EXPECT_FALSE(written());
}

TEST_F(ConvertLists, AreComparedWithGeometryAndLawAndStrictAcceptsNoDoubt) {
  const std::string good = "id1,id2,normal_force\n1,3,2.5\n2,4,2.5\n";
  EXPECT_THAT(convert(good, "normal.stiffness=50").err,
              HasSubstr("normal forces differ from the law by at most"));
  const Outcome other_law = convert(good, "normal.stiffness=40");
  EXPECT_EQ(other_law.code, 0);
  EXPECT_THAT(other_law.err,
              HasSubstr("warning: 2 normal forces differ from the law, by up to 0.2 of their mean"));
  EXPECT_THAT(convert("id1,id2,normal_force\n1,3,2.5\n", "normal.stiffness=50").err,
              HasSubstr("warning: 1 pairs of grains touch but are not listed (grains 2-4 at a gap of -0.05)"));
  EXPECT_THAT(convert("id1,id2,normal_force,shear_force1,shear_force2\n1,3,2.5,2,0\n2,4,2.5,0,0\n",
                      "normal.stiffness=50,friction.coefficient=0.5,friction.stiffness=30")
                  .err,
              HasSubstr("warning: 1 tangential forces or rolling moments are above their limit in the law"));
  std::filesystem::remove(scratch_.file("s.h5"));
  const Outcome strict = convert(good, "normal.stiffness=40", {"--strict", "--tolerance", "100"});
  EXPECT_EQ(strict.code, 5);
  EXPECT_THAT(strict.err, AllOf(HasSubstr("2 normal forces differ from the law"), HasSubstr("--strict")));
  EXPECT_FALSE(written());
  EXPECT_EQ(convert(good, "normal.stiffness=50", {"--strict", "--tolerance", "100"}).code, 0);
}

/// A simple cubic cell with one bead, under Hertz's law. The bead has three contacts with its own images. The file
/// gives the stiffnesses of these contacts.
TEST_F(ConvertLists, WithStiffnessesOfAnotherLawAreSaidToHaveThemByConvertModuliAndVerify) {
  const double E = 1e4, nu = 0.3, overlap = 1e-3;
  const double kn = E / (1 - nu * nu) * std::sqrt(0.25 * overlap), force = 2.0 / 3.0 * kn * overlap;
  const auto convert_bead = [&](double kn_factor, double kt_factor, std::vector<std::string> more) {
    write_text(scratch_.file("g.csv"), "x,y,z,radius\n0,0,0,0.5\n");
    std::string list = "id1,id2,image1,image2,image3,normal_force,kn,kt\n";
    for (const char* image : {"1,0,0", "0,1,0", "0,0,1"})
      list += fmt::format("0,0,{},{},{},{}\n", image, force, kn_factor * kn,
                          kt_factor * kn * (2 - 2 * nu) / (2 - nu));
    write_text(scratch_.file("c.csv"), list);
    more.insert(
        more.begin(),
        {"convert", scratch_.file("g.csv"), scratch_.file("s.h5"), "--overwrite", "--contacts",
         scratch_.file("c.csv"), "--cell", "0.999,0,0;0,0.999,0;0,0,0.999", "--law",
         fmt::format("normal.modulus={},normal.poisson={},friction.law=mindlin,friction.coefficient=0.5", E,
                     nu)});
    return floc_arguments(more);
  };
  const Outcome right = convert_bead(1, 1, {"--strict"});
  EXPECT_EQ(right.code, 0) << right.err;
  EXPECT_THAT(right.err, Not(HasSubstr("the law gives")));
  EXPECT_THAT(floc_arguments({"moduli", scratch_.file("s.h5")}).err, Not(HasSubstr("the law gives")));
  struct {
    double kn, kt;
    const char* words;
  } const wrong[] = {
      {10, 10, "kn of 3 contacts is 10 times the value of the contact law (grains 0-0: "},
      {1, 10, "kt of 3 contacts is 10 times the value of the contact law"},
      {2.0 / 3.0, 1,
       "the value is N/delta (normal force N divided by overlap delta), but the stiffness of the law "
       "is 1.5 N/delta"}};
  for (const auto& [kn_factor, kt_factor, words] : wrong) {
    std::filesystem::remove(scratch_.file("s.h5"));
    const Outcome strict = convert_bead(kn_factor, kt_factor, {"--strict"});
    EXPECT_EQ(strict.code, 5);
    EXPECT_THAT(strict.err, HasSubstr(words));
    EXPECT_FALSE(written());
    const Outcome warned = convert_bead(kn_factor, kt_factor, {});
    EXPECT_EQ(warned.code, 0);
    EXPECT_THAT(warned.err, AllOf(HasSubstr("warning: "), HasSubstr(words)));
    EXPECT_THAT(floc_arguments({"moduli", scratch_.file("s.h5")}).err,
                AllOf(HasSubstr("warning: "), HasSubstr(words)));
    const Outcome verified = floc_arguments({"verify", scratch_.file("s.h5")});
    EXPECT_EQ(verified.code, 5);
    EXPECT_THAT(verified.err, HasSubstr("law does not hold: grains 0-0 by the stiffness k"));
  }
}

TEST_F(ConvertLists, OfGrainsThatDoNotTouchSayHowFarTheyAreApartAndWhy) {
  const auto convert_row = [&](const std::string& column, double spacing, std::vector<std::string> more) {
    write_text(scratch_.file("g.csv"), fmt::format("x,y,{}\n0,0,0.5\n{},0,0.5\n", column, spacing));
    more.insert(more.begin(), {"convert", scratch_.file("g.csv"), scratch_.file("s.h5"), "--overwrite", "--law",
                               "normal.stiffness=1000", "--cell", fmt::format("{},0;0,9", 2 * spacing)});
    return floc_arguments(more);
  };
  const std::tuple<const char*, double, const char*> rows[] = {
      {"radius", 1.0000001,
       "no grains touch (the smallest gap is 1e-07, 1e-07 of a mean diameter, of grains 0-1): simulations of "
       "hard"},
      {"diameter", 0.999, "are the values read as diameters in fact radii?"},
      {"radius", 3.0, "are the radii and the cell in the same unit of length?"}};
  for (const auto& [column, spacing, words] : rows) {
    const Outcome warned = convert_row(column, spacing, {});
    EXPECT_EQ(warned.code, 0) << warned.err;
    EXPECT_THAT(warned.err,
                AllOf(HasSubstr("warning: no grains touch (the smallest gap is "), HasSubstr(words)));
    EXPECT_EQ(convert_row(column, spacing, {"--strict"}).code, 5);
  }
  EXPECT_THAT(convert_row("radius", 0.999, {"--strict"}).err, Not(HasSubstr("no grains touch")));
}

TEST_F(ConvertLists, OfASolidFractionAboveOneAreRefused) {
  write_text(scratch_.file("g.csv"), "x,y,radius\n1,1,1\n3,1,1\n1,3,1\n3,3,1.5\n");
  const Outcome o = floc_arguments({"convert", scratch_.file("g.csv"), scratch_.file("s.h5"), "--cell",
                                    "4,0;0,4", "--law", "normal.stiffness=50"});
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, AllOf(HasSubstr("g.csv: the solid fraction is 1.031"), HasSubstr("diameter")));
  EXPECT_FALSE(written());
}

}  // namespace
}  // namespace floc::test
