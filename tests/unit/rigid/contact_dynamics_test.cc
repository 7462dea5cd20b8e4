#include "floc/rigid/contact_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "floc/contact/law_parameters.h"
#include "floc/packing/balance.h"
#include "floc/shape/generators.h"

namespace floc {
namespace {

Law rigid_law(double friction) {
  LawParameters law;
  law.normal = RigidContact{};
  if (friction > 0.0) law.friction = RigidFriction{friction};
  return law;
}

/// Returns a packing without grains in a cell with sides of 40.
template <int Dim>
Packing<Dim> empty_packing(double friction) {
  Packing<Dim> packing;
  packing.cell.matrix = 40.0 * Mat<Dim>::Identity();
  packing.law = packing.wall_law = rigid_law(friction);
  return packing;
}

/// Adds immovable walls across the last axis, at 0 and 40.
template <int Dim>
void add_floor(Packing<Dim>& packing) {
  const double heavy = std::numeric_limits<double>::infinity();
  packing.walls = {{.axis = Dim - 1, .side = -1, .position = 0.0, .mass = heavy},
                   {.axis = Dim - 1, .side = 1, .position = 40.0, .mass = heavy}};
}

template <int Dim>
void add_grain(Packing<Dim>& packing, const Vec<Dim>& position, double radius, double mass) {
  Grains<Dim>& g = packing.grains;
  g.position.push_back(position);
  g.velocity.push_back(Vec<Dim>::Zero());
  g.radius.push_back(radius);
  g.mass.push_back(mass);
  g.orientation.push_back(no_rotation<Dim>());
  g.angular_velocity.push_back(RotationVector<Dim>::Zero());
}

/// Adds a grain of density 1.
/// @param shape  index of its shape in the table of shapes
template <int Dim>
void add_shaped(Packing<Dim>& packing, const Vec<Dim>& position, int shape, double diameter) {
  Grains<Dim>& g = packing.grains;
  const Shape<Dim>& own = (*g.shapes)[static_cast<std::size_t>(shape)];
  add_grain(packing, position, 0.5 * diameter, std::pow(diameter / own.diameter(), Dim) * own.volume);
  g.shape.push_back(shape);
  g.scale.push_back(diameter / own.diameter());
}

/// Returns a block with the given sides that stands on the floor. Along the other axes, the centre of the block is at
/// 20.
template <int Dim>
Packing<Dim> block_on_floor(const Vec<Dim>& sides, double friction) {
  Packing<Dim> packing = empty_packing<Dim>(friction);
  add_floor(packing);
  packing.grains.shapes = std::make_shared<std::vector<Shape<Dim>>>(1, box<Dim>(sides, 0.0));
  Vec<Dim> centre = Vec<Dim>::Constant(20.0);
  centre[Dim - 1] = 0.5 * sides[Dim - 1];
  add_shaped(packing, centre, 0, sides.norm());
  return packing;
}

ContactDynamicsSettings exact(double step, double restitution = 0.0) {
  return {.longest_step = step, .sweep_tolerance = 1e-13, .max_sweeps = 100'000, .restitution = restitution};
}

template <int Dim>
ContactDynamics<Dim> dynamics(const Packing<Dim>& packing, const ContactDynamicsSettings& settings,
                              const Vec<Dim>& gravity = Vec<Dim>::Zero()) {
  Packing<Dim> heavy = packing;
  heavy.gravity = gravity;
  return {std::move(heavy), {}, settings, settings.longest_step};
}

/// Returns gravity of magnitude 1 in axes that are aligned with an inclined plane.
/// @param tangent  tangent of the inclination of the plane
template <int Dim>
Vec<Dim> slope(double tangent) {
  Vec<Dim> g = Vec<Dim>::Zero();
  g[0] = std::sin(std::atan(tangent));
  g[Dim - 1] = -std::cos(std::atan(tangent));
  return g;
}

// A stack of disks over several time steps. Already after the first step, each contact must carry the weight of the
// disks above it. This must not depend on the length of the step.
TEST(ContactDynamics, StackOfDisksCarriesItsWeightInOneStep) {
  Packing<2> packing = empty_packing<2>(0.0);
  add_floor(packing);
  constexpr int kDisks = 20;
  for (int k = 0; k < kDisks; ++k) add_grain<2>(packing, {20.0, 0.5 + k}, 0.5, 1.0);
  for (const double step : {1e-3, 0.1}) {
    ContactDynamics<2> motion = dynamics<2>(packing, exact(step), {0.0, -1.0});
    motion.step(false);
    ASSERT_EQ(motion.packing().contacts.size(), kDisks);
    for (const Contact<2>& c : motion.packing().contacts)
      EXPECT_NEAR(c.normal_force, motion.packing().is_wall(c.j) ? kDisks : kDisks - c.j, 1e-8);
    EXPECT_EQ(motion.last_step(), step);
  }
}

// The first ball hits a row of equal balls. Newton's law of restitution must hold at all contacts simultaneously.
TEST(ContactDynamics, RowOfBallsSharesTheImpact) {
  for (const double e : {0.0, 0.5, 1.0}) {
    constexpr int kBalls = 3;
    Packing<3> packing = empty_packing<3>(0.0);
    for (int k = 0; k < kBalls; ++k) add_grain<3>(packing, {10.5 + k, 20.0, 20.0}, 0.5, 1.0);
    packing.grains.velocity[0][0] = 1.0;
    ContactDynamics<3> motion = dynamics<3>(packing, exact(1e-3, e));
    motion.step(false);
    const double last = (1.0 + e) / kBalls;
    EXPECT_NEAR(motion.packing().grains.velocity[0][0], last - e, 1e-12);
    EXPECT_NEAR(motion.packing().grains.velocity[1][0], last, 1e-12);
    EXPECT_NEAR(motion.packing().grains.velocity[2][0], last, 1e-12);
    for (const Contact<3>& c : motion.packing().contacts)
      EXPECT_NEAR(1e-3 * c.normal_force, (kBalls - 1.0 - c.i) * last, 1e-12);
  }
}

TEST(ContactDynamics, DroppedBallBouncesWithItsRestitution) {
  Packing<2> packing = empty_packing<2>(0.0);
  add_floor(packing);
  add_grain<2>(packing, {20.0, 0.6}, 0.5, 1.0);
  packing.grains.velocity[0][1] = -1.0;
  ContactDynamics<2> motion = dynamics<2>(packing, exact(1e-3, 0.6));
  while (motion.packing().grains.velocity[0][1] < 0.0) motion.step(false);
  EXPECT_NEAR(motion.packing().grains.velocity[0][1], 0.6, 1e-12);
}

template <int Dim>
void slides_to_rest() {
  Vec<Dim> down = Vec<Dim>::Zero();
  down[Dim - 1] = -1.0;
  Packing<Dim> packing = block_on_floor<Dim>(Vec<Dim>::Ones(), 0.3);
  packing.grains.velocity[0][0] = 0.6;
  const double step = 0.01;
  ContactDynamics<Dim> motion = dynamics<Dim>(packing, exact(step), down);
  for (int k = 0; k < 300; ++k) motion.step(false);
  const Grains<Dim>& g = motion.packing().grains;
  // The sliding distance is v0^2/(2 mu g) - v0 dt/2 for the initial speed v0.
  EXPECT_NEAR(g.position[0][0] - 20.0, 0.6 - 0.5 * 0.6 * step, 1e-10);
  EXPECT_LT(g.velocity[0].norm(), 1e-12);
  EXPECT_LT(g.angular_velocity[0].norm(), 1e-12);
}

/// Returns the length of a step of grains of diameter 0.5 that touch no others, of which `n_fast` have the velocity 1 and
/// the others are at rest. The longest step is 0.05.
template <int Dim>
double step_of_free_grains(int n_grains, int n_fast) {
  Packing<Dim> packing = empty_packing<Dim>(0.0);
  constexpr int kRow = 35;
  for (int k = 0; k < n_grains; ++k) {
    Vec<Dim> x = Vec<Dim>::Constant(20.0);
    x[0] = 0.5 + k % kRow;
    x[1] = 0.5 + k / kRow;
    add_grain<Dim>(packing, x, 0.25, 1.0);
    if (k < n_fast) packing.grains.velocity[k][0] = 1.0;
  }
  ContactDynamics<Dim> motion = dynamics<Dim>(packing, exact(0.05));
  motion.step(false);
  return motion.last_step();
}

// A grain may move by 2e-2 of its diameter in a step, which is halved until it does. Of more than 1000 grains, one in
// twenty may move four times as far.
TEST(ContactDynamics, FewFastGrainsDoNotMakeTheStepsOfManyShort) {
  EXPECT_EQ(step_of_free_grains<2>(1000, 1), 0.05 / 8);
  EXPECT_EQ(step_of_free_grains<2>(1100, 1), 0.05 / 2);
  EXPECT_EQ(step_of_free_grains<2>(1100, 55), 0.05 / 2);
  EXPECT_EQ(step_of_free_grains<2>(1100, 56), 0.05 / 8);
  EXPECT_EQ(step_of_free_grains<3>(1000, 1), 0.05 / 8);
  EXPECT_EQ(step_of_free_grains<3>(1100, 55), 0.05 / 2);
}

TEST(ContactDynamics, SlidingBlockStopsAfterItsPath) {
  slides_to_rest<2>();
  slides_to_rest<3>();
}

struct OnSlope {
  double width, height, tangent, friction;
  double acceleration;  // acceleration along the slope
  double lower, upper;  // normal forces of the lower and the upper contact point in the first step
};

// A block of width w and height h on a slope of angle a, with the friction coefficient mu: it slides if tan a > mu, it
// tips over if min(tan a, mu) > w/h, and otherwise it rests.
TEST(ContactDynamics, BlockOnASlopeRestsSlidesOrTips) {
  const double step = 0.005;
  for (const OnSlope& c : {OnSlope{1, 1, 0.45, 0.5, 0.0, 0.66114309, 0.25077841},
                           OnSlope{1, 1, 0.55, 0.5, 0.04381080, 0.65716193, 0.21905398},
                           OnSlope{1, 2, 0.45, 0.7, 0.0, 1.73265086, 0.09119215},
                           OnSlope{1, 2, 0.45, 0.4, 0.04559608, -1.0, -1.0}}) {
    ContactDynamics<2> motion =
        dynamics<2>(block_on_floor<2>({c.width, c.height}, c.friction), exact(step), slope<2>(c.tangent));
    motion.step(false);
    EXPECT_NEAR(motion.packing().grains.velocity[0][0] / step, c.acceleration, 1e-8);
    EXPECT_LT(motion.packing().grains.angular_velocity[0].norm(), 1e-10);
    ASSERT_EQ(motion.packing().contacts.size(), 2u);
    for (const Contact<2>& point : motion.packing().contacts) {
      if (c.lower < 0.0) continue;
      EXPECT_NEAR(point.normal_force, point.arm_i[0] > 0.0 ? c.lower : c.upper, 1e-8);
    }
  }
}

TEST(ContactDynamics, TallBlockTipsOverItsLowerEdge) {
  const double step = 0.005;
  ContactDynamics<2> motion = dynamics<2>(block_on_floor<2>({1.0, 2.0}, 0.7), exact(step), slope<2>(0.55));
  motion.step(false);
  EXPECT_LT(motion.packing().grains.angular_velocity[0][0], -1e-4);
  for (const Contact<2>& point : motion.packing().contacts)
    EXPECT_NEAR(point.normal_force, point.arm_i[0] > 0.0 ? 1.778718 : 0.0, 1e-6);
}

template <int Dim>
double acceleration_on_slope(double tangent, double friction) {
  Packing<Dim> packing = empty_packing<Dim>(friction);
  add_floor(packing);
  Vec<Dim> centre = Vec<Dim>::Constant(20.0);
  centre[Dim - 1] = 0.5;
  add_grain<Dim>(packing, centre, 0.5, 1.0);
  const double step = 0.01;
  ContactDynamics<Dim> motion = dynamics<Dim>(packing, exact(step), slope<Dim>(tangent));
  motion.step(false);
  return motion.packing().grains.velocity[0][0] / step / slope<Dim>(tangent)[0];
}

// Up to tan a = 3 mu, a disk rolls with the acceleration 2/3 g sin a. Up to tan a = 7/2 mu, a sphere rolls with
// 5/7 g sin a.
TEST(ContactDynamics, RoundGrainsRollOrSlideDownASlope) {
  EXPECT_NEAR(acceleration_on_slope<2>(0.5, 0.2), 2.0 / 3.0, 1e-10);
  EXPECT_NEAR(acceleration_on_slope<2>(0.5, 0.1), 0.8, 1e-10);
  EXPECT_NEAR(acceleration_on_slope<3>(0.5, 0.2), 5.0 / 7.0, 1e-10);
  EXPECT_NEAR(acceleration_on_slope<3>(0.5, 0.1), 0.8, 1e-10);
}

// Friction at the four contact points exerts a moment of mu m g sqrt(2)/2 about the vertical axis; the moment of
// inertia is m/6.
TEST(ContactDynamics, SpinningCubeStops) {
  Packing<3> packing = block_on_floor<3>(Vec<3>::Ones(), 0.3);
  packing.grains.angular_velocity[0][2] = 0.9;
  ContactDynamics<3> motion = dynamics<3>(packing, exact(1e-3), {0.0, 0.0, -1.0});
  double time = 0.0;
  while (motion.packing().grains.angular_velocity[0][2] > 1e-9 && time < 1.0) {
    motion.step(false);
    time += motion.last_step();
  }
  EXPECT_NEAR(time, 0.9 * std::numbers::sqrt2 / (6.0 * 0.3), 2e-3);
}

// Column of ten cubes. Each cube is shifted by 0.04 relative to the cube below it. The force on the base of a cube is
// the weight of this cube and the cubes above, and acts below their common centre of mass.
TEST(ContactDynamics, LeaningColumnOfCubesStands) {
  constexpr int kCubes = 10;
  constexpr double kShift = 0.04;
  Packing<3> packing = empty_packing<3>(0.5);
  add_floor(packing);
  packing.grains.shapes = std::make_shared<std::vector<Shape<3>>>(1, box<3>(Vec<3>::Ones(), 0.0));
  for (int k = 0; k < kCubes; ++k)
    add_shaped<3>(packing, {20.0 + kShift * k, 20.0, 0.5 + k}, 0, std::sqrt(3.0));
  ContactDynamicsSettings settings = exact(0.01);
  settings.sweep_tolerance = 1e-11;
  settings.max_sweeps = 400'000;
  ContactDynamics<3> motion = dynamics<3>(packing, settings, {0.0, 0.0, -1.0});
  motion.step(false);
  for (int k = 0; k < kCubes; ++k) {
    double force = 0.0, moment = 0.0;
    for (const Contact<3>& c : motion.packing().contacts) {
      const bool below = motion.packing().is_wall(c.j) ? k == 0 : c.j == k && c.i == k - 1;
      if (!below) continue;
      const Vec<3> point = motion.packing().grains.position[c.i] + c.arm_i;
      force += c.normal_force;
      moment += c.normal_force * point[0];
    }
    EXPECT_NEAR(force, kCubes - k, 1e-8);
    EXPECT_NEAR(moment / force, 20.0 + kShift * 0.5 * (k + kCubes - 1), 1e-6);
  }
}

/// Returns a gas of moving pentagons and disks without load.
Packing<2> moving_mixture() {
  Packing<2> packing = empty_packing<2>(0.3);
  packing.cell.matrix = 10.0 * Mat<2>::Identity();
  packing.grains.shapes = std::make_shared<std::vector<Shape<2>>>(
      std::vector<Shape<2>>{regular_polygon(5, 0.0), round_shape<2>(0.5)});
  for (int k = 0; k < 64; ++k) {
    add_shaped<2>(packing, {0.7 + 1.25 * (k % 8), 0.7 + 1.25 * (k / 8)}, k % 2, 1.1);
    packing.grains.velocity.back() = Vec<2>(std::sin(7.0 * k), std::cos(5.0 * k));
    packing.grains.orientation.back() = k;
  }
  return packing;
}

double energy(const Packing<2>& packing) {
  return mean_kinetic_energy(packing) * packing.grains.size();
}

TEST(ContactDynamics, CollisionsKeepMomentumAndNeverAddEnergy) {
  for (const double e : {0.0, 0.7}) {
    const Packing<2> start = moving_mixture();
    ContactDynamicsSettings settings = exact(0.01, e);
    settings.sweep_tolerance = 1e-10;
    ContactDynamics<2> motion(start, {}, settings, 0.01);
    Vec<2> before = Vec<2>::Zero();
    double scale = 0.0;
    for (int i = 0; i < start.grains.size(); ++i) {
      before += start.grains.mass[i] * start.grains.velocity[i];
      scale += start.grains.mass[i] * start.grains.velocity[i].norm();
    }
    double last = energy(start);
    for (int k = 0; k < 300; ++k) {
      motion.step(false);
      // The correction of overlaps may add energy, so the tolerance allows for a small increase.
      EXPECT_LE(energy(motion.packing()), last * (1.0 + 1e-3)) << k;
      last = energy(motion.packing());
    }
    Vec<2> after = Vec<2>::Zero();
    for (int i = 0; i < start.grains.size(); ++i)
      after += start.grains.mass[i] * motion.packing().grains.velocity[i];
    EXPECT_LT((after - before).norm(), 1e-12 * scale);
    EXPECT_LT(last, 0.9 * energy(start));
  }
}

}  // namespace
}  // namespace floc
