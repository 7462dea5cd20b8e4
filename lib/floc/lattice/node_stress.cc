#include "floc/lattice/node_stress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace floc {
namespace {

/// Smallest number of values above the threshold for which an exponential tail is fitted.
constexpr int kFewest = 10;

StressTail tail_beyond(const std::vector<double>& x, double from) {
  StressTail tail{from};
  double beyond = 0.0;
  for (const double value : x)
    if (value > from) ++tail.n, beyond += value - from;
  if (tail.n < kFewest || beyond <= 0.0) return tail;
  tail.beta = tail.n / beyond;
  tail.error = *tail.beta / std::sqrt(tail.n);
  return tail;
}

}  // namespace

template <int Dim>
std::vector<Mat<Dim>> node_stress(const Lattice<Dim>& lattice, const LatticeNetwork<Dim>& network,
                                  const LatticeSolution<Dim>& solution) {
  std::vector<Mat<Dim>> sum(lattice.node.size(), Mat<Dim>::Zero());
  for (int e = 0; e < static_cast<int>(network.elements.size()); ++e) {
    const LatticeElement<Dim>& element = network.elements[e];
    const Vec<Dim> on_i = solution.force_on_i(network, e);
    sum[element.i] -= element.arm_i * on_i.transpose();
    sum[element.j] += (element.arm_i - element.branch) * on_i.transpose();
  }
  for (std::size_t k = 0; k < sum.size(); ++k) {
    const Mat<Dim> stress = sum[k] / lattice.volume[k];
    sum[k] = 0.5 * (stress + stress.transpose());
  }
  return sum;
}

StressDistribution stress_distribution(const std::vector<double>& values, double sign, double least) {
  StressDistribution out;
  out.n = static_cast<int>(values.size());
  if (values.empty()) return out;
  double squares = 0.0;
  for (const double value : values) out.mean += value, squares += value * value;
  out.mean /= out.n;
  // The sign of a rounding error is random. If rounding errors were counted by their sign, the statistics would depend
  // on the size of the load, and the means of the signs would be too small.
  out.least = std::max(least, kRoundingShare * std::sqrt(squares / out.n));
  const auto has_sign = [&out](double of_value) { return of_value > 0.0 && of_value >= out.least; };
  // Before a tail is fitted, the values of each sign are divided by the mean of the values of this sign
  // (docs/physics.md, "Cemented grains"). The two signs are therefore summed and counted separately.
  double loaded = 0.0, other = 0.0;
  int n_loaded = 0, n_other = 0;
  for (const double value : values) {
    if (has_sign(sign * value)) ++n_loaded, loaded += value;
    if (has_sign(-sign * value)) ++n_other, other -= value;
  }
  out.spread = out.mean != 0.0 && std::abs(out.mean) >= out.least
                   ? std::sqrt(std::max(0.0, squares / out.n / (out.mean * out.mean) - 1.0))
                   : std::numeric_limits<double>::quiet_NaN();
  out.other_share = static_cast<double>(n_other) / out.n;
  if (n_loaded == 0) return out;
  out.unit = loaded / n_loaded;
  std::vector<double> x, minus;
  for (const double value : values) {
    if (has_sign(sign * value)) x.push_back(value / out.unit);
    if (has_sign(-sign * value)) minus.push_back(-value * n_other / other);
  }
  out.largest = *std::max_element(x.begin(), x.end());
  out.loaded_1 = tail_beyond(x, 1.0);
  out.loaded_2 = tail_beyond(x, 2.0);
  out.other_1 = tail_beyond(minus, 1.0);
  return out;
}

template std::vector<Mat<2>> node_stress(const Lattice<2>&, const LatticeNetwork<2>&,
                                         const LatticeSolution<2>&);
template std::vector<Mat<3>> node_stress(const Lattice<3>&, const LatticeNetwork<3>&,
                                         const LatticeSolution<3>&);

}  // namespace floc
