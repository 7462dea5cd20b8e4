#include "floc/structure/pores.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/base/disjoint_sets.h"
#include "floc/neighbors/pairs.h"
#include "floc/network/components.h"
#include "floc/packing/contact_order.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Edge of the network of interactions, from the centre of grain i to the centre of a periodic image of grain j.
struct Edge {
  int i, j;
  Vec<2, int> image;
  Vec<2> branch;
};

std::vector<Edge> edges_of(const Packing<2>& packing, DisjointSets& sets) {
  std::vector<Edge> edges;
  const Contact<2>* previous = nullptr;
  for (const Contact<2>& c : packing.contacts) {
    const bool again = previous != nullptr && same_pair(*previous, c);
    previous = &c;
    // There is already an edge for this pair of grains; c is a further contact point of the same pair.
    if (again) continue;
    edges.push_back({c.i, c.j, c.image, branch(packing, c)});
    sets.join(c.i, c.j);
  }
  return edges;
}

/// Joins separate parts of the network by edges across the shortest gaps between the parts, as in a minimal spanning
/// tree. These edges cross no grain and no other edge.
void bridge(const Packing<2>& packing, DisjointSets& sets, std::vector<Edge>& edges) {
  const Grains<2>& g = packing.grains;
  struct Gap {
    double size;
    Edge edge;
  };
  const double a = largest_diameter(g);
  const double longest = packing.cell.matrix.rowwise().norm().sum();
  for (double reach = 0.1 * a; sets.n_sets() > 1; reach = std::min(2.0 * reach, longest)) {
    std::vector<Gap> gaps;
    for (const NeighborPair<2>& p : find_pairs(packing.cell, g, reach)) {
      const Vec<2> r = g.position[p.j] + packing.cell.shift(p.image) - g.position[p.i];
      gaps.push_back({r.norm() - g.radius[p.i] - g.radius[p.j], {p.i, p.j, p.image, r}});
    }
    std::stable_sort(gaps.begin(), gaps.end(), [](const Gap& p, const Gap& q) { return p.size < q.size; });
    for (const Gap& gap : gaps)
      if (sets.join(gap.edge.i, gap.edge.j)) edges.push_back(gap.edge);
    if (reach == longest) return;
  }
}

/// Integrals of 1, x and x.x over a region, with x the vector from a fixed origin.
struct AreaMoments {
  double area = 0.0;
  Vec<2> first = Vec<2>::Zero();
  double second = 0.0;

  /// Adds the moments of the triangle (origin, p, q), with negative sign if its corners are clockwise.
  void add_triangle(const Vec<2>& p, const Vec<2>& q) {
    const double cross = p[0] * q[1] - p[1] * q[0];
    area += cross / 2.0;
    first += cross / 6.0 * (p + q);
    second += cross / 12.0 * (p.dot(p) + p.dot(q) + q.dot(q));
  }

  void add(const AreaMoments& other) {
    area += other.area;
    first += other.first;
    second += other.second;
  }

  /// Subtracts a sector of a disk of radius R about c, which begins at direction `from` and extends
  /// counter-clockwise by `angle` (radians).
  void remove_sector(const Vec<2>& c, double R, double from, double angle) {
    const double s = 0.5 * R * R * angle;
    const double to = from + angle;
    const Vec<2> m = R * R * R / 3.0 * Vec<2>(std::sin(to) - std::sin(from), std::cos(from) - std::cos(to));
    area -= s;
    first -= s * c + m;
    second -= s * c.squaredNorm() + 2.0 * m.dot(c) + 0.25 * R * R * R * R * angle;
  }
};

/// Face of the network of interactions. The moments are integrals over the part of the face outside the disks.
struct Face {
  AreaMoments moments;   // moments of area about `origin`
  double polygon = 0.0;  // signed area of the polygon of grain centres around the face
  Vec<2> origin;         // centre of the first grain
  std::vector<int> grains;
  bool winds = false;  // whether the face winds around the periodic cell
};

/// Finds the faces of a network of edges in the periodic cell by a walk around each face. Every edge e consists of two
/// half edges: half edge 2e from grain i to grain j, and half edge 2e + 1 from j to i.
class FaceWalk {
 public:
  FaceWalk(const Packing<2>& packing, const std::vector<Edge>& edges)
      : packing_(packing), edges_(edges), angle_(2 * edges.size()), next_(2 * edges.size()) {
    std::vector<std::vector<int>> out(packing.grains.size());
    for (int h = 0; h < n_half_edges(); ++h) {
      const Vec<2> r = direction(h);
      angle_[h] = std::atan2(r[1], r[0]);
      out[origin(h)].push_back(h);
    }
    for (std::vector<int>& around : out) {
      std::sort(around.begin(), around.end(), [&](int p, int q) { return angle_[p] < angle_[q]; });
      // A walk that arrives along the opposite of half edge `around[k]` continues along the half edge that follows
      // `around[k]` in clockwise order. The face is therefore always on the left of the walk.
      const std::size_t n = around.size();
      for (std::size_t k = 0; k < n; ++k) next_[twin(around[k])] = around[(k + n - 1) % n];
    }
  }

  std::vector<Face> faces() const {
    std::vector<Face> found;
    std::vector<bool> visited(edges_.size() * 2, false);
    for (int h = 0; h < n_half_edges(); ++h)
      if (!visited[h]) found.push_back(follow(h, visited));
    return found;
  }

 private:
  int n_half_edges() const { return 2 * static_cast<int>(edges_.size()); }
  static int twin(int h) { return h ^ 1; }
  int origin(int h) const { return h % 2 == 0 ? edges_[h / 2].i : edges_[h / 2].j; }
  int sign(int h) const { return h % 2 == 0 ? 1 : -1; }
  Vec<2> direction(int h) const { return sign(h) * edges_[h / 2].branch; }

  Face follow(int start, std::vector<bool>& visited) const {
    Face face;
    face.origin = packing_.grains.position[origin(start)];
    Vec<2> at = Vec<2>::Zero();
    CellCount<2> winding = CellCount<2>::Zero();
    AreaMoments polygon;
    int h = start;
    do {
      visited[h] = true;
      face.grains.push_back(origin(h));
      const Vec<2> to = at + direction(h);
      polygon.add_triangle(at, to);
      winding += sign(h) * edges_[h / 2].image.cast<std::int64_t>();
      const int after = next_[h];
      double angle = angle_[twin(h)] - angle_[after];
      // At a dead end, the walk turns back, and the angle of the sector is the full angle.
      if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
      face.moments.remove_sector(to, packing_.grains.radius[origin(after)], angle_[after], angle);
      at = to;
      h = after;
    } while (h != start);
    face.polygon = polygon.area;
    face.moments.add(polygon);
    face.winds = !winding.isZero();
    return face;
  }

  const Packing<2>& packing_;
  const std::vector<Edge>& edges_;
  std::vector<double> angle_;
  std::vector<int> next_;
};

/// Removes unbounded faces, and sets `unbounded` if there are any. There are two kinds: faces that wind around the
/// cell, and the outside of a network that does not span the cell. Euler's formula shows whether edges cross, and
/// distinguishes a network that spans the cell from a network that does not.
/// @return false if the edges cross
bool remove_unbounded(double area, int n_grains, int n_edges, std::vector<Face>& faces, bool& unbounded) {
  constexpr double kWhole = 1e-6;
  const int euler = n_grains - n_edges + static_cast<int>(faces.size());
  double covered = 0.0;
  for (const Face& face : faces) covered += face.polygon;
  if (std::erase_if(faces, [](const Face& face) { return face.winds; }) > 0) {
    unbounded = true;
    return euler == 2;
  }
  if (euler == 2 && std::abs(covered) < kWhole * area) {
    unbounded = true;
    faces.erase(std::min_element(faces.begin(), faces.end(),
                                 [](const Face& p, const Face& q) { return p.polygon < q.polygon; }));
    return true;
  }
  return euler == 0 && std::abs(covered - area) < kWhole * area;
}

void summarise(Pores& out) {
  double second = 0.0;
  for (const Pore& p : out.pores) {
    out.total_area += p.area;
    second += p.area * p.gyration_radius * p.gyration_radius;
  }
  if (out.pores.empty()) return;
  out.size = std::sqrt(second / out.total_area);
  out.mean_area = out.total_area / static_cast<double>(out.pores.size());
}

}  // namespace

Pores find_pores(const Packing<2>& packing) {
  Pores out;
  const int n = packing.grains.size();
  if (n == 0) return out;
  DisjointSets sets(n);
  std::vector<Edge> edges = edges_of(packing, sets);
  bridge(packing, sets, edges);
  if (edges.empty()) {  // the packing is a single grain without contacts
    out.unbounded = true;
    return out;
  }
  std::vector<Face> faces = FaceWalk(packing, edges).faces();
  if (!remove_unbounded(packing.cell.volume(), n, static_cast<int>(edges.size()), faces, out.unbounded)) {
    out.failure_reason =
        "pores cannot be identified, because lines between the centres of touching grains cross each other";
    return out;
  }
  for (Face& face : faces) {
    const AreaMoments& m = face.moments;
    if (m.area <= 0.0) continue;  // the pore is filled by overlapping disks
    const Vec<2> centre = m.first / m.area;
    const double gyration2 = std::max(0.0, m.second / m.area - centre.squaredNorm());
    out.pores.push_back(
        {m.area, std::sqrt(gyration2), packing.cell.wrapped(face.origin + centre), std::move(face.grains)});
  }
  summarise(out);
  return out;
}

}  // namespace floc
