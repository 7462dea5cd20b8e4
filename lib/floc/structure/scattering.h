#pragma once

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/structure/coverage.h"

namespace floc {

inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Scattering intensity I(k) = |chi_hat(k)|^2/V, averaged over directions, in bins of the wave number k
/// (docs/physics.md, "Structure"). Here, chi_hat is the Fourier transform of a function that is 1 inside grains and 0
/// outside, and V is the volume of the cell.
struct Scattering {
  std::vector<double> k;  ///< mean wave number of each bin (1/length)
  std::vector<double> I;  ///< mean intensity of each bin (length^Dim)
  /// Number of independent wave vectors in each bin; k and -k count once. The intensity at a single wave vector has a
  /// relative standard deviation of 100 %.
  std::vector<std::int64_t> n_vectors;
};

/// Numerical settings for the computation of a scattering intensity.
struct ScatteringOptions {
  /// Largest wave number k, in units of 2 pi divided by the largest diameter. In this unit, intensities at k > 1 show
  /// the shapes and contacts of grains, and intensities at k < 1 show aggregates.
  double largest = 2.0;
  /// For disks: number of mesh cells per wavelength of the largest k. The value of each mesh cell is an average over
  /// its area, and the intensity is corrected for this averaging. With 8 mesh cells per wavelength, the error due to
  /// shorter waves (aliasing) is below 1 % of the intensity, and decreases as k^5 towards small k.
  double cells_per_wave = 8.0;
  /// Upper edge of a bin of k, divided by the lower edge. The width of a bin is at least 2 pi/V^(1/Dim), where V is the
  /// volume of the cell.
  double bin_growth = 1.05;
  /// For spheres: largest number of wave vectors in the average of a bin. From a bin with more wave vectors, a random
  /// sample of this size is taken. The relative error of the intensity is then 1/sqrt(most_vectors), which is 6 % for
  /// 300 wave vectors. In bins of small k with fewer wave vectors, the error is larger.
  int most_vectors = 300;
  /// For spheres: largest number of wave vectors in all bins together, before samples are taken. If the number would be
  /// larger, the largest k is lowered.
  std::int64_t most_waves = std::int64_t{1} << 24;
  /// For disks: largest number of mesh cells. If the number would be larger, the largest k is lowered.
  std::int64_t most_cells = std::int64_t{1} << 26;

  static constexpr NumberRange kLargest{.least = 0.0, .most = 1e6, .without_least = true};
  static constexpr NumberRange kCellsPerWave{.least = 4.0, .most = 1000.0};
  /// Returns the faults of the options, each as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Returns the edges of the bins of the wave number k (1/length), from `unit`/2 to `largest`. Each edge is `growth`
/// times the previous edge, but at least `unit` larger.
/// @param unit  smallest wave number of the cell (1/length)
std::vector<double> scattering_bins(double largest, double unit, double growth);

/// Bins of the wave number k, and the mesh that resolves the largest k.
struct ScatteringMesh {
  std::vector<double> edges;  ///< edges of the bins of the wave number, ascending (1/length)
  double spacing = 0.0;       ///< largest side of a mesh cell (length)

  /// Returns the number of mesh cells along each lattice vector of a cell. Each number has no prime factors other than
  /// 2, 3, 5 and 7.
  Vec<2, int> size(const Cell<2>& cell) const;
};

/// Returns the grains of a packing in another cell of the same lattice: the cell with the shortest sides. The
/// scattering intensity is the same for all cells of a lattice, but a very slanted cell would need a large mesh along
/// its long sides. A cell that already has the shortest sides is left unchanged.
Packing<2> in_shortest_cell(const Packing<2>& packing);

/// Chooses the bins of the wave number and the mesh for a packing of disks. Both depend only on the options, the area
/// of the cell and the largest diameter.
/// @pre the packing has grains
/// @throws InputError with the faults of the options if they are not valid
ScatteringMesh scattering_mesh(const Packing<2>& packing, const ScatteringOptions& options);

/// Returns the edges of the bins of the wave number for a packing of spheres, ascending (1/length).
/// @pre the packing has grains
/// @throws InputError with the faults of the options if they are not valid
std::vector<double> scattering_edges(const Packing<3>& packing, const ScatteringOptions& options);

/// Scattering intensity I(k), averaged over wave vectors and states. All states have the same bins.
class ScatteringAverage {
 public:
  /// @param edges  edges of the bins of the wave number k, ascending (1/length)
  explicit ScatteringAverage(std::vector<double> edges);

  /// Adds a field in a periodic cell, such as a map of the solid fraction.
  /// @param field  averages of the field over the mesh cells
  void add(const Cell<2>& cell, const CoverageMap& field);
  /// Adds a packing of spheres. The Fourier transform of the packing is the sum of the Fourier transforms of the
  /// spheres, without a mesh; overlaps count twice.
  /// @param most_vectors  largest number of wave vectors per bin, >= 1; a bin with more wave vectors is averaged over a
  /// random sample, with a fixed seed
  void add(const Packing<3>& packing, int most_vectors);

  /// Returns the average intensity. Bins without wave vectors are left out.
  Scattering result() const;

 private:
  void add_vector(double k, double intensity, std::int64_t weight);

  std::vector<double> edges_;
  std::vector<double> sum_k_, sum_I_;
  std::vector<std::int64_t> n_;
};

/// Returns the scattering intensity I(k) of one packing.
Scattering scattering(const Packing<2>& packing, const ScatteringOptions& options = {});
Scattering scattering(const Packing<3>& packing, const ScatteringOptions& options = {});

/// Returns the Fourier transform of a ball of radius R at the wave number k > 0: 4 pi (sin kR - kR cos kR)/k^3
/// (volume).
double ball_transform(double k, double R);

}  // namespace floc
