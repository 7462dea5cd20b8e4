#include "floc/rigid/contact_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/angular_packing.h"
#include "support/few_grains.h"
#include "support/network_packings.h"
#include "support/rigid_states.h"

namespace floc {
namespace {

/// Expects that no grain has a contact with the image of a grain across a wall.
template <int Dim>
void expect_no_images_between_walls(const test::Ends<Dim>& ends) {
  for (Packing<Dim> p :
       {test::packing_with_forces<Dim>(ends).packing, test::angular_packing_with_forces<Dim>(ends).packing})
    for (const Contact<Dim>& c : ContactPoints<Dim>().find(p, 0.01))
      for (int a = 0; a < Dim; ++a)
        EXPECT_TRUE(c.image[a] == 0 || !between_walls(p.walls, a)) << c.i << " " << c.j;
}

/// Returns two prisms of height 1, one above the other, with a gap of 1e-3. The upper prism is tilted a little, so that
/// the gaps at its corners differ, and turned by half the angle between two corners.
Packing<3> two_prisms(const Law& law, int n_sides) {
  const double angle = 2.0 * std::numbers::pi / n_sides;
  std::vector<Vec<3>> corners;
  for (int k = 0; k < n_sides; ++k)
    for (const double z : {-0.5, 0.5}) corners.emplace_back(std::cos(k * angle), std::sin(k * angle), z);
  Packing<3> packing = test::unit_grains<3>({{4, 4, 3}, {4, 4, 4.001}}, 8.0, law);
  test::set_shape(packing.grains, shape_of_points<3>(corners, 0.0).shape, std::sqrt(5.0));
  packing.grains.orientation[1] = Eigen::AngleAxisd(1e-7, Vec<3>(1.0, 0.3, 0.0).normalized()) *
                                  Eigen::AngleAxisd(0.5 * angle, Vec<3>::UnitZ());
  return packing;
}

/// All corners between two faces, and between a face and a wall, have to take part in a step: if the step left out a
/// corner that a force has just closed, the force would act at another corner in the next step, and so on. At rest, a
/// force that acts between a corner that was left out and the other corners would have no balance.
TEST(ContactPoints, OfFacesAreAllCornersWhateverTheLawAndTheirNumber) {
  for (const Law& law : {test::rigid_law(0.0), test::rigid_law(0.5), test::elastic_law(1e3, 0.5, 0.0)})
    for (const int n_sides : {3, 4, 5, 8, 20, 90}) {
      Packing<3> packing = two_prisms(law, n_sides);
      const std::size_t n_common = 2 * n_sides;  // each side of one face cuts a corner of the other face
      EXPECT_EQ(ContactPoints<3>().find(packing, 0.01).size(), n_common) << n_sides;
      packing.walls = {{.axis = 2, .side = -1, .position = 2.499}, {.axis = 2, .side = 1, .position = 5.6}};
      EXPECT_EQ(ContactPoints<3>().find(packing, 0.01).size(), n_common + n_sides) << n_sides;
    }
}

TEST(ContactPoints, DoNotReachAcrossWalls) {
  expect_no_images_between_walls<2>({"ww", "ww"});
  expect_no_images_between_walls<2>({"p", "wo"});
  expect_no_images_between_walls<3>({"oo", "p", "ww"});
}

}  // namespace
}  // namespace floc
