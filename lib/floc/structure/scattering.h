#pragma once

#include <cstdint>
#include <vector>

#include "floc/structure/coverage.h"

namespace floc {

/// Intensity I(k) = |chi_hat(k)|^2/A of the indicator chi of the grains (2D; docs/physics.md, "Structure"),
/// averaged over directions in bins of k.
struct Scattering {
  std::vector<double> k;                ///< mean over the wave vectors of each bin (1/length)
  std::vector<double> I;                ///< (area)
  std::vector<std::int64_t> n_vectors;  ///< independent ones, k and -k counted once; their I scatter by 100 %
};

/// Numerical settings of a scattering intensity.
struct ScatteringOptions {
  /// Largest k, in 2 pi over the largest diameter: form factor and contacts show beyond 1, aggregates below.
  double largest = 2.0;
  /// Mesh cells for each wave length of the largest k. The mesh holds averages over its cells, which is undone;
  /// what folds back from shorter waves is below 1 % of I at 8, and smaller by the power 5 of k below.
  double cells_per_wave = 8.0;
  /// Bins are this much wider than the one before, and no narrower than 2 pi/sqrt(A).
  double bin_growth = 1.05;
  /// Larger meshes are not made: the largest k is lowered.
  std::int64_t most_cells = std::int64_t{1} << 26;
};

/// Bins of k and the mesh that resolves them.
struct ScatteringMesh {
  std::vector<double> edges;  ///< of the bins, ascending (1/length)
  double spacing = 0.0;       ///< of the mesh, at most (length)

  /// Mesh cells along each lattice vector of a cell, products of 2, 3, 5 and 7.
  Vec<2, int> size(const Cell<2>& cell) const;
};

/// The grains of a packing in the shortest cell of its lattice: the lattice is what scatters, and a cell so
/// slanted that its sides are nearly parallel would take a mesh as long as they are. Cells of short vectors are
/// left as they are.
Packing<2> in_shortest_cell(const Packing<2>& packing);

/// Depends on area and largest diameter only.
/// @pre the packing has grains
ScatteringMesh scattering_mesh(const Packing<2>& packing, const ScatteringOptions& options);

/// I(k) averaged over states too. All states are binned alike.
class ScatteringAverage {
 public:
  /// @param edges  of the bins of k, ascending (1/length)
  explicit ScatteringAverage(std::vector<double> edges);

  /// Adds a field given by its averages over mesh cells.
  void add(const Cell<2>& cell, const CoverageMap& field);

  /// Bins without any wave vector are left out.
  Scattering result() const;

 private:
  void add_vector(double k, double intensity, std::int64_t weight);

  std::vector<double> edges_;
  std::vector<double> sum_k_, sum_I_;
  std::vector<std::int64_t> n_;
};

/// I(k) of one packing.
Scattering scattering(const Packing<2>& packing, const ScatteringOptions& options = {});

}  // namespace floc
