#include "floc/lattice/cemented_sample.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/error.h"
#include "floc/lattice/node_grid.h"
#include "floc/neighbors/pairs.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/require_elastic.h"
#include "floc/packing/require_periodic.h"

namespace floc {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

template <int Dim>
class Cementing {
 public:
  Cementing(const Packing<Dim>& packing, Lattice<Dim> lattice)
      : out_(empty_sample(std::move(lattice))), grid_(out_.lattice) {
    out_.grains = strained(packing);
    const int n = out_.lattice.n_nodes();
    out_.phase.assign(n, Phase::none);
    out_.owner.assign(n, -1);
    out_.owner_image.assign(n, Vec<Dim, int>::Zero());
    to_surface_.assign(n, kFar);
    out_.mean_diameter = mean_diameter(out_.grains.radius);
  }
  Cementing(const Cementing&) = delete;
  Cementing& operator=(const Cementing&) = delete;

  void lay_grains() {
    take_owners(0.0);
    for (int k = 0; k < out_.lattice.n_nodes(); ++k)
      if (to_surface_[k] < 0.0) out_.phase[k] = Phase::grain;
    out_.grain_content = content(Phase::grain);
  }

  void lay_matrix(const CementOptions& options) {
    pairs_ = find_pairs(out_.lattice.cell, out_.grains, options.bridge_gap * out_.mean_diameter);
    out_.n_bridges = static_cast<int>(pairs_.size());
    const double wanted = options.matrix_content * out_.lattice.cell.volume();
    if (wanted > 0.0) choose_nodes(options.matrix_content, nodes_by_width(options.matrix_content));
    // The owner of each node of the matrix is the grain with the nearest surface. The search distance is doubled until
    // every node of the matrix has an owner.
    for (double reach = 0.25 * out_.mean_diameter; without_owner(); reach *= 2.0) take_owners(reach);
    for (int k = 0; k < out_.lattice.n_nodes(); ++k)
      if (out_.phase[k] == Phase::none) out_.owner[k] = -1;
    out_.matrix_content = content(Phase::matrix);
  }

  CementedSample<Dim> take() { return std::move(out_); }

 private:
  struct CoveredNode {
    // width of the narrowest bridge that covers the node, divided by R' = 2 R_i R_j/(R_i + R_j), where R_i and R_j are
    // the radii of the two grains of the bridge
    double width;
    int node;
  };

  static CementedSample<Dim> empty_sample(Lattice<Dim> lattice) {
    CementedSample<Dim> sample;
    sample.lattice = std::move(lattice);
    return sample;
  }

  Grains<Dim> strained(const Packing<Dim>& packing) {
    const Cell<Dim>& from = packing.cell;
    const Cell<Dim>& to = out_.lattice.cell;
    Grains<Dim> grains = packing.grains;
    grains.position_low.clear();
    const double size = std::pow(to.volume() / from.volume(), 1.0 / Dim);
    for (int i = 0; i < grains.size(); ++i) {
      grains.position[i] = to.matrix.transpose() * from.reduced(packing.grains.position[i]);
      grains.radius[i] *= size;
    }
    const Mat<Dim> stretch = from.matrix.inverse() * to.matrix;
    out_.strain = (stretch - Mat<Dim>::Identity()).cwiseAbs().maxCoeff();
    return grains;
  }

  double content(Phase phase) const {
    double volume = 0.0;
    for (int k = 0; k < out_.lattice.n_nodes(); ++k)
      if (out_.phase[k] == phase) volume += out_.lattice.volume[k];
    return volume / out_.lattice.cell.volume();
  }

  /// For each node inside a grain or near a grain, finds the owner (the grain with the nearest surface).
  /// @param reach  largest distance of a node from the surface of its owner (length)
  void take_owners(double reach) {
    for (int i = 0; i < out_.grains.size(); ++i) {
      const double radius = out_.grains.radius[i];
      grid_.near(out_.grains.position[i], radius + reach,
                 [&](int node, const Vec<Dim>& from, const Vec<Dim, int>& image) {
                   const double distance = from.norm() - radius;
                   if (distance >= to_surface_[node]) return;
                   to_surface_[node] = distance;
                   out_.owner[node] = i;
                   out_.owner_image[node] = -image;
                 });
    }
  }

  bool without_owner() const {
    for (int k = 0; k < out_.lattice.n_nodes(); ++k)
      if (out_.phase[k] == Phase::matrix && out_.owner[k] < 0) return true;
    return false;
  }

  /// For each node, returns the width of the narrowest bridge of matrix that covers the node. The width is divided by
  /// R' = 2 R_i R_j/(R_i + R_j), where R_i and R_j are the radii of the two grains of the bridge. The result is
  /// infinite if it would exceed `largest`.
  std::vector<double> covering_widths(double largest) const {
    std::vector<double> width(out_.lattice.n_nodes(), kFar);
    for (const NeighborPair<Dim>& pair : pairs_) {
      const double ri = out_.grains.radius[pair.i], rj = out_.grains.radius[pair.j];
      const double reduced_radius = 2.0 * ri * rj / (ri + rj);
      const Vec<Dim> branch =
          out_.grains.position[pair.j] + out_.lattice.cell.shift(pair.image) - out_.grains.position[pair.i];
      const double reach = 0.5 * branch.norm() + 0.5 * largest * reduced_radius;
      const Vec<Dim> middle = out_.grains.position[pair.i] + 0.5 * branch;
      grid_.near(middle, reach, [&](int node, const Vec<Dim>& from, const Vec<Dim, int>&) {
        if (out_.phase[node] != Phase::none) return;
        const double along = std::clamp(from.dot(branch) / branch.squaredNorm(), -0.5, 0.5);
        const double needed = 2.0 * (from - along * branch).norm() / reduced_radius;
        if (needed <= largest) width[node] = std::min(width[node], needed);
      });
    }
    return width;
  }

  /// Returns nodes that bridges of matrix can cover, sorted by the width of the narrowest bridge that covers the node.
  /// The list contains at least as many nodes as the wanted matrix content requires.
  /// @param wanted  matrix content as a share of the volume
  std::vector<CoveredNode> nodes_by_width(double wanted) const {
    std::vector<CoveredNode> covered;
    double reached = 0.0;
    /// Largest width of a bridge that is tried, divided by R' = 2 R_i R_j/(R_i + R_j), where R_i and R_j are the radii
    /// of the two grains. This width is many times the size of the grains, so that wider bridges cover no additional
    /// nodes.
    constexpr double kWidest = 64.0;
    for (double largest = 0.5; largest <= kWidest; largest *= 2.0) {
      const std::vector<double> width = covering_widths(largest);
      covered.clear();
      double volume = 0.0;
      for (int k = 0; k < out_.lattice.n_nodes(); ++k)
        if (width[k] < kFar) covered.push_back({width[k], k}), volume += out_.lattice.volume[k];
      reached = volume / out_.lattice.cell.volume();
      if (reached >= wanted || reached >= 1.0 - out_.grain_content - 1e-12) break;
    }
    if (reached < wanted - 1e-12)
      throw InputError("",
                       fmt::format("matrix = {:.6g} cannot be reached: with a grain content of {:.4g}, "
                                   "the bridges between {} pairs of neighbours can contain a matrix content of "
                                   "at most {:.4g}",
                                   wanted, out_.grain_content, out_.n_bridges, reached));
    std::sort(covered.begin(), covered.end(), [](const CoveredNode& a, const CoveredNode& b) {
      return a.width != b.width ? a.width < b.width : a.node < b.node;
    });
    return covered;
  }

  /// Chooses the width of the bridges for which the matrix content is nearest to the wanted content.
  /// @param wanted   matrix content as a share of the volume
  /// @param covered  result of nodes_by_width() for this content
  void choose_nodes(double wanted, const std::vector<CoveredNode>& covered) {
    const double volume = wanted * out_.lattice.cell.volume();
    double taken = 0.0;
    for (const CoveredNode& c : covered) {
      const double with = taken + out_.lattice.volume[c.node];
      if (with - volume > volume - taken) break;
      taken = with;
      out_.phase[c.node] = Phase::matrix;
      out_.bridge_width = c.width;
    }
  }

  CementedSample<Dim> out_;
  NodeGrid<Dim> grid_;
  std::vector<NeighborPair<Dim>> pairs_;
  // for each node, the distance to the nearest surface of a grain, negative inside the grain (length)
  std::vector<double> to_surface_;
};

}  // namespace

std::vector<std::string> CementOptions::validate() const {
  std::vector<std::string> faults;
  if (!kContent.holds(matrix_content))
    faults.push_back(fmt::format("matrix = {}: must be a share of the volume, from 0 to 1", matrix_content));
  if (!(bridge_gap >= 0.0) || !std::isfinite(bridge_gap))
    faults.push_back(fmt::format("bridge-gap = {}: must be >= 0 and finite", bridge_gap));
  return faults;
}

template <int Dim>
CementedSample<Dim> cement(const Packing<Dim>& packing, Lattice<Dim> lattice, const CementOptions& options) {
  refuse_faults(options.validate());
  require_periodic(packing, "grains are cemented");
  require_round(packing, "grains are cemented");
  Cementing<Dim> cementing(packing, std::move(lattice));
  cementing.lay_grains();
  cementing.lay_matrix(options);
  return cementing.take();
}

template CementedSample<2> cement(const Packing<2>&, Lattice<2>, const CementOptions&);
template CementedSample<3> cement(const Packing<3>&, Lattice<3>, const CementOptions&);

}  // namespace floc
