#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_arguments.h"

/// Tests of commands on packings of other programs, from the input file to the printed table. The packings have walls,
/// free sides, gravity, bonds or gaps, in several formats.
namespace floc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class Imports : public testing::Test {
 protected:
  Outcome convert(const std::string& in, std::vector<std::string> more = {}, const std::string& law = kLaw) {
    std::vector<std::string> arguments = {"convert",     scratch_.file(in), scratch_.file("s.h5"),
                                          "--overwrite", "--law",           law};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return floc_arguments(arguments);
  }
  json row(const std::string& command, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {command, scratch_.file("s.h5"), "--format", "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome o = floc_arguments(arguments);
    EXPECT_EQ(o.code, 0) << o.err;
    return o.code == 0 ? json::parse(o.out).at(0) : json();
  }
  void write(const std::string& name, const std::string& text) { write_text(scratch_.file(name), text); }

  static inline const std::string kLaw = "normal.stiffness=1000";
  ScratchDirectory scratch_;
};

TEST_F(Imports, OfAClusterHaveContactsAndNoModuli) {
  write("open.xyz",
        "3\nLattice=\"4 0 0 0 4 0 0 0 4\" Properties=pos:R:3:radius:R:1 pbc=\"F F F\"\n0.4 1 1 0.5\n1.39 1 1 "
        "0.5\n3.6 1 1.2 "
        "0.5\n");
  const Outcome o = convert("open.xyz");
  EXPECT_EQ(o.code, 0);
  EXPECT_THAT(o.err, AllOf(HasSubstr("not periodic along x,y,z (pbc=\"F F F\")"),
                           HasSubstr("it ends in free space there")));
  const json network = row("network");
  EXPECT_EQ(network.at("n_contacts"), 1);
  EXPECT_NEAR(network.at("z").get<double>(), 2.0 / 3.0, 1e-15);
  const Outcome none = floc_arguments({"moduli", scratch_.file("s.h5"), "--force"});
  EXPECT_EQ(none.code, 4);
  EXPECT_THAT(none.err,
              HasSubstr("ends in free space along every axis, so it resists no strain and has no moduli"));
}

/// A column of n spheres on a floor, between walls across x and y, under gravity. The force below sphere k is
/// the weight of spheres k to n.
TEST_F(Imports, UnderGravityAreInBalanceWithTheirWeight) {
  constexpr int kSpheres = 5;
  const double stiffness = 1e5, weight = 2.0 * 9.81;
  std::string text = "x,y,z,radius,mass\n";
  double z = 0.0, above = kSpheres * weight;
  z = 0.5 - above / stiffness;
  for (int k = 0; k < kSpheres; ++k) {
    text += fmt::format("0.5,0.5,{:.17g},0.5,2\n", z);
    above -= weight;
    z += 1.0 - above / stiffness;
  }
  write("column.csv", text);
  const Outcome o =
      convert("column.csv", {"--walls", "x=0:1,y=0:1,z=0:", "--gravity=0,0,-9.81"}, "normal.stiffness=1e5");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, Not(HasSubstr("warning")));
  // p_wall is the mean over the three axes
  EXPECT_NEAR(row("info").at("p_wall").get<double>() * 3.0, kSpheres * weight, 1e-9);
  EXPECT_EQ(row("verify").at("equilibrium"), true);
  const Outcome without = convert("column.csv", {"--walls", "x=0:1,y=0:1,z=0:"}, "normal.stiffness=1e5");
  EXPECT_THAT(without.err, HasSubstr("not in equilibrium"));
  const Outcome moduli = floc_arguments({"moduli", scratch_.file("s.h5"), "--force"});
  EXPECT_THAT(moduli.err, HasSubstr("these moduli are zero"));
}

/// A face-centred cubic crystal of spheres of unit diameter, with a small gap between neighbours.
TEST_F(Imports, OfHardGrainsTouchAcrossTheGapThatIsGiven) {
  const double a = std::sqrt(2.0) * (1.0 + 1e-7);
  std::string text = "x,y,z,radius\n";
  for (const auto& x : {std::array{0.0, 0.0, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}, {0.5, 0.5, 0.0}})
    text += fmt::format("{:.17g},{:.17g},{:.17g},0.5\n", a * x[0], a * x[1], a * x[2]);
  write("hard.csv", text);
  const std::string cell = fmt::format("{0:.17g},0,0;0,{0:.17g},0;0,0,{0:.17g}", a);
  EXPECT_THAT(convert("hard.csv", {"--cell", cell}).err,
              AllOf(HasSubstr("no grains touch (the smallest gap is 1e-07"), HasSubstr("--touch-gap")));
  EXPECT_THAT(convert("hard.csv", {"--cell", cell, "--touch-gap", "1e-6"}).err, Not(HasSubstr("warning")));
  EXPECT_EQ(row("network").at("z"), 12.0);
  EXPECT_EQ(row("verify").at("equilibrium"), true);
}

/// A square lattice of disks that are joined by bonds across gaps: C11 = K_N, C12 = 0, and C33 = K_T/2 because
/// the grains can rotate freely.
TEST_F(Imports, HoldBondsAcrossGaps) {
  std::string grains = "id,x,y,radius\n", bonds = "id1,id2,image1,image2,normal_force,kn,kt\n";
  for (int i = 0; i < 9; ++i) {
    grains += fmt::format("{},{},{},0.5\n", i, 1.01 * (i % 3), 1.01 * (i / 3));
    bonds += fmt::format("{},{},{},0,0,1000,500\n", i, i / 3 * 3 + (i + 1) % 3, i % 3 == 2 ? 1 : 0);
    bonds += fmt::format("{},{},0,{},0,1000,500\n", i, (i + 3) % 9, i / 3 == 2 ? 1 : 0);
  }
  write("grains.csv", grains);
  write("bonds.csv", bonds);
  for (const std::string option : {"--contacts", "--bonds"}) {
    const Outcome o = convert("grains.csv", {option, scratch_.file("bonds.csv"), "--cell", "3.03,0;0,3.03"});
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_THAT(o.err, AllOf(HasSubstr("18 are bonds"), Not(HasSubstr("warning"))));
    const json moduli = row("moduli", {"--strains", "full"});
    EXPECT_EQ(moduli.at("n_contacts"), 18);
    EXPECT_EQ(row("network").at("n_solid_bonds"), 18);
    EXPECT_NEAR(moduli.at("B").get<double>(), 500.0, 1e-9);
    EXPECT_NEAR(moduli.at("G").get<double>(), 500.0, 1e-9);
    EXPECT_NEAR(moduli.at("C33").get<double>(), 250.0, 1e-9);
    EXPECT_EQ(row("verify").at("equilibrium"), true);
  }
  // In this narrower cell, grains touch their images across two sides of the cell. The file contains a bond of another
  // pair of grains only.
  write("one.csv", "id1,id2,kn\n0,1,7\n");
  ASSERT_EQ(convert("grains.csv", {"--bonds", scratch_.file("one.csv"), "--cell", "2.97,0;0,3.03"}).code, 0);
  EXPECT_EQ(row("network").at("n_contacts"), 4);
  EXPECT_EQ(row("network").at("n_solid_bonds"), 1);
}

/// Two disks that touch walls and each other. The contacts with walls are found from the positions, or are read from
/// the columns that the fix wall/gran of LAMMPS writes.
TEST_F(Imports, HaveTheContactsWithWallsOfColumnsOrOfTheGeometry) {
  write("s.dump",
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1.994\n0 1.994\n-0.5 "
        "0.5\nITEM: ATOMS id x "
        "y z radius f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] f_w[6] f_w[7] f_w[8]\n"
        "7 0.498 0.498 0 0.5 1 2 0.25 0 0 0.498 0 0.5\n9 1.496 0.498 0 0.5 1 -2 0.125 0 1.994 0.498 0 0.5\n");
  write("c.csv", "id1,id2,force1,force2\n7,9,-2,0\n");
  const std::string law = "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800";
  const std::vector<std::string> options = {"--contacts", scratch_.file("c.csv"), "--walls",
                                            "x,y=:",      "--tolerance",          "1e9"};
  const Outcome found = convert("s.dump", options, law);
  ASSERT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(found.err, AllOf(HasSubstr("the file of contacts lists no contacts with walls"),
                               Not(HasSubstr("not listed"))));
  EXPECT_NEAR(row("info").at("p_wall").get<double>(), 2.0, 1e-12);  // across x; y has no walls
  std::vector<std::string> with_columns = options;
  with_columns.insert(with_columns.end(), {"--columns", "x-=f_w,x+=f_w"});
  const Outcome listed = convert("s.dump", with_columns, law);
  ASSERT_EQ(listed.code, 0) << listed.err;
  EXPECT_THAT(listed.err,
              AllOf(HasSubstr("contacts: 3 read, 3 kept"), Not(HasSubstr("no contacts with walls"))));
  ASSERT_EQ(floc_arguments({"export", scratch_.file("s.h5"), "--contacts", scratch_.file("e.csv")}).code, 0);
  EXPECT_THAT(content_of(scratch_.file("e.csv")),
              AllOf(HasSubstr("7,x-,0,0,2,0,0.25,"), HasSubstr("9,x+,0,0,2,0,0.125,")));
  EXPECT_THAT(convert("s.dump", {"--walls", "x,y=:", "--columns", "x-=f_w"}, law).err,
              HasSubstr("the forces between grains and walls are given, but the forces between grains are not: "
                        "give --contacts"));
  EXPECT_THAT(
      convert("s.dump", {"--contacts", scratch_.file("c.csv"), "--walls", "x,y=:", "--columns", "x-=f_v"}, law)
          .err,
      HasSubstr("the dump has no column f_v[1]"));
  EXPECT_THAT(
      convert("s.dump", {"--contacts", scratch_.file("c.csv"), "--walls", "y", "--columns", "x-=f_w"}, law).err,
      HasSubstr("the packing has no such wall: give --walls"));
}

TEST_F(Imports, TakeWallsAndGravityFromAScript) {
  write("one.csv", "x,y,radius,mass\n0.5,0.498,0.5,1\n");
  write("in.lmp", "fix w all wall/gran hooke 1 2 3 4 5 6 yplane 0 NULL\nfix g all gravity 2 vector 0 -1 0\n");
  const Outcome o = convert("one.csv", {"--walls", "x=:," + scratch_.file("in.lmp")});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err,
              AllOf(HasSubstr("in.lmp are y- at 0"), HasSubstr("in.lmp is 0,-2,0"), Not(HasSubstr("warning"))));
  EXPECT_EQ(
      convert("one.csv", {"--walls", "x=:," + scratch_.file("in.lmp"), "--gravity=0,-1"}).err.find("in.lmp is"),
      std::string::npos);
}

/// Whether a contact slides depends only on its forces, not on the stiffness in the file.
TEST_F(Imports, SlideAtTheLimitOfTheirForces) {
  write("g.csv", "x,y,radius\n0.5,0.5,0.5\n1.49,0.5,0.5\n2.48,0.5,0.5\n");
  write("c.csv",
        "id1,id2,normal_force,shear_force1,shear_force2,kn,kt\n0,1,10,0,4.5,1000,400\n1,2,10,0,5,1000,1600\n");
  const Outcome o =
      convert("g.csv", {"--cell", "9,0;0,9", "--contacts", scratch_.file("c.csv"), "--tolerance", "1e9"},
              "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, AllOf(HasSubstr("1 have a tangential force or moment at its limit"),
                           Not(HasSubstr("above their limit"))));
}

/// Files of positions have no place for gravity, for the place of the box and for the masses of walls. That is said
/// where a state has them, and only there.
TEST_F(Imports, SayWhatAFormatDoesNotHold) {
  write("g.csv", "x,y,radius\n1,1,0.5\n");
  const auto said = [&](const std::string& name) {
    const Outcome o = floc_arguments({"convert", scratch_.file("s.h5"), scratch_.file(name), "--overwrite"});
    EXPECT_EQ(o.code, 0) << o.err;
    return o.err;
  };
  const std::vector<std::string> walls = {"--walls", "x=0.5:3,y=0.5:3"}, cell = {"--cell", "3,0;0,3"};
  std::vector<std::string> all = walls;
  all.insert(all.end(), {"--gravity=0,-9.81", "--wall-masses", "y+=2"});
  ASSERT_EQ(convert("g.csv", all).code, 0);
  for (const char* name : {"s.vtu", "s.xyz", "s.data"})
    EXPECT_THAT(said(name),
                HasSubstr("files of this format do not hold gravity, the place of the box, which begins "
                          "at zero in the file, the masses of the walls that forces move;"));
  EXPECT_THAT(said("s.vtkhdf"), Not(HasSubstr("do not hold")));
  ASSERT_EQ(convert("g.csv", cell).code, 0);
  for (const char* name : {"s.vtu", "s.xyz", "s.data", "s.vtkhdf"})
    EXPECT_THAT(said(name), Not(HasSubstr("do not hold")));
  const Outcome bad = convert("g.csv", {"--walls", "x=0:3,y=0:3", "--wall-masses", "y+=-2"});
  EXPECT_EQ(bad.code, 4);
  EXPECT_THAT(bad.err, HasSubstr("--wall-masses: \"y+=-2\": expected a wall and its mass"));
}

/// The strengths of bonds are preserved in the state, in the table of its contacts and in VTKHDF files.
TEST_F(Imports, KeepTheStrengthsOfBonds) {
  write("g.csv", "id,x,y,z,radius\n1,9.5,1,1,0.5\n2,0.6,1,1,0.5\n3,2.6,1,1.2,0.5\n");
  write("b.csv",
        "id1,id2,kn,kt,kr,ktw,tensile_strength,shear_strength,twisting_strength\n"
        "3,2,5,4,3,2,30,20,0.5\n1,2,7,6,5,4,10,0,0.25\n");
  const std::string law = "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800";
  const std::vector<std::string> cell = {"--cell", "10,0,0;0,10,0;0,0,10", "--tolerance", "1e9"};
  std::vector<std::string> options = cell;
  options.insert(options.end(), {"--bonds", scratch_.file("b.csv")});
  ASSERT_EQ(convert("g.csv", options, law).code, 0);
  const auto exported = [&] {
    EXPECT_EQ(floc_arguments({"export", scratch_.file("s.h5"), "--contacts", scratch_.file("e.csv")}).code, 0);
    return content_of(scratch_.file("e.csv"));
  };
  const std::string kept = exported();
  EXPECT_THAT(
      kept, AllOf(HasSubstr("ktw,tensile_strength,shear_strength,twisting_strength\n"),
                  HasSubstr("4,10,0,0.25\n"), HasSubstr("2,30,20,0.5\n"), Not(HasSubstr("rolling_strength"))));
  ASSERT_EQ(floc_arguments({"convert", scratch_.file("s.h5"), scratch_.file("s.vtkhdf")}).code, 0);
  ASSERT_EQ(convert("s.vtkhdf", {"--tolerance", "1e9"}, law).code, 0);
  EXPECT_EQ(exported(), kept);
  write("again.csv", kept);
  options = cell;
  options.insert(options.end(), {"--contacts", scratch_.file("again.csv")});
  ASSERT_EQ(convert("g.csv", options, law).code, 0);
  EXPECT_EQ(exported(), kept);
  write("b.csv", "id1,id2,kn,tensile_strength\n1,2,7,-1\n");
  EXPECT_THAT(convert("g.csv", {"--cell", "10,0,0;0,10,0;0,0,10", "--bonds", scratch_.file("b.csv")}, law).err,
              HasSubstr("b.csv:2: tensile_strength = -1, expected a strength of 0 or more"));
}

/// A square lattice of disks with bonds (K_N = 100, K_T = 50) has C11 = C22 = K_N, C33 = K_T/2 and B = K_N/2, whatever
/// forces its two rows bear. The forces along each row balance each other.
TEST_F(Imports, BondsHoldGrainsInTensionAndWithoutForce) {
  write("g.csv", "id,x,y,r\n0,0,0,0.5\n1,1.1,0,0.5\n2,0,1.1,0.5\n3,1.1,1.1,0.5\n");
  for (const auto& [first, second] :
       {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, -0.5}, {-1.0, 0.0}, {-1.0, -2.0}}) {
    SCOPED_TRACE(testing::Message() << "forces of the rows: " << first << ", " << second);
    write("b.csv", fmt::format("id1,id2,image1,image2,normal_force,kn,kt,kr\n"
                               "0,1,0,0,{0},100,50,1\n1,0,1,0,{0},100,50,1\n"
                               "2,3,0,0,{1},100,50,1\n3,2,1,0,{1},100,50,1\n"
                               "0,2,0,0,0,100,50,1\n2,0,0,1,0,100,50,1\n"
                               "1,3,0,0,0,100,50,1\n3,1,0,1,0,100,50,1\n",
                               first, second));
    ASSERT_EQ(
        convert("g.csv", {"--cell", "2.2,0;0,2.2", "--bonds", scratch_.file("b.csv")}, "normal.stiffness=100")
            .code,
        0);
    const json moduli = row("moduli", {"--strains", "full", "--columns", "all"}), network = row("network");
    EXPECT_EQ(moduli.at("n_rattlers"), 0);
    EXPECT_EQ(moduli.at("n_undecided"), 0);
    EXPECT_NEAR(moduli.at("C11").get<double>(), 100.0, 1e-9);
    EXPECT_NEAR(moduli.at("C22").get<double>(), 100.0, 1e-9);
    EXPECT_NEAR(moduli.at("C33").get<double>(), 25.0, 1e-9);
    EXPECT_NEAR(moduli.at("B").get<double>(), 50.0, 1e-9);
    EXPECT_NEAR(network.at("z_star").get<double>(), 4.0, 1e-12);
    EXPECT_EQ(network.at("x0").get<double>(), 0.0);
    EXPECT_NEAR(network.at("energy_per_grain").get<double>(),
                2.0 * (first * first + second * second) / (2.0 * 100.0) / 4.0, 1e-12);
  }
}

/// The weights of grains without a listed mass follow from the mass d^2 of a disk, which is said.
TEST_F(Imports, SayWhichMassesAreAssumedUnderGravity) {
  write("g.csv", "id,x,y,r\n0,0.5,0.499,0.5\n1,1.6,0.499,0.5\n");
  write("all.csv", "id,x,y,r,mass\n0,0.5,0.499,0.5,2\n1,1.6,0.499,0.5,2\n");
  const std::vector<std::string> box = {"--cell",    "3,0;0,3", "--walls",     "y=0:3",
                                        "--gravity", "0,-1",    "--tolerance", "1e9"};
  const Outcome o = convert("g.csv", box), all = convert("all.csv", box);
  EXPECT_THAT(o.err, HasSubstr("no mass for 2 of 2 grains")) << o.err;
  EXPECT_THAT(all.err, Not(HasSubstr("no mass")));
}

TEST_F(Imports, ReadTheAtomStylesOfLammpsThatHaveRadii) {
  const std::string head = "title\n\n2 atoms\n\n0 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n\nAtoms";
  for (const auto& [style, first, second] :
       {std::tuple{"", "1 1 1 2 1 1 1", "2 1 1 2 1.99 1 1.2"},
        {" # sphere", "1 1 1 2 1 1 1", "2 1 1 2 1.99 1 1.2 0 0 1"},
        {" # granular", "1 1 1 2 1 1 1", "2 1 1 2 1.99 1 1.2"},
        {" # bpm/sphere", "1 7 1 1 2 1 1 1", "2 7 1 1 2 1.99 1 1.2"},
        {" # hybrid sphere bond", "1 1 1 1 1 1 2 7", "2 1 1.99 1 1.2 1 2 7"},
        {" # hybrid bond sphere", "1 1 1 1 1 7 1 2", "2 1 1.99 1 1.2 7 1 2 1 0 0"}}) {
    write("s.data", fmt::format("{}{}\n\n{}\n{}\n", head, style, first, second));
    const Outcome o = convert("s.data", {"--tolerance", "1e9"});
    EXPECT_EQ(o.code, 0) << style << o.err;
    EXPECT_THAT(o.err, HasSubstr("2 grains in 3D")) << style;
  }
  for (const auto& [style, words] : {std::pair{" # atomic", "has no radii"},
                                     {" # hybrid bond charge", "has no radii"},
                                     {" # line", "is not known"}}) {
    write("s.data", head + style + "\n\n1 1 1 1 1\n");
    EXPECT_THAT(convert("s.data").err, HasSubstr(words)) << style;
  }
}

TEST_F(Imports, ReadGeneralTriclinicBoxesOfLammps) {
  write("s.dump",
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS abc origin pp pp pp\n0 3 0 1\n-4 0.5 0 "
        "1\n0 0 5 "
        "1\nITEM: ATOMS id x y z Radius\n1 1 1 1 0.5\n");
  ASSERT_EQ(convert("s.dump", {"--tolerance", "1e9", "--dimension", "3"}).code, 0);
  EXPECT_EQ(row("info").at("cell"), "0,3,0;-4,0.5,0;0,0,5");
  write("s.data",
        "title\n\n1 atoms\n\n0 3 0 avec\n-4 0.5 0 bvec\n0 0 5 cvec\n1 1 1 abc origin\n\nAtoms # sphere\n\n1 1 "
        "1 1 1 1 1\n");
  ASSERT_EQ(convert("s.data", {"--tolerance", "1e9", "--dimension", "3"}).code, 0);
  EXPECT_EQ(row("info").at("cell"), "0,3,0;-4,0.5,0;0,0,5");
}

TEST_F(Imports, ReadPlainXyzByTheNumbersOfItsColumns) {
  write("plain.xyz", "2\nany comment\nA 0.5 0.5 0.5 0.5 1\nB 1.49 0.5 0.6 0.5 2\n");
  EXPECT_THAT(convert("plain.xyz", {"--walls", "x=:,y=:,z=:"}).err,
              HasSubstr("give the number of the column of the sizes, --columns radius=5"));
  ASSERT_EQ(convert("plain.xyz", {"--walls", "x=:,y=:,z=:", "--columns", "radius=5,mass=6"}).code, 0);
  EXPECT_EQ(row("network").at("n_contacts"), 1);
  ASSERT_EQ(convert("plain.xyz", {"--walls", "x=:,y=:,z=:", "--columns", "x=4,y=3,z=2,diameter=5"}).code, 0);
  EXPECT_EQ(row("network").at("n_contacts"), 0);
}

TEST_F(Imports, ReadCompressedFiles) {
  write("g.csv", "X,y,RADIUS\n0.5,0.5,0.5\n1.49,0.5,0.5\n");
  ASSERT_EQ(std::system(("gzip -k '" + scratch_.file("g.csv") + "'").c_str()), 0);
  const std::vector<std::string> options = {"--cell", "2,0;0,1.5", "--columns", "x=X", "--tolerance", "1e9"};
  ASSERT_EQ(convert("g.csv.gz", options).code, 0);
  EXPECT_EQ(row("network").at("n_contacts"), 1);
  const std::string bytes = content_of(scratch_.file("g.csv.gz"));
  write("cut.csv.gz", bytes.substr(0, bytes.size() - 6));
  EXPECT_THAT(convert("cut.csv.gz", options).err, HasSubstr("the compressed file is cut short"));
  std::string spoiled = bytes;
  spoiled[spoiled.size() / 2] ^= 0x55;
  write("bad.csv.gz", spoiled);
  EXPECT_THAT(convert("bad.csv.gz", options).err, HasSubstr("the compressed file is damaged"));
  EXPECT_EQ(convert("bad.csv.gz", options).code, 4);
}

TEST_F(Imports, MergePairsThatAreListedTwice) {
  write("g.csv", "x,y,radius\n0.5,0.5,0.5\n1.49,0.5,0.5\n2.48,0.5,0.5\n");
  write("c.csv", "id1,id2,force1,force2\n0,1,-10,0\n1,2,-10,0\n1,0,10,0\n2,1,9,0\n");
  const std::vector<std::string> options = {"--cell",      "9,0;0,9", "--contacts", scratch_.file("c.csv"),
                                            "--tolerance", "1e9"};
  EXPECT_THAT(convert("g.csv", options).err, HasSubstr("is listed twice"));
  std::vector<std::string> merged = options;
  merged.emplace_back("--pairs-twice");
  const Outcome o = convert("g.csv", merged);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err,
              HasSubstr("2 of the 4 listed contacts repeat an earlier pair of grains and are left out; 1 of "
                        "these contacts contradict the forces in the earlier row of the pair"));
}

TEST_F(Imports, SayThatAStressDoesNotActOnFixedWalls) {
  write("g.csv", "x,y,radius\n1,1,0.5\n");
  const std::string said = "--stress does not act along";
  const std::vector<std::string> fixed = {"--walls", "x=0.5:3,y=0.5:3", "--stress", "1,2"};
  EXPECT_THAT(convert("g.csv", fixed).err, HasSubstr(said + " x,y, where no wall follows forces"));
  std::vector<std::string> lid = fixed;
  lid.insert(lid.end(), {"--wall-masses", "y+=2"});
  EXPECT_THAT(convert("g.csv", lid).err, HasSubstr(said + " x, where no wall follows forces"));
  EXPECT_THAT(convert("g.csv", {"--cell", "3,0;0,3", "--stress", "1,2"}).err, Not(HasSubstr(said)));
}

}  // namespace
}  // namespace floc::test
