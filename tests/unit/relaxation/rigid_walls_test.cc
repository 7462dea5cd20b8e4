#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "floc/assembly/box_options.h"
#include "floc/packing/wall_forces.h"
#include "floc/rigid/contact_dynamics.h"
#include "floc/rigid/static_forces.h"
#include "floc/shape/generators.h"
#include "support/rigid_gas.h"

/// Tests of rigid grains between walls and under gravity: closed forms, and states that pass the verification.
namespace floc::test {
namespace {

constexpr double kFixed = std::numeric_limits<double>::infinity();

/// Returns disks or spheres of diameter 1 and mass 1 in a box with fixed walls at 0 and 40 across all axes.
template <int Dim>
Packing<Dim> balls_in_box(const std::vector<Vec<Dim>>& centres, double friction) {
  Packing<Dim> p;
  p.law = p.wall_law = rigid_law(friction);
  p.cell.matrix = 40.0 * Mat<Dim>::Identity();
  p.grains = Grains<Dim>::with_size(static_cast<int>(centres.size()));
  p.grains.position = centres;
  p.grains.radius.assign(centres.size(), 0.5);
  p.grains.mass.assign(centres.size(), 1.0);
  for (int a = 0; a < Dim; ++a)
    for (const int side : {-1, 1})
      p.walls.push_back({.axis = a, .side = side, .position = side < 0 ? 0.0 : 40.0, .mass = kFixed});
  return p;
}

/// Makes the grains of a packing squares or cubes of side 1 and mass 1.
template <int Dim>
void make_blocks(Packing<Dim>& packing) {
  set_shape<Dim>(packing.grains, box<Dim>(Vec<Dim>::Ones(), 0.0), std::sqrt(double{Dim}));
}

/// Relaxes a packing under its weight. The walls that can move are under a pressure of 1.
template <int Dim>
RigidEnd<Dim> settled(const Packing<Dim>& packing, RelaxationOptions options = rigid_options()) {
  options.tolerance.stress = 1e-3;
  return relaxed<Dim>(packing, options);
}

template <int Dim>
Contact<Dim> wall_contact(const Packing<Dim>& packing, int axis, int side) {
  for (const Contact<Dim>& c : packing.contacts)
    if (packing.is_wall(c.j) && packing.wall(c.j).axis == axis && packing.wall(c.j).side == side) return c;
  ADD_FAILURE() << "no contact with the wall";
  return {};
}

TEST(RigidWalls, PileOfDisksBearsTheWeightAbove) {
  constexpr int kDisks = 6;
  std::vector<Vec<2>> centres;
  for (int k = 0; k < kDisks; ++k) centres.emplace_back(20.0, 0.5 + k);
  Packing<2> pile = balls_in_box<2>(centres, 0.0);
  pile.gravity = {0.0, -1.0};
  // Side walls that touch the disks keep the pile from falling over.
  for (Wall<2>& wall : pile.walls)
    if (wall.axis == 0) wall.position = 20.0 + 0.5 * wall.side;
  pile.cell.matrix(0, 0) = 1.0;
  const RigidEnd<2> end = settled(pile);
  expect_at_rest(end);
  int found = 0;
  for (const Contact<2>& c : end.packing.contacts) {
    const bool on_wall = end.packing.is_wall(c.j);
    if (on_wall && end.packing.wall(c.j).axis == 0) continue;
    EXPECT_NEAR(c.normal_force, on_wall ? kDisks : kDisks - c.j, 1e-9);
    ++found;
  }
  EXPECT_EQ(found, kDisks);
}

// A disk with the weight (g_1, g_2) lies in the corner of two walls. The friction force t is equal on both walls. By
// force balance, the normal forces are N_1 = g_1 - t and N_2 = g_2 - t. The energy N_1^2 + N_2^2 + 2 t^2 is smallest
// for t = (g_1 + g_2)/4.
TEST(RigidWalls, DiskInACornerSharesItsWeight) {
  for (const double friction : {0.0, 2.0}) {
    Packing<2> corner = balls_in_box<2>({{0.5, 0.5}}, friction);
    corner.gravity = {-0.6, -0.8};
    RelaxationOptions options = rigid_options();
    options.contact_dynamics.forces = RigidForces::canonical;
    const RigidEnd<2> end = settled(corner, options);
    expect_at_rest(end);
    const Contact<2> left = wall_contact(end.packing, 0, -1), below = wall_contact(end.packing, 1, -1);
    const double t = friction > 0.0 ? 0.35 : 0.0;
    EXPECT_NEAR(left.normal_force, 0.6 - t, 1e-8);
    EXPECT_NEAR(below.normal_force, 0.8 - t, 1e-8);
    EXPECT_NEAR(left.shear_force[1], t, 1e-8);
    EXPECT_NEAR(below.shear_force[0], t, 1e-8);
  }
}

TEST(RigidWalls, SquareRestsOnTwoCorners) {
  Packing<2> block = balls_in_box<2>({{20.0, 0.5}}, 0.5);
  make_blocks(block);
  block.gravity = {0.0, -1.0};
  const RigidEnd<2> end = settled(block);
  expect_at_rest(end);
  ASSERT_EQ(end.packing.contacts.size(), 2U);
  for (const Contact<2>& c : end.packing.contacts) {
    // The block may tilt by the gap tolerance of 1e-3.
    EXPECT_NEAR(c.normal_force, 0.5, 1e-3);
    EXPECT_NEAR(std::abs(c.arm_i[0]), 0.5, 1e-3);
  }
}

TEST(RigidWalls, CubeDropsAndRestsOnItsFace) {
  Packing<3> block = balls_in_box<3>({{20.0, 20.0, 0.8}}, 0.5);
  make_blocks(block);
  block.gravity = {0.0, 0.0, -1.0};
  const RigidEnd<3> end = settled(block);
  expect_at_rest(end);
  EXPECT_NEAR(end.packing.grains.position[0][2], 0.5, 1e-3);
  EXPECT_NEAR(wall_forces(end.packing)[4], 1.0, 1e-9);
  EXPECT_EQ(end.packing.contacts.size(), 4U);
}

/// A lid under the pressure 1 lies on a row of two disks. The floor carries the load on the lid and the weight
/// of the disks.
TEST(RigidWalls, FloorBearsTheLoadOnTheLidAndTheWeight) {
  Packing<2> row = balls_in_box<2>({{10.0, 0.5}, {20.0, 0.5}}, 0.3);
  row.gravity = {0.0, -3.0};
  row.walls[3].position = row.cell.matrix(1, 1) = 1.5;
  row.walls[3].mass = 5.0;
  const RigidEnd<2> end = settled(row);
  expect_at_rest(end);
  EXPECT_NEAR(end.packing.walls[3].position, 1.0, 1e-3);
  EXPECT_EQ(end.packing.cell.matrix(1, 1), end.packing.walls[3].position - end.packing.walls[2].position);
  const std::vector<double> force = wall_forces(end.packing);
  EXPECT_NEAR(force[3], 40.0, 1e-7);
  EXPECT_NEAR(force[2], 46.0, 1e-7);
}

/// The grain touches no wall. The two moving walls approach each other at the speed of the load, and the grain between
/// them stays in place.
TEST(RigidWalls, FreeWallsReachTheirSpeed) {
  Packing<2> p = balls_in_box<2>({{20.0, 20.0}}, 0.0);
  p.walls[0].mass = p.walls[1].mass = 2.0;
  BoundaryLoad<2> load;
  load.stress = {3.0, 3.0};
  load.wall_speed = 0.8;
  ContactDynamics<2> motion(p, load, {.longest_step = 0.1, .sweep_tolerance = 1e-6, .max_sweeps = 100}, 0.1);
  double time = 0.0;
  while (time < 2.0) {
    motion.step(false);
    time += motion.last_step();
  }
  const Packing<2>& now = motion.packing();
  EXPECT_NEAR(now.walls[0].velocity, 0.4, 1e-9);
  EXPECT_NEAR(now.walls[1].velocity, -0.4, 1e-9);
  EXPECT_NEAR(now.cell.matrix(0, 0), now.walls[1].position - now.walls[0].position, 1e-12);
  EXPECT_EQ(now.cell.matrix(1, 1), 40.0);
  EXPECT_EQ(now.grains.position[0], Vec<2>(20.0, 20.0));
}

/// Compresses a gas of grains between moving walls. The test is made for each kind of boundary of the lateral axes.
/// Expects a pressure of 1 on all walls that move.
template <int Dim>
void expect_walls_bear_pressure(int count, const std::optional<ShapeOptions>& shape,
                                const std::vector<BoxSide>& laterals) {
  for (const BoxSide lateral : laterals) {
    BoxOptions box;
    box.boundary = {lateral, Dim == 2 ? BoxSide::walls : lateral, BoxSide::walls};
    box.friction = 0.2;
    box.mass = 3.0;
    const RigidEnd<Dim> end = settled(boxed_gas<Dim>(count, shape, box, 0.4));
    expect_at_rest(end);
    const std::vector<double> force = wall_forces(end.packing);
    for (std::size_t w = 0; w < end.packing.walls.size(); ++w)
      if (follows_forces(end.packing.walls[w])) {
        EXPECT_NEAR(force[w] / wall_area(end.packing, end.packing.walls[w].axis), 1.0, 1e-8);
      }
    const std::optional<double> freedom = [&] {
      State<Dim> state;
      state.packing = end.packing;
      state.target_stress = Vec<Dim>::Ones();
      measure(state);
      return force_freedom(state);
    }();
    ASSERT_TRUE(freedom.has_value());
    EXPECT_LT(*freedom, 1.0);
  }
}

TEST(RigidWalls, PressGrainsTogether) {
  const std::vector<BoxSide> all = {BoxSide::walls, BoxSide::fixed, BoxSide::periodic};
  expect_walls_bear_pressure<2>(40, std::nullopt, all);
  expect_walls_bear_pressure<2>(20, ShapeOptions{.kind = PolygonOptions{5}}, all);
  expect_walls_bear_pressure<3>(20, std::nullopt, {BoxSide::walls});
  expect_walls_bear_pressure<3>(8, ShapeOptions{.kind = CutOptions{}, .count = 8}, {BoxSide::fixed});
}

/// Lets heavy walls press on a gas. Expects that they are still in motion after 20 time units, and that each has the
/// velocity which the pressure has given to it.
template <int Dim>
void expect_heavy_walls_move() {
  BoxOptions box;
  box.boundary = {BoxSide::periodic, Dim == 2 ? BoxSide::walls : BoxSide::periodic, BoxSide::walls};
  box.mass = 1e5;
  const Packing<Dim> gas = boxed_gas<Dim>(20, std::nullopt, box, 0.4);
  const RigidEnd<Dim> end = relaxed(gas, rigid_options(), false, 400);
  EXPECT_EQ(end.report.phase, "moving") << end.reason;
  for (const Wall<Dim>& wall : end.packing.walls)
    EXPECT_NEAR(std::abs(wall.velocity) * box.mass, wall_area(gas, wall.axis) * end.report.time,
                0.05 * wall_area(gas, wall.axis) * end.report.time);
}

// The gas between heavy walls is calm at first.
TEST(RigidWalls, HeavyWallsStartToMove) {
  expect_heavy_walls_move<2>();
  expect_heavy_walls_move<3>();
}

/// Lets grains of any shape fall on a floor. Expects that the force on the floor is their weight, and that the
/// upper end is open.
template <int Dim>
void expect_bed(const std::optional<ShapeOptions>& shape, int count, double gravity = 1.0) {
  BoxOptions box;
  box.boundary = {BoxSide::periodic, Dim == 2 ? BoxSide::floor : BoxSide::fixed, BoxSide::floor};
  box.friction = 0.5;
  box.gravity[Dim - 1] = -gravity;
  const RigidEnd<Dim> end = settled(boxed_gas<Dim>(count, shape, box, 0.5));
  expect_at_rest(end);
  const double weight =
      gravity * std::accumulate(end.packing.grains.mass.begin(), end.packing.grains.mass.end(), 0.0);
  double borne = 0.0;
  for (const Contact<Dim>& c : end.packing.contacts)
    if (end.packing.is_wall(c.j)) borne += (c.shear_force - c.normal_force * c.normal)[Dim - 1];
  EXPECT_NEAR(borne, weight, 1e-8 * weight);
  EXPECT_TRUE(end.packing.walls.back().open);
}

TEST(RigidWalls, FloorBearsTheWeightOfABed) {
  expect_bed<2>(std::nullopt, 40);
  expect_bed<2>(ShapeOptions{.kind = PolygonOptions{5}}, 20);
  expect_bed<3>(std::nullopt, 20);
  expect_bed<3>(ShapeOptions{.kind = CutOptions{}, .count = 6}, 8);
}

// Under weak gravity the gas above the floor is calm at first.
TEST(RigidWalls, FloorBearsABedUnderWeakGravity) {
  expect_bed<2>(std::nullopt, 20, 2e-3);
  expect_bed<3>(std::nullopt, 10, 2e-3);
}

TEST(RigidWalls, RepeatTheirBits) {
  BoxOptions box;
  box.friction = 0.2;
  const Packing<2> gas = boxed_gas<2>(30, ShapeOptions{.kind = PolygonOptions{5}}, box, 0.4);
  RelaxationOptions options = rigid_options();
  options.tolerance.stress = 1e-3;
  const RigidEnd<2> whole = relaxed<2>(gas, options);
  expect_same(whole, relaxed<2>(gas, options, true));
  options.threads = 2;
  expect_same(whole, relaxed<2>(gas, options));
}

}  // namespace
}  // namespace floc::test
