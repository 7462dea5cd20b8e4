#include "floc/picture/view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace floc {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kRounding = 1e-15;

View from(double azimuth, double elevation) {
  View view;
  view.azimuth = azimuth;
  view.elevation = elevation;
  return view;
}

TEST(Camera, OnTheXAxisSeesYToTheRightAndZUpwards) {
  const Camera camera(from(0.0, 0.0));
  EXPECT_TRUE(camera.seen({2.0, 3.0, 5.0}).isApprox(Vec<3>(3.0, 5.0, 2.0), kRounding));
}

TEST(Camera, OnTheYAxisSeesXToTheLeft) {
  const Camera camera(from(90.0, 0.0));
  EXPECT_TRUE(camera.seen({2.0, 3.0, 5.0}).isApprox(Vec<3>(-2.0, 5.0, 3.0), kRounding));
}

TEST(Camera, FromAboveSeesAMap) {
  const Camera camera(from(-90.0, 90.0));
  EXPECT_TRUE(camera.seen({2.0, 3.0, 5.0}).isApprox(Vec<3>(2.0, 3.0, 5.0), 4.0 * kRounding));
}

TEST(Camera, LooksAlongTheDirectionOfItsAngles) {
  const double a = -1.1, e = 0.4, degrees = 180.0 / std::numbers::pi;
  const Vec<3> eye(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
  const Camera camera(from(a * degrees, e * degrees));
  EXPECT_TRUE(camera.seen(eye).isApprox(Vec<3>(0.0, 0.0, 1.0), 4.0 * kRounding));
  // The z axis is drawn vertically. It is foreshortened by the cosine of the elevation.
  EXPECT_NEAR(camera.seen(Vec<3>::UnitZ())[0], 0.0, kRounding);
  EXPECT_NEAR(camera.seen(Vec<3>::UnitZ())[1], std::cos(e), kRounding);
}

TEST(View, FaultsAreNamedWithTheirValue) {
  View view = from(10.0, 95.0);
  view.sphere_size = 2.0;
  EXPECT_THAT(view.validate(),
              ElementsAre(HasSubstr("elevation of the view = 95 degrees: must be between -90 and 90"),
                          HasSubstr("sphere size = 2")));
  EXPECT_TRUE(View().validate().empty());
}

}  // namespace
}  // namespace floc
