#include "floc/geometry/ball_in_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace floc {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// Integrates over z the area that the cross sections of the ball and the box have in common, over the z that both
/// contain. At the ends of this range, the area may vary like the square root of the distance from the end. The
/// substitution z = middle - half length * cos(angle) makes the integrand smooth there.
double by_quadrature(const Vec<3>& centre, double radius, const Vec<3>& low, const Vec<3>& high) {
  const double from = std::max(low[2], centre[2] - radius), to = std::min(high[2], centre[2] + radius);
  constexpr int kSteps = 200000;
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double angle = kPi * (k + 0.5) / kSteps;
    const double z = 0.5 * (from + to) - 0.5 * (to - from) * std::cos(angle);
    const double rho = std::sqrt(std::max(0.0, radius * radius - (z - centre[2]) * (z - centre[2])));
    if (rho == 0.0) continue;
    const double area = ball_in_box<2>(centre.head<2>(), rho, low.head<2>(), high.head<2>());
    sum += area * 0.5 * (to - from) * std::sin(angle) * kPi / kSteps;
  }
  return sum;
}

TEST(BallInBox, OctantsCapsAndTheWholeAreClosedForms) {
  const Vec<3> origin = Vec<3>::Zero(), far = Vec<3>::Constant(kFar);
  EXPECT_NEAR(ball_in_box<3>(origin, 2.0, Vec<3>(-far), far), 32.0 / 3.0 * kPi, 1e-13);
  EXPECT_NEAR(ball_in_box<3>(origin, 1.0, origin, far), kPi / 6.0, 1e-15);
  for (const double h : {0.1, 0.7, 1.0, 1.3, 1.9}) {
    // The box cuts off a cap of height h.
    const double cap = kPi * h * h * (3.0 - h) / 3.0;
    for (int axis = 0; axis < 3; ++axis) {
      Vec<3> low = -far;
      low[axis] = 1.0 - h;
      EXPECT_NEAR(ball_in_box<3>(origin, 1.0, low, far), cap, 4e-15) << h;
    }
  }
  // The first box is a rectangle inside the disk. The second box cuts four segments off the disk.
  EXPECT_NEAR(ball_in_box<2>(Vec<2>::Zero(), 1.0, Vec<2>(-0.5, -0.6), Vec<2>(0.5, 0.6)), 1.2, 1e-15);
  const double segment = std::acos(0.9) - 0.9 * std::sqrt(0.19);
  EXPECT_NEAR(ball_in_box<2>(Vec<2>::Zero(), 1.0, Vec<2>::Constant(-0.9), Vec<2>::Constant(0.9)),
              kPi - 4.0 * segment, 2e-15);
  // The cube lies inside the ball.
  EXPECT_NEAR(ball_in_box<3>(origin, 1.0, Vec<3>::Constant(-0.5), Vec<3>::Constant(0.5)), 1.0, 1e-14);
}

TEST(BallInBox, AgreesWithQuadratureAndPartsAddUp) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  for (int trial = 0; trial < 12; ++trial) {
    const Vec<3> centre(uniform(engine), uniform(engine), uniform(engine));
    Vec<3> low, high, middle;
    for (int a = 0; a < 3; ++a) {
      const double p = uniform(engine), q = uniform(engine);
      low[a] = std::min(p, q), high[a] = std::max(p, q), middle[a] = 0.3 * p + 0.7 * q;
    }
    const double whole = ball_in_box<3>(centre, 1.1, low, high);
    EXPECT_NEAR(whole, by_quadrature(centre, 1.1, low, high), 1e-7) << trial;
    double parts = 0.0;
    for (int part = 0; part < 8; ++part) {
      Vec<3> from = low, to = high;
      for (int a = 0; a < 3; ++a) (part >> a & 1 ? from : to)[a] = middle[a];
      parts += ball_in_box<3>(centre, 1.1, from, to);
    }
    EXPECT_NEAR(parts, whole, 3e-14) << trial;
  }
}

TEST(BallInBox, OutsideIsNothing) {
  EXPECT_EQ(ball_in_box<3>(Vec<3>(3.0, 0.0, 0.0), 1.0, Vec<3>::Constant(-1.0), Vec<3>::Constant(1.0)), 0.0);
  // The centre of the ball is less than a radius away from the planes of two faces, but more than a radius away from
  // the edge between these faces.
  EXPECT_NEAR(ball_in_box<3>(Vec<3>(1.8, 1.8, 0.0), 1.0, Vec<3>::Constant(-1.0), Vec<3>::Constant(1.0)), 0.0,
              1e-15);
}

}  // namespace
}  // namespace floc
