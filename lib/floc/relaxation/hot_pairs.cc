#include "floc/relaxation/hot_pairs.h"

#include <algorithm>
#include <numeric>
#include <variant>

namespace floc {

template <int Dim>
HotPairs<Dim>::HotPairs(const std::vector<NeighborPair<Dim>>& pairs, const std::vector<double>& radius,
                        const std::vector<double>& mass, const AnyContactLaw& any_law, double time_step) {
  const int n_grains = static_cast<int>(radius.size());
  first_of_i_.assign(n_grains, 0);
  end_of_i_.assign(n_grains, 0);
  std::visit(
      [&]<class Law>(const Law& law) {
        row_bytes_ = static_cast<int>(sizeof(double)) * row_size(Law::kHasFriction);
        std::size_t next = 0;
        for (int i = 0; i < n_grains; ++i) {
          if (i % kGrainBlock == 0) pad_block();
          if (const int filled = size() % kPairPadding; filled != 0 && i - i_[size() - filled] >= kWindow)
            fill_pack();
          first_of_i_[i] = size();
          for (; next < pairs.size() && pairs[next].i == i; ++next) {
            const int j = pairs[next].j;
            add(pairs[next], radius[i], radius[j],
                lagging_damping(law.damping_coefficient(mass[i], mass[j]), mass[i], mass[j], time_step));
          }
          end_of_i_[i] = size();
        }
        pad_block();
        if constexpr (Law::kHasFriction) shear.assign(size(), 0.0);
        if constexpr (Law::kHasRolling) roll.assign(size(), 0.0);
        row_.assign(static_cast<std::size_t>(row_size(Law::kHasFriction)) * (size() + 1), 0.0);
      },
      any_law);
  plan_sums(n_grains);
}

template <int Dim>
void HotPairs<Dim>::add(const NeighborPair<Dim>& key, double radius_i, double radius_j, double damping) {
  i_.push_back(key.i);
  j_.push_back(key.j);
  for (int a = 0; a < Dim; ++a) image_[a].push_back(key.image[a]);
  radii_.push_back(radius_i + radius_j);
  share_i_.push_back(radius_i / (radius_i + radius_j));
  damping_.push_back(damping);
}

/// Completes the pack that was begun, if any.
template <int Dim>
void HotPairs<Dim>::fill_pack() {
  while (size() % kPairPadding != 0) {
    const int grain = i_.back();
    i_.push_back(grain);
    j_.push_back(grain);
    for (int a = 0; a < Dim; ++a) image_[a].push_back(1.0);
    for (Component* component : {&radii_, &share_i_, &damping_}) component->push_back(0.0);
  }
}

/// Ends a block, if one was begun, and begins the next.
template <int Dim>
void HotPairs<Dim>::pad_block() {
  fill_pack();
  first_of_block_.push_back(size());
}

template <int Dim>
NeighborPair<Dim> HotPairs<Dim>::key(int p) const {
  NeighborPair<Dim> key{i(p), j(p), {}};
  for (int a = 0; a < Dim; ++a) key.image[a] = static_cast<int>(image_[a][p]);
  return key;
}

template <int Dim>
int HotPairs<Dim>::find(const NeighborPair<Dim>& wanted) const {
  for (int p = first_of_i_[wanted.i]; p < end_of_i_[wanted.i]; ++p)
    if (key(p) == wanted) return p;
  return -1;
}

template <int Dim>
void HotPairs<Dim>::inherit(const HotPairs& old) {
  for (std::size_t i = 0; i < old.first_of_i_.size(); ++i) {
    int q = old.first_of_i_[i];
    for (int p = first_of_i_[i]; p < end_of_i_[i]; ++p) {
      while (q < old.end_of_i_[i] && before(old.key(q), key(p))) ++q;
      if (q == old.end_of_i_[i]) break;
      if (!(old.key(q) == key(p))) continue;
      if (!shear.empty()) shear[p] = old.shear[q];
      if (!roll.empty()) roll[p] = old.roll[q];
    }
  }
}

template <int Dim>
PairArrays<Dim> HotPairs<Dim>::arrays() {
  PairArrays<Dim> out;
  out.i = i_.data();
  out.j = j_.data();
  for (int a = 0; a < Dim; ++a) out.image[a] = image_[a].data();
  out.radii = radii_.data();
  out.share_i = share_i_.data();
  out.damping = damping_.data();
  out.shear = shear.data();
  out.roll = roll.data();
  out.row = row_.data();
  return out;
}

/// Lists for each grain the rows it sums, in the order of the pairs.
template <int Dim>
void HotPairs<Dim>::plan_sums(int n_grains) {
  std::vector<int> first_row(n_grains + 1, 0);
  for (int p = 0; p < size(); ++p) {
    if (padding(p)) continue;
    ++first_row[i(p) + 1];
    ++first_row[j(p) + 1];
  }
  std::partial_sum(first_row.begin(), first_row.end(), first_row.begin());
  std::vector<int> rows(first_row.back());
  std::vector<int> next(first_row.begin(), first_row.end() - 1);
  for (int p = 0; p < size(); ++p) {
    if (padding(p)) continue;
    rows[next[i(p)]++] = row_bytes_ * p;
    rows[next[j(p)]++] = row_bytes_ * p + kSideOfRow;
  }

  const int n_blocks = (n_grains + kGrainBlock - 1) / kGrainBlock;
  plans_.resize(n_blocks);
  int n_entries = 0;
  for (int b = 0; b < n_blocks; ++b) n_entries += plan_block(b, n_grains, first_row);
  entries_.assign(n_entries, row_bytes_ * size());  // the row that stays zero
  int* entry = entries_.data();
  for (int b = 0; b < n_blocks; ++b) {
    for (int g = 0; g < kGrainBlock / kSumGroup; ++g) {
      plans_[b].entry[g] = entry;
      for (int l = 0; l < kSumGroup; ++l) {
        const int k = b * kGrainBlock + plans_[b].grain[g * kSumGroup + l];
        if (k >= n_grains) continue;
        for (int d = 0; d < first_row[k + 1] - first_row[k]; ++d)
          entry[d * kSumGroup + l] = rows[first_row[k] + d];
      }
      entry += plans_[b].depth[g] * kSumGroup;
    }
  }
  plan_crossings();
}

/// Sorts the grains of a block by falling number of rows. @return the number of entries its groups take
template <int Dim>
int HotPairs<Dim>::plan_block(int block, int n_grains, const std::vector<int>& first_row) {
  BlockSumsPlan& plan = plans_[block];
  const auto n_rows = [&](int grain) {
    const int k = block * kGrainBlock + grain;
    return k < n_grains ? first_row[k + 1] - first_row[k] : 0;
  };
  std::iota(std::begin(plan.grain), std::end(plan.grain), 0);
  std::stable_sort(std::begin(plan.grain), std::end(plan.grain),
                   [&](int p, int q) { return n_rows(p) > n_rows(q); });
  int n_entries = 0;
  for (int g = 0; g < kGrainBlock / kSumGroup; ++g) {
    plan.depth[g] = n_rows(plan.grain[g * kSumGroup]);
    n_entries += plan.depth[g] * kSumGroup;
  }
  return n_entries;
}

template <int Dim>
void HotPairs<Dim>::plan_crossings() {
  const int n_blocks = static_cast<int>(plans_.size());
  std::vector<std::size_t> first(n_blocks);
  for (int b = 0; b < n_blocks; ++b) {
    first[b] = crossing_.size();
    for (int p = first_of_block(b); p < first_of_block(b + 1); ++p)
      if (!padding(p) && !key(p).image.isZero()) crossing_.push_back(p);
    plans_[b].n_crossing = static_cast<int>(crossing_.size() - first[b]);
  }
  for (int b = 0; b < n_blocks; ++b) plans_[b].crossing = crossing_.data() + first[b];
}

template class HotPairs<2>;

}  // namespace floc
