#include "floc/structure/scattering.h"

#include <fftw3.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "floc/fitting/scattering_fit.h"
#include "support/network_packings.h"

namespace floc::test {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Returns the Fourier transform of a disk of radius R at the wave number k.
double form_factor(double k, double R) {
  return kTwoPi * R * std::cyl_bessel_j(1.0, k * R) / k;
}

/// Closed form of I(k) for disks. In each bin, I(k) is averaged over the wave vectors over which scattering() averages.
struct Exact {
  std::vector<double> I, envelope;
};

Exact exact(const Packing<2>& packing, const std::vector<double>& edges) {
  const Mat<2> reciprocal = kTwoPi * packing.cell.matrix.inverse();
  const auto reach =
      static_cast<int>(std::ceil(edges.back() * packing.cell.matrix.rowwise().norm().maxCoeff() / kTwoPi));
  Exact out;
  std::vector<double> sum(edges.size() - 1, 0.0), largest(edges.size() - 1, 0.0);
  std::vector<int> n(edges.size() - 1, 0);
  for (int n1 = -reach; n1 <= reach; ++n1)
    for (int n2 = -reach; n2 <= reach; ++n2) {
      const Vec<2> k = reciprocal * Vec<2>(n1, n2);
      const auto above = std::upper_bound(edges.begin(), edges.end(), k.norm());
      if (above == edges.begin() || above == edges.end()) continue;
      std::complex<double> chi = 0.0;
      for (int i = 0; i < packing.grains.size(); ++i)
        chi += form_factor(k.norm(), packing.grains.radius[i]) *
               std::polar(1.0, -k.dot(packing.grains.position[i]));
      const auto bin = static_cast<std::size_t>(above - edges.begin()) - 1;
      const double I = std::norm(chi) / packing.cell.volume();
      sum[bin] += I;
      largest[bin] = std::max(largest[bin], I);
      ++n[bin];
    }
  for (std::size_t b = 0; b < n.size(); ++b)
    if (n[b] > 0) out.I.push_back(sum[b] / n[b]), out.envelope.push_back(largest[b]);
  return out;
}

Packing<2> one_disk(double R, const Mat<2>& cell) {
  Packing<2> packing;
  packing.cell.matrix = cell;
  packing.grains = Grains<2>::with_size(1);
  packing.grains.position[0] = {0.3, -0.7};
  packing.grains.radius[0] = R;
  return packing;
}

/// Returns disks of two sizes at independent random positions.
Packing<2> uncorrelated(int n, double side, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Packing<2> packing;
  packing.cell.matrix << side, 0.0, 0.2 * side, 0.9 * side;
  packing.grains = Grains<2>::with_size(n);
  for (int i = 0; i < n; ++i) {
    packing.grains.position[i] = packing.cell.matrix.transpose() * Vec<2>(uniform(engine), uniform(engine));
    packing.grains.radius[i] = i % 3 == 0 ? 0.5 : 0.25;
  }
  return packing;
}

TEST(Scattering, OfOneDiskIsItsFormFactor) {
  Mat<2> cell;
  cell << 9.0, 0.0, 2.5, 8.0;
  const Packing<2> packing = one_disk(0.5, cell);
  const ScatteringMesh mesh = scattering_mesh(packing, {});
  const Scattering found = scattering(packing);
  const Exact expected = exact(packing, mesh.edges);
  ASSERT_EQ(found.I.size(), expected.I.size());
  ASSERT_GT(found.I.size(), 12u);
  for (std::size_t b = 0; b < found.I.size(); ++b)
    EXPECT_NEAR(found.I[b], expected.I[b], 0.01 * expected.I[b]) << b;
}

TEST(Scattering, OfASquareLatticeIsInItsBraggPeaks) {
  constexpr int kSide = 6;
  Packing<2> packing;
  packing.cell.matrix = kSide * Mat<2>::Identity();
  packing.grains = Grains<2>::with_size(kSide * kSide);
  for (int i = 0; i < kSide * kSide; ++i) {
    packing.grains.position[i] = Vec<2>(0.1 + i % kSide, 0.2 + i / kSide);
    packing.grains.radius[i] = 0.5;
  }
  // Bins around the peaks at |k|/(2 pi) = 1, sqrt 2 and 2, and bins between the peaks.
  const std::vector<double> edges = {0.5 * kTwoPi, 0.95 * kTwoPi, 1.05 * kTwoPi, 1.39 * kTwoPi, 1.43 * kTwoPi};
  ScatteringAverage average(edges);
  ScatteringMesh mesh = scattering_mesh(packing, {});
  average.add(packing.cell, coverage_map(packing, mesh.size(packing.cell)));
  const Scattering found = average.result();
  const Exact expected = exact(packing, edges);
  ASSERT_EQ(found.I.size(), 4u);
  const auto peak = [&](double k) { return std::pow(kSide * form_factor(k, 0.5), 2); };  // N^2 f^2/A
  EXPECT_LT(found.I[0], 1e-4 * peak(kTwoPi));
  EXPECT_LT(found.I[2], 1e-4 * peak(kTwoPi));
  EXPECT_NEAR(found.I[1] / expected.I[1], 1.0, 0.01);
  EXPECT_NEAR(found.I[3] / expected.I[3], 1.0, 0.01);
  EXPECT_NEAR(expected.envelope[1], peak(kTwoPi), 1e-9 * peak(kTwoPi));
  EXPECT_NEAR(expected.envelope[3], peak(std::sqrt(2.0) * kTwoPi), 1e-9 * peak(kTwoPi));
}

/// Results must not depend on which vectors of a lattice describe the cell. Here, a lattice vector spans a million
/// cells; a mesh along this vector would be too large.
TEST(Scattering, OfALatticeDoesNotDependOnItsCell) {
  Packing<2> packing = one_disk(0.4, Mat<2>::Identity() * 3.0);
  const Scattering straight = scattering(packing);
  packing.cell.matrix.row(1) += 1e6 * packing.cell.matrix.row(0);
  const Scattering slanted = scattering(packing);
  EXPECT_EQ(slanted.k, straight.k);
  EXPECT_EQ(slanted.I, straight.I);
}

TEST(Scattering, OfUncorrelatedDisksIsThatOfEachOfThem) {
  // The first state is compared with the closed form for its positions. The mean of all 30 states is compared with rho
  // <f^2> (rho: number density, f: form factor of a disk). In the bins after the sixth, the states have about 1e4
  // independent speckles together, so the mean has an error of 1 %.
  constexpr int kStates = 30, kGrains = 60;
  const Packing<2> first = uncorrelated(kGrains, 14.0, 0);
  const ScatteringMesh mesh = scattering_mesh(first, {});
  ScatteringAverage average(mesh.edges);
  for (unsigned seed = 0; seed < kStates; ++seed) {
    const Packing<2> packing = uncorrelated(kGrains, 14.0, seed);
    ScatteringAverage alone(mesh.edges);
    const CoverageMap map = coverage_map(packing, mesh.size(packing.cell));
    average.add(packing.cell, map);
    if (seed > 0) continue;
    alone.add(packing.cell, map);
    const Scattering found = alone.result();
    const Exact expected = exact(packing, mesh.edges);
    for (std::size_t b = 0; b < found.I.size(); ++b) EXPECT_NEAR(found.I[b] / expected.I[b], 1.0, 0.01) << b;
  }
  const Scattering mean = average.result();
  double ratio = 0.0, n = 0.0;
  for (std::size_t b = 6; b < mean.k.size(); ++b) {
    const double f2 =
        (std::pow(form_factor(mean.k[b], 0.5), 2) + 2.0 * std::pow(form_factor(mean.k[b], 0.25), 2)) / 3.0;
    const auto weight = static_cast<double>(mean.n_vectors[b]);
    ratio += weight * mean.I[b] / (kGrains / first.cell.volume() * f2);
    n += weight;
  }
  EXPECT_NEAR(ratio / n, 1.0, 3.0 / std::sqrt(n));
}

TEST(Scattering, MeshesAreNoLargerThanAllowed) {
  ScatteringOptions options;
  options.most_cells = 10000;
  const Packing<2> packing = uncorrelated(10, 100.0, 1);
  const ScatteringMesh mesh = scattering_mesh(packing, options);
  // The mesh may have a few more cells than allowed, for two reasons: the lattice vectors are longer than the width of
  // the cell, and mesh sizes are rounded up to products of small primes.
  EXPECT_LT(mesh.size(packing.cell).prod(), 1.3 * 10000);
  EXPECT_NEAR(mesh.edges.back(), kTwoPi / (8.0 * mesh.spacing), 1e-12);
}

/// Returns a random Gaussian field on a mesh. On average over many fields, the intensity I(k) follows the law of
/// fractal aggregates.
CoverageMap aggregate_field(int n, double side, double xi, double dF, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  CoverageMap field{{n, n}, std::vector<double>(static_cast<std::size_t>(n) * n)};
  std::vector<std::complex<double>> hat(static_cast<std::size_t>(n) * (n / 2 + 1));
  for (std::size_t k = 0; k < field.share.size(); ++k) field.share[k] = normal(engine);
  auto* const data = reinterpret_cast<fftw_complex*>(hat.data());
  fftw_plan there = fftw_plan_dft_r2c_2d(n, n, field.share.data(), data, FFTW_ESTIMATE);
  fftw_execute(there);
  fftw_destroy_plan(there);
  const auto kept = [n](int m) {
    return m == 0 ? 1.0 : std::sin(std::numbers::pi * m / n) * n / (std::numbers::pi * m);
  };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column <= n / 2; ++column) {
      const int m = row <= n / 2 ? row : row - n;
      const double k = kTwoPi * std::hypot(m, column) / side;
      // The Fourier transform of white noise has the mean square n^2. A mesh stores averages over its cells. The
      // averages reduce the amplitude of a wave by kept() for each direction.
      const double amplitude = std::sqrt(scattered_intensity(1.0, xi, dF, k)) * kept(m) * kept(column);
      hat[static_cast<std::size_t>(row) * (n / 2 + 1) + column] *= amplitude / (static_cast<double>(n) * n);
    }
  fftw_plan back = fftw_plan_dft_c2r_2d(n, n, data, field.share.data(), FFTW_ESTIMATE);
  fftw_execute(back);
  fftw_destroy_plan(back);
  return field;
}

TEST(Scattering, OfAFieldOfKnownDimensionAndLengthGivesThemBack) {
  constexpr double kSide = 200.0;
  for (const auto& [dF, xi] : {std::pair{1.5, 8.0}, std::pair{1.9, 12.0}, std::pair{1.2, 15.0}}) {
    Packing<2> frame;
    frame.cell.matrix = kSide * Mat<2>::Identity();
    frame.grains = Grains<2>::with_size(1);
    frame.grains.radius[0] = 0.5;
    ScatteringOptions options;
    options.cells_per_wave = 4.0;
    options.largest = 1.0;
    const ScatteringMesh mesh = scattering_mesh(frame, options);
    ScatteringAverage average(mesh.edges);
    for (const unsigned seed : {1u, 2u})
      average.add(frame.cell, aggregate_field(mesh.size(frame.cell)[0], kSide, xi, dF, seed));
    const Scattering found = average.result();
    std::vector<ScatteredPoint> points;
    for (std::size_t b = 0; b < found.k.size(); ++b)
      points.push_back({found.k[b], found.I[b], found.n_vectors[b]});
    const ScatteringFit fit = fit_scattering(points, 0.0, 0.5 * kTwoPi);
    ASSERT_TRUE(fit.found()) << fit.failure_reason;
    EXPECT_NEAR(*fit.parameters[1].value, xi, 0.1 * xi);
    EXPECT_NEAR(*fit.parameters[2].value, dF, 0.05);
    EXPECT_LE(*fit.parameters[1].low95, xi);
    EXPECT_GE(*fit.parameters[1].high95, xi);
  }
}

}  // namespace
}  // namespace floc::test
