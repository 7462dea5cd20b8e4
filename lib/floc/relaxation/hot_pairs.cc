#include "floc/relaxation/hot_pairs.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <variant>

#include "floc/base/error.h"
#include "floc/packing/contact_order.h"

namespace floc {
namespace {

/// What a row costs that is summed alone, each addition waiting for the one before it, in rows of a group.
constexpr int kAlone = 3;

/// Depth to which a group of grains with falling numbers of rows is best summed side by side. @param count  of lane l
template <class Count>
int depth_of_group(const Count& count) {
  int best = 0, least = std::numeric_limits<int>::max();
  for (int l = 0; l < kSumGroup; ++l) {
    int cost = kSumGroup * count(l);
    for (int deeper = 0; deeper < l; ++deeper) cost += kAlone * (count(deeper) - count(l));
    if (cost < least) least = cost, best = count(l);
  }
  return best;
}

}  // namespace

int row_place(std::int64_t pair, int row_size) {
  const std::int64_t most = std::numeric_limits<int>::max() / row_size;
  if (pair > most)
    throw InputError("packing", "has more than " + std::to_string(most) +
                                    " pairs of neighbours, which is all that a computation of forces can hold");
  return static_cast<int>(pair * row_size);
}

template <int Dim>
HotPairs<Dim>::HotPairs(const std::vector<NeighborPair<Dim>>& pairs, const std::vector<double>& radius,
                        const std::vector<double>& mass, const AnyContactLaw& any_law, double time_step) {
  const int n_grains = static_cast<int>(radius.size());
  first_of_i_.assign(n_grains, 0);
  end_of_i_.assign(n_grains, 0);
  std::visit(
      [&]<class Law>(const Law& law) {
        row_size_ = row_size(Law::kHasFriction);
        // However many pairs of padding there will be: less than a pack for each grain and block.
        row_place(static_cast<std::int64_t>(pairs.size()) + std::int64_t{2 * kPairPadding} * (n_grains + 1),
                  row_size_);
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
        if constexpr (Law::kHasDamping) viscous.assign(size(), 0.0);
        if constexpr (Law::kNeedsReducedRadius) reduced_radius_ = reduced(radius);
        if constexpr (Law::kNeedsReducedMass) reduced_mass_ = reduced(mass);
        for_each_memory<Law, Dim>([&](auto, auto place) { memory[place].assign(size(), 0.0); });
        row_.assign(static_cast<std::size_t>(row_size_) * (size() + 1), 0.0);
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

/// p q/(p + q) of a quantity of the grains of each pair; of padding half of what its grain has.
template <int Dim>
typename HotPairs<Dim>::Component HotPairs<Dim>::reduced(const std::vector<double>& of_grain) const {
  Component values(size());
  for (int p = 0; p < size(); ++p) values[p] = floc::reduced(of_grain[i_[p]], of_grain[j_[p]]);
  return values;
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
      while (q < old.end_of_i_[i] && precedes(old.key(q), key(p))) ++q;
      if (q == old.end_of_i_[i]) break;
      if (!(old.key(q) == key(p))) continue;
      if (!viscous.empty()) viscous[p] = old.viscous[q];
      for (std::size_t k = 0; k < memory.size(); ++k)
        if (!memory[k].empty()) memory[k][p] = old.memory[k][q];
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
  out.reduced_radius = reduced_radius_.data();
  out.reduced_mass = reduced_mass_.data();
  out.viscous = viscous.data();
  for (std::size_t k = 0; k < memory.size(); ++k) out.memory[k] = memory[k].data();
  out.row = row_.data();
  return out;
}

/// In the order of the pairs; grains that pad the last block have none.
template <int Dim>
typename HotPairs<Dim>::RowsOfGrains HotPairs<Dim>::rows_of(const std::vector<int>& grain_of_pair,
                                                            int n_grains) const {
  const int padded = (n_grains + kGrainBlock - 1) / kGrainBlock * kGrainBlock;
  RowsOfGrains rows{std::vector<int>(padded + 1, 0), {}};
  for (int p = 0; p < size(); ++p)
    if (!padding(p)) ++rows.first[grain_of_pair[p] + 1];
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  rows.row.resize(rows.first.back());
  std::vector<int> next(rows.first.begin(), rows.first.end() - 1);
  for (int p = 0; p < size(); ++p)
    if (!padding(p)) rows.row[next[grain_of_pair[p]]++] = row_place(p, row_size_);
  return rows;
}

template <int Dim>
void HotPairs<Dim>::plan_sums(int n_grains) {
  plans_.resize((n_grains + kGrainBlock - 1) / kGrainBlock);
  std::vector<std::size_t> first;
  for (const bool is_i : {true, false}) {
    const RowsOfGrains rows = rows_of(is_i ? i_ : j_, n_grains);
    for (std::size_t b = 0; b < plans_.size(); ++b) {
      first.push_back(listed_rows_.size());
      plan_side(is_i ? plans_[b].as_i : plans_[b].as_j, static_cast<int>(b) * kGrainBlock, rows);
    }
  }
  // Only now that the list has stopped growing does it stay where it is.
  for (std::size_t b = 0; b < plans_.size(); ++b) {
    plans_[b].as_i.row = listed_rows_.data() + first[b];
    plans_[b].as_j.row = listed_rows_.data() + first[plans_.size() + b];
  }
  plan_crossings();
}

/// Groups the grains of a block by falling numbers of rows, and lists those of each group, then what is beyond.
template <int Dim>
void HotPairs<Dim>::plan_side(SideSumsPlan& plan, int begin, const RowsOfGrains& rows) {
  std::int64_t falling[kGrainBlock];  // sorts by falling numbers, then by grain, which its last digits hold
  for (int k = 0; k < kGrainBlock; ++k) falling[k] = -std::int64_t{rows.count(begin + k)} * kGrainBlock + k;
  std::sort(std::begin(falling), std::end(falling));
  for (int k = 0; k < kGrainBlock; ++k)
    plan.grain[k] = static_cast<int>((falling[k] % kGrainBlock + kGrainBlock) % kGrainBlock);
  const auto count = [&](int k) { return rows.count(begin + plan.grain[k]); };
  const auto row = [&](int k, int d) { return rows.row[rows.first[begin + plan.grain[k]] + d]; };
  const int zero_row = row_place(size(), row_size_);
  plan.n_deep = 0;
  for (int g = 0; g < SideSumsPlan::kGroups; ++g) {
    const int depth = plan.depth[g] = depth_of_group([&](int l) { return count(g * kSumGroup + l); });
    for (int d = 0; d < depth; ++d)
      for (int k = g * kSumGroup; k < (g + 1) * kSumGroup; ++k)
        listed_rows_.push_back(d < count(k) ? row(k, d) : zero_row);
    for (int k = g * kSumGroup; k < (g + 1) * kSumGroup; ++k) {
      plan.n_beyond[k] = std::max(0, count(k) - depth);
      if (plan.n_beyond[k] > 0) plan.n_deep = k + 1;
    }
  }
  for (int k = 0; k < plan.n_deep; ++k)
    for (int d = count(k) - plan.n_beyond[k]; d < count(k); ++d) listed_rows_.push_back(row(k, d));
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
