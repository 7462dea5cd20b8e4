#include "floc/neighbors/space_order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace floc {
namespace {

constexpr int kBitsPerAxis = 16;

/// Interleaves the bits of the coordinates.
template <int Dim>
std::uint64_t morton(const Vec<Dim>& s) {
  std::uint64_t code = 0;
  for (int a = 0; a < Dim; ++a) {
    const double inside = s[a] - std::floor(s[a]);
    const auto q = static_cast<std::uint64_t>(inside * (1 << kBitsPerAxis));
    for (int bit = 0; bit < kBitsPerAxis; ++bit) code |= ((q >> bit) & 1u) << (bit * Dim + a);
  }
  return code;
}

}  // namespace

template <int Dim>
std::vector<int> space_order(const Cell<Dim>& cell, const Grains<Dim>& grains) {
  const Mat<Dim> to_reduced = cell.matrix.transpose().inverse();
  std::vector<std::uint64_t> code(grains.size());
  for (int i = 0; i < grains.size(); ++i) code[i] = morton<Dim>(to_reduced * grains.position[i]);
  std::vector<int> order(grains.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) { return code[p] < code[q]; });
  return order;
}

template std::vector<int> space_order(const Cell<2>&, const Grains<2>&);
template std::vector<int> space_order(const Cell<3>&, const Grains<3>&);

}  // namespace floc
