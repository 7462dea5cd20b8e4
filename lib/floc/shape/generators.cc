#include "floc/shape/generators.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "floc/base/error.h"
#include "floc/base/random.h"
#include "floc/base/range.h"
#include "floc/shape/half_spaces.h"
#include "floc/shape/random_streams.h"
#include "floc/shape/voronoi_cells.h"

namespace floc {
namespace {

constexpr WholeRange kCounts{.least = 1, .most = 100000};
constexpr NumberRange kRounding{.least = 0.0, .most = 0.45};
/// Largest number of random draws for one shape. If none of them gives a valid shape, an error is reported.
constexpr int kMostDraws = 200;

void add_fault(std::vector<std::string>& faults, std::string fault) {
  if (!fault.empty()) faults.push_back(std::move(fault));
}

std::vector<std::string> interval_faults(const std::string& key, int least, int most, const WholeRange& range) {
  std::vector<std::string> faults;
  add_fault(faults, range_fault(key + "[0]", std::int64_t{least}, range));
  add_fault(faults, range_fault(key + "[1]", std::int64_t{most}, range));
  if (faults.empty() && least > most)
    faults.push_back(fmt::format("{} = [{}, {}]: expected the smaller number first", key, least, most));
  return faults;
}

template <int Dim>
Vec<Dim> direction(RandomStream& random) {
  if constexpr (Dim == 2) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    return {std::cos(angle), std::sin(angle)};
  } else {
    const double z = random.uniform(-1.0, 1.0), angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const double rho = std::sqrt(1.0 - z * z);
    return {rho * std::cos(angle), rho * std::sin(angle), z};
  }
}

/// Returns n random unit vectors. Their mutual distances are at least half the mean spacing of n points on the unit
/// sphere (2D: unit circle). Discs with this least distance as diameter cover a fifth of the sphere (2D: arcs cover
/// half of the circle), so random draws usually find free places.
template <int Dim>
std::vector<Vec<Dim>> spread_directions(RandomStream& random, int n) {
  const double least = 0.5 * (Dim == 2 ? 2.0 * std::numbers::pi / n : std::sqrt(4.0 * std::numbers::pi / n));
  for (;;) {
    std::vector<Vec<Dim>> chosen;
    // If the vectors drawn first leave no room for more vectors, all vectors are drawn again.
    for (int trial = 0; trial < 1000 * n && static_cast<int>(chosen.size()) < n; ++trial) {
      const Vec<Dim> u = direction<Dim>(random);
      bool is_free = true;
      for (const Vec<Dim>& v : chosen) is_free = is_free && (u - v).norm() >= least;
      if (is_free) chosen.push_back(u);
    }
    if (static_cast<int>(chosen.size()) == n) return chosen;
  }
}

int uniform_integer(RandomStream& random, int least, int most) {
  const int n_values = most - least + 1;
  return least + static_cast<int>(random.below(static_cast<std::uint64_t>(n_values)));
}

/// Returns `count` shapes. For each shape, `draw` makes a set of points from a random stream, and the shape is the
/// convex hull of the set. If a set gives no valid shape, for example because it is almost flat, a new set is drawn.
template <int Dim, class Draw>
std::vector<Shape<Dim>> drawn_shapes(int count, double rounding, std::uint64_t seed, std::uint64_t purpose,
                                     const Draw& draw) {
  require_in_range("count", std::int64_t{count}, kCounts);
  require_in_range("rounding", rounding, kRounding);
  RandomStream random(seed, purpose);
  std::vector<Shape<Dim>> shapes;
  while (static_cast<int>(shapes.size()) < count) {
    std::string reason = "the intersection of the half-spaces is not bounded";
    bool found = false;
    for (int k = 0; k < kMostDraws && !found; ++k) {
      const std::optional<std::vector<Vec<Dim>>> points = draw(random);
      if (!points) continue;
      try {
        shapes.push_back(with_unit_diameter<Dim>(convex_hull<Dim>(*points).polytope, rounding));
        found = true;
      } catch (const InputError& error) {
        reason = error.what();
      }
    }
    if (!found)
      throw InputError(
          "",
          fmt::format("grains.shape: none of {} random draws gave a valid shape; problem of the last draw: {}",
                      kMostDraws, reason));
  }
  return shapes;
}

}  // namespace

Shape<2> regular_polygon(int sides, double rounding) {
  require_in_range("sides", std::int64_t{sides}, {.least = 3, .most = kMostVertices});
  require_in_range("rounding", rounding, kRounding);
  std::vector<Vec<2>> points;
  for (int k = 0; k < sides; ++k) {
    const double angle = std::numbers::pi * (0.5 + 2.0 * k / sides);
    points.emplace_back(std::cos(angle), std::sin(angle));
  }
  return with_unit_diameter<2>(convex_hull<2>(points).polytope, rounding);
}

template <int Dim>
Shape<Dim> box(const Vec<Dim>& sides, double rounding) {
  for (int a = 0; a < Dim; ++a) require_in_range(fmt::format("sides[{}]", a), sides[a], kPositiveNumber);
  require_in_range("rounding", rounding, kRounding);
  const Vec<Dim> halves = 0.5 * sides / sides.maxCoeff();
  std::vector<Vec<Dim>> points;
  for (int k = 0; k < (1 << Dim); ++k) {
    Vec<Dim> p = halves;
    for (int a = 0; a < Dim; ++a)
      if ((k >> a & 1) == 0) p[a] = -p[a];
    points.push_back(p);
  }
  return with_unit_diameter<Dim>(convex_hull<Dim>(points).polytope, rounding);
}

template <int Dim>
Shape<Dim> capsule(double aspect) {
  require_in_range("aspect", aspect, {.least = 1.0, .most = 20.0});
  if (aspect == 1.0) return round_shape<Dim>(0.5);
  return capsule_shape<Dim>(1.0 - 1.0 / aspect, 0.5 / aspect);
}

std::vector<std::string> HullOptions::validate(int dim) const {
  std::vector<std::string> found =
      interval_faults("vertices", least_vertices, most_vertices, {.least = dim + 1, .most = kMostVertices});
  add_fault(found, range_fault("aspect", aspect, {.least = 1.0, .most = 10.0}));
  return found;
}

template <int Dim>
std::vector<Shape<Dim>> hull_shapes(const HullOptions& options, int count, double rounding,
                                    std::uint64_t seed) {
  refuse_faults(options.validate(Dim));
  return drawn_shapes<Dim>(count, rounding, seed, kHullStream, [&](RandomStream& random) {
    const int n = uniform_integer(random, options.least_vertices, options.most_vertices);
    std::vector<Vec<Dim>> points = spread_directions<Dim>(random, n);
    for (Vec<Dim>& p : points) p[0] *= options.aspect;
    return std::optional(points);
  });
}

std::vector<std::string> CutOptions::validate(int dim) const {
  std::vector<std::string> found =
      interval_faults("faces", least_faces, most_faces, {.least = dim + 1, .most = kMostVertices / 2});
  add_fault(found, range_fault("spread", spread, {.least = 0.0, .most = 1.0}));
  return found;
}

template <int Dim>
std::vector<Shape<Dim>> cut_shapes(const CutOptions& options, int count, double rounding, std::uint64_t seed) {
  refuse_faults(options.validate(Dim));
  return drawn_shapes<Dim>(count, rounding, seed, kCutStream, [&](RandomStream& random) {
    const int n = uniform_integer(random, options.least_faces, options.most_faces);
    std::vector<HalfSpace<Dim>> half_spaces;
    for (const Vec<Dim>& u : spread_directions<Dim>(random, n))
      half_spaces.push_back({u, 1.0 + random.uniform(-0.5, 0.5) * options.spread});
    return intersection_vertices<Dim>(half_spaces);
  });
}

std::vector<std::string> VoronoiOptions::validate() const {
  std::vector<std::string> found;
  add_fault(found, range_fault("cells", std::int64_t{cells}, {.least = 8, .most = 5000}));
  add_fault(found, range_fault("relaxed", std::int64_t{relaxed}, {.least = 0, .most = 100}));
  return found;
}

template <int Dim>
std::vector<Shape<Dim>> voronoi_shapes(const VoronoiOptions& options, int count, double rounding,
                                       std::uint64_t seed) {
  refuse_faults(options.validate());
  if (count > options.cells)
    throw InputError(
        "", fmt::format("count = {}: expected at most {}, the number of Voronoi cells", count, options.cells));
  const auto cells = voronoi_cells<Dim>(options.cells, options.relaxed, seed);
  std::size_t next = 0;
  // A Voronoi cell that is too thin for a shape is skipped; the next cell replaces it.
  return drawn_shapes<Dim>(count, rounding, seed, kVoronoiStream, [&](RandomStream&) {
    return next < cells.size() ? std::optional(cells[next++]) : std::nullopt;
  });
}

template Shape<2> box(const Vec<2>&, double);
template Shape<3> box(const Vec<3>&, double);
template Shape<2> capsule(double);
template Shape<3> capsule(double);
template std::vector<Shape<2>> hull_shapes(const HullOptions&, int, double, std::uint64_t);
template std::vector<Shape<3>> hull_shapes(const HullOptions&, int, double, std::uint64_t);
template std::vector<Shape<2>> cut_shapes(const CutOptions&, int, double, std::uint64_t);
template std::vector<Shape<3>> cut_shapes(const CutOptions&, int, double, std::uint64_t);
template std::vector<Shape<2>> voronoi_shapes(const VoronoiOptions&, int, double, std::uint64_t);
template std::vector<Shape<3>> voronoi_shapes(const VoronoiOptions&, int, double, std::uint64_t);

}  // namespace floc
