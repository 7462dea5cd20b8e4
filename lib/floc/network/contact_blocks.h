#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "floc/network/rigidity_matrix.h"

namespace floc {

/// Pairs of grains in contact, each once: for every grain the neighbours with a higher number, ascending. They
/// are the blocks of K below its diagonal.
struct ContactGraph {
  std::vector<int> start;  ///< where each grain's entries of `neighbour` begin, and the end
  std::vector<int> neighbour;
};

/// Returns the graph of the contacts. @param contacts  range of objects with members i and j; contacts of a
/// grain with its own image give no block
template <class Contacts>
ContactGraph contact_graph(int n_grains, const Contacts& contacts) {
  ContactGraph graph;
  graph.start.assign(n_grains + 1, 0);
  for (const auto& c : contacts)
    if (c.i != c.j) ++graph.start[std::min(c.i, c.j) + 1];
  for (int g = 0; g < n_grains; ++g) graph.start[g + 1] += graph.start[g];
  graph.neighbour.resize(graph.start.back());
  std::vector<int> next(graph.start.begin(), graph.start.end() - 1);
  for (const auto& c : contacts)
    if (c.i != c.j) graph.neighbour[next[std::min(c.i, c.j)]++] = std::max(c.i, c.j);
  int kept = 0;  // several contacts of one pair share a block
  for (int g = 0; g < n_grains; ++g) {
    const auto first = graph.neighbour.begin() + graph.start[g];
    const auto last = graph.neighbour.begin() + graph.start[g + 1];
    std::sort(first, last);
    graph.start[g] = kept;
    kept = static_cast<int>(std::unique_copy(first, last, graph.neighbour.begin() + kept) -
                            graph.neighbour.begin());
  }
  graph.start.back() = kept;
  graph.neighbour.resize(kept);
  return graph;
}

/// Adds G^T D G of one contact to a stiffness; all stiffnesses are assembled by this function. Rows of G are
/// relative motions, its columns the unknowns of i, of j and of the boundary.
///
/// @param on_i, on_j  rows x kDofs; if i = j, `on_i` has both and `on_j` is zero
/// @param boundary    rows x unknowns of the boundary: strains of a cell, displacements of walls
/// @param d           rows x rows, an Eigen expression: diagonal for a sum that keeps one triangle
/// @param sum         receives the blocks: add(grain, grain, block), low before high where `kSymmetric`;
///                    border(grain) and, where not symmetric, border_row(grain) are blocks to add to, and so is
///                    boundary()
template <class Rows, class Boundary, class Stiffness, class Sum>
void add_contact(int i, int j, const Rows& on_i, const Rows& on_j, const Boundary& boundary, const Stiffness& d,
                 Sum& sum) {
  using Block = Eigen::Matrix<double, Rows::ColsAtCompileTime, Rows::ColsAtCompileTime>;
  const auto add_own = [&](int grain, const Rows& rows, const Rows& forces) {
    sum.add(grain, grain, Block(rows.transpose() * forces));
    if constexpr (Sum::kSymmetric) {
      sum.border(grain) += forces.transpose() * boundary;
    } else {
      const Rows work = d.transpose() * rows;
      sum.border(grain) += work.transpose() * boundary;
      sum.border_row(grain) += boundary.transpose() * forces;
    }
  };
  const Rows forces_of_i = d * on_i;
  add_own(i, on_i, forces_of_i);
  sum.boundary() += boundary.transpose() * d * boundary;
  if (i == j) return;
  const Rows forces_of_j = d * on_j;
  add_own(j, on_j, forces_of_j);
  if (!Sum::kSymmetric || i < j) sum.add(i, j, Block(on_i.transpose() * forces_of_j));
  if (!Sum::kSymmetric || j < i) sum.add(j, i, Block(on_j.transpose() * forces_of_i));
}

}  // namespace floc
