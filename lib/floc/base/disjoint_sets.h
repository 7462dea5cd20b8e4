#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace floc {

/// The numbers below n in disjoint sets: each is alone at first, joins merge sets (union-find with path
/// halving). A set is named by its smallest member, so names do not depend on the order of the joins.
class DisjointSets {
 public:
  explicit DisjointSets(int n) : parent_(n), n_sets_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// The name of the set that holds i.
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// @return whether they were in different sets
  bool join(int i, int j) {
    i = root(i), j = root(j);
    if (i == j) return false;
    parent_[std::max(i, j)] = std::min(i, j);
    --n_sets_;
    return true;
  }

  int n_sets() const { return n_sets_; }

 private:
  std::vector<int> parent_;
  int n_sets_;
};

}  // namespace floc
