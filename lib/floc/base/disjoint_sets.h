#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace floc {

/// Disjoint sets of the whole numbers from 0 to n - 1 (union-find with path halving). At first, each number is a set of
/// its own. The smallest member of a set serves as its name, because the smallest member does not depend on the order
/// in which sets are merged.
class DisjointSets {
 public:
  explicit DisjointSets(int n) : parent_(n), n_sets_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Returns the name of the set that contains i.
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Merges the set that contains i and the set that contains j. @return false if i and j already were in one set
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
