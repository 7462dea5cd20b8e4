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

/// Adds the contacts of a packing whose gaps are at most 1e-9, and computes the properties of the state under
/// an isotropic pressure.
/// @param force  function that returns the normal force of a contact
template <int Dim, class Force>
void load_contacts(State<Dim>& state, double pressure, const Force& force) {
  Packing<Dim>& packing = state.packing;
  packing.contacts = ContactPoints<Dim>().find(packing, 1e-9);
  for (Contact<Dim>& c : packing.contacts) c.normal_force = c.elastic_force = force(c);
  state.target_stress.setConstant(pressure);
  measure(state);
}

/// Triangular crystal of disks of diameter 1, with four disks in each of four rows. Each contact carries
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

/// Simple cubic crystal of 27 spheres of diameter 1. Each contact carries P.
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
/// @param scale  diameter of the circumscribed circle or sphere of each grain (length), for a shape of diameter
/// 1
template <int Dim>
void set_shape(Grains<Dim>& grains, const Shape<Dim>& shape, double scale) {
  grains.shapes = std::make_shared<const std::vector<Shape<Dim>>>(1, shape);
  grains.shape.assign(grains.radius.size(), 0);
  grains.scale.assign(grains.radius.size(), scale);
  grains.radius.assign(grains.radius.size(), scale * shape.outer_radius);
  for (int i = 0; i < grains.size(); ++i) grains.mass[i] = grains.volume(i);
}

/// Squares of side 1 arranged like bricks, three in each of four rows that are shifted by half a side. Each of
/// the two contact points between neighbours in a row carries P/2, each of the four points on top of a square
/// P/4.
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

}  // namespace floc::test
