#include "floc/linalg/elimination_order.h"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace floc {
namespace {

/// Ordering::automatic tries nested dissection if a factorization takes more floating-point operations per group of
/// unknowns than this number. For comparison, the search for an order by nested dissection takes as long as about 3e5
/// operations per group.
constexpr double kNestedDissectionCost = 1e6;

/// Order in which groups of unknowns are eliminated.
struct GroupOrder {
  std::vector<SuiteSparse_long> group;  // groups in the order of elimination
  // number of floating-point operations of a factorization in this order, computed as if each group had one unknown
  double operations;
};

/// Graph whose nodes are the groups of unknowns of a sparse matrix. CHOLMOD finds orders of elimination from this
/// graph.
class GroupGraph {
 public:
  GroupGraph(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group)
      : n_(group.empty() ? 0 : group.back() + 1) {
    cholmod_l_start(&common_);
    common_.print = 0;
    make_pattern(lower, group);
  }
  ~GroupGraph() {
    cholmod_l_free_sparse(&pattern_, &common_);
    cholmod_l_finish(&common_);
  }
  GroupGraph(const GroupGraph&) = delete;
  GroupGraph& operator=(const GroupGraph&) = delete;

  GroupOrder order(bool metis) {
    std::vector<SuiteSparse_long> order(n_), parent(n_), post(n_), count(n_), first(n_), level(n_);
    if (metis)
      cholmod_l_metis(pattern_, nullptr, 0, 1, order.data(), &common_);
    else
      cholmod_l_amd(pattern_, nullptr, 0, order.data(), &common_);
    check();
    cholmod_l_analyze_ordering(pattern_, CHOLMOD_GIVEN, order.data(), nullptr, 0, parent.data(), post.data(),
                               count.data(), first.data(), level.data(), &common_);
    const double operations = common_.fl;
    cholmod_l_postorder(parent.data(), n_, count.data(), post.data(), &common_);
    check();
    std::transform(post.begin(), post.end(), post.begin(), [&](SuiteSparse_long k) { return order[k]; });
    return {std::move(post), operations};
  }

 private:
  /// Builds the pattern of the graph as a lower triangle. Two groups are connected if the matrix has an entry whose row
  /// is in one group and whose column is in the other.
  void make_pattern(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group) {
    std::vector<SuiteSparse_long> start{0}, row;
    std::vector<int> last_seen(n_, -1);
    for (int c = 0; c < static_cast<int>(lower.cols()); ++c) {
      const int g = group[c];
      while (static_cast<int>(start.size()) <= g) start.push_back(static_cast<SuiteSparse_long>(row.size()));
      for (Eigen::SparseMatrix<double>::InnerIterator it(lower, c); it; ++it) {
        if (it.row() < c) continue;
        const int h = group[it.row()];
        if (h == g || last_seen[h] == g) continue;
        last_seen[h] = g;
        row.push_back(h);
      }
    }
    while (static_cast<int>(start.size()) <= n_) start.push_back(static_cast<SuiteSparse_long>(row.size()));
    pattern_ = cholmod_l_allocate_sparse(n_, n_, row.size(), 0, 1, -1, CHOLMOD_PATTERN, &common_);
    check();
    std::copy(start.begin(), start.end(), static_cast<SuiteSparse_long*>(pattern_->p));
    std::copy(row.begin(), row.end(), static_cast<SuiteSparse_long*>(pattern_->i));
  }

  void check() const {
    if (common_.status < CHOLMOD_OK)
      throw std::runtime_error(common_.status == CHOLMOD_OUT_OF_MEMORY ? "out of memory while ordering a matrix"
                                                                       : "CHOLMOD could not order a matrix");
  }

  int n_;
  cholmod_common common_{};
  cholmod_sparse* pattern_ = nullptr;
};

GroupOrder best_order(GroupGraph& graph, Ordering ordering, double groups, double group_size) {
  GroupOrder order = graph.order(ordering == Ordering::metis);
  if (ordering != Ordering::automatic ||
      order.operations * std::pow(group_size, 3) < kNestedDissectionCost * groups)
    return order;
  GroupOrder dissected = graph.order(true);
  return dissected.operations < order.operations ? std::move(dissected) : std::move(order);
}

}  // namespace

Eigen::VectorXi elimination_places(const Eigen::SparseMatrix<double>& lower, const std::vector<int>& group,
                                   Ordering ordering) {
  if (group.empty()) return {};
  const int n_groups = group.back() + 1;
  GroupGraph graph(lower, group);
  const GroupOrder order = best_order(graph, ordering, n_groups, static_cast<double>(group.size()) / n_groups);
  std::vector<int> first(n_groups + 1, 0);
  for (const int g : group) ++first[g + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  Eigen::VectorXi places(static_cast<Eigen::Index>(group.size()));
  int next = 0;
  for (const SuiteSparse_long g : order.group)
    for (int k = first[g]; k < first[g + 1]; ++k) places[k] = next++;
  return places;
}

}  // namespace floc
