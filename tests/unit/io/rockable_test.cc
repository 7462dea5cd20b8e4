#include "floc/io/rockable.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/base/error.h"
#include "floc/io/rockable_text.h"
#include "support/contact_laws.h"
#include "support/foreign_packing.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::string components(const Eigen::Vector3d& v) {
  return fmt::format("{} {} {}", v[0], v[1], v[2]);
}

const std::string kShapes =
    "<\nname Sphere\nradius 0.5\npreCompDone y\nnv 1\n0 0 0\nne 0\nnf 0\nvolume 0.25\n>\n"
    "<\nname Plate\nradius 0.125\nnv 4\n9 9 0\n9 -9 0\n-9 -9 0\n-9 9 0\nne 0\nnf 1\n4 0 1 2 3\nvolume 1\n>\n";

/// Returns a packing as a configuration of Rockable. Walls are driven plates, listed before the spheres. The
/// normal points from j to i, and the force on i is fn n + ft.
std::string configuration(const Packing<3>& p) {
  std::string text = "Rockable 29-11-2018\n# a comment\nshapeFile shapes.txt\n";
  text += fmt::format("gravity {}\nnDriven {}\n", components(p.gravity), p.walls.size());
  if (p.walls.empty()) {
    text += "usePeriodicCell 1\nh";
    for (int a = 0; a < 3; ++a)
      text += " " + components(p.cell.matrix.col(a));  // the columns of h are the lattice vectors
    text += "\n";
  }
  const int n_driven = static_cast<int>(p.walls.size());
  std::string densities, bodies;
  for (int i = 0; i < p.grains.size(); ++i) {
    const double scale = p.grains.radius[i] / 0.5;
    densities += fmt::format("density {} {}\n", i, p.grains.mass[i] / (0.25 * std::pow(scale, 3)));
    bodies += fmt::format("Sphere {} 0 {} {} 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\n", i, scale,
                          components(p.grains.position[i]));
  }
  std::string plates;
  for (const Wall<3>& wall : p.walls) {
    const double half = std::sqrt(0.5);
    const std::string turned[] = {fmt::format("{} 0 {} 0", half, half), fmt::format("{} {} 0 0", half, half),
                                  "1 0 0 0"};
    plates += fmt::format("Plate 0 0 1 {} 0 0 0 0 0 0 {} 0 0 0 0 0 0\n",
                          components((wall.position + wall.side * 0.125) * Vec<3>::Unit(wall.axis)),
                          turned[wall.axis]);
  }
  text += densities + fmt::format("Particles {}\n{}{}", p.grains.size() + n_driven, plates, bodies);
  text += fmt::format("Interactions {}\n", p.contacts.size());
  for (const Contact<3>& c : p.contacts)
    text += fmt::format("{} {} 0 0 0 {} {} 0 0 0 0 0 0 {} {} 0 0 0 0\n", c.i + n_driven,
                        p.is_wall(c.j) ? c.j - p.grains.size() : c.j + n_driven, components(-c.normal), c.gap,
                        c.normal_force, components(c.shear_force));
  return text;
}

void expect_read(const test::Ends<3>& ends) {
  const Packing<3> written = test::packing_with_forces<3>(ends).packing;
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file("shapes.txt"), kShapes);
  test::write_text(scratch.file("conf0"), configuration(written));
  EXPECT_TRUE(is_rockable(scratch.file("conf0")));
  test::expect_same_packing(test::read_packing<3>(scratch.file("conf0")), written, 1e-12);
}

TEST(Rockable, GivesContactsForcesAndBalance) {
  expect_read({"p", "p", "p"});
  expect_read({"ww", "ww", "ww"});
}

/// The moment of an interaction acts on the first body. It is written and read if the law has it.
TEST(Rockable, KeepsRollingAndTwistingMoments) {
  State<3> state = test::packing_with_forces<3>({"ww", "ww", "ww"});
  Law law = parse_law("law", test::kForeignLaw + ",rolling.coefficient=0.1,rolling.stiffness=3");
  law += test::twisting_spring(0.5, 4.0);
  state.packing.law = state.packing.wall_law = law;
  double next = 0.25;
  for (Contact<3>& c : state.packing.contacts) {
    c.rolling_moment = next * 1e-3 * c.normal.cross(Vec<3>(1.0, 2.0, 3.0));
    c.twisting_moment = (next = -1.1 * next) * 1e-3;
    if (std::abs(next) > 2.0) next = 0.25;
  }
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("s.conf");
  write_rockable(path, state);
  ImportOptions options;
  options.law = law;
  const Packing<3> read = test::read_packing<3>(path, options);
  ASSERT_EQ(read.contacts.size(), state.packing.contacts.size());
  for (std::size_t k = 0; k < read.contacts.size(); ++k) {
    const Contact<3>&a = read.contacts[k], &b = state.packing.contacts[k];
    EXPECT_NEAR((a.rolling_moment - b.rolling_moment).norm(), 0.0, 1e-15) << k;
    EXPECT_NEAR(a.twisting_moment, b.twisting_moment, 1e-15) << k;
  }
  options.law = parse_law("law", test::kForeignLaw);
  const Imported without = read_rockable(path, options);
  EXPECT_THAT(
      without.inconsistencies,
      testing::Contains(HasSubstr(fmt::format("{} interactions have moments (mom) that the law does not "
                                              "have",
                                              read.contacts.size()))));
}

TEST(Rockable, NamesWhatIsWrong) {
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("conf0");
  const std::string good = configuration(test::packing_with_forces<3>({"ww", "ww", "ww"}).packing);
  const auto refusal = [&](const std::string& from, const std::string& to, const std::string& words) {
    test::write_text(scratch.file("shapes.txt"), kShapes);
    std::string text = good;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    test::write_text(path, text.replace(at, from.size(), to));
    EXPECT_THAT([&] { test::read_packing<3>(path); }, ThrowsMessage<InputError>(HasSubstr(words))) << from;
  };
  refusal("Sphere 0", "Cube 0", "the shape Cube is not in the file of shapes");
  refusal("Sphere 0", "Plate 0", "preCompDone");
  refusal("Sphere 1 0 1", "Sphere 1 0 -1", "must be positive");
  refusal("nDriven 6", "nDriven 7", "the driven body Sphere is not a flat face perpendicular to an axis");
  refusal("Interactions ", "Interactions 1", "the file ends before row");
  refusal("shapeFile shapes.txt", "shapeFile none.txt", "none.txt");
  refusal("Particles", "Partikles", "the file has no section Particles");
}

}  // namespace
}  // namespace floc
