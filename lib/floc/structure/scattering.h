#pragma once

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/structure/coverage.h"

namespace floc {

inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Intensity I(k) = |chi_hat(k)|^2/V of the indicator chi of the grains (docs/physics.md, "Structure"), V the
/// volume of the cell, averaged over directions in bins of k.
struct Scattering {
  std::vector<double> k;  ///< mean wave number of each bin (1/length)
  std::vector<double> I;  ///< mean intensity of each bin (length^Dim)
  /// Independent wave vectors in each bin, k and -k counted once; the intensities of single ones scatter by 100
  /// %.
  std::vector<std::int64_t> n_vectors;
};

/// Numerical settings of a scattering intensity.
struct ScatteringOptions {
  /// Largest k, in 2 pi over the largest diameter: form factor and contacts show beyond 1, aggregates below.
  double largest = 2.0;
  /// Mesh cells per wavelength of the largest k. The mesh holds averages over its cells; the result is
  /// corrected for that. Aliasing from shorter waves is below 1 % of I with 8 cells, and falls as k^5 towards
  /// smaller k.
  double cells_per_wave = 8.0;
  /// Bins are this much wider than the one before, and no narrower than 2 pi/V^(1/Dim).
  double bin_growth = 1.05;
  /// For spheres, bins with more wave vectors than this are sampled instead of summed over. The relative error
  /// of I is 1/sqrt(n), 6 %, no more than that of bins of small k.
  int most_vectors = 300;
  /// Most wave vectors to sample from, in all; beyond it the largest k is lowered.
  std::int64_t most_waves = std::int64_t{1} << 24;
  /// Most cells of a mesh; beyond it the largest k is lowered.
  std::int64_t most_cells = std::int64_t{1} << 26;

  static constexpr NumberRange kLargest{.least = 0.0, .most = 1e6, .without_least = true};
  static constexpr NumberRange kCellsPerWave{.least = 4.0, .most = 1000.0};
  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Returns the edges of bins of k (1/length). The first edge is `unit`/2, with `unit` the smallest k of the
/// cell; each other one is `growth` times the edge before it, but at least `unit` above it.
std::vector<double> scattering_bins(double largest, double unit, double growth);

/// Bins of k and the mesh that resolves them.
struct ScatteringMesh {
  std::vector<double> edges;  ///< edges of the bins, ascending (1/length)
  double spacing = 0.0;       ///< largest spacing of the mesh (length)

  /// Mesh cells along each lattice vector of a cell, products of 2, 3, 5 and 7.
  Vec<2, int> size(const Cell<2>& cell) const;
};

/// Returns the grains of a packing in the shortest cell of its lattice. Scattering depends on the lattice
/// alone, and a cell so slanted that its sides are nearly parallel would take a mesh as long as its sides.
/// Cells of short vectors are left as they are.
Packing<2> in_shortest_cell(const Packing<2>& packing);

/// Chooses the bins and the mesh, which depend on the area and the largest diameter only.
/// @pre the packing has grains   @throws InputError with the faults of the options
ScatteringMesh scattering_mesh(const Packing<2>& packing, const ScatteringOptions& options);

/// Returns the edges of the bins of k of a packing of spheres, ascending (1/length), as in ScatteringMesh.
/// @pre the packing has grains   @throws InputError with the faults of the options
std::vector<double> scattering_edges(const Packing<3>& packing, const ScatteringOptions& options);

/// I(k) averaged over wave vectors and states. All states have the same bins.
class ScatteringAverage {
 public:
  /// @param edges  of the bins of k, ascending (1/length)
  explicit ScatteringAverage(std::vector<double> edges);

  /// Adds a field given by its averages over mesh cells.
  void add(const Cell<2>& cell, const CoverageMap& field);
  /// Adds a packing of spheres by the sum of their transforms, without a mesh: overlaps count twice.
  /// @param most_vectors  per bin, >= 1; drawn by a fixed seed where there are more
  void add(const Packing<3>& packing, int most_vectors);

  /// Returns the average. Bins without any wave vector are left out.
  Scattering result() const;

 private:
  void add_vector(double k, double intensity, std::int64_t weight);

  std::vector<double> edges_;
  std::vector<double> sum_k_, sum_I_;
  std::vector<std::int64_t> n_;
};

/// Return I(k) of one packing.
Scattering scattering(const Packing<2>& packing, const ScatteringOptions& options = {});
Scattering scattering(const Packing<3>& packing, const ScatteringOptions& options = {});

/// Returns the Fourier transform of a ball at k > 0: 4 pi (sin kR - kR cos kR)/k^3 (volume).
double ball_transform(double k, double R);

}  // namespace floc
