#include "floc/relaxation/row_sums.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Computing time of adding a row (force and moments of a pair) to a single sum, divided by the time per row if the
/// sums of several grains are computed side by side. A single sum is slower, since each addition waits for the previous
/// addition.
constexpr int kAlone = 3;

/// Returns the depth of a group of grains: up to this number of pairs per grain, the forces on the grains are summed
/// side by side. The depth is chosen for the shortest computing time. The grains are sorted from the largest to the
/// smallest number of pairs.
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

template <int Dim>
int first_pair(const PairArrays<Dim>& pairs, const SweepPlan& plan, int group) {
  return pairs.first_of_block(plan.first_block(group));
}

/// Assigns a slot of memory to each group of blocks, for the rows (forces and moments) of its pairs. A group reuses the
/// slot of an earlier group of its thread whose rows have all been summed; if there is no such group, the later group
/// gets a new slot.
/// @return number of the slot of each group
template <int Dim>
std::vector<int> slots_of_groups(const PairArrays<Dim>& pairs, const SweepPlan& plan) {
  std::vector<int> slots;
  // For each group of blocks: the memory slots that are free once the forces on the blocks of this group have been
  // summed.
  std::vector<std::vector<int>> left(plan.n_groups());
  int n_slots = 0;
  for (int thread = 0; thread < plan.n_threads(); ++thread) {
    std::vector<int> free;
    for (int g = plan.first_group(thread); g < plan.first_group(thread + 1); ++g) {
      if (free.empty()) free.push_back(n_slots++);
      slots.push_back(free.back());
      free.pop_back();
      int last = g;
      // Whether the rows (forces and moments) of this group are summed only after all pairs have been computed.
      bool kept = false;
      for (int p = first_pair(pairs, plan, g); p < first_pair(pairs, plan, g + 1); ++p) {
        const int i = pairs.i(p) / kGrainBlock, j = pairs.j(p) / kGrainBlock;
        last = std::max(last, plan.group_of(j));
        kept = kept || plan.is_shared(i) || plan.is_shared(j);
      }
      if (!kept) left[last].push_back(slots.back());
      free.insert(free.end(), left[g].begin(), left[g].end());
    }
  }
  return slots;
}

}  // namespace

int row_place(std::int64_t pair, int row_size) {
  const std::int64_t most = std::numeric_limits<int>::max() / row_size;
  if (pair > most)
    throw InputError(
        "packing",
        "the packing has more than " + std::to_string(most) +
            " pairs of neighbouring grains, which is the largest number for which floc can compute forces");
  return static_cast<int>(pair * row_size);
}

template <int Dim>
RowSums<Dim>::RowSums(const Lists& lists, RowKind rows, int n_grains, const SweepPlan& plan)
    : row_size_(row_size<Dim>(rows)),
      plans_(static_cast<std::size_t>((n_grains + kGrainBlock - 1) / kGrainBlock)) {
  place_rows(lists, plan);
  const RowsOfGrains as_i =
      rows_of(lists, plan, [](const PairArrays<Dim>& pairs, int p) { return pairs.i(p); });
  const RowsOfGrains as_j =
      rows_of({lists[0]}, plan, [](const PairArrays<Dim>& pairs, int p) { return pairs.j(p); });
  std::vector<std::size_t> first;
  for (std::size_t b = 0; b < plans_.size(); ++b) {
    const int begin = static_cast<int>(b) * kGrainBlock;
    first.push_back(listed_rows_.size());
    plan_side(plans_[b].as_i, begin, as_i);
    first.push_back(listed_rows_.size());
    plan_side(plans_[b].as_j, begin, as_j);
    plans_[b].rows = rows_.data();
  }
  // From here on the list listed_rows_ is complete: its memory does not move any more, so pointers into the list stay
  // valid.
  for (std::size_t b = 0; b < plans_.size(); ++b) {
    plans_[b].as_i.row = listed_rows_.data() + first[2 * b];
    plans_[b].as_j.row = listed_rows_.data() + first[2 * b + 1];
  }
  plan_crossings(*lists[0]);
}

template <int Dim>
void RowSums<Dim>::place_rows(const Lists& lists, const SweepPlan& plan) {
  const PairArrays<Dim>& pairs = *lists[0];
  int slot_size = 0;
  for (int g = 0; g < plan.n_groups(); ++g)
    slot_size = std::max(slot_size, first_pair(pairs, plan, g + 1) - first_pair(pairs, plan, g));
  std::int64_t n_rows = 0;
  const auto take = [&](std::int64_t first, std::int64_t n) {
    n_rows = std::max(n_rows, first + n);
    return row_place(first, row_size_);
  };
  for (const int slot : slots_of_groups(pairs, plan))
    first_row_.push_back(take(std::int64_t{slot_size} * slot, slot_size));
  if (lists.size() > 1) first_row_with_walls_ = take(n_rows, lists[1]->size());
  zero_row_ = take(n_rows, 1);
  rows_.assign(static_cast<std::size_t>(zero_row_) + row_size_, 0.0);
}

template <int Dim>
int RowSums<Dim>::place_of_row(const Lists& lists, const SweepPlan& plan, std::size_t list, int pair) const {
  if (list > 0) return first_row_with_walls_ + pair * row_size_;
  const int group = plan.group_of(lists[0]->i(pair) / kGrainBlock);
  return first_row_[group] + (pair - first_pair(*lists[0], plan, group)) * row_size_;
}

/// Returns the places of the rows (forces and moments) of the pairs of each grain, in the order of the pairs. The
/// padding grains of the last block have no pairs.
/// @param grain_of  function that takes a list of pairs and the index of a pair in this list, and returns the grain to
/// which the pair is assigned
template <int Dim>
template <class GrainOf>
typename RowSums<Dim>::RowsOfGrains RowSums<Dim>::rows_of(const Lists& lists, const SweepPlan& plan,
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
      if (!lists[l]->padding(p)) rows.row[next[grain_of(*lists[l], p)]++] = place_of_row(lists, plan, l, p);
  return rows;
}

/// Sorts the grains of a block from the largest to the smallest number of pairs and divides the grains into groups.
/// Lists the rows (forces and moments) that are summed side by side, group by group, and then the rows that are summed
/// one by one.
template <int Dim>
void RowSums<Dim>::plan_side(SideSumsPlan& plan, int begin, const RowsOfGrains& rows) {
  // Sort keys. They order the grains by their number of pairs, the largest number first, then by index. The index of a
  // grain is the remainder of its key modulo kGrainBlock.
  std::int64_t falling[kGrainBlock];
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
