#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "floc/neighbors/find_contacts.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/state.h"
#include "support/contact_laws.h"
#include "support/springs.h"

namespace floc::test {

/// Returns a state with a model in every slot of the law, and with every flag and every text. The grains lie on a line
/// in a skewed cell. One pair overlaps and has stretched springs, one pair attracts at a distance, and one grain
/// touches its own image. The state is not in equilibrium. Its numbers have no short decimal form, so that a test
/// notices lost digits.
template <int Dim>
State<Dim> busy_state() {
  State<Dim> s;
  Packing<Dim>& p = s.packing;
  p.law = cohesive_law();
  if (Dim == 3) p.law += test::twisting_spring(0.004, 8.0);
  p.cell.matrix *= 7.3;
  p.cell.matrix(0, 0) = 1.0 - 1e-5 / 3.0;
  p.cell.matrix(1, 0) = 0.1;
  p.cell.velocity(0, 0) = -1e-3 / 7.0;

  p.grains = Grains<Dim>::with_size(3);
  const double x[3] = {0.2, 0.2 + 0.9 - 2e-5, 0.2 + 1.6};
  const double radius[3] = {0.5, 0.4, 0.3 - 1e-4};
  for (int i = 0; i < 3; ++i) {
    p.grains.position[i].setConstant(0.1 / 3.0);
    p.grains.position[i][1] = x[i];
    p.grains.velocity[i].setConstant(1e-9 / (i + 3.0));
    p.grains.radius[i] = radius[i];
    p.grains.mass[i] = std::pow(2.0 * radius[i], Dim);
    p.grains.angular_velocity[i].setConstant(1e-8 / (i + 7.0));
    if constexpr (Dim == 2) p.grains.orientation[i] = 1.0 / (i + 3.0);
    if constexpr (Dim == 3) p.grains.orientation[i] = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  }
  Contact<Dim> own;
  own.image[0] = 1;
  Contact<Dim> overlap;
  overlap.j = 1;
  overlap.key = 4;
  test::shear_spring(overlap)[0] = 1e-6 / 3.0;
  test::rolling_spring(overlap)[0] = -1e-4 / 3.0;
  if constexpr (Dim == 3) test::twisting_spring(overlap) = 1e-3 / 3.0;
  Contact<Dim> distant;
  distant.i = 1;
  distant.j = 2;
  p.contacts = {own, overlap, distant};
  refresh_contacts(p);

  s.target_stress.setConstant(0.01 / 3.0);
  s.tolerance.force = 2e-5;
  measure(s);
  s.n_negative = 2;
  s.path = {17, "unload", 123.456 / 7.0, std::int64_t{5} << 33, "polished", {}};
  s.scene = "[scene]\nname = \"d\xc3\xa9pot\"\n";
  s.provenance = {"floc 0.1.0",         "abc123", "g++", ~std::uint64_t{0}, 1234567890123456789u,
                  std::string(64, 'e'), "a b"};
  return s;
}

/// Returns busy_state() with walls. A grain touches the two walls across the first axis; the lower wall is fixed.
/// Two walls that can move lie across the last axis.
template <int Dim>
State<Dim> boxed_state() {
  State<Dim> s = busy_state<Dim>();
  Packing<Dim>& p = s.packing;
  p.cell.matrix = (7.3 / 3.0) * Mat<Dim>::Identity();
  p.cell.matrix(0, 0) = 1.0 - 1e-5 / 1.1;
  p.cell.velocity.setZero();
  p.wall_law = p.law;
  p.wall_law += test::without("adhesion");
  p.wall_law += test::coulomb(0.3, 1e5);
  const double lowest = 0.1 / 3.0 - 0.5 + 4e-6;
  p.walls = {{0, -1, lowest, 0.0, std::numeric_limits<double>::infinity()},
             {0, +1, lowest + p.cell.matrix(0, 0), -1e-3 / 7.0, 96.0},
             {Dim - 1, -1, -1.0 / 3.0, 1e-3 / 3.0, 96.0},
             {Dim - 1, +1, 6.3 / 3.0, 0.0, 96.0}};
  Contact<Dim> low, high;
  low.j = p.grains.size();
  high.j = low.j + 1;
  test::shear_spring(low)[Dim == 2 ? 0 : 1] = 1e-6 / 7.0;
  Contact<Dim> overlap;
  overlap.j = 1;
  test::shear_spring(overlap)[0] = 1e-6 / 3.0;
  p.contacts = {overlap, low, high};
  refresh_contacts(p);
  measure(s);
  return s;
}

/// Returns the grains of busy_state(), with liquid bridges instead of other interactions.
template <int Dim>
State<Dim> wet_state() {
  State<Dim> s = busy_state<Dim>();
  Packing<Dim>& p = s.packing;
  p.law += test::without("rolling");
  p.law += test::without("twisting");
  p.law += test::liquid(0.3, 20.0, 0.01, 2.6, "rational", "contact");
  find_contacts(p);
  s.n_bridges_unsettled = 3;
  return s;
}

}  // namespace floc::test
