#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "support/lattices.h"
#include "support/run_program.h"
#include "support/states.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// Fixture: two states of eight disks. In the first state, the disks form two blocks of four. In the second state, one
/// disk of a block has moved to the other block, and all disks are shifted across the cell boundary.
class Compare : public testing::Test {
 protected:
  void SetUp() override {
    State<2> before;
    before.packing =
        disks(12.0 * Mat<2>::Identity(), {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {6, 6}, {7, 6}, {6, 7}, {7, 7}}, 1.0,
              elastic_law(1.0, 0.5, 0.1));
    write_state(scratch_.file("a.h5"), before);
    State<2> after = before;
    Grains<2>& g = after.packing.grains;
    g.position[3] = {7, 5};
    for (Vec<2>& x : g.position) x = after.packing.cell.wrapped(x + Vec<2>(8.0, 9.5));
    find_contacts(after.packing);
    write_state(scratch_.file("b.h5"), after);
    write_state(scratch_.file("spheres.h5"), busy_state<3>());
    write_state(scratch_.file("three.h5"), busy_state<2>());
  }

  Outcome compare(const std::string& arguments) const {
    return run_floc("compare " + arguments, scratch_.path());
  }

  ScratchDirectory scratch_;
};

TEST_F(Compare, CountsWhatWasKeptLostAndGained) {
  const Outcome o = compare("a.h5 b.h5 --displacements u.csv --contacts c.csv --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json row = json::parse(o.out).at(0);
  EXPECT_EQ(row.at("before"), "a.h5");
  EXPECT_EQ(row.at("after"), "b.h5");
  EXPECT_EQ(row.at("n_before"), 8);
  EXPECT_EQ(row.at("n_after"), 7);
  EXPECT_EQ(row.at("n_kept"), 6);
  EXPECT_EQ(row.at("n_lost"), 2);
  EXPECT_EQ(row.at("n_gained"), 1);
  EXPECT_EQ(row.at("kept_share"), 0.75);
  EXPECT_EQ(row.at("kept_share_after"), 6.0 / 7.0);
  EXPECT_EQ(row.at("lost_share"), 0.25);
  EXPECT_EQ(row.at("gained_share"), 1.0 / 7.0);
  EXPECT_EQ(row.at("n_rigid"), 2);
  EXPECT_EQ(row.at("rigid_largest"), 4);
  EXPECT_EQ(row.at("rigid_share"), 7.0 / 8.0);
  // Only one of eight grains moved, by the vector (5, 3). Relative to the mean displacement, this grain moved by 7/8 of
  // the vector, and the other grains by -1/8 of the vector.
  const double size = std::sqrt(34.0);
  EXPECT_NEAR(row.at("displacement_largest").get<double>(), 7.0 / 8.0 * size, 1e-12);
  EXPECT_NEAR(row.at("displacement_rms").get<double>(), size * std::sqrt(7.0 / 64.0), 1e-12);
  EXPECT_NEAR(row.at("strain11").get<double>(), 0.0, 1e-14);

  const CsvTable u = CsvTable::read(scratch_.file("u.csv"));
  EXPECT_THAT(u.columns(), ElementsAre("before", "after", "grain", "x1", "x2", "u1", "u2", "rigid_cluster"));
  ASSERT_EQ(u.n_rows(), 8);
  EXPECT_NEAR(u.number(3, 5), 35.0 / 8.0, 1e-12);
  EXPECT_TRUE(u.is_empty(3, 7));
  EXPECT_EQ(u.integer(7, 7), 0);
  const CsvTable c = CsvTable::read(scratch_.file("c.csv"));
  ASSERT_EQ(c.n_rows(), 9);
  EXPECT_EQ(c.text(6, 2), "lost");
  EXPECT_EQ(c.integer(6, 3), 1);
  EXPECT_EQ(c.integer(6, 4), 3);
  EXPECT_EQ(c.text(8, 2), "gained");
  EXPECT_EQ(c.integer(8, 3), 3);
  EXPECT_EQ(c.integer(8, 4), 5);
  EXPECT_TRUE(c.is_empty(8, 5));
}

TEST_F(Compare, GoesFromStateToStateOrFromTheFirst) {
  const auto pairs = [&](const std::string& arguments) {
    std::string text;
    for (const json& row : json::parse(compare(arguments + " --format json").out))
      text += row.at("before").get<std::string>() + ">" + row.at("after").get<std::string>() + " ";
    return text;
  };
  EXPECT_EQ(pairs("a.h5 b.h5 a.h5"), "a.h5>b.h5 b.h5>a.h5 ");
  EXPECT_EQ(pairs("a.h5 b.h5 a.h5 --against-first"), "a.h5>b.h5 a.h5>a.h5 ");
}

TEST_F(Compare, NamesWhatCannotBeComparedAndDoesTheRest) {
  const Outcome o = compare("a.h5 three.h5 none.h5 b.h5 a.h5 --format csv");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err,
              HasSubstr("three.h5: this state cannot be compared with a.h5: there are 8 grains in one state, "
                        "but 3 in the other"));
  EXPECT_THAT(o.err, HasSubstr("none.h5"));
  EXPECT_THAT(o.out, HasSubstr("\nb.h5,a.h5,8,"));
  const Outcome mixed = compare("three.h5 spheres.h5");
  EXPECT_EQ(mixed.code, 4);
  EXPECT_THAT(mixed.err, HasSubstr("spheres.h5: this is a state in 3D, but three.h5 is in 2D"));
  EXPECT_EQ(compare("a.h5").code, 2);
  EXPECT_EQ(compare("a.h5 b.h5 --rigid-tolerance 0").code, 2);
}

}  // namespace
}  // namespace floc::test
