#include "floc/io/yade_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/io/law_text.h"
#include "support/run_program.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kCell = "# cell 4 0 0 0 4 0 0 0 4\n";
const std::string kSpheres = kCell + "# id x y z r\n4 0.5 1 1 0.5\n9 3.6 1 1.3 0.5\n";
const std::string kNames = "# id1 id2 cellx celly cellz fnx fny fnz fsx fsy fsz kn ks tan_phi\n";

class YadeText : public testing::Test {
 protected:
  void write(const std::string& spheres, const std::string& interactions = "") {
    test::write_text(scratch_.file("s.txt"), spheres);
    options_.contacts = interactions.empty() ? "" : scratch_.file("i.txt");
    if (!interactions.empty()) test::write_text(options_.contacts, interactions);
  }
  Packing<3> read() {
    return std::get<State<3>>(read_yade_text(scratch_.file("s.txt"), options_).state).packing;
  }
  auto refusal() {
    return [this] { read(); };
  }

  test::ScratchDirectory scratch_;
  ImportOptions options_;
};

/// The nearest image of the second sphere is at x = -0.4, so the normal is (-0.9, 0, 0.3)/0.9487. Forces in YADE act on
/// the second sphere.
TEST_F(YadeText, HasForcesOnTheSecondSphereAndItsCellDistance) {
  write(kSpheres, kNames + "4 9 -1 0 0 -1.8 0 0.6 0 0.5 0 1000 400 0.6\n");
  const Packing<3> p = read();
  ASSERT_EQ(p.contacts.size(), 1u);
  const Contact<3>& c = p.contacts[0];
  EXPECT_EQ(c.image, (Vec<3, int>(-1, 0, 0)));
  EXPECT_NEAR(c.normal_force, std::hypot(1.8, 0.6), 1e-15);
  EXPECT_NEAR((c.shear_force - Vec<3>(0.0, -0.5, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(std::tie(c.kn, c.kt), std::make_tuple(1000.0, 400.0));
  EXPECT_EQ(p.law, parse_law("", "normal.stiffness=1000,friction.coefficient=0.6,friction.stiffness=400"));
}

TEST_F(YadeText, WithoutNamesOrWithThoseOfTextExtHasOneSphereALine) {
  options_.law = parse_law("", "normal.stiffness=10");
  options_.cell = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  for (const std::string header : {"", "#format x_y_z_r\n"}) {
    write(header + "0.5 1 1 0.5\n3.6\t1 1.3 0.25\n");
    EXPECT_EQ(read().grains.radius, (std::vector<double>{0.5, 0.25}));
  }
  EXPECT_TRUE(is_yade_text(scratch_.file("s.txt")));
}

TEST_F(YadeText, NamesWhatIsWrong) {
  write("# cell 4 0 0 0 4 0 0 0\n# x y z r\n1 1 1 1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("s.txt:1: the cell has 8 numbers")));
  write("# cell 4 0 0 0 4 0 8 0 0\n# x y z r\n1 1 1 1\n2 2 2.5 1\n",
        kNames + "0 1 0 0 0 1 1 1 0 0 0 1 1 0.5\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("s.txt:1: the cell is degenerate")));
  write(kSpheres);
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("give --law")));
  write(kSpheres, "4 9 -1 0 0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr(
                             "i.txt:1: no comment line before this line gives the names of the columns")));
  write(kSpheres, kNames + "4 9 -1 0 0 -1.8 0 inf 0 0.5 0 1000 400 0.6\n");
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("i.txt:2: fnz = \"inf\", expected a finite number")));
  write(kSpheres, kNames + "4 9 -1 0 0 -1.8 0 0.6 0 0.5 0 1000 400 0.6\n4 9 0 0 0 1 0 0 0 0 0 1 1 0.5\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(
                             HasSubstr("i.txt:3: tan_phi = 0.5, but tan_phi = 0.6 in the first interaction")));
  write(kSpheres + "9 1 1 1 1\n");
  options_.law = parse_law("", "normal.stiffness=10");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("s.txt:5: id = 9 is given twice")));
}

}  // namespace
}  // namespace floc
