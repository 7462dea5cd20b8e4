#include "floc/packing/overlaps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "support/contact_laws.h"

namespace floc {
namespace {

/// Returns a large sphere in contact with small spheres of radius 1.
/// @param overlaps  overlaps of the large sphere with the small ones
Packing<3> spheres_with(const std::vector<double>& overlaps) {
  Packing<3> packing;
  packing.law += test::hertz(1.0, 0.3);
  packing.grains = Grains<3>::with_size(static_cast<int>(overlaps.size()) + 1);
  packing.grains.radius.assign(overlaps.size() + 1, 1.0);
  packing.grains.radius[0] = 5.0;
  for (std::size_t k = 0; k < overlaps.size(); ++k) {
    packing.contacts.emplace_back();
    packing.contacts.back().j = static_cast<int>(k) + 1;
    packing.contacts.back().gap = -overlaps[k];
  }
  return packing;
}

TEST(Overlaps, AreMeasuredOverTheSmallerRadius) {
  const Overlaps found = measure_overlaps(spheres_with({0.01, 0.05, 0.11, 0.03}));
  EXPECT_NEAR(found.mean, 0.05, 1e-15);
  EXPECT_EQ(found.largest, 0.11);
  EXPECT_EQ(found.deep_share, 0.25);
  EXPECT_EQ(measure_overlaps(spheres_with({})).mean, 0.0);
}

TEST(Overlaps, AreNoneOfBondsAcrossGaps) {
  Packing<3> packing = spheres_with({0.04, -3.0});
  packing.contacts[1].bonded = true;
  EXPECT_EQ(measure_overlaps(packing).mean, 0.04);
}

TEST(Overlaps, BeyondATenthAreWarnedOfWithTheirShare) {
  EXPECT_EQ(overlap_warning(spheres_with({0.01, 0.1})), "");
  EXPECT_THAT(
      overlap_warning(spheres_with({0.01, 0.05, 0.12, 0.03})),
      testing::StartsWith("25 % of the contacts overlap by more than a tenth of a radius; the largest overlap "
                          "is 0.12 of a radius"));
}

TEST(Overlaps, AreRefusedWhereTheirMeanIsBeyondThatOfTheLargestPressure) {
  require_small_overlaps("here", spheres_with({0.03, 0.19}));
  try {
    require_small_overlaps("here", spheres_with({0.06, 0.2}));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("here: the mean overlap of the contacts is 0.13 of a radius"));
  }
}

TEST(Overlaps, OfALinearLawAreWarnedOfAndNeverRefused) {
  Packing<3> packing = spheres_with({0.5});
  packing.law += test::linear(1.0);
  EXPECT_THAT(
      overlap_warning(packing),
      testing::AllOf(testing::StartsWith("100 % of the contacts overlap by more than a tenth"),
                     testing::HasSubstr("is K_N = 1 consistent with the units of lengths and forces?")));
  require_small_overlaps("here", packing);
}

}  // namespace
}  // namespace floc
