#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "floc/assembly/gas.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/wall_forces.h"
#include "floc/relaxation/box_relaxer.h"
#include "floc/relaxation/dynamics.h"
#include "support/contact_laws.h"

namespace floc {
namespace {

Law stiff_law(double friction) {
  Law law;
  law += test::linear(1e4);
  law += test::viscous_damping(std::sqrt(0.2));
  if (friction > 0.0) law += test::coulomb(friction, 1e4);
  return law;
}

/// Returns a column of touching disks on the lower wall of the second axis. The upper end of this axis is open.
Packing<2> column(int n, double gravity) {
  Packing<2> p;
  p.law = stiff_law(0.0);
  p.grains = Grains<2>::with_size(n);
  p.cell.matrix << 3.0, 0.0, 0.0, n;
  for (int i = 0; i < n; ++i) {
    p.grains.position[i] = Vec<2>(1.5, 0.5 + i);
    p.grains.radius[i] = 0.5;
    p.grains.mass[i] = 1.0 + 0.1 * i;
  }
  const double fixed = std::numeric_limits<double>::infinity();
  p.walls = {{1, -1, 0.0, 0.0, fixed, false}, {1, +1, static_cast<double>(n), 0.0, fixed, true}};
  p.wall_law = p.law;
  p.gravity = Vec<2>(0.0, -gravity);
  find_contacts(p);
  return p;
}

TEST(Gravity, FreeFallIsExact) {
  Packing<2> p = column(1, 0.7);
  p.grains.position[0][1] = 40.0;
  p.grains.velocity[0] = Vec<2>(0.3, 1.1);
  p.contacts.clear();
  const double dt = 1e-3;
  const int n_steps = 2000;
  for (const int threads : {1, 2}) {
    auto dynamics = make_dynamics<2>(p, BoundaryControl<2>::fixed(), {dt, 0.1, threads});
    dynamics->advance(n_steps, Motion::free);
    const Packing<2> after = dynamics->packing();
    const double t = n_steps * dt;
    EXPECT_NEAR(after.grains.position[0][1], 40.0 + 1.1 * t - 0.35 * t * t, 1e-11);
    EXPECT_NEAR(after.grains.velocity[0][1], 1.1 - 0.7 * t, 1e-12);
    EXPECT_NEAR(after.grains.velocity[0][0], 0.3, 1e-15);
    EXPECT_EQ(after.gravity, p.gravity);
  }
}

TEST(Gravity, ContactOfAColumnBearsTheWeightAbove) {
  const Packing<2> p = column(12, 0.05);
  auto dynamics = make_dynamics<2>(p, BoundaryControl<2>::fixed(), {1e-3, 0.1});
  dynamics->advance(60000, Motion::power_control);
  const Packing<2> at_rest = dynamics->packing();
  ASSERT_EQ(at_rest.contacts.size(), 12u);
  for (const Contact<2>& c : at_rest.contacts) {
    const int lowest_above = at_rest.is_wall(c.j) ? 0 : c.j;
    double weight = 0.0;
    for (int i = lowest_above; i < 12; ++i) weight += 0.05 * p.grains.mass[i];
    EXPECT_NEAR(c.normal_force, weight, 1e-9 * weight) << c.i << " " << c.j;
  }
}

template <int Dim>
Packing<Dim> gas_over_floor(int n, const BoxOptions& box, double friction) {
  GrainOptions grains;
  grains.count = n;
  grains.diameter.kind = DiameterDistribution::Kind::uniform;
  grains.diameter.min = 0.8;
  grains.diameter.max = 1.0;
  RandomStream random(5, 1);
  return make_boxed_gas<Dim>(grains, stiff_law(friction), box, 0.3, random);
}

template <int Dim>
BoxOptions bed_box(BoxSide vertical, double gravity) {
  BoxOptions box;
  box.boundary = {BoxSide::periodic, Dim == 2 ? vertical : BoxSide::fixed, vertical};
  box.sides = Dim == 2 ? Vec<3>(1.0, 2.0, 1.0) : Vec<3>(1.0, 1.0, 2.0);
  box.friction = 0.3;
  box.mass = 20.0;
  box.gravity[Dim - 1] = -gravity;
  return box;
}

/// Lets grains fall onto a floor. Expects that the force on the floor is their weight plus the pressure on the
/// lid.
template <int Dim>
void expect_floor_bears_weight(BoxSide vertical, int n) {
  const double gravity = 0.5, pressure = vertical == BoxSide::lid ? 3.0 : gravity;
  const Packing<Dim> gas = gas_over_floor<Dim>(n, bed_box<Dim>(vertical, gravity), 0.3);
  RelaxationOptions options;
  options.tolerance.force = options.tolerance.moment = 1e-7;
  options.max_time = 2000.0;
  BoxRelaxer<Dim> relaxer(options, gas, Vec<Dim>(Vec<Dim>::Constant(pressure)));
  RelaxationStatus status = RelaxationStatus::running;
  for (int k = 0; status == RelaxationStatus::running && k < 4000; ++k) status = relaxer.advance();
  ASSERT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
  const Packing<Dim>& bed = relaxer.packing();
  EXPECT_EQ(bed.gravity, gas.gravity);
  const double weight = gravity * std::accumulate(bed.grains.mass.begin(), bed.grains.mass.end(), 0.0);
  double borne = 0.0, on_lid = 0.0, highest = 0.0;
  for (const Contact<Dim>& c : bed.contacts) {
    if (!bed.is_wall(c.j)) continue;
    const double up = (c.shear_force - c.normal_force * c.normal)[Dim - 1];
    borne += up;
    if (bed.wall(c.j).axis == Dim - 1 && bed.wall(c.j).side > 0) on_lid += c.normal_force;
  }
  EXPECT_NEAR(borne, weight, 1e-5 * weight);
  for (int i = 0; i < bed.grains.size(); ++i)
    highest = std::max(highest, bed.grains.position[i][Dim - 1] + bed.grains.radius[i]);
  const Wall<Dim>& top = bed.walls.back();
  EXPECT_EQ(top.open, vertical == BoxSide::floor);
  if (top.open) {
    EXPECT_EQ(top.position, highest);
  } else {
    EXPECT_NEAR(on_lid, pressure * wall_area(bed, Dim - 1), 2e-3 * on_lid);
  }
  EXPECT_EQ(bed.cell.matrix(Dim - 1, Dim - 1), top.position - bed.walls[bed.walls.size() - 2].position);
}

TEST(Gravity, FloorBearsTheWeightOfABed) {
  expect_floor_bears_weight<2>(BoxSide::floor, 80);
  expect_floor_bears_weight<3>(BoxSide::floor, 60);
}

TEST(Gravity, LidBearsItsPressureAndTheFloorTheWeightToo) {
  expect_floor_bears_weight<2>(BoxSide::lid, 80);
  expect_floor_bears_weight<3>(BoxSide::lid, 60);
}

}  // namespace
}  // namespace floc
