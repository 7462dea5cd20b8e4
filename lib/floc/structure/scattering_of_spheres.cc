#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "floc/base/interruption.h"
#include "floc/base/random.h"
#include "floc/geometry/lattice_reduction.h"
#include "floc/packing/grain_sizes.h"
#include "floc/structure/scattering.h"

namespace floc {
namespace {

/// Seed and stream number of the random choice of wave vectors. All states use the same choice.
constexpr std::uint64_t kSeed = 1, kPurpose = 0x1e;

using Wave = Vec<3, int>;

/// Returns true if the first nonzero component of n is positive. This is true for exactly one of n and -n.
bool in_half_space(const Wave& n) {
  return n[0] > 0 || (n[0] == 0 && (n[1] > 0 || (n[1] == 0 && n[2] > 0)));
}

/// Returns the integer vectors n of all wave vectors k = 2 pi M^-1 n, sorted into bins of the wave number. The rows of
/// M are the lattice vectors. Of n and -n, only one is returned.
std::vector<std::vector<Wave>> waves_in(const std::vector<double>& edges, const Cell<3>& cell) {
  const Mat<3> reciprocal = kTwoPi * cell.matrix.inverse();
  // Largest value of each component of an integer vector n. The component for the lattice vector a is (k . a)/(2 pi).
  Wave reach;
  for (int a = 0; a < 3; ++a) reach[a] = static_cast<int>(edges.back() * cell.matrix.row(a).norm() / kTwoPi);
  std::vector<std::vector<Wave>> bins(edges.size() - 1);
  for (int n1 = 0; n1 <= reach[0]; ++n1)
    for (int n2 = -reach[1]; n2 <= reach[1]; ++n2)
      for (int n3 = -reach[2]; n3 <= reach[2]; ++n3) {
        const Wave n(n1, n2, n3);
        if (!in_half_space(n)) continue;
        const auto above = std::upper_bound(edges.begin(), edges.end(), (reciprocal * n.cast<double>()).norm());
        if (above == edges.begin() || above == edges.end()) continue;
        bins[static_cast<std::size_t>(above - edges.begin()) - 1].push_back(n);
      }
  return bins;
}

/// If there are more than `most` waves, replaces them by a random sample of `most` waves.
void draw(std::size_t most, RandomStream& random, std::vector<Wave>& waves) {
  if (waves.size() <= most) return;
  for (std::size_t k = 0; k < most; ++k) std::swap(waves[k], waves[k + random.below(waves.size() - k)]);
  waves.resize(most);
}

/// Positions of grains in reduced coordinates, and their radii.
struct Scatterers {
  std::vector<Vec<3>> place;
  std::vector<double> radius;
};

std::complex<double> amplitude(const Scatterers& grains, const Wave& n, double k) {
  std::complex<double> sum = 0.0;
  double radius = 0.0, transform = 0.0;
  for (std::size_t i = 0; i < grains.place.size(); ++i) {
    if (grains.radius[i] != radius) radius = grains.radius[i], transform = ball_transform(k, radius);
    // `transform` is not passed to std::polar as the magnitude, because `transform` may be negative.
    sum += transform * std::polar(1.0, -kTwoPi * n.cast<double>().dot(grains.place[i]));
  }
  return sum;
}

}  // namespace

double ball_transform(double k, double R) {
  const double x = k * R;
  // Below this value of kR a series is used, because the difference sin kR - kR cos kR loses digits there.
  constexpr double kSmall = 0.02;
  const double over_volume = x < kSmall ? 1.0 - x * x / 10.0 + x * x * x * x / 280.0
                                        : 3.0 * (std::sin(x) - x * std::cos(x)) / (x * x * x);
  return 4.0 / 3.0 * std::numbers::pi * R * R * R * over_volume;
}

std::vector<double> scattering_edges(const Packing<3>& packing, const ScatteringOptions& options) {
  assert(packing.grains.size() > 0);
  refuse_faults(options.validate());
  const double volume = packing.cell.volume();
  // In a cell of volume V, there are V k^3/(12 pi^2) pairs of opposite wave vectors up to the wave number k.
  const double affordable = std::cbrt(3.0 * kTwoPi * kTwoPi * static_cast<double>(options.most_waves) / volume);
  return scattering_bins(std::min(options.largest * kTwoPi / largest_diameter(packing.grains), affordable),
                         kTwoPi / std::cbrt(volume), options.bin_growth);
}

void ScatteringAverage::add(const Packing<3>& packing, int most_vectors) {
  assert(most_vectors >= 1);
  const Cell<3> cell = reduced_lattice(packing.cell).cell;
  const Mat<3> reciprocal = kTwoPi * cell.matrix.inverse();
  const double volume = cell.volume();
  Scatterers grains{{}, packing.grains.radius};
  for (const Vec<3>& x : packing.grains.position) grains.place.push_back(cell.reduced(x));
  RandomStream random(kSeed, kPurpose);
  for (std::vector<Wave>& waves : waves_in(edges_, cell)) {
    draw(static_cast<std::size_t>(most_vectors), random, waves);
    for (const Wave& n : waves) {
      check_interruption();
      const double k = (reciprocal * n.cast<double>()).norm();
      add_vector(k, std::norm(amplitude(grains, n, k)) / volume, 2);
    }
  }
}

Scattering scattering(const Packing<3>& packing, const ScatteringOptions& options) {
  ScatteringAverage average(scattering_edges(packing, options));
  average.add(packing, options.most_vectors);
  return average.result();
}

}  // namespace floc
