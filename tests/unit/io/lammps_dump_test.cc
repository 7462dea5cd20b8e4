#include "floc/io/lammps_dump.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/io/law_text.h"
#include "support/run_program.h"

namespace floc {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Returns one frame of a dump: a box of 4 x 3 with its corner at (1, 2), and three disks. The disks with ids 7
/// and 3 overlap by 0.1 across the side of the box.
std::string frame(int timestep, const std::string& columns, const std::string& rows,
                  const std::string& box = "ITEM: BOX BOUNDS pp pp pp\n1 5\n2 5\n-0.5 0.5\n") {
  const auto n = std::count(rows.begin(), rows.end(), '\n');
  return "ITEM: TIMESTEP\n" + std::to_string(timestep) + "\nITEM: NUMBER OF ATOMS\n" + std::to_string(n) +
         "\n" + box + "ITEM: ATOMS " + columns + "\n" + rows;
}
const std::string kRows = "7 1.4 3 0 0.5\n3 4.5 3 0 0.5\n5 3.7 3 0 0.5\n";

class LammpsDump : public testing::Test {
 protected:
  LammpsDump() {
    options_.law = parse_law("", "normal.stiffness=10,friction.coefficient=0.5,friction.stiffness=4");
    grains(frame(10, "id x y z radius", kRows));
  }
  void grains(const std::string& text) { test::write_text(scratch_.file("g.dump"), text); }
  void contacts(const std::string& rows, int timestep = 10) {
    options_.contacts = scratch_.file("c.dump");
    options_.contact_columns = {{"id1", "c_p[1]"},    {"id2", "c_p[2]"},          {"force1", "c_f[1]"},
                                {"force2", "c_f[2]"}, {"shear_force1", "c_f[4]"}, {"shear_force2", "c_f[5]"}};
    const auto n = std::count(rows.begin(), rows.end(), '\n');
    test::write_text(options_.contacts,
                     "ITEM: TIMESTEP\n" + std::to_string(timestep) + "\nITEM: NUMBER OF ENTRIES\n" +
                         std::to_string(n) + "\nITEM: BOX BOUNDS pp pp pp\n1 5\n2 5\n-0.5 0.5\n" +
                         "ITEM: ENTRIES c_p[1] c_p[2] c_f[1] c_f[2] c_f[3] c_f[4] c_f[5]\n" + rows);
  }
  Imported read() { return read_lammps_dump(scratch_.file("g.dump"), options_); }
  template <int Dim>
  Packing<Dim> packing() {
    return std::get<State<Dim>>(read().state).packing;
  }
  auto refusal() {
    return [this] { read(); };
  }

  test::ScratchDirectory scratch_;
  ImportOptions options_;
};

TEST_F(LammpsDump, WhoseGrainsAllHaveOneHeightIsTwoDimensional) {
  const Packing<2> p = packing<2>();
  EXPECT_EQ(p.cell.matrix, (Mat<2>() << 4, 0, 0, 3).finished());
  // Expected positions of the grains, up to whole lattice vectors.
  for (int i = 0; i < 3; ++i) {
    const Vec<2> apart = p.cell.reduced(p.grains.position[i] - Vec<2>(i == 0 ? 1.4 : i == 1 ? 4.5 : 3.7, 3.0));
    EXPECT_NEAR((apart.array() - apart.array().round()).abs().maxCoeff(), 0.0, 1e-15);
  }
  options_.dimension = 3;
  EXPECT_EQ(packing<3>().cell.matrix.diagonal(), Vec<3>(4, 3, 1));
  options_.dimension.reset();
  grains(frame(10, "id x y z radius", "1 1 2 0 0.5\n2 1 2 0.1 0.5\n"));
  EXPECT_EQ(packing<3>().grains.size(), 2);
}

TEST_F(LammpsDump, MayHaveScaledOrUnwrappedPositionsAndDiameters) {
  const Packing<2> wrapped = packing<2>();
  grains(frame(10, "diameter id xs ys zs",
               "1 7 0.1 0.3333333333333333 0\n1 3 0.875 0.3333333333333333 0\n"
               "1 5 0.675 0.3333333333333333 0\n"));
  const Packing<2> scaled = packing<2>();
  grains(frame(10, "id xu yu zu radius", "7 5.4 6 0 0.5\n3 -3.5 0 0 0.5\n5 3.7 3 0 0.5\n"));
  const Packing<2> unwrapped = packing<2>();
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR((scaled.grains.position[i] - wrapped.grains.position[i]).norm(), 0.0, 1e-14);
    EXPECT_NEAR((unwrapped.grains.position[i] - wrapped.grains.position[i]).norm(), 0.0, 1e-14);
    EXPECT_EQ(scaled.grains.radius[i], 0.5);
  }
}

/// For a triclinic box, LAMMPS gives the bounds of its bounding box: xlo + min(0, xy, xz, xy + xz) and so on.
TEST_F(LammpsDump, OfATriclinicBoxHasTheBoundsOfItsBoundingBox) {
  grains(frame(10, "id x y z radius", "1 1 1 0 0.5\n2 2 2 1 0.5\n",
               "ITEM: BOX BOUNDS xy xz yz pp pp pp\n-1 6.5 -1\n-0.25 3 1.5\n0 2 -0.25\n"));
  EXPECT_EQ(packing<3>().cell.matrix, (Mat<3>() << 5, 0, 0, -1, 3, 0, 1.5, -0.25, 2).finished());
}

TEST_F(LammpsDump, OfSeveralFramesIsReadLastUnlessOneIsNamed) {
  grains(frame(10, "id x y z radius", kRows) + frame(20, "id x y z radius", "1 2 3 0 0.25\n"));
  EXPECT_EQ(packing<2>().grains.size(), 1);
  EXPECT_THAT(read().remarks, ElementsAre("frame 1 of the frames 0 to 1 is read, time step 20",
                                          "every z is the same, so the grains are taken as disks in 2D; give "
                                          "--dimension 3 to make them spheres"));
  options_.index = 0;
  EXPECT_EQ(packing<2>().grains.size(), 3);
  options_.index = 2;
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("index = 2, but the file contains frames 0 to 1")));
}

TEST_F(LammpsDump, TakesForcesOnTheFirstGrainFromADumpLocal) {
  // Grains 3 and 7 touch across the side of the box. The force on grain 3 has the components -1 along x and 0.3 along
  // y.
  contacts("3 7 -1 0 0 0 0.3\n5 3 -2 0 0 0 -0.5\n");
  const Packing<2> p = packing<2>();
  ASSERT_EQ(p.contacts.size(), 2u);
  // The contact joins the grains with index 0 (id 7) and 1 (id 3). The file lists grain 3 first.
  const Contact<2>& across = p.contacts[0];
  EXPECT_EQ(std::tie(across.i, across.j), std::make_tuple(0, 1));
  EXPECT_NEAR(across.gap, -0.1, 1e-14);
  EXPECT_NEAR(across.normal[0], -1.0, 1e-15);
  EXPECT_NEAR(across.normal_force, 1.0, 1e-15);
  EXPECT_NEAR(across.shear_force[1], -0.3, 1e-15);
  EXPECT_FALSE(across.sliding);
  const Contact<2>& inside = p.contacts[1];
  EXPECT_NEAR(inside.normal_force, 2.0, 1e-14);
  EXPECT_NEAR(inside.shear_force[1], 0.5, 1e-14);
  EXPECT_FALSE(inside.sliding);
}

TEST_F(LammpsDump, NamesWhatIsWrongInItsGrains) {
  grains(frame(10, "id x y z", "1 2 3 0\n"));
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("no column radius or diameter; its columns are id, x")));
  grains(frame(10, "id x y z radius", "1 2 3 0 0.5\n2 2 nan 0 0.5\n"));
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("g.dump:11: y = \"nan\", expected a finite number")));
  grains(frame(10, "id x y z radius", "1 2 3 0 0\n"));
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("g.dump:10: radius = 0, must be positive")));
  grains(frame(10, "id x y z radius", kRows, "ITEM: BOX BOUNDS pp pp pp\n1 1\n2 5\n-0.5 0.5\n"));
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("g.dump:5: the cell is degenerate: its side along x is 0")));
  grains(frame(10, "id x y z radius", kRows, "ITEM: BOX BOUNDS pp ff pp\n1 5\n2 5\n-0.5 0.5\n"));
  EXPECT_EQ(packing<2>().walls.size(), 2u);
  options_.cell = {{9, 0}, {0, 9}};
  EXPECT_EQ(packing<2>().cell.matrix(0, 0), 9.0);
  options_.cell.clear();
  const std::string whole = frame(10, "id x y z radius", kRows);
  grains(whole.substr(0, whole.size() - 15));
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("expected row 3 of 3")));
  grains("1 2 3\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("no line \"ITEM: TIMESTEP\"")));
  options_.law.reset();
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("give --law")));
}

TEST_F(LammpsDump, NamesWhatIsWrongInItsContacts) {
  contacts("3 8 -1 0 0 0 0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr(
                             "c.dump:10: id2 = 8: no grain has this id; the ids of grains are from 3 to 7")));
  contacts("3 7 -1 0 0 0 0\n7 3 1 0 0 0 0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(
                             HasSubstr("c.dump:11: the contact of grains 7 and 3 is listed twice, first at")));
  contacts("3 7 -1 0 0 0 0\n", 20);
  EXPECT_THAT(
      refusal(),
      ThrowsMessage<InputError>(HasSubstr(
          "has no frame with time step 10, the time step of the grains; the time steps in the dump are 20")));
  contacts("3 7 -1 0 0 0 0\n");
  options_.contact_columns.clear();
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("has no column \"id1\"")));
  contacts("3 7 -1 0 0 0 0.3\n");
  options_.law = parse_law("", "normal.stiffness=10");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("the law has no friction")));
}

/// The grains are 2.9 apart in a cell of height 4. If the distance is more than half of the height, two images of a
/// grain can be equally near.
TEST_F(LammpsDump, DoesNotGuessTheImageOfAContactOfHalfTheCell) {
  contacts("7 3 1 0 0 0 0\n");
  options_.cell = {{6, 0}, {0, 4}};
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("c.dump:10: the centres of the grains are 2.9 apart")));
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("half the width of the cell (2) or more")));
}

TEST_F(LammpsDump, WithMoreRowsThanItsHeadStatesIsRefused) {
  const std::string whole = frame(10, "id x y z radius", kRows);
  const auto with_more = [&](const std::string& more) { grains(whole + more); };
  with_more("9 2 4.5 0 0.1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(
                             HasSubstr("g.dump:13: the line is \"9 2 4.5 0 0.1\", expected the next frame")));
  with_more("9 2 4.5 0 0.1\n" + whole);
  options_.index = 0;
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("after the 3 rows that the frame states")));
  with_more("\n\n");
  EXPECT_EQ(packing<2>().grains.size(), 3);
  with_more(whole);
  EXPECT_EQ(packing<2>().grains.size(), 3);
}

}  // namespace
}  // namespace floc
