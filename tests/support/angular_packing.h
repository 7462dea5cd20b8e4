#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <random>
#include <tuple>
#include <vector>

#include "floc/packing/balance.h"
#include "floc/rigid/contact_points.h"
#include "floc/shape/generators.h"
#include "support/foreign_packing.h"

/// Packings of grains with corners, whose contacts have forces. Tests write these packings in the formats of other
/// programs.
namespace floc::test {

/// Returns five different shapes; one of them is a disk or sphere, and one is a capsule.
template <int Dim>
std::vector<Shape<Dim>> rounded_shapes() {
  std::vector<Shape<Dim>> shapes = cut_shapes<Dim>({}, 3, 0.1, 7);
  shapes.push_back(round_shape<Dim>(0.5));
  shapes.push_back(capsule_shape<Dim>(0.2, 0.4));
  return shapes;
}

/// Moves each open end of an axis to the outermost point of the grains.
template <int Dim>
void set_open_ends(Packing<Dim>& p) {
  for (Wall<Dim>& wall : p.walls) {
    if (!wall.open) continue;
    double furthest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < p.grains.size(); ++i) {
      const PlacedShape<Dim> placed = p.grains.placed(i);
      for (int v = 0; v < std::max(1, placed.shape->n_vertices()); ++v) {
        const Vec<Dim> x = placed.position + placed.scale * (placed.rotation * core_vertex(*placed.shape, v));
        furthest = std::max(furthest, wall.side * x[wall.axis] + placed.rounding());
      }
    }
    wall.position = wall.side * furthest;
  }
  for (std::size_t w = 0; w + 1 < p.walls.size(); w += 2)
    p.cell.matrix(p.walls[w].axis, p.walls[w].axis) = p.walls[w + 1].position - p.walls[w].position;
}

/// Returns randomly rotated grains with corners in a box of four diameters, with random forces on their
/// contacts.
/// @param ends  ends of the axes: see Ends
template <int Dim>
State<Dim> angular_packing_with_forces(const Ends<Dim>& ends,
                                       std::vector<Shape<Dim>> shapes = rounded_shapes<Dim>()) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  State<Dim> state = packing_with_forces<Dim>(ends);
  Packing<Dim>& p = state.packing;
  Grains<Dim>& g = p.grains;
  g.shapes = std::make_shared<const std::vector<Shape<Dim>>>(std::move(shapes));
  for (int i = 0; i < g.size(); ++i) {
    g.shape.push_back(i % static_cast<int>(g.shapes->size()));
    const double outer = (*g.shapes)[g.shape[i]].outer_radius;
    g.scale.push_back((0.52 + 0.02 * unit(random)) / outer);
    g.radius[i] = g.scale[i] * outer;
    g.mass[i] = 2.0 * g.volume(i);
    if constexpr (Dim == 2)
      g.orientation[i] = 6.0 * unit(random) - 3.0;
    else
      g.orientation[i] =
          Eigen::Quaterniond(Eigen::Vector4d::NullaryExpr([&] { return unit(random) - 0.5; })).normalized();
  }
  set_open_ends(p);
  p.contacts = ContactPoints<Dim>().find(p, 0.0);
  for (Contact<Dim>& c : p.contacts) {
    c.normal_force = c.elastic_force = 0.1 + unit(random);
    Vec<Dim> t = Vec<Dim>::NullaryExpr([&] { return unit(random) - 0.5; });
    t -= c.normal * c.normal.dot(t);
    c.shear_force = 0.3 * c.normal_force * t;
  }
  measure(state);
  return state;
}

/// Returns the contacts of a packing in an order that does not depend on their keys.
template <int Dim>
std::vector<Contact<Dim>> in_order_of_place(std::vector<Contact<Dim>> contacts) {
  const auto place = [](const Contact<Dim>& c) {
    return std::tuple(c.i, c.j, std::vector(c.image.begin(), c.image.end()), c.arm_i[0] + 0.7 * c.arm_i[1]);
  };
  std::ranges::sort(contacts,
                    [&](const Contact<Dim>& a, const Contact<Dim>& b) { return place(a) < place(b); });
  return contacts;
}

/// Expects that two packings are equal: the shapes in space, masses and moments of inertia of the grains, and the
/// points, normals, gaps and forces of the contacts.
/// @param tolerance  largest accepted difference between two coordinates, or between two forces divided by the largest
/// force
template <int Dim>
void expect_same_angular_packing(const Packing<Dim>& read, const Packing<Dim>& written, double tolerance) {
  ASSERT_FALSE(read.grains.are_round());
  ASSERT_EQ(read.grains.size(), written.grains.size());
  ASSERT_EQ(read.walls.size(), written.walls.size());
  for (std::size_t w = 0; w < read.walls.size(); ++w)
    EXPECT_NEAR(read.walls[w].position, written.walls[w].position, tolerance) << w;
  for (int i = 0; i < read.grains.size(); ++i) {
    const PlacedShape<Dim> a = read.grains.placed(i), b = written.grains.placed(i);
    EXPECT_NEAR(read.grains.mass[i], written.grains.mass[i], tolerance * written.grains.mass[i]);
    EXPECT_NEAR(a.outer_radius(), b.outer_radius(), tolerance);
    EXPECT_NEAR(a.rounding(), b.rounding(), tolerance);
    EXPECT_NEAR((read.grains.inertia_tensor(i) - written.grains.inertia_tensor(i)).norm(), 0.0,
                10 * tolerance * written.grains.inertia_tensor(i).norm());
    // each vertex must have a counterpart at the same position, up to lattice vectors
    ASSERT_EQ(a.shape->n_vertices(), b.shape->n_vertices());
    for (const Vec<Dim>& vertex : a.shape->vertices) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec<Dim>& other : b.shape->vertices)
        nearest = std::min(nearest, (a.scale * (a.rotation * vertex) - b.scale * (b.rotation * other)).norm());
      EXPECT_LE(nearest, tolerance) << i;
    }
  }
  const auto of_read = in_order_of_place(read.contacts), of_written = in_order_of_place(written.contacts);
  ASSERT_EQ(of_read.size(), of_written.size());
  for (std::size_t k = 0; k < of_read.size(); ++k) {
    const Contact<Dim>&a = of_read[k], &b = of_written[k];
    ASSERT_EQ(std::tuple(a.i, a.j), std::tuple(b.i, b.j)) << k;
    EXPECT_EQ(a.image, b.image) << k;
    EXPECT_EQ(a.type, b.type) << k;
    EXPECT_NEAR(a.gap, b.gap, tolerance) << k;
    EXPECT_NEAR((a.normal - b.normal).norm(), 0.0, tolerance) << k;
    EXPECT_NEAR((a.arm_i - b.arm_i).norm(), 0.0, tolerance) << k;
    EXPECT_NEAR((a.arm_j - b.arm_j).norm(), 0.0, tolerance) << k;
    EXPECT_NEAR(a.normal_force, b.normal_force, tolerance) << k;
    EXPECT_NEAR((a.shear_force - b.shear_force).norm(), 0.0, tolerance) << k;
  }
}

}  // namespace floc::test
