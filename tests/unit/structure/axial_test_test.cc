#include "floc/structure/axial_test.h"

#include <gtest/gtest.h>

#include <cmath>

namespace floc {
namespace {

TEST(AxialTest, OfDisksByHand) {
  const Vec<2> before(0.01, 0.02), strain(0.005, 0.04);
  const AxialTest t = measure_axial_test<2>(1, Vec<2>(1.0, 3.0), strain, &before);
  EXPECT_DOUBLE_EQ(t.mean_stress, 2.0);
  EXPECT_DOUBLE_EQ(t.deviator, 2.0);
  EXPECT_DOUBLE_EQ(t.lateral_ratio, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(t.volumetric_strain, 0.045);
  EXPECT_DOUBLE_EQ(t.mobilised, 0.5);
  // eps_v grows by 0.015 and eps_q by 0.025: the sample contracts.
  EXPECT_NEAR(*t.dilatancy, -0.6, 1e-12);
}

TEST(AxialTest, OfSpheresByHand) {
  const Vec<3> before = Vec<3>::Zero(), strain(-0.01, 0.03, -0.01);
  const AxialTest t = measure_axial_test<3>(1, Vec<3>(1.0, 4.0, 1.0), strain, &before);
  EXPECT_DOUBLE_EQ(t.mean_stress, 2.0);
  EXPECT_DOUBLE_EQ(t.deviator, 3.0);
  EXPECT_DOUBLE_EQ(t.lateral_ratio, 0.25);
  EXPECT_DOUBLE_EQ(t.mobilised, 1.5);
  // Here eps_v = 0.01 and eps_q = 2/3 (0.03 + 0.01).
  EXPECT_NEAR(*t.dilatancy, -0.375, 1e-12);
}

TEST(AxialTest, WithoutShearThereIsNoDilatancy) {
  const Vec<2> before = Vec<2>::Zero(), strain = Vec<2>::Constant(0.01);
  EXPECT_FALSE(measure_axial_test<2>(0, Vec<2>::Ones(), strain, &before).dilatancy);
  EXPECT_FALSE(measure_axial_test<2>(0, Vec<2>::Ones(), strain, nullptr).dilatancy);
}

TEST(AxialTest, StrainsAreLogarithmic) {
  EXPECT_NEAR(axial_strain<2>(Vec<2>(2.0, 1.0), Vec<2>(1.0, 1.0))[0], std::log(2.0), 1e-15);
}

}  // namespace
}  // namespace floc
