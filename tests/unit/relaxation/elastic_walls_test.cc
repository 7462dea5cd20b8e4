#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/network/geometric_springs.h"
#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/least_mechanisms.h"
#include "floc/packing/wall_forces.h"
#include "floc/relaxation/spring_balance.h"
#include "floc/rigid/contact_points.h"
#include "floc/rigid/elastic_contacts.h"
#include "floc/shape/generators.h"
#include "floc/verification/verification.h"
#include "support/elastic_gas.h"

/// Tests of elastic grains with corners between walls and under gravity: closed forms, states that pass the verification,
/// and moduli.
namespace floc::test {
namespace {

constexpr double kStiffness = 1e4;

/// Returns the names of the criteria that a packing, with the pressure 1 on the walls that move, does not meet.
template <int Dim>
std::string violations_of(const Packing<Dim>& packing) {
  State<Dim> state;
  state.packing = packing;
  state.target_stress = Vec<Dim>::Ones();
  state.tolerance.stress = 1e-3;
  state.n_negative = 0;
  measure(state);
  std::string names;
  for (const Criterion& criterion : verify_equilibrium(state))
    if (!criterion.holds) names += std::string(criterion.name) + " (" + criterion.where + ") ";
  return names;
}

/// Returns the moduli of a packing with prestress.
template <int Dim>
Moduli prestressed(const Packing<Dim>& packing) {
  ModuliOptions options;
  options.prestress = true;
  return elastic_moduli(packing, options);
}

/// Returns the side of block k in column().
double side_of_block(int k) {
  return 1.0 - 0.05 * k;
}

/// Returns a column of squares or cubes of mass 1 on a floor, with periodic sides and a fixed lid far above. Each block is
/// smaller than the one below, so that all its corners bear it.
template <int Dim>
Packing<Dim> column(int count) {
  Packing<Dim> p;
  set_springs(p, kStiffness, 0.5, 0.5);
  p.cell.matrix = 3.0 * Mat<Dim>::Identity();
  p.cell.matrix(Dim - 1, Dim - 1) = 2.0 * count;
  p.grains = Grains<Dim>::with_size(count);
  set_shape<Dim>(p.grains, box<Dim>(Vec<Dim>::Ones(), 0.0), std::sqrt(double{Dim}));
  p.grains.mass.assign(count, 1.0);
  double top = 0.0;
  for (int k = 0; k < count; top += side_of_block(k), ++k) {
    p.grains.position[k] = Vec<Dim>::Constant(1.5);
    p.grains.position[k][Dim - 1] = top + 0.5 * side_of_block(k);
    p.grains.scale[k] *= side_of_block(k);
    p.grains.radius[k] *= side_of_block(k);
  }
  p.walls = {
      {.axis = Dim - 1, .side = -1, .position = 0.0, .mass = std::numeric_limits<double>::infinity()},
      {.axis = Dim - 1, .side = 1, .position = 2.0 * count, .mass = std::numeric_limits<double>::infinity()}};
  p.gravity[Dim - 1] = -1.0;
  return p;
}

/// The face below block k, with c corners, is a spring of stiffness c K_N and bears the weight of the n - k blocks from k
/// on.
template <int Dim>
void expect_column_sinks(int n) {
  SCOPED_TRACE(testing::Message() << Dim << " dimensions");
  const RigidEnd<Dim> end = relaxed(column<Dim>(n));
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  EXPECT_EQ(violations_of(end.packing), "");
  const double corners = Dim == 2 ? 2.0 : 4.0;
  double top = 0.0;
  for (int k = 0; k < n; top += side_of_block(k), ++k) {
    top -= (n - k) / (corners * kStiffness);
    EXPECT_NEAR(end.packing.grains.position[k][Dim - 1], top + 0.5 * side_of_block(k), 1e-10) << k;
  }
  EXPECT_NEAR(wall_forces(end.packing)[0], n, 1e-9);
}

TEST(ElasticWalls, ColumnOfBlocksSinksUnderItsWeight) {
  expect_column_sinks<2>(5);
  expect_column_sinks<3>(4);
}

/// A lid presses a column together: its springs are in series.
TEST(ElasticWalls, LidRestsWhereTheSpringsBearIt) {
  constexpr int n = 4;
  Packing<2> pressed = column<2>(n);
  pressed.gravity.setZero();
  pressed.walls[1].mass = 5.0;
  double height = 0.0;
  for (int k = 0; k < n; ++k) height += side_of_block(k);
  pressed.walls[1].position = pressed.cell.matrix(1, 1) = height + 0.01;
  const RigidEnd<2> end = relaxed(pressed);
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  EXPECT_EQ(violations_of(end.packing), "");
  // The lid has the area 3, and each of the n + 1 faces the stiffness 2 K_N. Friction that the impact of the lid has left
  // tilts the blocks a little.
  EXPECT_NEAR(end.packing.walls[1].position, height - (n + 1) * 3.0 / (2.0 * kStiffness), 1e-8);
  EXPECT_EQ(end.packing.cell.matrix(1, 1), end.packing.walls[1].position - end.packing.walls[0].position);
}

/// A square on a floor has two contacts. Without friction they hold two of its three degrees of freedom.
TEST(ElasticWalls, RotationsOfSmoothGrainsWithCornersCount) {
  for (const double friction : {0.0, 0.5}) {
    Packing<2> square = column<2>(1);
    set_springs(square, kStiffness, friction, friction);
    square.grains.position[0][1] -= 1e-4;
    square.contacts = ContactPoints<2>().find(square, 0.0);
    set_spring_forces(square);
    ASSERT_EQ(square.contacts.size(), 2U);
    EXPECT_EQ(least_mechanisms(square), friction > 0.0 ? 0 : 1);
  }
}

const ShapeOptions kPentagons{.kind = PolygonOptions{5}, .rounding = 0.05};
const ShapeOptions kCapsules{.kind = CapsuleOptions{1.5}};
const ShapeOptions kStones{.kind = CutOptions{}, .rounding = 0.1, .count = 8};

template <int Dim>
Packing<Dim> boxed_springs(int count, const ShapeOptions& shape, const BoxOptions& box, double friction) {
  Packing<Dim> gas = boxed_gas<Dim>(count, shape, box, friction);
  set_springs(gas, kStiffness, friction, box.friction);
  return gas;
}

/// Expects that the stress of each axis between walls is the pressure on its walls less the parts of it that friction on
/// the other walls and the weights bear, and that the stress is symmetric. The pressure of an axis with an open end is that
/// on its only wall.
template <int Dim>
void expect_stress_of_walls(const Packing<Dim>& packing) {
  const Mat<Dim> stress = static_stress(packing);
  const Vec<Dim> pressure = wall_pressure(packing), friction = stress_borne_by_friction(packing);
  Vec<Dim> middle = Vec<Dim>::Zero();
  for (std::size_t w = 0; w < packing.walls.size(); w += 2) {
    const Wall<Dim>&lower = packing.walls[w], &upper = packing.walls[w + 1];
    middle[lower.axis] = upper.open ? upper.position : 0.5 * (lower.position + upper.position);
  }
  for (int a = 0; a < Dim; ++a) {
    if (!between_walls(packing.walls, a)) continue;
    double weights = 0.0;
    for (int i = 0; i < packing.grains.size(); ++i)
      weights += packing.grains.mass[i] * packing.gravity[a] * (packing.grains.position[i][a] - middle[a]);
    EXPECT_NEAR(stress(a, a), pressure[a] - friction[a] - weights / packing.cell.volume(), 1e-8)
        << "axis " << a;
  }
  // The tangential forces act in the middle of the overlaps, and the normal forces on the planes of the walls.
  EXPECT_LT((stress - stress.transpose()).cwiseAbs().maxCoeff(), 1e-4);
}

/// Friction coefficient between grains, and of grains on walls.
using Frictions = std::pair<double, double>;

/// Compresses a gas between moving walls, for each kind of boundary of the lateral axes.
template <int Dim>
void expect_walls_bear_pressure(int count, const ShapeOptions& shape, const std::vector<BoxSide>& laterals,
                                const std::vector<Frictions>& frictions) {
  for (const BoxSide lateral : laterals)
    for (const auto& [friction, of_walls] : frictions) {
      SCOPED_TRACE(testing::Message() << Dim << " dimensions, boundary " << static_cast<int>(lateral)
                                      << ", friction " << friction << ", of walls " << of_walls);
      BoxOptions box;
      box.boundary = {lateral, Dim == 2 ? BoxSide::walls : lateral, BoxSide::walls};
      box.friction = of_walls;
      box.mass = 3.0;
      const RigidEnd<Dim> end = relaxed(boxed_springs<Dim>(count, shape, box, friction));
      ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
      EXPECT_EQ(violations_of(end.packing), "");
      const std::vector<double> force = wall_forces(end.packing);
      for (std::size_t w = 0; w < end.packing.walls.size(); ++w) {
        const Wall<Dim>& wall = end.packing.walls[w];
        EXPECT_EQ(wall.velocity, 0.0);
        if (!follows_forces(wall)) continue;
        EXPECT_NEAR(force[w] / wall_area(end.packing, wall.axis), 1.0, 1e-8);
      }
      for (const Contact<Dim>& c : end.packing.contacts) EXPECT_NEAR(c.normal_force, -kStiffness * c.gap, 1e-9);
      expect_stress_of_walls(end.packing);
    }
}

/// Grains with corners and without friction do not always come to rest in 3D.
TEST(ElasticWalls, PressGrainsTogether) {
  const std::vector<BoxSide> all = {BoxSide::walls, BoxSide::fixed, BoxSide::periodic};
  const std::vector<Frictions> rough = {{0.4, 0.2}, {0.4, 0.0}}, any = {{0.4, 0.2}, {0.4, 0.0}, {0.0, 0.0}};
  expect_walls_bear_pressure<2>(20, kPentagons, all, any);
  expect_walls_bear_pressure<2>(20, kCapsules, {BoxSide::walls}, any);
  expect_walls_bear_pressure<3>(8, kCapsules, all, rough);
  expect_walls_bear_pressure<3>(8, kStones, all, rough);
}

/// Lets grains fall on a floor. Expects that the walls bear their weight, and that the upper end is open.
template <int Dim>
void expect_bed_rests(int count, const ShapeOptions& shape) {
  SCOPED_TRACE(testing::Message() << Dim << " dimensions");
  BoxOptions box;
  box.boundary = {BoxSide::periodic, Dim == 2 ? BoxSide::floor : BoxSide::fixed, BoxSide::floor};
  box.friction = 0.5;
  box.gravity[Dim - 1] = -1.0;
  const RigidEnd<Dim> end = relaxed(boxed_springs<Dim>(count, shape, box, 0.5));
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  EXPECT_EQ(violations_of(end.packing), "");
  double borne = 0.0;
  for (const Contact<Dim>& c : end.packing.contacts)
    if (end.packing.is_wall(c.j)) borne += (c.shear_force - c.normal_force * c.normal)[Dim - 1];
  EXPECT_NEAR(borne, total_mass(end.packing.grains), 1e-8);
  EXPECT_TRUE(end.packing.walls.back().open);
  expect_stress_of_walls(end.packing);
  // Nothing resists a change of the height, and the load is that of no wall.
  const Moduli m = prestressed(end.packing);
  EXPECT_EQ(m.n_negative, 0);
  EXPECT_EQ(m.n_coupled_mechanisms, 1);
  EXPECT_LT(m.C.row(Dim - 1).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(m.B_S, 0.0);
  const RigidEnd<Dim> again = relaxed(end.packing);
  EXPECT_EQ(again.report.n_steps, 0);
  for (int i = 0; i < count; ++i)
    EXPECT_LT((again.packing.grains.position[i] - end.packing.grains.position[i]).norm(), 1e-9) << i;
}

TEST(ElasticWalls, FloorBearsTheWeightOfABed) {
  expect_bed_rests<2>(20, kPentagons);
  expect_bed_rests<2>(20, kCapsules);
  expect_bed_rests<3>(8, kStones);
}

TEST(ElasticWalls, NewtonIterationsFindTheNewPlaceOfWalls) {
  BoxOptions box;
  box.friction = 0.2;
  const RigidEnd<2> rested = relaxed(boxed_springs<2>(20, kPentagons, box, 0.4));
  ASSERT_EQ(rested.status, RelaxationStatus::converged) << rested.reason;
  const Vec<2> pressure{1.0 + 1e-4, 1.0 - 1e-4};
  const SpringBalance<2> found = balance_springs(rested.packing, LoadTarget<2>::normal_stress(pressure), 1e-9);
  EXPECT_TRUE(found.converged);
  const std::vector<double> force = wall_forces(found.packing);
  for (std::size_t w = 0; w < force.size(); ++w) {
    const int axis = found.packing.walls[w].axis;
    EXPECT_NEAR(force[w] / wall_area(found.packing, axis), pressure[axis], 1e-9) << w;
    EXPECT_NE(found.packing.walls[w].position, rested.packing.walls[w].position) << w;
  }
}

TEST(ElasticWalls, ModuliAreThoseOfRelaxedStrains) {
  BoxOptions box;
  const double stiffness = 1e5;
  for (const double of_walls : {0.0, 0.2}) {
    SCOPED_TRACE(testing::Message() << "friction of walls " << of_walls);
    box.friction = of_walls;
    Packing<2> plane = boxed_gas<2>(20, kPentagons, box, 0.4);
    set_springs(plane, stiffness, 0.4, of_walls);
    expect_moduli_of_strains(plane, stiffness, 1e-3);
    Packing<3> stones = boxed_gas<3>(8, kStones, box, 0.4);
    set_springs(stones, stiffness, 0.4, of_walls);
    expect_moduli_of_strains(stones, stiffness, 2e-4);
  }
}

/// Below a lid, the floor and the side walls stay where they are. Their friction bears a part of the changes of the
/// pressure, so that the lid feels a larger stiffness than two walls that press the grains from both ends.
template <int Dim>
void expect_modulus_of_lid(int count, const ShapeOptions& shape, double step) {
  SCOPED_TRACE(testing::Message() << Dim << " dimensions");
  constexpr double kSpring = 1e5, kSticks = 100.0;
  constexpr int kUp = Dim - 1;
  BoxOptions box;
  box.boundary = {BoxSide::fixed, Dim == 2 ? BoxSide::lid : BoxSide::fixed, BoxSide::lid};
  box.friction = 0.4;
  box.gravity[kUp] = -0.05;
  Packing<Dim> gas = boxed_gas<Dim>(count, shape, box, 0.4);
  set_springs(gas, kSpring, 0.4, box.friction);
  RigidEnd<Dim> rested = relaxed(gas, strict_options<Dim>());
  ASSERT_EQ(rested.status, RelaxationStatus::converged) << rested.reason;
  expect_stress_of_walls(rested.packing);
  set_springs(rested.packing, kSpring, kSticks, kSticks);
  const Vec<Dim> change = step * Vec<Dim>::Unit(kUp), pressure = Vec<Dim>::Ones();
  const double strain = strain_under<Dim>(rested.packing, pressure + change)[kUp] -
                        strain_under<Dim>(rested.packing, pressure - change)[kUp];
  const Moduli m = prestressed(rested.packing);
  EXPECT_NEAR(m.C(kUp, kUp), 2.0 * step / strain, 2e-6 * m.C(kUp, kUp));
  EXPECT_EQ(m.n_negative, 0);
  Packing<Dim> both = rested.packing;
  for (Wall<Dim>& wall : both.walls) wall.mass = 1.0;
  EXPECT_LT(prestressed(both).C(kUp, kUp), m.C(kUp, kUp));
}

TEST(ElasticWalls, ModulusOfALidIsThatOfItsPressure) {
  expect_modulus_of_lid<2>(20, kPentagons, 1e-3);
  expect_modulus_of_lid<3>(10, kStones, 2e-5);  // with 2e-4 another contact closes
}

/// A wall and a grain that move together along the axis of the wall do not change their contact.
TEST(ElasticWalls, GeometricSpringsDoNotResistTranslationsWithTheWall) {
  BoxOptions box;
  box.friction = 0.2;
  const RigidEnd<3> rested = relaxed(boxed_springs<3>(8, kStones, box, 0.4));
  ASSERT_EQ(rested.status, RelaxationStatus::converged) << rested.reason;
  const auto springs = geometric_springs(rested.packing);
  int n_on_walls = 0;
  for (const NetworkContact<3>& c : contact_network(rested.packing).contacts) {
    if (!c.on_wall()) continue;
    ++n_on_walls;
    const int axis = rested.packing.walls[static_cast<std::size_t>(c.wall)].axis;
    for (int first = 0; first < kMotionRows<3>; first += kDofs<3>) {
      const ContactRows<3> rows = geometric_rows(c, springs[static_cast<std::size_t>(c.source)], first);
      for (int a = 0; a < 3; ++a) {
        const double along = a == axis ? 1.0 : 0.0;
        EXPECT_LT((rows.on_wall.col(a) + along * rows.on_i.col(a)).norm(), 1e-12) << c.source << ", axis " << a;
      }
      EXPECT_TRUE(rows.on_j.isZero(0.0));
    }
  }
  EXPECT_GT(n_on_walls, 3);
}

TEST(ElasticWalls, RepeatTheirBits) {
  BoxOptions box;
  box.friction = 0.2;
  const Packing<2> gas = boxed_springs<2>(20, kPentagons, box, 0.4);
  RelaxationOptions options = rigid_options();
  const RigidEnd<2> whole = relaxed<2>(gas, options);
  expect_same(whole, relaxed<2>(gas, options, true));
  options.threads = 2;
  expect_same(whole, relaxed<2>(gas, options));
}

}  // namespace
}  // namespace floc::test
