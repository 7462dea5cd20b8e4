#include "floc/lattice/lattice_network.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "floc/base/range.h"

namespace floc {
namespace {

/// Two directions count as collinear if the sine of the angle between them is below this number.
constexpr double kCollinear = 1e-6;

template <int Dim>
class NetworkBuilder {
 public:
  NetworkBuilder(const CementedSample<Dim>& sample, const ElementStiffness& stiffness, LatticeBoundary boundary,
                 int axis)
      : sample_(sample), stiffness_(stiffness), boundary_(boundary), axis_(axis) {
    out_.n_nodes = sample.lattice.n_nodes();
    out_.volume = sample.lattice.cell.volume();
    out_.spacing = sample.lattice.spacing;
    out_.shear = stiffness.shear;
    out_.bending = stiffness.bending;
  }

  LatticeNetwork<Dim> build() {
    if (boundary_ != LatticeBoundary::periodic)
      out_.held.assign(static_cast<std::size_t>(Dim) * out_.n_nodes, false);
    out_.elements.reserve(sample_.lattice.bonds.size());
    for (int b = 0; b < static_cast<int>(sample_.lattice.bonds.size()); ++b) add(b, sample_.lattice.bonds[b]);
    remove_dangling();
    remove_islands();
    out_.present.assign(out_.n_nodes, false);
    for (const LatticeElement<Dim>& e : out_.elements) out_.present[e.i] = out_.present[e.j] = true;
    for (int k = 0; k < out_.n_nodes; ++k)
      if (sample_.phase[k] != Phase::none && !out_.present[k]) ++out_.n_removed;
    if (boundary_ == LatticeBoundary::plates || boundary_ == LatticeBoundary::bonded_plates)
      out_.volume *= held_distance();
    return std::move(out_);
  }

 private:
  void add(int number, const LatticeBond<Dim>& bond) {
    const Phase a = sample_.phase[bond.i], b = sample_.phase[bond.j];
    if (a == Phase::none || b == Phase::none) return;
    if (boundary_ != LatticeBoundary::periodic && !bond.image.isZero()) return hold(bond);
    const bool one_grain = sample_.owner[bond.i] == sample_.owner[bond.j] &&
                           sample_.owner_image[bond.i] == sample_.owner_image[bond.j] + bond.image;
    const ElementKind kind = a != b                ? ElementKind::interface
                             : a == Phase::matrix ? ElementKind::matrix
                             : one_grain           ? ElementKind::grain
                                                   : ElementKind::bare;
    const bool bare = kind == ElementKind::bare;
    if (bare && (stiffness_.contact == BareContact::none || !in_patch(bond))) return;
    double k = stiffness_.of(kind);
    if (stiffness_.by_facet) k *= bond.facet / bond.branch.norm();
    if (k == 0.0) return;
    // The force of a central spring acts along the line between the nodes, wherever the face between their cells lies.
    const Vec<Dim> arm_i = stiffness_.central() ? Vec<Dim>(0.5 * bond.branch) : bond.arm_i;
    out_.elements.push_back({bond.i, bond.j, bond.image, bond.branch, arm_i, k, kind,
                             bare && stiffness_.contact == BareContact::unilateral, number});
  }

  /// Handles a bond that crosses the border of the cell: no element is made from the bond, and its two nodes are fixed
  /// as the boundary condition requires.
  void hold(const LatticeBond<Dim>& bond) {
    if (boundary_ == LatticeBoundary::uniform_strain) {
      for (const int node : {bond.i, bond.j})
        for (int a = 0; a < Dim; ++a) out_.held[Dim * node + a] = true;
    } else if (bond.image[axis_] != 0) {
      for (const int node : {bond.i, bond.j})
        for (int a = 0; a < Dim; ++a)
          if (a == axis_ || boundary_ == LatticeBoundary::bonded_plates) out_.held[Dim * node + a] = true;
    }
  }

  bool in_patch(const LatticeBond<Dim>& bond) const {
    if (!stiffness_.patch) return true;
    const Lattice<Dim>& lattice = sample_.lattice;
    const int i = sample_.owner[bond.i], j = sample_.owner[bond.j];
    const auto centre = [&](int node, int grain) -> Vec<Dim> {
      return sample_.grains.position[grain] + lattice.cell.shift(sample_.owner_image[node]);
    };
    const Vec<Dim> from = centre(bond.i, i);
    const Vec<Dim> line = (centre(bond.j, j) + lattice.cell.shift(bond.image) - from).normalized();
    const Vec<Dim> to_middle = lattice.node[bond.i] + 0.5 * bond.branch - from;
    const double ri = sample_.grains.radius[i], rj = sample_.grains.radius[j];
    return (to_middle - line * line.dot(to_middle)).norm() <= *stiffness_.patch * 2.0 * ri * rj / (ri + rj);
  }

  bool is_held(int node) const {
    if (out_.held.empty()) return false;
    for (int a = 0; a < Dim; ++a)
      if (out_.held[Dim * node + a]) return true;
    return false;
  }

  /// Returns the distance between the two layers of fixed nodes, divided by the length of the cell along the axis of
  /// the plates. The plates lie at the fixed nodes, half a layer of nodes inside the cell. The force on a plate is
  /// therefore the sum of the products of forces and branches divided by this distance, not by the length of the cell.
  double held_distance() const {
    std::array<double, 2> sum{};
    std::array<int, 2> n{};
    for (int k = 0; k < out_.n_nodes; ++k) {
      if (!out_.present[k] || !is_held(k)) continue;
      const double at = sample_.lattice.cell.reduced(sample_.lattice.node[k])[axis_];
      const int side = at < 0.5 ? 0 : 1;
      sum[side] += at;
      ++n[side];
    }
    if (n[0] == 0 || n[1] == 0) return 1.0;
    return sum[1] / n[1] - sum[0] / n[0];
  }

  /// The elements at one node: their number, the direction of the first element, and whether another element has a
  /// different direction.
  struct Holding {
    int count = 0;
    Vec<Dim> first = Vec<Dim>::Zero();
    bool spans = false;
  };

  /// Removes nodes that cannot carry any force, and their elements, until no such node is left. Fixed nodes are kept.
  void remove_dangling() {
    for (std::vector<bool> gone(out_.n_nodes, false);;) {
      const std::vector<Holding> holding = find_holding();
      bool any = false;
      for (int k = 0; k < out_.n_nodes; ++k)
        if (holding[k].count > 0 && !is_held(k) && dangles(holding[k])) gone[k] = any = true;
      if (!any) return;
      std::erase_if(out_.elements, [&](const LatticeElement<Dim>& e) { return gone[e.i] || gone[e.j]; });
    }
  }

  bool dangles(const Holding& h) const {
    if (h.count == 1) return true;
    // Two collinear central springs do not resist a force across the line on which they lie.
    return out_.central() && h.count == 2 && !h.spans;
  }

  std::vector<Holding> find_holding() const {
    std::vector<Holding> holding(out_.n_nodes);
    for (const LatticeElement<Dim>& e : out_.elements) {
      const Vec<Dim> direction = e.branch.normalized();
      for (const int node : {e.i, e.j}) {
        Holding& h = holding[node];
        if (h.count++ == 0)
          h.first = direction;
        else if (1.0 - std::abs(h.first.dot(direction)) > 0.5 * kCollinear * kCollinear)
          h.spans = true;
      }
    }
    return holding;
  }

  /// Removes connected parts of the network that cannot carry a load. These parts neither wind around the periodic cell
  /// nor connect the two fixed sides of the cell.
  void remove_islands() {
    const Parts parts = find_parts();
    std::vector<bool> carries(parts.winding.size(), false);
    int n_parts = 0, n_carrying = 0;
    for (std::size_t p = 0; p < parts.winding.size(); ++p) {
      ++n_parts;
      carries[p] =
          boundary_ == LatticeBoundary::periodic ? rank_of(parts.winding[p]) > 0 : parts.n_faces[p] == 3;
      if (!carries[p]) continue;
      ++n_carrying;
      out_.n_directions =
          boundary_ == LatticeBoundary::periodic ? std::max(out_.n_directions, rank_of(parts.winding[p])) : Dim;
    }
    out_.n_islands = n_parts - n_carrying;
    std::erase_if(out_.elements, [&](const LatticeElement<Dim>& e) { return !carries[parts.of[e.i]]; });
  }

  struct Parts {
    // for each node, the number of the connected part that contains it; -1 for nodes without elements
    std::vector<int> of;
    // for each connected part, linearly independent loops around the cell; each loop is given by the number of cells
    // that it crosses along each lattice vector
    std::vector<std::vector<Vec<Dim, int>>> winding;
    // for each connected part, the sum of two numbers: 1 if a fixed node of the part is in the lower half of the cell,
    // and 2 if a fixed node of the part is in the upper half
    std::vector<int> n_faces;
  };

  static int rank_of(const std::vector<Vec<Dim, int>>& winding) { return static_cast<int>(winding.size()); }

  /// Adds a loop around the cell to the loops found so far, if it is linearly independent of them.
  static void note_winding(const Vec<Dim, int>& loop, std::vector<Vec<Dim, int>>& found) {
    if (loop.isZero() || static_cast<int>(found.size()) == Dim) return;
    Eigen::Matrix<double, Dim, Eigen::Dynamic> all(Dim, found.size() + 1);
    for (std::size_t w = 0; w < found.size(); ++w) all.col(w) = found[w].template cast<double>();
    all.col(found.size()) = loop.template cast<double>();
    const double volume = (all.transpose() * all).determinant();
    if (volume > 0.5) found.push_back(loop);  // an integer, because the loops are vectors of integers
  }

  Parts find_parts() const {
    Parts parts;
    parts.of.assign(out_.n_nodes, -1);
    std::vector<int> start(out_.n_nodes + 1, 0), end_of;
    for (const LatticeElement<Dim>& e : out_.elements) ++start[e.i + 1], ++start[e.j + 1];
    for (int k = 0; k < out_.n_nodes; ++k) start[k + 1] += start[k];
    end_of.resize(start.back());
    std::vector<int> next(start.begin(), start.end() - 1);
    for (int e = 0; e < static_cast<int>(out_.elements.size()); ++e) {
      end_of[next[out_.elements[e].i]++] = e;
      end_of[next[out_.elements[e].j]++] = e;
    }
    std::vector<Vec<Dim, int>> cell(
        // for each node, the first of its periodic images that the search has reached
        out_.n_nodes, Vec<Dim, int>::Zero());
    for (int k = 0; k < out_.n_nodes; ++k) {
      if (parts.of[k] >= 0 || start[k] == start[k + 1]) continue;
      const int part = static_cast<int>(parts.winding.size());
      parts.winding.emplace_back();
      parts.n_faces.push_back(0);
      std::vector<int> open = {k};
      parts.of[k] = part;
      while (!open.empty()) {
        const int at = open.back();
        open.pop_back();
        parts.n_faces[part] |= faces_of(at);
        for (int n = start[at]; n < start[at + 1]; ++n) {
          const LatticeElement<Dim>& e = out_.elements[end_of[n]];
          const bool forward = e.i == at;
          const int other = forward ? e.j : e.i;
          const Vec<Dim, int> reached =
              forward ? Vec<Dim, int>(cell[at] + e.image) : Vec<Dim, int>(cell[at] - e.image);
          if (parts.of[other] < 0) {
            parts.of[other] = part;
            cell[other] = reached;
            open.push_back(other);
          } else {
            note_winding(reached - cell[other], parts.winding[part]);
          }
        }
      }
    }
    return parts;
  }

  /// Returns a number for the fixed sides of the cell to which a node belongs: 0 for a free node, 1 for a fixed node in
  /// the lower half of the cell, 2 for a fixed node in the upper half, and 3 (both sides) if the whole border is fixed.
  int faces_of(int node) const {
    if (!is_held(node)) return 0;
    if (boundary_ == LatticeBoundary::uniform_strain) return 3;
    return sample_.lattice.cell.reduced(sample_.lattice.node[node])[axis_] < 0.5 ? 1 : 2;
  }

  const CementedSample<Dim>& sample_;
  const ElementStiffness& stiffness_;
  LatticeBoundary boundary_;
  int axis_;
  LatticeNetwork<Dim> out_;
};

void check_stiffness(const char* name, double value, bool zero_allowed, std::vector<std::string>& faults) {
  if (ElementStiffness::kRange.holds(value) || (zero_allowed && value == 0.0)) return;
  if (std::isfinite(value) && value > 0.0)
    faults.push_back(fmt::format("{} = {}: must be {}", name, value, ElementStiffness::kRange.words()));
  else
    faults.push_back(fmt::format("{} = {}: must be {} and finite", name, value, zero_allowed ? ">= 0" : "> 0"));
}

}  // namespace

const char* name_of(ElementKind kind) {
  static constexpr std::array<const char*, kElementKinds> kNames = {"grain", "matrix", "interface", "contact"};
  return kNames[static_cast<std::size_t>(kind)];
}

double ElementStiffness::of(ElementKind kind) const {
  switch (kind) {
    case ElementKind::grain:
      return grain;
    case ElementKind::matrix:
      return matrix;
    case ElementKind::interface:
      return interface.value_or(2.0 * grain * matrix / (grain + matrix));
    case ElementKind::bare:
      return bare.value_or(grain);
  }
  return 0.0;
}

std::vector<std::string> ElementStiffness::validate() const {
  std::vector<std::string> faults;
  check_stiffness("stiffness of the grains", grain, false, faults);
  check_stiffness("stiffness of the matrix", matrix, false, faults);
  if (interface) check_stiffness("stiffness of the interface", *interface, true, faults);
  if (bare) check_stiffness("stiffness of bare contacts", *bare, true, faults);
  check_stiffness("shear", shear, true, faults);
  check_stiffness("bending", bending, true, faults);
  if (shear == 0.0 && bending > 0.0)
    faults.push_back(fmt::format(
        "bending = {}: elements that resist bending must also resist shear, so set shear > 0", bending));
  if (patch && !(std::isfinite(*patch) && *patch >= 0.0))
    faults.push_back(fmt::format("patch = {}: must be >= 0 and finite", *patch));
  if (!faults.empty()) return faults;
  double least = grain, most = grain;
  for (const ElementKind kind : {ElementKind::matrix, ElementKind::interface, ElementKind::bare})
    if (const double k = of(kind); k > 0.0) least = std::min(least, k), most = std::max(most, k);
  if (most > kLargestRatio * least)
    faults.push_back(fmt::format(
        "the stiffest elements are {:.3g} times as stiff as the softest: this ratio must be at most {:.0e}",
        most / least, kLargestRatio));
  return faults;
}

template <int Dim>
int LatticeNetwork<Dim>::count(ElementKind kind) const {
  return static_cast<int>(std::count_if(elements.begin(), elements.end(),
                                        [kind](const LatticeElement<Dim>& e) { return e.kind == kind; }));
}

template <int Dim>
LatticeNetwork<Dim> lattice_network(const CementedSample<Dim>& sample, const ElementStiffness& stiffness,
                                    LatticeBoundary boundary, int axis) {
  assert(axis >= 0 && axis < Dim);
  refuse_faults(stiffness.validate());
  return NetworkBuilder<Dim>(sample, stiffness, boundary, axis).build();
}

template <int Dim>
ContactNetwork<Dim> contact_network(const LatticeNetwork<Dim>& network, const std::vector<bool>& open) {
  ContactNetwork<Dim> out;
  out.n_grains = network.n_nodes;
  out.volume = network.volume;
  out.grain_size.assign(network.n_nodes, network.spacing);
  // The contact network represents the lattice without load, and all its contact forces are zero.
  for (int e = 0; e < static_cast<int>(network.elements.size()); ++e) {
    if (!open.empty() && open[e]) continue;
    const LatticeElement<Dim>& from = network.elements[e];
    NetworkContact<Dim> c{};
    c.i = from.i;
    c.j = from.j;
    c.image = from.image;
    c.branch = from.branch;
    c.arm_i = from.arm_i;
    c.arm_j = from.arm_i - from.branch;
    c.frame = contact_frame(Vec<Dim>(from.branch.normalized()));
    c.kn = from.kn;
    // Unilateral elements are contacts without friction: they have only a normal stiffness.
    if (!from.unilateral) {
      c.kt = network.shear * from.kn;
      c.kr = network.bending * from.kn * network.spacing * network.spacing;
    }
    c.shear_force.setZero();
    c.rolling_moment.setZero();
    c.source = e;
    out.contacts.push_back(c);
  }
  return out;
}

template struct LatticeNetwork<2>;
template struct LatticeNetwork<3>;
template LatticeNetwork<2> lattice_network(const CementedSample<2>&, const ElementStiffness&, LatticeBoundary,
                                           int);
template LatticeNetwork<3> lattice_network(const CementedSample<3>&, const ElementStiffness&, LatticeBoundary,
                                           int);
template ContactNetwork<2> contact_network(const LatticeNetwork<2>&, const std::vector<bool>&);
template ContactNetwork<3> contact_network(const LatticeNetwork<3>&, const std::vector<bool>&);

}  // namespace floc
