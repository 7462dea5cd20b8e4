#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "floc/shape/manifold.h"
#include "unit/shape/solids.h"

/// Shapes placed in space, and the points of their contacts.
namespace floc::test {

/// Tolerance for rounding errors in examples with closed forms.
inline constexpr double kExact = 1e-13;
inline const Mat<3> kNoTurn = Mat<3>::Identity();

inline Mat<3> turn_about(const Vec<3>& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis).toRotationMatrix();
}
inline Mat<2> turn_by(double degrees) {
  return Eigen::Rotation2Dd(degrees * std::numbers::pi / 180.0).toRotationMatrix();
}

/// Places a shape in space. The points from which the shape was made are rotated by `turn` and then shifted by
/// `position`.
template <int Dim>
PlacedShape<Dim> placed(const Shape<Dim>& shape, const Vec<Dim>& position, const Mat<Dim>& turn) {
  return {&shape, 1.0, position + turn * shape.centre, turn * shape.axes};
}

template <int Dim>
std::vector<Vec<Dim>> positions(const Manifold<Dim>& manifold, const PlacedShape<Dim>& first) {
  std::vector<Vec<Dim>> found;
  for (int k = 0; k < manifold.n(); ++k) found.push_back(first.position + manifold.points[k].arm);
  return found;
}

template <int Dim>
void expect_points(const std::vector<Vec<Dim>>& found, const std::vector<Vec<Dim>>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (const Vec<Dim>& e : expected) {
    double nearest = 1e9;
    for (const Vec<Dim>& f : found) nearest = std::min(nearest, (f - e).norm());
    EXPECT_LT(nearest, kExact) << e.transpose();
  }
}

}  // namespace floc::test
