#include "floc/io/csv_packing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "floc/base/error.h"
#include "floc/io/law_text.h"
#include "support/contact_laws.h"
#include "support/scratch_directory.h"
#include "support/springs.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Fixture: three disks in a skewed cell. Its lattice vectors are (4, 0) and (1, 3). Disks 0 and 1 overlap by 0.1
/// across a side of the cell, and disks 1 and 2 by 0.2 inside the cell.
class CsvPacking : public testing::Test {
 protected:
  CsvPacking() {
    options_.law = parse_law("",
                             "normal.stiffness=10,friction.coefficient=0.5,friction.stiffness=4,"
                             "rolling.coefficient=0.1,rolling.stiffness=2");
    options_.cell = {{4, 0}, {1, 3}};
    grains("id,x,y,radius\n7,4.4,1,0.5\n3,3.5,1,0.5\n5,2.7,1,0.5\n");
  }

  void grains(const std::string& text) { std::ofstream(scratch_.file("g.csv")) << text; }
  void contacts(const std::string& text) {
    options_.contacts = scratch_.file("c.csv");
    std::ofstream(options_.contacts) << text;
  }
  template <int Dim = 2>
  Packing<Dim> read() {
    return std::get<State<Dim>>(read_csv_packing(scratch_.file("g.csv"), options_).state).packing;
  }
  auto refusal() {
    return [this] { read_csv_packing(scratch_.file("g.csv"), options_); };
  }

  test::ScratchDirectory scratch_;
  ImportOptions options_;
};

TEST_F(CsvPacking, PutsGrainsIntoTheCellWithUnitMassAtUnitDiameter) {
  const Packing<2> p = read();
  EXPECT_NEAR(p.grains.position[0][0], 0.4, 1e-15);
  EXPECT_EQ(p.grains.position[1], Vec<2>(3.5, 1.0));
  EXPECT_EQ(p.grains.mass[2], 1.0);
  EXPECT_TRUE(p.contacts.empty());
}

TEST_F(CsvPacking, ConvertsLengthsToTheUnitOfXOrToMetres) {
  grains("X (cm),Y (cm),diameter [mm]\n1,0.5,5\n2.5,0.5,2.5\n");
  EXPECT_EQ(read().grains.radius, (std::vector<double>{0.25, 0.125}));
  EXPECT_EQ(read().grains.position[1], Vec<2>(2.5, 0.5));
  options_.units = "SI";
  EXPECT_NEAR(read().grains.position[1][0], 0.025, 1e-17);
  EXPECT_NEAR(read().grains.radius[0], 0.0025, 1e-17);
  grains("x [cm],y,radius [cm]\n1,1,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("column y: found no unit here")));
  grains("x [m],y [m],radius [m],mass [g]\n1,1,1,1\n");
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("column \"mass [g]\" is in g: expected kg, the unit of SI")));
}

TEST_F(CsvPacking, SaysHowItsTablesAreWritten) {
  grains("id;x;y;radius\n7;4,4;1;0,5\n3;3,5;1;0,5\n5;2,7;1;0,5\n");
  contacts("# id1 id2 normal_force\n7 3 1\n");
  const std::vector<std::string> remarks = read_csv_packing(scratch_.file("g.csv"), options_).remarks;
  EXPECT_THAT(remarks,
              testing::IsSupersetOf({std::string("read 3 rows: separated by semicolons, decimal commas"),
                                     scratch_.file("c.csv") + ": read 1 row: separated by blanks"}));
}

TEST_F(CsvPacking, RefusesForcesInSeveralUnits) {
  contacts("id1,id2,force1 [N],force2 [kN]\n7,3,1,0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("column \"force2 [kN]\" is in kN: expected N")));
  options_.units = "SI";
  contacts("id1,id2,normal_force [kN]\n7,3,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("is in kN: expected N, the unit of SI")));
}

TEST_F(CsvPacking, TakesColumnsByTheNamesGiven) {
  grains("D;Y;X;M\n2;1;0.5;3\n");
  options_.columns = {{"x", "X"}, {"y", "Y"}, {"diameter", "D"}, {"mass", "M"}};
  const Packing<2> p = read();
  EXPECT_EQ(p.grains.position[0], Vec<2>(0.5, 1.0));
  EXPECT_EQ(p.grains.radius[0], 1.0);
  EXPECT_EQ(p.grains.mass[0], 3.0);
}

TEST_F(CsvPacking, HasThreeDimensionsWhenTheCellHasThreeVectors) {
  grains("x,y,z,radius\n0.5,0.6,4.7,1\n");
  options_.cell = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const Packing<3> p = read<3>();
  EXPECT_NEAR((p.grains.position[0] - Vec<3>(0.5, 0.6, 0.7)).norm(), 0.0, 1e-15);
  EXPECT_EQ(p.grains.mass[0], 8.0);
}

TEST_F(CsvPacking, FindsTheNearestImageOfListedContacts) {
  contacts("id1,id2\n7,3\n3,5\n");
  const Packing<2> p = read();
  ASSERT_EQ(p.contacts.size(), 2u);
  EXPECT_EQ(std::tie(p.contacts[0].i, p.contacts[0].j), std::make_tuple(0, 1));
  EXPECT_EQ(p.contacts[0].image, (Vec<2, int>(-1, 0)));
  EXPECT_NEAR(p.contacts[0].gap, -0.1, 1e-15);
  EXPECT_NEAR(p.contacts[0].normal_force, 1.0, 1e-14);
  EXPECT_NEAR(p.contacts[1].gap, -0.2, 1e-15);
}

TEST_F(CsvPacking, TakesImagesThatReferToThePositionsOfTheFile) {
  contacts("id1,id2,image1,image2\n7,3,0,0\n");
  const Packing<2> p = read();
  EXPECT_EQ(p.contacts[0].image, (Vec<2, int>(-1, 0)));
  EXPECT_NEAR(p.contacts[0].gap, -0.1, 1e-15);
}

TEST_F(CsvPacking, KeepsForcesOfTheListAndStretchesTheSpringsToThem) {
  // The list names grain 5 first: the listed force of +0.3 acts on grain 5, and the opposite force on grain 3.
  contacts("id1,id2,normal_force,shear_force1,shear_force2,rolling_moment\n5,3,2.5,0,0.3,0.04\n");
  const Contact<2> c = read().contacts[0];
  EXPECT_EQ(std::tie(c.i, c.j), std::make_tuple(1, 2));
  EXPECT_NEAR(c.normal[0], -1.0, 1e-15);
  EXPECT_EQ(c.normal_force, 2.5);
  EXPECT_NEAR(c.shear_force[1], -0.3, 1e-15);
  // The normal is along -x, so the tangent is along -y. Along this tangent, the elongation of the spring is F/K_T =
  // 0.3/4.
  EXPECT_NEAR(test::shear_spring(c)[0], 0.075, 1e-15);
  EXPECT_NEAR(c.rolling_moment[0], -0.04, 1e-15);
  EXPECT_NEAR(test::rolling_spring(c)[0], 0.02, 1e-15);
  EXPECT_FALSE(c.sliding);
  EXPECT_EQ(std::tie(c.kn, c.kt, c.kr), std::make_tuple(10.0, 4.0, 2.0));
}

TEST_F(CsvPacking, StretchesTheTwistingSpringToTheMomentOfTheList) {
  grains("id,x,y,z,radius\n3,3.5,1,1,0.5\n5,2.6,1,1,0.5\n");
  contacts("id1,id2,normal_force,twisting_moment\n5,3,2.5,0.04\n");
  options_.cell = {{8, 0, 0}, {0, 8, 0}, {0, 0, 8}};
  *options_.law += test::twisting_spring(0.5, 4.0);
  const Contact<3> c = read<3>().contacts[0];
  EXPECT_EQ(std::tie(c.i, c.j, c.twisting_moment, c.ktw), std::make_tuple(0, 1, 0.04, 4.0));
  EXPECT_DOUBLE_EQ(c.history[HistoryLayout<3>::kTwisting], -0.01);
  *options_.law += test::without("twisting");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("the law has no twisting")));
}

TEST_F(CsvPacking, TakesAForceAcrossTheSmallGapThatRigidGrainsLeave) {
  grains("id,x,y,radius\n3,3.5,1,0.5\n5,2.5,1,0.4999\n");
  contacts("id1,id2,normal_force\n3,5,0.7\n");
  const Contact<2> c = read().contacts[0];
  EXPECT_GT(c.gap, 0.0);
  EXPECT_EQ(std::tie(c.normal_force, c.elastic_force, c.kn, c.distant), std::make_tuple(0.7, 0.7, 10.0, false));
  contacts("id1,id2\n3,5\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("c.csv:2: the gap is")));
}

TEST_F(CsvPacking, NamesWhatIsMissingOrMalformed) {
  const ImportOptions good = options_;
  options_.law.reset();
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("give --law")));
  options_ = good;
  options_.cell.clear();
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("give --cell")));
  options_.cell = {{1, 2}, {2, 4}};
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("span no volume")));
  options_.cell = {{1, 2}, {2, 4, 5}};
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("vector 2 has 3 components, expected 2")));
  options_ = good;
  options_.columns = {{"r", "radius"}};
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("\"r\" is not the name of a grain column that floc reads")));
  options_ = good;
  options_.index = 1;
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("the file contains only one packing")));
  options_ = good;
  grains("x,y,radius\n1,1,0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("g.csv:2: radius = 0, must be positive")));
  grains("x,y\n1,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("has no column \"radius\"")));
  grains("id,x,y,radius\n1,1,1,1\n1,2,2,1\n");
  contacts("id1,id2\n1,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("g.csv:3: id = 1 is given twice")));
}

TEST_F(CsvPacking, NamesWhatIsWrongInAListOfContacts) {
  contacts("id1,id2\n7,4\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("c.csv:2: id2 = 4: no grain has this id")));
  contacts("id1,id2\n7,3\n3,7\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("listed twice")));
  contacts("id1,id2,image1,image2\n7,7,0,0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("touch itself")));
  contacts("id1,id2,image1,image2\n7,3,0,-1000000001\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(
                             HasSubstr("c.csv:2: image2 = -1000000001, expected a number of cells up to 1e9")));
  grains("id,x,y,radius\n7,-3e9,1,0.5\n3,3e9,1,0.5\n");
  contacts("id1,id2,image1,image2,normal_force\n7,3,1000000000,0,1\n");
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("g.csv:2: the grain is more than 1e9 cells away from")));
  grains("id,x,y,radius\n7,4.4,1,0.5\n3,3.5,1,0.5\n");
  contacts("id1,id2,shear_force1,shear_force2\n7,3,0,1\n");
  options_.law = parse_law("", "normal.stiffness=10");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("the law has no friction")));
  grains("x,y,radius\n1,1,0.5\n1,1,0.4\n");
  contacts("id1,id2\n0,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("c.csv:2: the grains have the same centre")));
  grains("x,y,radius\n1,1,1\n");
  contacts("id1,id2\n0,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(
                             HasSubstr("id2 = 1: no grain has this id; the ids of grains are from 0 to 0")));
}

}  // namespace
}  // namespace floc
