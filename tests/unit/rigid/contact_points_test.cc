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

/// Returns two octagonal prisms of height 1, one above the other, with a gap of 1e-3. The upper prism is tilted a little,
/// so that the gaps at its corners differ.
Packing<3> two_octagons(const Law& law) {
  std::vector<Vec<3>> corners;
  for (int k = 0; k < 8; ++k)
    for (const double z : {-0.5, 0.5})
      corners.emplace_back(std::cos(0.25 * k * std::numbers::pi), std::sin(0.25 * k * std::numbers::pi), z);
  Packing<3> packing = test::unit_grains<3>({{4, 4, 3}, {4, 4, 4.001}}, 8.0, law);
  test::set_shape(packing.grains, shape_of_points<3>(corners, 0.0).shape, std::sqrt(5.0));
  packing.grains.orientation[1] = Eigen::AngleAxisd(1e-4, Vec<3>(1.0, 0.3, 0.0).normalized());
  return packing;
}

/// All corners between two faces, and between a face and a wall, have to take part in a step: if the step left out a
/// corner that a force has just closed, the force would act at another corner in the next step, and so on.
TEST(ContactPoints, OfFacesAreAllCornersWhateverTheLaw) {
  for (const Law& law : {test::rigid_law(0.0), test::rigid_law(0.5), test::elastic_law(1e3, 0.5, 0.0)}) {
    Packing<3> packing = two_octagons(law);
    EXPECT_EQ(ContactPoints<3>().find(packing, 0.01).size(), 8u);
    packing.walls = {{.axis = 2, .side = -1, .position = 2.499}, {.axis = 2, .side = 1, .position = 5.6}};
    EXPECT_EQ(ContactPoints<3>().find(packing, 0.01).size(), 16u);
  }
}

TEST(ContactPoints, DoNotReachAcrossWalls) {
  expect_no_images_between_walls<2>({"ww", "ww"});
  expect_no_images_between_walls<2>({"p", "wo"});
  expect_no_images_between_walls<3>({"oo", "p", "ww"});
}

}  // namespace
}  // namespace floc
