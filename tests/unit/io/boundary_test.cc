#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/io/export.h"
#include "floc/io/listed_packing.h"
#include "floc/io/settle_space.h"
#include "support/foreign_packing.h"

/// Tests of packings with periodic axes, walls or open ends, which are given in the file of the packing or by options.
namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::vector<std::string> kEnds = {"p", "ww", "wo", "ow", "oo"};

/// Writes a packing in a format and reads it back. The friction forces of the packing are not compared, because the
/// formats do not store them.
template <int Dim>
void expect_round_trip(const std::string& keyword, const test::Ends<Dim>& ends) {
  SCOPED_TRACE(keyword + " " + testing::PrintToString(ends));
  const State<Dim> state = test::packing_with_forces<Dim>(ends);
  const test::ScratchDirectory scratch;
  const ExportFormat& format = find_export_format(keyword, "");
  const std::string path = scratch.file("s" + format.extension);
  format.write(path, state);
  Packing<Dim> read = test::read_packing<Dim>(path);
  find_contacts(read);
  Packing<Dim> written = state.packing;
  for (Contact<Dim>& c : written.contacts) c.shear_force.setZero();
  // In files the cell begins at zero, so writing shifts a packing with an open lower end. The positions of walls are
  // therefore not compared.
  for (Wall<Dim>& wall : written.walls) wall.position = 0.0;
  for (Wall<Dim>& wall : read.walls) wall.position = 0.0;
  test::expect_same_packing<Dim>(read, written, 1e-12);
}

TEST(Boundary, OfEveryKindComesBackFromEveryFormat) {
  for (const std::string keyword : {"vtu", "extended-xyz", "lammps-data", "state"})
    for (const std::string& x : kEnds)
      for (const std::string& y : kEnds) {
        if (keyword != "state") expect_round_trip<2>(keyword, {x, y});
        if (keyword != "state") expect_round_trip<3>(keyword, {x, "p", y});
      }
}

template <int Dim>
void expect_kept(const test::Ends<Dim>& ends) {
  State<Dim> state = test::packing_with_forces<Dim>(ends);
  for (int a = 0; a < Dim; ++a)
    state.packing.gravity[a] = between_walls(state.packing.walls, a) ? -9.81 - a : 0.0;
  const test::ScratchDirectory scratch;
  write_state(scratch.file("s.h5"), state);
  const auto read = std::get<State<Dim>>(read_state(scratch.file("s.h5"))).packing;
  EXPECT_EQ(read.walls, state.packing.walls);
  EXPECT_EQ(read.gravity, state.packing.gravity);
}

TEST(Boundary, AndGravityAreKeptInStates) {
  for (const std::string& x : kEnds)
    for (const std::string& y : kEnds) {
      expect_kept<2>({x, y});
      expect_kept<3>({"p", x, y});
    }
}

ListedSpace box() {
  ListedSpace space;
  space.cell = {{4.0, 0.0, 0.0}, {0.0, 6.0, 0.0}, {0.0, 0.0, 8.0}};
  space.origin = {1.0, 2.0, 3.0};
  return space;
}

TEST(Walls, AreFacesOfTheBoxOrPlacesOnAnAxis) {
  const auto text_of = [](const std::string& text) {
    std::string found;
    for (const ListedEnds& e : parse_walls(text, box(), 3))
      found += fmt::format("{}{} {};", "xyz"[e.axis], e.low ? fmt::format(" {}", *e.low) : " open",
                           e.high ? fmt::format("{}", *e.high) : "open");
    return found;
  };
  EXPECT_EQ(text_of(""), "");
  EXPECT_EQ(text_of("x"), "x 1 5;");
  EXPECT_EQ(text_of("y-"), "y 2 open;");
  EXPECT_EQ(text_of("z+, x-"), "z open 11;x 1 open;");
  EXPECT_EQ(text_of("z=0:10"), "z 0 10;");
  EXPECT_EQ(text_of("z = -1e-3 : "), "z -0.001 open;");
  EXPECT_EQ(text_of("x=:"), "x open open;");
}

TEST(Walls, OfAnotherFormAreRefused) {
  const auto refusal = [](const std::string& text, const std::string& words) {
    EXPECT_THAT([&] { parse_walls(text, box(), 2); }, ThrowsMessage<InputError>(HasSubstr(words))) << text;
  };
  refusal("z", "does not begin with an axis");
  refusal("x,,y", "does not begin with an axis");
  refusal("x,x-", "given twice");
  refusal("x=5", "is not a pair of walls");
  refusal("x=a:1", "expected a finite number");
  refusal("x=2:1", "expected a position below that of the upper wall");
  EXPECT_THAT([] { parse_walls("x", ListedSpace{}, 2); },
              ThrowsMessage<InputError>(HasSubstr("give positions")));
}

class GivenBoundary : public testing::Test {
 protected:
  GivenBoundary() {
    options_.law = parse_law("law", test::kForeignLaw);
    test::write_text(scratch_.file("g.csv"), "x,y,radius\n0.5,0.5,0.5\n1.5,0.5,0.5\n");
  }
  Packing<2> read() { return test::read_packing<2>(scratch_.file("g.csv"), options_); }
  void expect_refusal(const std::string& words) {
    EXPECT_THAT([&] { read(); }, ThrowsMessage<InputError>(HasSubstr(words)));
  }

  test::ScratchDirectory scratch_;
  ImportOptions options_;
};

TEST_F(GivenBoundary, NeedsNoCellIfNoAxisIsPeriodic) {
  options_.walls = "x=0:,y=0:1";
  const Packing<2> p = read();
  ASSERT_EQ(p.walls.size(), 4u);
  EXPECT_TRUE(p.walls[1].open);
  EXPECT_EQ(p.walls[1].position, 2.0);
  EXPECT_EQ(p.cell.matrix(0, 0), 2.0);
  EXPECT_EQ(p.cell.matrix(1, 1), 1.0);
}

TEST_F(GivenBoundary, ThatCutsThroughGrainsIsRefused) {
  options_.walls = "x=0.06:,y=0:1";
  expect_refusal("g.csv:2: the wall x- at x = 0.06 cuts the grain");
  options_.walls = "x=0.04:,y=0:1";
  EXPECT_EQ(read().grains.size(), 2);
}

TEST(WallMasses, BelongToWallsOfThePacking) {
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file("g.csv"), "x,y,radius\n1,1,0.5\n");
  ImportOptions options;
  options.walls = "x=0:3,y=0:";
  options.cell = {{3, 0}, {0, 4}};
  options.wall_masses = {{{0, 1}, 2.5}, {{1, -1}, 4.0}};
  const Packing<2> p = test::read_packing<2>(scratch.file("g.csv"), options);
  const double fixed = std::numeric_limits<double>::infinity();
  EXPECT_EQ(std::tuple(p.walls[0].mass, p.walls[1].mass, p.walls[2].mass), std::tuple(fixed, 2.5, 4.0));
  for (const WallSide absent : {WallSide{1, 1}, WallSide{2, -1}}) {
    options.wall_masses = {{absent, 1.0}};
    EXPECT_THAT([&] { test::read_packing<2>(scratch.file("g.csv"), options); },
                ThrowsMessage<InputError>(HasSubstr("a mass is given for the wall " + absent.name() +
                                                    ", but the packing has no such wall")));
  }
}

/// Grains of one z are taken as disks. Walls across z show that this guess is wrong.
TEST(Monolayer, WithWallsAcrossZNeedsItsDimension) {
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file("g.csv"), "x,y,z,radius\n1,1,0.5,0.5\n");
  ImportOptions options;
  for (const char* walls : {"x=0:3,y=0:3,z=0:", "z=0:1,x=0:3,y=0:3", "x=0:3,y=0:3, z=0:1"}) {
    options.walls = walls;
    options.dimension.reset();
    EXPECT_THAT([&] { test::read_packing<3>(scratch.file("g.csv"), options); },
                ThrowsMessage<InputError>(HasSubstr("give --dimension 3 to make them spheres")));
    options.dimension = 3;
    EXPECT_EQ(test::read_packing<3>(scratch.file("g.csv"), options).grains.size(), 1);
  }
}

TEST_F(GivenBoundary, ThatIsPeriodicAlongEveryAxisIsRefusedUnderGravity) {
  options_.cell = {{2.0, 0.0}, {0.0, 2.0}};
  options_.gravity = {0.0, -9.81};
  expect_refusal("--gravity: gravity is (0, -9.81), but the packing is periodic along every axis");
  options_.walls = "y-";
  EXPECT_EQ(read().gravity, Vec<2>(0.0, -9.81));
  options_.gravity = {0.0, 0.0, -9.81};
  expect_refusal("gravity has 3 components, expected 2 in 2D");
}

TEST_F(GivenBoundary, WithWallsNeedsARectangularCell) {
  options_.cell = {{2.0, 0.0}, {0.3, 2.0}};
  options_.walls = "y";
  expect_refusal("lattice vector 2 has the component 0.3 along x: expected a rectangular cell");
}

TEST_F(GivenBoundary, HoldsContactsWithItsWallsAlone) {
  options_.contacts = scratch_.file("c.csv");
  test::write_text(options_.contacts, "id1,id2,normal_force\n0,x-,3\ny-,1,4\n");
  options_.walls = "x=0:2,y=0.001:1";
  const Packing<2> p = read();
  ASSERT_EQ(p.contacts.size(), 2u);
  EXPECT_EQ(p.contacts[0].j, 2);
  EXPECT_EQ(p.contacts[0].normal_force, 3.0);
  EXPECT_EQ(p.contacts[1].i, 1);
  EXPECT_EQ(p.contacts[1].j, 4);
  options_.walls = "x=:2,y=0:1";
  expect_refusal("c.csv:2: the contact is between grain 0 and the wall x-, but the packing has no such wall");
  options_.walls = "x=-3:2,y=0:1";
  expect_refusal("c.csv:2: grain 0 carries a force of 3 at the wall x-, but the gap is 3");
  test::write_text(options_.contacts, "id1,id2,normal_force\ny-,x-,3\n");
  expect_refusal("c.csv:2: the bodies y- and x- are both walls");
}

TEST_F(GivenBoundary, MayHaveWallsByTheirIds) {
  options_.contacts = scratch_.file("c.csv");
  test::write_text(options_.contacts, "id1,id2,force1,force2\n7,1,-1,-4\n0,9,3,0.5\n");
  options_.walls = "x=0:2,y=0:1";
  expect_refusal("id1 = 7: no grain has this id");
  options_.wall_ids = {{7, {1, -1}}, {9, {0, -1}}};
  const Packing<2> p = read();
  ASSERT_EQ(p.contacts.size(), 2u);
  EXPECT_NEAR(p.contacts[0].normal_force, 3.0, 1e-15);
  EXPECT_NEAR(p.contacts[0].shear_force[1], 0.5, 1e-15);
  EXPECT_NEAR(p.contacts[1].normal_force, 4.0, 1e-15);
  EXPECT_NEAR(p.contacts[1].shear_force[0], 1.0, 1e-15);
}

TEST_F(GivenBoundary, LeavesNoImageBehindAWall) {
  options_.contacts = scratch_.file("c.csv");
  options_.cell = {{2.0, 0.0}, {0.0, 2.0}};
  options_.walls = "y";
  test::write_text(options_.contacts, "id1,id2,image1,image2,normal_force\n0,1,-1,0,3\n0,1,0,0,2\n");
  EXPECT_EQ(read().contacts.size(), 2u);
  test::write_text(options_.contacts, "id1,id2,image1,image2,normal_force\n0,1,0,1,3\n");
  expect_refusal("c.csv:2: image2 = 1, expected 0: the packing is not periodic along y");
}

TEST_F(GivenBoundary, DoesNotMatterToBonds) {
  options_.bonds = scratch_.file("b.csv");
  options_.walls = "x=:,y=0:1";
  test::write_text(scratch_.file("g.csv"), "x,y,radius\n0.5,0.5,0.5\n2,0.5,0.5\n");
  test::write_text(options_.bonds, "id1,id2,kn,kt\n0,1,70,30\n");
  const Packing<2> p = read();
  ASSERT_EQ(p.contacts.size(), 1u);
  EXPECT_TRUE(p.contacts[0].bonded);
  EXPECT_EQ(p.contacts[0].kn, 70.0);
  EXPECT_EQ(p.contacts[0].kt, 30.0);
  EXPECT_EQ(p.contacts[0].normal_force, 0.0);
  test::write_text(options_.bonds, "id1,id2\n0,1\n");
  expect_refusal("b.csv:2: kn = 0, expected a positive stiffness of the bond");
  test::write_text(options_.bonds, "id1,id2,kn\n0,2,1\n");
  expect_refusal("b.csv:2: id2 = 2: no grain has this id");
}

}  // namespace
}  // namespace floc
