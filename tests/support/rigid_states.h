#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "floc/contact/law_parameters.h"
#include "floc/packing/state.h"
#include "floc/rigid/contact_points.h"
#include "floc/shape/generators.h"

/// States of rigid grains whose forces have closed forms.
namespace floc::test {

inline Law rigid_law(double friction, std::optional<double> adhesion = std::nullopt) {
  LawParameters law;
  law.normal = RigidContact{};
  law.friction = RigidFriction{friction};
  if (adhesion) law.adhesion = ConstantAdhesion{*adhesion};
  return law;
}

/// Adds all contacts with gaps of at most 1e-9 to a packing, and measures the state under an isotropic pressure.
/// @param force  function that returns the normal force of a contact
template <int Dim, class Force>
void load_contacts(State<Dim>& state, double pressure, const Force& force) {
  Packing<Dim>& packing = state.packing;
  packing.contacts = ContactPoints<Dim>().find(packing, 1e-9);
  for (Contact<Dim>& c : packing.contacts) c.normal_force = c.elastic_force = force(c);
  state.target_stress.setConstant(pressure);
  measure(state);
}

/// Triangular crystal of disks of diameter 1, with four disks in each of four rows. The force on each contact is
/// P/sqrt(3).
inline State<2> triangular_crystal(double pressure, double friction) {
  State<2> state;
  state.packing.law = rigid_law(friction);
  const double height = std::sqrt(0.75);
  state.packing.cell.matrix << 4.0, 0.0, 0.0, 4.0 * height;
  state.packing.grains = Grains<2>::with_size(16);
  Grains<2>& g = state.packing.grains;
  for (int i = 0; i < 16; ++i) {
    g.position[i] = Vec<2>(0.25 + i % 4 + 0.5 * (i / 4 % 2), (0.25 + i / 4) * height);
    g.radius[i] = 0.5;
    g.mass[i] = 1.0;
  }
  load_contacts(state, pressure, [&](const Contact<2>&) { return pressure / std::sqrt(3.0); });
  return state;
}

/// Simple cubic crystal of 27 spheres of diameter 1. The force on each contact is P.
inline State<3> cubic_crystal(double pressure, double friction) {
  State<3> state;
  state.packing.law = rigid_law(friction);
  state.packing.cell.matrix = 3.0 * Mat<3>::Identity();
  state.packing.grains = Grains<3>::with_size(27);
  Grains<3>& g = state.packing.grains;
  for (int i = 0; i < 27; ++i) {
    g.position[i] = Vec<3>(0.5 + i % 3, 0.5 + i / 3 % 3, 0.5 + i / 9);
    g.radius[i] = 0.5;
    g.mass[i] = 1.0;
  }
  load_contacts(state, pressure, [&](const Contact<3>&) { return pressure; });
  return state;
}

/// Gives all grains of a packing one shape.
/// @param scale  diameter of the circumscribed circle or sphere of each grain (length), if `shape` has the diameter 1
template <int Dim>
void set_shape(Grains<Dim>& grains, const Shape<Dim>& shape, double scale) {
  grains.shapes = std::make_shared<const std::vector<Shape<Dim>>>(1, shape);
  grains.shape.assign(grains.radius.size(), 0);
  grains.scale.assign(grains.radius.size(), scale);
  grains.radius.assign(grains.radius.size(), scale * shape.outer_radius);
  for (int i = 0; i < grains.size(); ++i) grains.mass[i] = grains.volume(i);
}

/// Squares of side 1 arranged like bricks: three squares in each of four rows, and each row shifted by half a side. The
/// force is P/2 on each of the two contact points between neighbours in a row, and P/4 on each of the four points on
/// top of a square.
inline State<2> brick_bond(double pressure, double friction) {
  State<2> state;
  state.packing.law = rigid_law(friction);
  state.packing.cell.matrix << 3.0, 0.0, 0.0, 4.0;
  state.packing.grains = Grains<2>::with_size(12);
  Grains<2>& g = state.packing.grains;
  for (int i = 0; i < 12; ++i) g.position[i] = Vec<2>(0.25 + i % 3 + 0.5 * (i / 3 % 2), 0.5 + i / 3);
  set_shape(g, box<2>(Vec<2>(1.0, 1.0), 0.0), std::sqrt(2.0));
  load_contacts(state, pressure,
                [&](const Contact<2>& c) { return pressure * (std::abs(c.normal[0]) > 0.5 ? 0.5 : 0.25); });
  return state;
}

/// Removes the contacts between blocks that share only an edge or a corner. Then computes the quantities of the state
/// again.
template <int Dim>
void keep_neighbours_across_faces(State<Dim>& state) {
  const Packing<Dim>& packing = state.packing;
  std::erase_if(state.packing.contacts, [&](const Contact<Dim>& c) {
    return !packing.is_wall(c.j) && branch(packing, c).norm() > 1.2;
  });
  measure(state);
}

/// Simple cubic crystal of eight cubes of side 1. The force on each of the four points between neighbours is P/4.
inline State<3> cube_stack(double pressure, double friction) {
  State<3> state;
  state.packing.law = rigid_law(friction);
  state.packing.cell.matrix = 2.0 * Mat<3>::Identity();
  state.packing.grains = Grains<3>::with_size(8);
  for (int i = 0; i < 8; ++i)
    state.packing.grains.position[i] = Vec<3>(0.5 + i % 2, 0.5 + i / 2 % 2, 0.5 + i / 4);
  set_shape(state.packing.grains, box<3>(Vec<3>(1.0, 1.0, 1.0), 0.0), std::sqrt(3.0));
  load_contacts(state, pressure, [&](const Contact<3>&) { return 0.25 * pressure; });
  keep_neighbours_across_faces(state);
  return state;
}

/// Four squares of side 1 that fill a box between walls. The force on each of the two contact points of a side is P/2.
inline State<2> boxed_squares(double pressure, double friction) {
  State<2> state;
  Packing<2>& packing = state.packing;
  packing.law = packing.wall_law = rigid_law(friction);
  packing.cell.matrix = 2.0 * Mat<2>::Identity();
  packing.grains = Grains<2>::with_size(4);
  for (int i = 0; i < 4; ++i) packing.grains.position[i] = Vec<2>(0.5 + i % 2, 0.5 + i / 2);
  for (const int axis : {0, 1})
    for (const int side : {-1, 1})
      packing.walls.push_back(
          {.axis = axis, .side = side, .position = side < 0 ? 0.0 : 2.0, .velocity = 0.0, .mass = 1.0});
  set_shape(packing.grains, box<2>(Vec<2>(1.0, 1.0), 0.0), std::sqrt(2.0));
  load_contacts(state, pressure, [&](const Contact<2>&) { return 0.5 * pressure; });
  keep_neighbours_across_faces(state);
  return state;
}

}  // namespace floc::test
