#include "floc/structure/affine_prediction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/packing/balance.h"
#include "floc/packing/tile.h"
#include "floc/structure/gap_coordination.h"
#include "support/crystals.h"
#include "support/lattices.h"

namespace floc::test {
namespace {

TEST(AffinePrediction, OfCrystalsIsTheirLawAtEveryDensity) {
  // With a = 1, normal force N, branch length r and volume c r^3 per sphere, the pressure is P = z N/(6 c r^2)
  // and the solid fraction Phi = pi/(6 c r^3).
  for (const CubicCrystal& crystal : cubic_crystals()) {
    const Packing<3> packing = crystal_of(crystal, 0.999, 1.0, elastic_law(2.0, 0.0, 0.0));
    const AffineReference<3> reference(packing, std::vector<bool>(packing.grains.size(), false));
    for (const double r : {0.9, 0.97, 0.9995}) {
      const AffinePrediction p = reference.at(std::acos(-1.0) / (6.0 * crystal.volume * r * r * r));
      EXPECT_EQ(p.z, crystal.z) << crystal.name << r;
      EXPECT_EQ(p.z_pushed, crystal.z) << crystal.name << r;
      EXPECT_NEAR(p.pressure, crystal.z * 2.0 * (1.0 - r) / (6.0 * crystal.volume * r * r), 1e-12)
          << crystal.name;
    }
    const AffinePrediction apart = reference.at(0.9 * solid_fraction(packing));
    EXPECT_EQ(apart.z, 0.0);
    EXPECT_EQ(apart.pressure, 0.0);
  }
}

TEST(AffinePrediction, CountsTheNeighboursAtSmallGaps) {
  // For equal spheres of diameter a, a linear compression by the factor s brings neighbours with gaps of up to a/s - a
  // into contact. The predicted coordination is therefore z_I(a/s - a).
  Packing<3> packing = random_packing<3>(60, 11, elastic_law(1.0, 0.0, 0.0), 0.9);
  packing.grains.radius.assign(packing.grains.radius.size(), 0.45);
  const AffineReference<3> reference(packing, std::vector<bool>(packing.grains.size(), false));
  for (const double s : {0.98, 0.9, 0.8}) {
    const double z = gap_coordination(packing, {0.9 / s - 0.9})[0];
    EXPECT_EQ(reference.at(solid_fraction(packing) / (s * s * s)).z, z);
  }
  EXPECT_GT(reference.at(solid_fraction(packing) / 0.5).z, reference.at(solid_fraction(packing)).z + 1.0);
}

TEST(AffinePrediction, OfTheSameDensityIsTheStateItself) {
  const Packing<2> packing = random_packing<2>(60, 11, elastic_law(1.0, 0.0, 0.0));
  const AffineReference<2> reference(packing, std::vector<bool>(packing.grains.size(), false));
  const AffinePrediction p = reference.at(solid_fraction(packing));
  EXPECT_NEAR(p.z, 2.0 * static_cast<double>(packing.contacts.size()) / 60, 1e-12);
  EXPECT_NEAR(p.pressure, static_stress(packing).trace() / 2.0, 1e-12);
}

TEST(AffinePrediction, WithPushedRattlersCountsTheirContacts) {
  // A frame of unit squares with a rattler inside. When the rattler is pushed against the frame, it touches two grains.
  Packing<2> packing = square_frames(5, 1.0, elastic_law(1.0, 0.0, 0.0));
  packing.grains.position.emplace_back(2.0, 2.1);
  packing.grains.radius.push_back(0.4);
  const AffineReference<2> reference(packing, {false, false, false, false, false, false, false, true});
  const AffinePrediction p = reference.at(solid_fraction(packing));
  EXPECT_NEAR(p.z_pushed - p.z, 2.0 * 2 / 8, 1e-12);
}

}  // namespace
}  // namespace floc::test
