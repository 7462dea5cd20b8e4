#pragma once

#include <cmath>
#include <numbers>

#include "floc/shape/generators.h"
#include "floc/shape/placed_shape.h"
#include "unit/shape/solids.h"

/// Random pairs of shapes. Their separation is found by a search that does not use faces and edges.
namespace floc::test {

/// Returns the separation of two shapes along n: the lowest point of the second shape minus the highest point of the
/// first shape, both measured along n. The result is negative if the shapes overlap in this direction.
/// @param n  direction from the first shape to the second
template <int Dim>
double separation_along(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second, const Vec<Dim>& n) {
  const auto extent = [&](const PlacedShape<Dim>& one, const Vec<Dim>& direction) {
    const int v = lowest_vertex<Dim>(*one.shape, one.rotation.transpose() * direction);
    return direction.dot(one.position) +
           one.scale * direction.dot(one.rotation * core_vertex<Dim>(*one.shape, v)) - one.rounding();
  };
  return extent(second, n) + extent(first, -n);
}

/// Returns the largest separation over all directions: the distance of separate shapes, or minus the depth of
/// overlapping shapes. The search starts from many directions and improves each of them in decreasing steps.
template <int Dim>
double separation_by_search(const PlacedShape<Dim>& first, const PlacedShape<Dim>& second,
                            Vec<Dim>* normal = nullptr) {
  RandomStream random(77, 1);
  double best = -1e9;
  const Vec<Dim> towards = (second.position - first.position).normalized();
  for (int start = 0; start < 10; ++start) {
    const double spread = 0.8 * random.uniform();
    Vec<Dim> n = (towards + spread * random_direction<Dim>(random)).normalized();
    double here = separation_along(first, second, n);
    for (double step = 0.3; step > 1e-11; step *= 0.5) {
      bool is_better = true;
      while (is_better) {
        is_better = false;
        for (int k = 0; k < (Dim == 2 ? 4 : 8); ++k) {
          const Vec<Dim> other = (n + step * random_direction<Dim>(random)).normalized();
          const double there = separation_along(first, second, other);
          if (there > here + 1e-15) n = other, here = there, is_better = true;
        }
      }
    }
    if (here <= best) continue;
    best = here;
    if (normal != nullptr) *normal = n;
  }
  return best;
}

/// Returns the largest separation of two sharp polyhedra along certain directions: the normals of all faces and the
/// common normals of all pairs of edges, including pairs that cannot touch each other.
inline double separation_by_all_axes(const PlacedShape<3>& first, const PlacedShape<3>& second) {
  double most = -1e9;
  const auto try_axis = [&](const Vec<3>& n) { most = std::max(most, separation_along<3>(first, second, n)); };
  for (const Vec<3>& n : first.shape->normals) try_axis(first.rotation * n);
  for (const Vec<3>& n : second.shape->normals) try_axis(-(second.rotation * n));
  const auto along = [](const PlacedShape<3>& one, const ShapeEdge& e) {
    return Vec<3>(one.rotation * (one.shape->vertices[e.to] - one.shape->vertices[e.from]));
  };
  for (const ShapeEdge& e : first.shape->edges)
    for (const ShapeEdge& f : second.shape->edges) {
      const Vec<3> n = along(first, e).cross(along(second, f)).normalized();
      try_axis(n);
      try_axis(-n);
    }
  return most;
}

/// Two random shapes of diameters 1 and 1.3 with random rotations.
template <int Dim>
class RandomPair {
 public:
  RandomPair(RandomStream& random, double rounding)
      : a_(shape(random, rounding)),
        b_(shape(random, rounding)),
        turn_a_(random_turn<Dim>(random)),
        turn_b_(random_turn<Dim>(random)) {}

  /// Moves the second shape in a random direction from the first, until the largest separation along face normals is
  /// -depth. The separation along a common normal of two edges may be larger.
  void set_depth(RandomStream& random, double depth) {
    towards_ = random_direction<Dim>(random);
    double near = 0.0, far = 3.0;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (near + far);
      position_ = middle * towards_;
      (largest_separation() < -depth ? near : far) = middle;
    }
  }

  /// Moves the second shape until the largest separation along any direction is -depth, up to rounding.
  void set_true_depth(RandomStream& random, double depth) {
    set_depth(random, depth);
    for (int pass = 0; pass < 5; ++pass) {
      Vec<Dim> n = towards_;
      const double excess = separation_by_search(first(), second(), &n) + depth;
      if (std::abs(excess) < 1e-9) break;
      position_ -= excess / std::max(0.3, n.dot(towards_)) * towards_;
    }
  }

  PlacedShape<Dim> first() const { return {&a_, 1.0, Vec<Dim>::Zero(), turn_a_}; }
  PlacedShape<Dim> second() const { return {&b_, 1.3, position_, turn_b_}; }

 private:
  static Shape<Dim> shape(RandomStream& random, double rounding) {
    const auto seed = random.next();
    const int least = Dim == 2 ? 4 : 10, most = Dim == 2 ? 9 : 18;
    return random.below(2) == 0 ? cut_shapes<Dim>({least, most, 0.3}, 1, rounding, seed)[0]
                                : hull_shapes<Dim>({least, most, 1.3}, 1, rounding, seed)[0];
  }

  /// Returns the largest separation along the normals of all faces.
  double largest_separation() const {
    double most = -1e9;
    for (const Vec<Dim>& n : a_.normals)
      most = std::max(most, separation_along<Dim>(first(), second(), turn_a_ * n));
    for (const Vec<Dim>& n : b_.normals)
      most = std::max(most, separation_along<Dim>(first(), second(), -(turn_b_ * n)));
    return most;
  }

  Shape<Dim> a_, b_;
  Mat<Dim> turn_a_, turn_b_;
  Vec<Dim> position_ = Vec<Dim>::Zero();
  Vec<Dim> towards_ = Vec<Dim>::Unit(0);
};

}  // namespace floc::test
