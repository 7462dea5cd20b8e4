#include "floc/geometry/frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace floc {
namespace {

const Vec<3> kNormal = Vec<3>(2, 3, 6) / 7.0;

TEST(Frame, TangentIsTheNormalTurnedByPlus90Degrees) {
  EXPECT_EQ(tangent<double>({1, 0}), Vec<2>(0, 1));
  EXPECT_EQ(tangent<double>({0, 1}), Vec<2>(-1, 0));
}

TEST(Frame, CrossAndMomentIn2DAreThoseOf3DInThePlane) {
  const Vec<2> arm(0.3, -0.7), force(2.0, 5.0);
  const RotationVector<2> spin(1.5);
  const Vec<3> arm3(0.3, -0.7, 0), force3(2.0, 5.0, 0), spin3(0, 0, 1.5);
  EXPECT_NEAR((cross<double>(spin, arm) - spin3.cross(arm3).head<2>()).norm(), 0.0, 1e-15);
  EXPECT_NEAR(moment<double>(arm, force)[0], arm3.cross(force3)[2], 1e-15);
}

TEST(Frame, CrossAndMomentIn3DAreCrossProducts) {
  const Vec<3> a(0.3, -0.7, 1.1), b(2.0, 5.0, -0.4);
  EXPECT_NEAR((cross<double>(a, b) - a.cross(b)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((moment<double>(a, b) - a.cross(b)).norm(), 0.0, 1e-15);
}

TEST(Frame, ShearIsWhatTheNormalLeavesOfADisplacement) {
  const Vec<2> n2(0.6, 0.8), u2(1.0, 2.0);
  const Vec<2> back2 = from_shear<double>(n2, to_shear<double>(n2, u2));
  EXPECT_NEAR((back2 + n2 * n2.dot(u2) - u2).norm(), 0.0, 1e-15);
  const Vec<3> u3(1.0, 2.0, -0.5);
  const Vec<3> back3 = from_shear<double>(kNormal, to_shear<double>(kNormal, u3));
  EXPECT_NEAR((back3 + kNormal * kNormal.dot(u3) - u3).norm(), 0.0, 1e-15);
  EXPECT_NEAR(back3.dot(kNormal), 0.0, 1e-15);
}

TEST(Transport, In2DLeavesTheScalarAsItIs) {
  const Shear<2> shear(0.25);
  EXPECT_EQ(transport<double>(shear, Vec<2>(1, 0), Vec<2>(0, 1), 0.4), shear);
}

TEST(Transport, TurnsWithTheNormalWhereTheAxisLiesInTheTangentPlane) {
  const Vec<3> axis = kNormal.cross(Vec<3>::UnitX()).normalized();
  for (const double angle : {1e-8, 0.1, 1.5, 3.0}) {
    SCOPED_TRACE(angle);
    const Mat<3> turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Vec<3> spring(0.4, -1.2, 0.9);  // like a rolling spring, this vector also has a normal component
    const Vec<3> carried = transport<double>(Shear<3>(spring), kNormal, Vec<3>(turn * kNormal), 0.0);
    // Near half a turn, the factor 1/(1 + cos) amplifies rounding errors: 1 + cos 3 = 0.01.
    EXPECT_NEAR((carried - turn * spring).norm(), 0.0, 1e-13);
  }
}

TEST(Transport, TurnsAboutTheNormalWithTheMeanSpin) {
  for (const double angle : {1e-8, 0.1, 2.0}) {
    SCOPED_TRACE(angle);
    const Mat<3> turn = Eigen::AngleAxisd(angle, kNormal).toRotationMatrix();
    const Vec<3> spring(0.4, -1.2, 0.9);
    const Vec<3> carried = transport<double>(Shear<3>(spring), kNormal, kNormal, angle);
    EXPECT_NEAR((carried - turn * spring).norm(), 0.0, 1e-14);
  }
}

TEST(Transport, KeepsLengthAndTangency) {
  const Vec<3> n1 = Vec<3>(-0.3, 0.8, 0.4).normalized();
  const Vec<3> spring = to_shear<double>(kNormal, {0.4, -1.2, 0.9});
  const Vec<3> carried = transport<double>(Shear<3>(spring), kNormal, n1, 0.7);
  EXPECT_NEAR(carried.norm(), spring.norm(), 1e-14);
  EXPECT_NEAR(carried.dot(n1), 0.0, 1e-14);
}

}  // namespace
}  // namespace floc
