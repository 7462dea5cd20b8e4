#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "floc/io/state_file.h"
#include "floc/neighbors/find_contacts.h"
#include "support/contact_laws.h"
#include "support/lattices.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// Fixture: square frames of disks. An additional disk is attached to a node of a frame and can roll on this node.
/// Another additional disk touches nothing.
class ModesCommand : public testing::Test {
 protected:
  void SetUp() override {
    // The law has adhesion. Without adhesion, a disk with only one contact would be a rattler.
    Law law = elastic_law(1.0, 0.5, 0.0);
    law += test::constant_adhesion(1e-3);
    State<2> state;
    state.packing = square_frames_around({{2.0, 1.0}, {2.2, 2.2}}, 5, 1.0, law);
    state.packing.grains.radius.back() = 0.2;
    find_contacts(state.packing);
    write_state(scratch_.file("frames.h5"), state);
  }
  Outcome modes(const std::string& arguments) const { return run_floc("modes " + arguments, scratch_.path()); }

  ScratchDirectory scratch_;
};

TEST_F(ModesCommand, ListWhatIsFreeThenMechanismsThenModes) {
  const Outcome o = modes("frames.h5 --count 8 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json rows = json::parse(o.out);
  std::map<std::string, int> count;
  for (const json& row : rows) count[row.at("kind")] += row.at("count").get<int>();
  EXPECT_EQ(count["translation"], 2);
  EXPECT_EQ(count["rattler"], 3);
  EXPECT_EQ(count["roll"], 1);
  EXPECT_EQ(count["mechanism"] + count["near-mechanism"] + count["elastic"], 8);
  EXPECT_THAT(o.err, HasSubstr("mechanism(s): "));
}

TEST_F(ModesCommand, HasTheColumnsOfEveryState) {
  const Outcome o = modes("frames.h5 none.h5 frames.h5 --count 3 --format csv");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("none.h5: No such file"));
  EXPECT_THAT(o.out,
              StartsWith("file,kind,count,eigenvalue,eigenvalue_prestress,participation,softens_B,softens_G,"
                         "coupling1,coupling2,strain1,strain2,grains\n"));
}

TEST_F(ModesCommand, NameTheModuliThatVanish) {
  State<2> chain;
  chain.packing = chain_across(4, 1.0, 3.0, elastic_law(1.0, 0.5, 0.1));
  write_state(scratch_.file("chain.h5"), chain);
  const Outcome o = modes("chain.h5 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(
      o.err, HasSubstr("chain.h5: warning: mechanisms let the cell change its shape without elastic energy, so "
                       "these moduli are zero: C22, B_S"));
  json strain;
  for (const json& row : json::parse(o.out))
    if (row.at("kind") == "strain mechanism") strain = row;
  EXPECT_NEAR(std::abs(strain.at("strain2").get<double>()), 1.0, 1e-9);
  EXPECT_EQ(strain.at("eigenvalue"), 0.0);
}

TEST_F(ModesCommand, RefuseWhatIsNoCount) {
  EXPECT_EQ(modes("frames.h5 --count 0").code, 2);
  EXPECT_EQ(modes("frames.h5 --count many").code, 2);
  EXPECT_EQ(modes("").code, 2);
}

}  // namespace
}  // namespace floc::test
