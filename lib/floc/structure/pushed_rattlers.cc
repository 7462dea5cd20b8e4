#include "floc/structure/pushed_rattlers.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "floc/neighbors/pairs.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Ball that the centre of a rattler cannot enter. Its centre is the centre of another grain, and its radius is the sum
/// of the radii of that grain and of the rattler.
template <int Dim>
struct Obstacle {
  Vec<Dim> centre;
  double reach;
};

/// Half space of the points u with n . u >= low.
template <int Dim>
struct HalfSpace {
  Vec<Dim> n;
  double low;
};

/// Advances `choice` to the next combination of Dim ascending indices below n.
/// @return false after the last combination
template <int Dim>
bool next_choice(std::array<int, Dim>& choice, int n) {
  for (int a = Dim - 1; a >= 0; --a) {
    if (++choice[a] > n - Dim + a) continue;
    for (int b = a + 1; b < Dim; ++b) choice[b] = choice[b - 1] + 1;
    return true;
  }
  return false;
}

/// Returns the corner that lies furthest along a direction, among the corners of the intersection of half spaces. There
/// are only a few corners, so the function tries all of them.
/// @pre The intersection is bounded and contains the origin.
template <int Dim>
Vec<Dim> furthest_corner(const std::vector<HalfSpace<Dim>>& spaces, const Vec<Dim>& direction, double length) {
  const auto n = static_cast<int>(spaces.size());
  const double slack = 1e-14 * length;
  Vec<Dim> best = Vec<Dim>::Zero();
  std::array<int, Dim> choice;
  for (int a = 0; a < Dim; ++a) choice[a] = a;
  do {
    Mat<Dim> normals;
    Vec<Dim> low;
    for (int a = 0; a < Dim; ++a) normals.row(a) = spaces[choice[a]].n, low[a] = spaces[choice[a]].low;
    if (std::abs(normals.determinant()) < 1e-9) continue;
    const Vec<Dim> corner = normals.inverse() * low;
    if (!(direction.dot(corner) > direction.dot(best))) continue;
    const bool inside = std::all_of(spaces.begin(), spaces.end(),
                                    [&](const HalfSpace<Dim>& s) { return s.n.dot(corner) >= s.low - slack; });
    if (inside) best = corner;
  } while (next_choice<Dim>(choice, n));
  return best;
}

/// Pushes a point from the origin along a direction until obstacles, which are balls, stop the point. In each step, a
/// half space replaces each ball. The half space contains the ball, and its boundary touches the ball at the place
/// nearest to the point. The point makes the longest move along the direction outside all of these half spaces, found
/// by linear programming, and therefore never enters a ball. The positions converge quadratically to a corner between
/// balls.
/// @return place where the point stops; no value if the point moves further than `length`
template <int Dim>
std::optional<Vec<Dim>> pushed(const std::vector<Obstacle<Dim>>& obstacles, const Vec<Dim>& direction,
                               double length) {
  constexpr int kMaxSteps = 200;
  Vec<Dim> x = Vec<Dim>::Zero();
  for (int step = 0; step < kMaxSteps; ++step) {
    const double room = 0.5 * length;
    std::vector<HalfSpace<Dim>> spaces;
    for (int a = 0; a < Dim; ++a)
      for (const double sign : {1.0, -1.0}) spaces.push_back({sign * Vec<Dim>::Unit(a), -room});
    for (const Obstacle<Dim>& o : obstacles) {
      const Vec<Dim> away = x - o.centre;
      const double gap = away.norm() - o.reach;
      if (gap < std::sqrt(static_cast<double>(Dim)) * room)
        spaces.push_back({away.normalized(), -std::max(gap, 0.0)});
    }
    const Vec<Dim> move = furthest_corner(spaces, direction, length);
    x += move;
    if (x.norm() > length) return std::nullopt;
    if (move.norm() < 1e-14 * length) return x;
  }
  return x;
}

/// Returns the direction in which a rattler is pushed: the unit vector towards the nearest obstacle plus half the unit
/// vector towards the second-nearest obstacle, normalised.
template <int Dim>
Vec<Dim> push_direction(std::vector<Obstacle<Dim>>& obstacles) {
  std::sort(obstacles.begin(), obstacles.end(), [](const Obstacle<Dim>& p, const Obstacle<Dim>& q) {
    return p.centre.norm() - p.reach < q.centre.norm() - q.reach;
  });
  Vec<Dim> direction = obstacles[0].centre.normalized();
  if (obstacles.size() > 1) direction += 0.5 * obstacles[1].centre.normalized();
  return direction.normalized();
}

}  // namespace

template <int Dim>
Packing<Dim> with_pushed_rattlers(const Packing<Dim>& packing, const std::vector<bool>& rattler) {
  assert(static_cast<int>(rattler.size()) == packing.grains.size());
  Packing<Dim> out = packing;
  const Grains<Dim>& g = packing.grains;
  if (std::find(rattler.begin(), rattler.end(), true) == rattler.end()) return out;
  const double a = largest_diameter(g);
  const double travel = 2.0 * a;
  std::vector<std::vector<Obstacle<Dim>>> around(g.size());
  for (const NeighborPair<Dim>& pair : find_pairs(packing.cell, g, travel, most_pairs_in_memory(g.size()))) {
    if (rattler[pair.i] == rattler[pair.j]) continue;
    const Vec<Dim> r = g.position[pair.j] + packing.cell.shift(pair.image) - g.position[pair.i];
    const double reach = g.radius[pair.i] + g.radius[pair.j];
    if (rattler[pair.i])
      around[pair.i].push_back({r, reach});
    else
      around[pair.j].push_back({-r, reach});
  }
  for (int i = 0; i < g.size(); ++i) {
    if (around[i].empty()) continue;
    const Vec<Dim> direction = push_direction(around[i]);
    if (const auto moved = pushed(around[i], direction, travel))
      out.grains.position[i] = packing.cell.wrapped(g.position[i] + *moved);
  }
  return out;
}

template Packing<2> with_pushed_rattlers(const Packing<2>&, const std::vector<bool>&);
template Packing<3> with_pushed_rattlers(const Packing<3>&, const std::vector<bool>&);

}  // namespace floc
