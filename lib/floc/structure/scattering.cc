#include "floc/structure/scattering.h"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "floc/geometry/lattice_reduction.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Returns the smallest number >= n of the form 2^a 3^b 5^c 7^d. For meshes of this size, Fourier transforms are fast.
int smooth_size(int n) {
  for (;; ++n) {
    int rest = n;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

/// Returns the Fourier coefficients sum_x f(x) exp(-i k x) of a real field f on a mesh. The second index runs
/// from 0 to size[1]/2.
std::vector<std::complex<double>> transform(const CoverageMap& field) {
  std::vector<std::complex<double>> out(static_cast<std::size_t>(field.size[0]) * (field.size[1] / 2 + 1));
  // With FFTW_PRESERVE_INPUT, FFTW does not change its input, so the const_cast is safe.
  fftw_plan plan =
      fftw_plan_dft_r2c_2d(field.size[0], field.size[1], const_cast<double*>(field.share.data()),
                           reinterpret_cast<fftw_complex*>(out.data()), FFTW_ESTIMATE | FFTW_PRESERVE_INPUT);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  return out;
}

/// Returns the factor sin(x)/x, x = pi n/size, by which averaging over mesh cells reduces the amplitude of a wave with
/// n periods in the cell.
double kept_by_averaging(int n, int size) {
  const double x = std::numbers::pi * n / size;
  return n == 0 ? 1.0 : std::sin(x) / x;
}

}  // namespace

std::vector<std::string> ScatteringOptions::validate() const {
  std::vector<std::string> faults = {
      range_fault("largest_k", largest, kLargest),
      range_fault("cells_per_wave", cells_per_wave, kCellsPerWave),
      range_fault("bin_growth", bin_growth, {.least = 1.0, .most = 1000.0, .without_least = true}),
      range_fault("most_vectors", most_vectors, kPositiveWhole),
      range_fault("most_waves", most_waves, kPositiveWhole),
      range_fault("most_cells", most_cells, kPositiveWhole)};
  std::erase(faults, "");
  return faults;
}

std::vector<double> scattering_bins(double largest, double unit, double growth) {
  std::vector<double> edges = {0.5 * unit};
  while (edges.back() < largest) edges.push_back(std::max(edges.back() + unit, edges.back() * growth));
  // If the first edge (half the smallest wave number of the cell) is not below the largest k, there is a single bin.
  if (edges.size() == 1) edges.push_back(edges[0] * growth);
  edges.back() = std::max(largest, edges[0] * growth);
  return edges;
}

Vec<2, int> ScatteringMesh::size(const Cell<2>& cell) const {
  Vec<2, int> n;
  for (int a = 0; a < 2; ++a)
    n[a] = smooth_size(static_cast<int>(std::ceil(cell.matrix.row(a).norm() / spacing)));
  return n;
}

Packing<2> in_shortest_cell(const Packing<2>& packing) {
  Packing<2> shortest;
  shortest.grains = packing.grains;
  shortest.cell.matrix = reduced_lattice(packing.cell).cell.matrix;
  return shortest;
}

ScatteringMesh scattering_mesh(const Packing<2>& packing, const ScatteringOptions& options) {
  assert(packing.grains.size() > 0);
  refuse_faults(options.validate());
  const double a = largest_diameter(packing.grains);
  const double area = packing.cell.volume();
  ScatteringMesh mesh;
  mesh.spacing = std::max(a / (options.largest * options.cells_per_wave),
                          std::sqrt(area / static_cast<double>(options.most_cells)));
  const double largest = kTwoPi / (mesh.spacing * options.cells_per_wave);
  mesh.edges = scattering_bins(largest, kTwoPi / std::sqrt(area), options.bin_growth);
  return mesh;
}

ScatteringAverage::ScatteringAverage(std::vector<double> edges)
    : edges_(std::move(edges)),
      sum_k_(edges_.size() - 1, 0.0),
      sum_I_(edges_.size() - 1, 0.0),
      n_(edges_.size() - 1, 0) {
  assert(edges_.size() >= 2);
}

void ScatteringAverage::add_vector(double k, double intensity, std::int64_t weight) {
  const auto above = std::upper_bound(edges_.begin(), edges_.end(), k);
  if (above == edges_.begin() || above == edges_.end()) return;
  const auto bin = static_cast<std::size_t>(above - edges_.begin()) - 1;
  sum_k_[bin] += static_cast<double>(weight) * k;
  sum_I_[bin] += static_cast<double>(weight) * intensity;
  n_[bin] += weight;
}

void ScatteringAverage::add(const Cell<2>& cell, const CoverageMap& field) {
  const std::vector<std::complex<double>> hat = transform(field);
  const Mat<2> reciprocal = kTwoPi * cell.matrix.inverse();  // wave vectors are k = reciprocal * (n1, n2)
  const double area = cell.volume();
  const double per_cell = area / (static_cast<double>(field.size[0]) * field.size[1]);
  const int n_columns = field.size[1] / 2 + 1;
  for (int row = 0; row < field.size[0]; ++row) {
    const int n1 = row <= field.size[0] / 2 ? row : row - field.size[0];
    const double kept1 = kept_by_averaging(n1, field.size[0]);
    for (int n2 = 0; n2 < n_columns; ++n2) {
      const double k = (reciprocal * Vec<2>(n1, n2)).norm();
      if (k < edges_.front() || k >= edges_.back()) continue;
      const double kept = kept1 * kept_by_averaging(n2, field.size[1]);
      const std::complex<double> chi = hat[static_cast<std::size_t>(row) * n_columns + n2];
      // For n2 = 0, the transform contains both k and -k. For other n2, it contains only one vector of this pair, which
      // therefore counts twice.
      add_vector(k, per_cell * per_cell * std::norm(chi) / (kept * kept * area), n2 == 0 ? 1 : 2);
    }
  }
}

Scattering ScatteringAverage::result() const {
  Scattering out;
  for (std::size_t bin = 0; bin < n_.size(); ++bin) {
    if (n_[bin] == 0) continue;
    out.k.push_back(sum_k_[bin] / static_cast<double>(n_[bin]));
    out.I.push_back(sum_I_[bin] / static_cast<double>(n_[bin]));
    out.n_vectors.push_back((n_[bin] + 1) / 2);
  }
  return out;
}

Scattering scattering(const Packing<2>& packing, const ScatteringOptions& options) {
  const ScatteringMesh mesh = scattering_mesh(packing, options);
  ScatteringAverage average(mesh.edges);
  const Packing<2> shortest = in_shortest_cell(packing);
  average.add(shortest.cell, coverage_map(shortest, mesh.size(shortest.cell)));
  return average.result();
}

}  // namespace floc
