#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "floc/structure/force_distribution.h"
#include "floc/structure/force_moments.h"
#include "support/contact_laws.h"

namespace floc {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Packing<2> with_forces(const std::vector<double>& normal, double F0) {
  Packing<2> packing;
  packing.law += test::linear(1.0);
  if (F0 > 0.0) packing.law += test::tail_adhesion(F0, 0.1);
  packing.grains = Grains<2>::with_size(2);
  packing.grains.radius = {0.5, 1.0};
  for (const double f : normal) {
    Contact<2> c;
    c.normal_force = f;
    c.elastic_force = f + F0;
    c.shear_force = {0.3 * f, -0.4 * f};
    c.rolling_moment = RotationVector<2>(-0.01 * f);
    packing.contacts.push_back(c);
  }
  return packing;
}

TEST(ForceDistribution, KeepsTheSignOfNormalForcesAndNeverMixesThem) {
  const ForceDistribution d = force_distribution(with_forces({-2.4, -0.1, 0.1, 0.2, 1.9, 2.0}, 2.0),
                                                 ForceKind::normal, ForceUnit::pull_off, 0.5);
  EXPECT_EQ(d.unit, 2.0);
  EXPECT_EQ(d.n, 6);
  EXPECT_EQ(d.first, -3);
  EXPECT_THAT(d.counts, ElementsAre(1, 0, 1, 2, 1, 1));
  EXPECT_DOUBLE_EQ(d.low(0), -1.5);
  EXPECT_DOUBLE_EQ(d.middle(3), 0.25);
  EXPECT_DOUBLE_EQ(d.density(3), 2.0 / (6.0 * 0.5));
}

TEST(ForceDistribution, ByTheMeanIsOfMeanOne) {
  Packing<2> packing = with_forces({-3.0, 1.0, 2.0, 6.0}, 0.0);
  EXPECT_DOUBLE_EQ(force_distribution(packing, ForceKind::normal, ForceUnit::mean, 0.1).unit, 3.0);
  const ForceDistribution t = force_distribution(packing, ForceKind::tangential, ForceUnit::mean, 0.1);
  EXPECT_DOUBLE_EQ(t.unit, 1.5);
  EXPECT_EQ(t.first, 3);  // index of the first bin: the smallest size is 0.5/1.5
  EXPECT_DOUBLE_EQ(force_distribution(packing, ForceKind::rolling, ForceUnit::mean, 0.1).unit, 0.03);
  packing.contacts[0].distant = true;
  EXPECT_EQ(force_distribution(packing, ForceKind::tangential, ForceUnit::mean, 0.1).n, 3);
  EXPECT_EQ(force_distribution(packing, ForceKind::normal, ForceUnit::mean, 0.1).n, 4);
}

TEST(ForceDistribution, OfMomentsIsByForceTimesLargestDiameter) {
  EXPECT_DOUBLE_EQ(
      force_distribution(with_forces({1.0}, 3.0), ForceKind::rolling, ForceUnit::pull_off, 0.1).unit, 6.0);
}

TEST(ForceDistribution, WithoutAUnitIsEmpty) {
  EXPECT_THAT(force_distribution(with_forces({1.0}, 0.0), ForceKind::normal, ForceUnit::pull_off, 0.1).counts,
              IsEmpty());
  EXPECT_THAT(force_distribution(with_forces({}, 1.0), ForceKind::normal, ForceUnit::mean, 0.1).counts,
              IsEmpty());
}

TEST(ForceDistribution, OfAnyValuesIsInTheirUnit) {
  const ForceDistribution d = distribution_of({-1.0, 0.5, 0.6, 3.0}, 2.0, 0.25);
  EXPECT_EQ(d.first, -2);
  EXPECT_THAT(d.counts, ElementsAre(1, 0, 0, 2, 0, 0, 0, 0, 1));
  EXPECT_THAT(distribution_of({1.0}, 0.0, 0.25).counts, IsEmpty());
  EXPECT_THAT(distribution_of({}, 1.0, 0.25).counts, IsEmpty());
}

TEST(ForceDistribution, CountsWhatLiesBeyondItsBinsAndPutsItInNone) {
  // There are at most 1e5 bins on each side of zero; here the bins extend from -1e4 to 1e4. A value at the upper end of
  // the last bin is not counted in this bin.
  const ForceDistribution d =
      distribution_of({-2e4, -1e4, -0.05, 0.0, 9999.95, 1e4, 3e7, std::nan("")}, 1.0, 0.1);
  EXPECT_EQ(d.n, 8);
  EXPECT_EQ(d.n_outside, 4);
  EXPECT_EQ(d.first, -kMaxBins);
  EXPECT_EQ(d.counts.size(), 2u * kMaxBins);
  EXPECT_EQ(std::accumulate(d.counts.begin(), d.counts.end(), std::int64_t{0}), 4);
  EXPECT_EQ(d.counts.front(), 1);
  EXPECT_EQ(d.counts.back(), 1);
  const ForceDistribution none = distribution_of({1.0, 2.0}, 1.0, 1e-9);
  EXPECT_EQ(none.n_outside, 2);
  EXPECT_THAT(none.counts, IsEmpty());
  ForceDistribution sum = none;
  sum.add(distribution_of({0.5}, 1.0, 1e-9));
  EXPECT_EQ(sum.n_outside, 3);
  for (const double width : {1e-300, 1e-9, 1.0, 1e300}) {
    const ForceDistribution wide = distribution_of({-1e-3, 0.0, 1.0, 1e6}, 1.0, width);
    EXPECT_EQ(std::accumulate(wide.counts.begin(), wide.counts.end(), wide.n_outside), 4) << width;
    for (int b = 0; b < static_cast<int>(wide.counts.size()); ++b)
      EXPECT_TRUE(std::isfinite(wide.low(b)) && std::isfinite(wide.low(b + 1))) << width;
  }
}

TEST(ForceDistribution, HasNoUnitOfRounding) {
  // Elastic forces cancel the adhesion except for rounding, so the pressure consists of rounding errors only.
  Packing<2> packing = with_forces({1e-16, -1e-16}, 1.0);
  packing.cell.matrix.setIdentity();
  EXPECT_EQ(force_unit(packing, ForceKind::normal, ForceUnit::mean), 0.0);
  EXPECT_EQ(force_unit(packing, ForceKind::tangential, ForceUnit::mean), 0.0);
  EXPECT_EQ(force_unit(packing, ForceKind::normal, ForceUnit::pull_off), 1.0);
  EXPECT_TRUE(pressure_is_noise(packing));
  EXPECT_EQ(force_unit(packing, ForceKind::normal, ForceUnit::pressure), 0.0);
  EXPECT_GT(force_unit(with_forces({1e-9, -1e-9}, 1.0), ForceKind::normal, ForceUnit::mean), 0.0);
}

TEST(ForceDistribution, OfStatesAddUp) {
  ForceDistribution sum;
  sum.add(force_distribution(with_forces({-1.0, 3.0}, 1.0), ForceKind::normal, ForceUnit::pull_off, 1.0));
  sum.add(force_distribution(with_forces({2.5, -4.5}, 1.0), ForceKind::normal, ForceUnit::pull_off, 1.0));
  EXPECT_EQ(sum.n, 4);
  EXPECT_EQ(sum.first, -5);
  EXPECT_THAT(sum.counts, ElementsAre(1, 0, 0, 0, 1, 0, 0, 1, 1));
}

TEST(ForceMoments, OfAHandfulOfContacts) {
  // Elastic forces are 1, 2, 3 and 6, with mean 3. The ratio |F_T|/N is 0.5.
  Packing<2> packing = with_forces({1.0, 2.0, 3.0, 6.0}, 0.0);
  packing.contacts[3].shear_force *= 0.5;
  const ForceMoments m = force_moments(packing);
  EXPECT_DOUBLE_EQ(m.mean_normal, 3.0);
  EXPECT_DOUBLE_EQ(m.largest, 6.0);
  EXPECT_NEAR(m.Z[0], 50.0 / 4.0 / 9.0, 1e-14);
  EXPECT_NEAR(m.Z[1], 252.0 / 4.0 / 27.0, 1e-14);
  EXPECT_NEAR(m.Z[2], 1394.0 / 4.0 / 81.0, 1e-14);
  EXPECT_NEAR(m.M1, 0.25, 1e-15);
  EXPECT_NEAR(m.M2, 0.5, 1e-15);
}

TEST(ForceMoments, WithAdhesionAreOfTheElasticPart) {
  const ForceMoments m = force_moments(with_forces({-1.0, 1.0}, 2.0));  // elastic forces of 1 and 3
  EXPECT_DOUBLE_EQ(m.mean_normal, 2.0);
  EXPECT_DOUBLE_EQ(m.largest, 3.0);
  EXPECT_DOUBLE_EQ(m.Z[0], 5.0 / 4.0);
  EXPECT_DOUBLE_EQ(m.M1, 0.5 / 3.0);
  EXPECT_DOUBLE_EQ(m.M2, 0.5);
}

}  // namespace
}  // namespace floc
