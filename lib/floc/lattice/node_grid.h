#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "floc/lattice/lattice.h"

namespace floc {

/// Search grid that finds the nodes of a lattice near a point of the periodic cell.
template <int Dim>
class NodeGrid {
 public:
  explicit NodeGrid(const Lattice<Dim>& lattice) : lattice_(lattice) {
    // The columns are the gradients of the reduced coordinates.
    const Mat<Dim> inverse = lattice.cell.matrix.inverse();
    for (int a = 0; a < Dim; ++a) {
      width_[a] = 1.0 / inverse.col(a).norm();
      bins_[a] = std::max(1, static_cast<int>(width_[a] / (kNodesAcross * lattice.spacing)));
    }
    start_.assign(bins_.prod() + 1, 0);
    std::vector<int> bin(lattice.node.size());
    for (int k = 0; k < lattice.n_nodes(); ++k) {
      const Vec<Dim> s = lattice.cell.reduced(lattice.node[k]);
      Vec<Dim, int> at;
      for (int a = 0; a < Dim; ++a) at[a] = std::clamp(static_cast<int>(s[a] * bins_[a]), 0, bins_[a] - 1);
      ++start_[(bin[k] = number(at)) + 1];
    }
    for (std::size_t b = 1; b < start_.size(); ++b) start_[b] += start_[b - 1];
    order_.resize(bin.size());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (int k = 0; k < lattice.n_nodes(); ++k) order_[next[bin[k]]++] = k;
  }

  /// Calls visit(node, from, image) for every periodic image of a node whose distance from the point `centre` is below
  /// `radius`. `from` is the vector from `centre` to this image of the node, and image * cell.matrix is the
  /// displacement of the image.
  template <class Visit>
  void near(const Vec<Dim>& centre, double radius, Visit&& visit) const {
    const Vec<Dim> s = lattice_.cell.reduced(centre);
    Vec<Dim, int> low, high;
    for (int a = 0; a < Dim; ++a) {
      low[a] = static_cast<int>(std::floor((s[a] - radius / width_[a]) * bins_[a]));
      high[a] = static_cast<int>(std::floor((s[a] + radius / width_[a]) * bins_[a]));
    }
    for (Vec<Dim, int> at = low; at[Dim - 1] <= high[Dim - 1];) {
      visit_bin(at, centre, radius, visit);
      for (int a = 0; a < Dim; ++a) {
        if (++at[a] <= high[a] || a == Dim - 1) break;
        at[a] = low[a];
      }
    }
  }

 private:
  static constexpr double kNodesAcross = 3.0;

  int number(const Vec<Dim, int>& at) const {
    int n = 0;
    for (int a = Dim; a-- > 0;) n = n * bins_[a] + at[a];
    return n;
  }

  template <class Visit>
  void visit_bin(const Vec<Dim, int>& at, const Vec<Dim>& centre, double radius, Visit&& visit) const {
    Vec<Dim, int> image, inside;
    for (int a = 0; a < Dim; ++a) {
      image[a] = static_cast<int>(std::floor(static_cast<double>(at[a]) / bins_[a]));
      inside[a] = at[a] - image[a] * bins_[a];
    }
    const Vec<Dim> shift = lattice_.cell.shift(image);
    const int bin = number(inside);
    for (int k = start_[bin]; k < start_[bin + 1]; ++k) {
      const Vec<Dim> from = lattice_.node[order_[k]] + shift - centre;
      if (from.squaredNorm() < radius * radius) visit(order_[k], from, image);
    }
  }

  const Lattice<Dim>& lattice_;
  Vec<Dim> width_;      // distances between opposite faces of the cell (length)
  Vec<Dim, int> bins_;  // number of bins of the search grid along each lattice vector
  std::vector<int> start_, order_;
};

}  // namespace floc
