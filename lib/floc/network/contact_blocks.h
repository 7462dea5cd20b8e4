#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "floc/network/rigidity_matrix.h"

namespace floc {

/// Graph of the pairs of grains in contact. The graph contains each pair once: for every grain, it lists the neighbours
/// with higher numbers, in ascending order. Each pair corresponds to a block below the diagonal of the stiffness
/// matrix.
struct ContactGraph {
  /// for each grain, the index of its first neighbour in `neighbour`; one additional last entry is the size of
  /// `neighbour`
  std::vector<int> start;
  std::vector<int> neighbour;
};

/// Returns the graph of the pairs of grains that are connected by the given contacts.
/// @param contacts  range of objects with the numbers i and j of two grains; contacts of a grain with its own image are
/// ignored
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
  int kept = 0;  // number of different pairs so far: several contacts of one pair count once
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

/// Adds G^T D G for one contact to a stiffness matrix. The product of the matrix G with the unknowns (of grain i, grain
/// j and the boundary) is the relative motion at the contact, with one row per component of the motion. The matrix D
/// contains the stiffnesses for these components. All stiffness matrices are assembled by this function.
///
/// @param i, j        numbers of the two grains
/// @param on_i, on_j  columns of G for the unknowns of i and of j, rows x kDofs; if i = j, `on_i` contains both and
///                    `on_j` is zero
/// @param boundary    columns of G for the unknowns of the boundary (strains of a cell, displacements of walls)
/// @param d           the matrix D, an Eigen expression; it must be symmetric if `sum` stores only one triangle
/// @param sum         stiffness matrix, an object with these functions: add(grain, grain, block) adds a block of two
///                    grains, of which the first has the lower number if `kSymmetric`; boundary(), border(grain) and,
///                    unless `kSymmetric`, border_row(grain) return references to the blocks of the boundary
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
