#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "floc/packing/tile.h"
#include "floc/structure/scattering.h"
#include "support/crystals.h"

namespace floc::test {
namespace {

using testing::ElementsAre;

constexpr double kTau = 2.0 * std::numbers::pi;

TEST(BallTransform, IsTheIntegralOfItsShells) {
  // Compares the transform with the integral of 4 pi r sin(kr)/k over r from 0 to R.
  for (const double R : {0.5, 2.0})
    for (const double k : {1e-4, 0.03, 0.05, 1.0, 7.0}) {
      constexpr int kSteps = 2000;
      double sum = 0.0;
      for (int s = 0; s < kSteps; ++s) {
        const double r = (s + 0.5) * R / kSteps;
        sum += 2.0 * kTau * r * std::sin(k * r) / k * R / kSteps;
      }
      EXPECT_NEAR(ball_transform(k, R), sum, 1e-5 * R * R * R) << k;
    }
  // ball_transform() uses a series for small k R and a closed form above k R = 0.02, where both agree.
  EXPECT_NEAR(ball_transform(0.02 - 1e-12, 1.0) / ball_transform(0.02, 1.0), 1.0, 1e-11);
}

TEST(Scattering, OfOneSphereIsItsFormFactor) {
  // Two opposite wave vectors count as one. The first bin contains 3 wave vectors of the kind (1,0,0) and 6 of the kind
  // (1,1,0). The second bin contains 4 of the kind (1,1,1), 3 of the kind (2,0,0), 12 of the kind (2,1,0) and 12 of the
  // kind (2,1,1).
  const double R = 0.3;
  const Packing<3> packing = crystal_of(simple_cubic(), 1.0, 2.0 * R, elastic_law(1.0, 0.0, 0.0));
  const Scattering s = scattering(packing);
  const auto I = [&](double n2) { return std::pow(ball_transform(kTau * std::sqrt(n2), R), 2); };
  ASSERT_GE(s.I.size(), 2u);
  EXPECT_EQ(s.n_vectors[0], 9);
  EXPECT_NEAR(s.k[0], kTau * (3.0 + 6.0 * std::sqrt(2.0)) / 9.0, 1e-12);
  EXPECT_NEAR(s.I[0], (3.0 * I(1.0) + 6.0 * I(2.0)) / 9.0, 1e-15);
  EXPECT_EQ(s.n_vectors[1], 31);
  EXPECT_NEAR(s.I[1], (4.0 * I(3.0) + 3.0 * I(4.0) + 12.0 * I(5.0) + 12.0 * I(6.0)) / 31.0, 1e-15);
}

TEST(Scattering, OfACrystalIsAtItsReciprocalLattice) {
  // A body-centred cubic crystal has two spheres in a cubic cell of side L. Only wave vectors with an even sum
  // of indices scatter, with the intensity I = 4 f^2/L^3 (form factor f of a sphere).
  const Packing<3> packing = crystal_of(body_centred_cubic(), 1.0, 0.9, elastic_law(1.0, 0.0, 0.0));
  const double L = packing.cell.matrix(0, 0);
  const auto I = [&](double n2) {
    return 4.0 * std::pow(ball_transform(kTau * std::sqrt(n2) / L, 0.45), 2) / (L * L * L);
  };
  const Scattering s = scattering(packing);
  EXPECT_NEAR(s.I[0], 6.0 * I(2.0) / 9.0, 1e-14);
  EXPECT_NEAR(s.I[1], (3.0 * I(4.0) + 12.0 * I(6.0)) / 31.0, 1e-14);
  // In a cell with twice the side, only the wave vectors of the reciprocal lattice of the crystal scatter. At
  // all others the intensity is zero.
  const Packing<3> large = tiled<3>(packing, {2, 2, 2});
  ScatteringAverage peak({kTau / L * 1.4, kTau / L * 1.42});
  peak.add(large, 1000);
  ASSERT_THAT(peak.result().n_vectors, ElementsAre(6));
  EXPECT_NEAR(peak.result().I[0], 8.0 * I(2.0), 1e-13);
}

TEST(Scattering, OfIndependentSpheresIsThatOfOneTimesTheirDensity) {
  const Packing<3> packing = random_packing<3>(2000, 3, elastic_law(1.0, 0.0, 0.0));
  const Scattering s = scattering(packing);
  const double density = packing.grains.size() / packing.cell.volume();
  int n = 0;
  for (std::size_t b = 0; b < s.k.size(); ++b) {
    double expected = 0.0;
    for (const double R : packing.grains.radius)
      expected += std::pow(ball_transform(s.k[b], R), 2) * density / packing.grains.size();
    if (s.n_vectors[b] < 30 || s.k[b] > 4.0) continue;  // at larger k, the intensity varies within a bin
    EXPECT_NEAR(s.I[b] / expected, 1.0, 4.0 / std::sqrt(static_cast<double>(s.n_vectors[b]))) << s.k[b];
    EXPECT_LE(s.n_vectors[b], 300);
    ++n;
  }
  EXPECT_GE(n, 4);
}

TEST(Scattering, OfAVastCellStopsAtTheWavesThatItCanAfford) {
  Packing<3> packing = crystal_of(simple_cubic(), 1.0, 0.5, elastic_law(1.0, 0.0, 0.0));
  packing.cell.matrix *= 1e6;
  ScatteringOptions few;
  few.most_waves = 5000;
  const std::vector<double> edges = scattering_edges(packing, few);
  ScatteringAverage all(edges);
  all.add(packing, 1000000);
  std::int64_t n = 0;
  for (const std::int64_t m : all.result().n_vectors) n += m;
  EXPECT_NEAR(static_cast<double>(n), 5000.0, 300.0);
}

TEST(Scattering, OfSpheresDoesNotSeeHowTheCellIsCut) {
  const Packing<3> packing = random_packing<3>(30, 8, elastic_law(1.0, 0.0, 0.0), 0.9);
  Packing<3> sheared = packing;
  sheared.cell.matrix.row(0) += 3.0 * packing.cell.matrix.row(1);
  for (Vec<3>& x : sheared.grains.position) x += Vec<3>(0.3, 4.0, -2.0);
  ScatteringOptions all;
  all.most_vectors = 1000000;
  const Scattering s = scattering(packing, all), t = scattering(sheared, all);
  ASSERT_EQ(s.n_vectors, t.n_vectors);
  for (std::size_t b = 0; b < s.I.size(); ++b) EXPECT_NEAR(t.I[b], s.I[b], 1e-9 * s.I[b]);
}

}  // namespace
}  // namespace floc::test
