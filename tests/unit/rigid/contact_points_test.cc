#include "floc/rigid/contact_points.h"

#include <gtest/gtest.h>

#include "support/angular_packing.h"

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

TEST(ContactPoints, DoNotReachAcrossWalls) {
  expect_no_images_between_walls<2>({"ww", "ww"});
  expect_no_images_between_walls<2>({"p", "wo"});
  expect_no_images_between_walls<3>({"oo", "p", "ww"});
}

}  // namespace
}  // namespace floc
