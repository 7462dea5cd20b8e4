#include "floc/relaxation/row_sums.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "floc/base/error.h"

namespace floc {
namespace {

/// What a row costs that is summed alone, each addition waiting for the one before it, in rows of a group.
constexpr int kAlone = 3;

/// Depth to which a group of grains with falling numbers of rows is best summed side by side. @param count  of
/// lane l
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
RowSums<Dim>::RowSums(const std::vector<const PairArrays<Dim>*>& lists, RowKind rows, int n_grains,
                      RowsKept kept)
    : kept_(kept),
      row_size_(row_size<Dim>(rows)),
      plans_(static_cast<std::size_t>((n_grains + kGrainBlock - 1) / kGrainBlock)) {
  place_rows(lists);
  const RowsOfGrains as_i = rows_of(lists, [](const PairArrays<Dim>& pairs, int p) { return pairs.i(p); });
  RowsOfGrains as_j{std::vector<int>(plans_.size() * kGrainBlock + 1, 0), {}};
  const std::size_t sums_of_block = static_cast<std::size_t>(kGrainBlock) * row_sum_size<Dim>(rows);
  if (kept == RowsKept::all)
    as_j = rows_of({lists[0]}, [](const PairArrays<Dim>& pairs, int p) { return pairs.j(p); });
  else
    sums_as_j_.assign(plans_.size() * sums_of_block, 0.0);
  std::vector<std::size_t> first;
  for (std::size_t b = 0; b < plans_.size(); ++b) {
    const int begin = static_cast<int>(b) * kGrainBlock;
    first.push_back(listed_rows_.size());
    plan_side(plans_[b].as_i, begin, as_i);
    first.push_back(listed_rows_.size());
    plan_side(plans_[b].as_j, begin, as_j);
    plans_[b].sums_as_j = kept == RowsKept::all ? nullptr : sums_as_j_.data() + b * sums_of_block;
  }
  // Only now that the list has stopped growing does it stay where it is.
  for (std::size_t b = 0; b < plans_.size(); ++b) {
    plans_[b].as_i.row = listed_rows_.data() + first[2 * b];
    plans_[b].as_j.row = listed_rows_.data() + first[2 * b + 1];
  }
  plan_crossings(*lists[0]);
}

template <int Dim>
void RowSums<Dim>::place_rows(const std::vector<const PairArrays<Dim>*>& lists) {
  std::int64_t n_pairs = 0;
  for (const PairArrays<Dim>* pairs : lists) {
    first_row_.push_back(row_place(n_pairs, row_size_));
    int kept = pairs->size();
    if (kept_ == RowsKept::one_block && pairs == lists[0]) {
      kept = 0;
      for (int b = 0; b < static_cast<int>(plans_.size()); ++b)
        kept = std::max(kept, pairs->first_of_block(b + 1) - pairs->first_of_block(b));
    }
    n_pairs += kept;
  }
  zero_row_ = row_place(n_pairs, row_size_);
  rows_.assign(static_cast<std::size_t>(zero_row_) + row_size_, 0.0);
}

template <int Dim>
int RowSums<Dim>::place_of_row(const std::vector<const PairArrays<Dim>*>& lists, std::size_t list,
                               int pair) const {
  if (kept_ == RowsKept::one_block && list == 0)
    pair -= lists[0]->first_of_block(lists[0]->i(pair) / kGrainBlock);
  return first_row_[list] + pair * row_size_;
}

/// In the order of the pairs; grains that pad the last block have none.
template <int Dim>
template <class GrainOf>
typename RowSums<Dim>::RowsOfGrains RowSums<Dim>::rows_of(const std::vector<const PairArrays<Dim>*>& lists,
                                                          const GrainOf& grain_of) const {
  RowsOfGrains rows{std::vector<int>(plans_.size() * kGrainBlock + 1, 0), {}};
  for (const PairArrays<Dim>* pairs : lists)
    for (int p = 0; p < pairs->size(); ++p)
      if (!pairs->padding(p)) ++rows.first[grain_of(*pairs, p) + 1];
  std::partial_sum(rows.first.begin(), rows.first.end(), rows.first.begin());
  rows.row.resize(rows.first.back());
  std::vector<int> next(rows.first.begin(), rows.first.end() - 1);
  for (std::size_t l = 0; l < lists.size(); ++l)
    for (int p = 0; p < lists[l]->size(); ++p)
      if (!lists[l]->padding(p)) rows.row[next[grain_of(*lists[l], p)]++] = place_of_row(lists, l, p);
  return rows;
}

/// Groups the grains of a block by falling numbers of rows, and lists those of each group, then what is beyond.
template <int Dim>
void RowSums<Dim>::plan_side(SideSumsPlan& plan, int begin, const RowsOfGrains& rows) {
  std::int64_t falling[kGrainBlock];  // sorts by falling numbers, then by grain, which its last digits hold
  for (int k = 0; k < kGrainBlock; ++k) falling[k] = -std::int64_t{rows.count(begin + k)} * kGrainBlock + k;
  std::sort(std::begin(falling), std::end(falling));
  for (int k = 0; k < kGrainBlock; ++k)
    plan.grain[k] = static_cast<int>((falling[k] % kGrainBlock + kGrainBlock) % kGrainBlock);
  const auto count = [&](int k) { return rows.count(begin + plan.grain[k]); };
  const auto row = [&](int k, int d) { return rows.row[rows.first[begin + plan.grain[k]] + d]; };
  plan.n_deep = 0;
  for (int g = 0; g < SideSumsPlan::kGroups; ++g) {
    const int depth = plan.depth[g] = depth_of_group([&](int l) { return count(g * kSumGroup + l); });
    for (int d = 0; d < depth; ++d)
      for (int k = g * kSumGroup; k < (g + 1) * kSumGroup; ++k)
        listed_rows_.push_back(d < count(k) ? row(k, d) : zero_row_);
    for (int k = g * kSumGroup; k < (g + 1) * kSumGroup; ++k) {
      plan.n_beyond[k] = std::max(0, count(k) - depth);
      if (plan.n_beyond[k] > 0) plan.n_deep = k + 1;
    }
  }
  for (int k = 0; k < plan.n_deep; ++k)
    for (int d = count(k) - plan.n_beyond[k]; d < count(k); ++d) listed_rows_.push_back(row(k, d));
}

template <int Dim>
void RowSums<Dim>::plan_crossings(const PairArrays<Dim>& pairs) {
  const int n_blocks = static_cast<int>(plans_.size());
  std::vector<std::size_t> first(n_blocks);
  for (int b = 0; b < n_blocks; ++b) {
    first[b] = crossing_.size();
    for (int p = pairs.first_of_block(b); p < pairs.first_of_block(b + 1); ++p)
      if (!pairs.padding(p) && !pairs.key(p).image.isZero()) crossing_.push_back(p);
    plans_[b].n_crossing = static_cast<int>(crossing_.size() - first[b]);
  }
  for (int b = 0; b < n_blocks; ++b) plans_[b].crossing = crossing_.data() + first[b];
}

template class RowSums<2>;
template class RowSums<3>;

}  // namespace floc
