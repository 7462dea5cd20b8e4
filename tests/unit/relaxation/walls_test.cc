#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/base/error.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/static_solver.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/few_grains.h"
#include "support/springs.h"

namespace floc {
namespace {

using test::agitated_gas;
using test::cohesive_law;

/// Puts walls across the first `n_axes` axes of a gas, outside its cell by half of the largest diameter.
Packing<2> boxed(Packing<2> gas, int n_axes, const Law& wall_law) {
  for (int a = 0; a < n_axes; ++a) {
    gas.walls.push_back({a, -1, -0.5, 0.0, 20.0});
    gas.walls.push_back({a, +1, gas.cell.matrix(a, a) + 0.5, 0.0, 20.0});
    gas.cell.matrix(a, a) += 1.0;
  }
  gas.wall_law = wall_law;
  gas.contacts.clear();
  return gas;
}

Packing<2> one_disk() {
  return test::unit_grains<2>({{5.0, 5.0}}, 10.0, test::law_of({test::linear(1.0)}));
}

/// Returns one disk in a box whose walls on both axes touch it.
Packing<2> box_around_one_disk(const Law& law) {
  Packing<2> packing = one_disk();
  packing.law = packing.wall_law = law;
  for (int a = 0; a < 2; ++a) {
    packing.cell.matrix(a, a) = 1.0;
    packing.walls.push_back({a, -1, 4.5, 0.0, 2.0});
    packing.walls.push_back({a, +1, 5.5, 0.0, 2.0});
  }
  return packing;
}

BoundaryControl<2> pressure(double p) {
  return BoundaryControl<2>::normal_stress(Vec<2>::Constant(p), 100.0);
}

double momentum(const Packing<2>& packing, int axis) {
  double sum = 0.0;
  for (int i = 0; i < packing.grains.size(); ++i)
    sum += packing.grains.mass[i] * packing.grains.velocity[i][axis];
  for (const Wall<2>& wall : packing.walls)
    if (wall.axis == axis) sum += wall.mass * wall.velocity;
  return sum;
}

TEST(Walls, AroundManyGrainsLeaveTheSameBitsWhicheverRowsAreKept) {
  for (const int n_axes : {1, 2})
    test::expect_no_trace_of_kept_rows(
        boxed(test::large_agitated_gas<2>(cohesive_law()), n_axes, cohesive_law()));
}

/// The distance of two walls of an empty square box is L = L0 cos(t sqrt(2 p/m)), with the pressure p and the
/// mass m of a wall.
TEST(Walls, OfAnEmptyBoxFollowTheirPressure) {
  Packing<2> box = one_disk();
  for (int a = 0; a < 2; ++a) {
    box.walls.push_back({a, -1, 0.0, 0.0, 96.0});
    box.walls.push_back({a, +1, 10.0, 0.0, 96.0});
  }
  box.wall_law += test::linear(1.0);
  const double p = 2.0, dt = 1e-3;
  const auto dynamics = make_dynamics(box, pressure(p), {dt, 0.1});
  dynamics->advance(3000, Motion::free);
  const Packing<2> end = dynamics->packing();
  const double expected = 10.0 * std::cos(3.0 * std::sqrt(2.0 * p / 96.0));
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(end.cell.matrix(a, a), expected, 1e-5);
  EXPECT_NEAR(end.walls[0].position + end.walls[1].position, 10.0, 1e-12);
}

TEST(Walls, ApproachEachOtherAtTheRateGiven) {
  Packing<2> box = boxed(one_disk(), 1, one_disk().law);
  BoundaryControl<2> control = BoundaryControl<2>::fixed();
  control.target[0] = 0.01;
  const auto dynamics = make_dynamics(box, control, {1e-2, 0.1});
  dynamics->advance(1000, Motion::free);
  EXPECT_NEAR(std::log(dynamics->packing().cell.matrix(0, 0) / 11.0), -0.1, 1e-5);
}

/// Returns the speed of a disk after its impact on a wall at rest, divided by the speed before the impact. Returns zero
/// if the disk sticks. The units are K_N = m = F0 = 1; the contact has the adhesion F0 and a damping ratio of 0.248139.
/// Expected values are those of a damped oscillation (Bouzid et al. 2024, corrected).
double rebound(double speed) {
  Packing<2> packing = boxed(one_disk(), 1, {});
  packing.law += test::linear(1.0);
  packing.wall_law += test::linear(1.0);
  packing.wall_law += test::constant_adhesion(1.0);
  packing.wall_law += test::viscous_damping(std::sqrt(0.2));
  // Overlaps are of the order of the speed, so the disk has to be large.
  const double scale = 1000.0;
  packing.grains.radius[0] = scale;
  packing.cell.matrix *= 10.0 * scale;
  packing.walls[0].position = -scale;
  packing.walls[1].position = packing.cell.matrix(0, 0) - scale;
  packing.grains.position[0] = Vec<2>(1e-9, 0.0);
  packing.grains.velocity[0] = Vec<2>(-speed, 0.0);
  const double dt = 1e-3;
  const auto dynamics = make_dynamics(packing, BoundaryControl<2>::fixed(), {dt, 1.0});
  dynamics->advance(8000, Motion::free);
  const Packing<2> end = dynamics->packing();
  return end.contacts.empty() ? end.grains.velocity[0][0] / speed : 0.0;
}

TEST(Walls, ReflectAndCatchAGrainAsTheDampedOscillationSays) {
  EXPECT_NEAR(rebound(4.0), 0.15968, 2e-3);
  EXPECT_NEAR(rebound(5.0), 0.24834, 2e-3);
  EXPECT_NEAR(rebound(10.0), 0.36475, 2e-3);
  EXPECT_NEAR(rebound(100.0), 0.43994, 2e-3);
  EXPECT_EQ(rebound(3.45), 0.0);  // the disk sticks below a speed of 3.48447
  EXPECT_GT(rebound(3.52), 0.0);
}

TEST(Walls, MomentumOfGrainsAndWallsIsConserved) {
  const Packing<2> gas = agitated_gas(60, cohesive_law());
  Law smooth;
  smooth += test::linear(1e5);
  Packing<2> box = boxed(gas, 2, smooth);
  for (Wall<2>& wall : box.walls) wall.velocity = -0.5 * wall.side;
  const double dt = time_step_of(box, 0.2);
  const auto dynamics = make_dynamics(box, pressure(0.0), {dt, 0.05});
  dynamics->advance(4000, Motion::free);
  const Packing<2> end = dynamics->packing();
  int on_walls = 0;
  for (const Contact<2>& c : end.contacts) on_walls += end.is_wall(c.j);
  EXPECT_NE(end.walls[0].velocity, box.walls[0].velocity);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(momentum(end, a), momentum(box, a), 1e-9);
}

double total_energy(const Packing<2>& packing, const BoundaryControl<2>& control) {
  double energy = control.target[0] * packing.cell.volume();
  for (int a = 0; a < 2; ++a)
    if (!between_walls(packing.walls, a))
      energy += 0.5 * control.mass * std::pow(packing.cell.velocity(a, a), 2);
  for (const Wall<2>& wall : packing.walls) energy += 0.5 * wall.mass * wall.velocity * wall.velocity;
  for (int i = 0; i < packing.grains.size(); ++i)
    energy += 0.5 * packing.grains.mass[i] * packing.grains.velocity[i].squaredNorm();
  for (const Contact<2>& c : packing.contacts) energy += 0.5 * c.kn * c.gap * c.gap;
  return energy;
}

/// Returns the largest relative change of the energy of undamped disks between walls, with time steps of length
/// dt.
double energy_drift(int n_walled_axes, double dt, int n_steps) {
  Law law;
  law += test::linear(1.0);
  Packing<2> gas = test::gas_of(100, law, 0.7, 3);
  RandomStream random(4, 2);
  agitate(gas, 0.02, random);
  Law stiffer;
  stiffer += test::linear(1.5);
  const Packing<2> box = boxed(gas, n_walled_axes, stiffer);
  const BoundaryControl<2> control = pressure(1e-2);
  const auto dynamics = make_dynamics(box, control, {dt, 0.1});
  const double initial = total_energy(dynamics->packing(), control);
  double largest = 0.0;
  int on_walls = 0;
  for (int k = 0; k < 20; ++k) {
    dynamics->advance(n_steps / 20, Motion::free);
    const Packing<2> now = dynamics->packing();
    for (const Contact<2>& c : now.contacts) on_walls += now.is_wall(c.j);
    largest = std::max(largest, std::abs(total_energy(now, control) / initial - 1.0));
  }
  EXPECT_GT(on_walls, 20);
  return largest;
}

TEST(Walls, ConserveEnergyToSecondOrder) {
  for (const int n_walled_axes : {1, 2}) {
    SCOPED_TRACE(n_walled_axes);
    const double coarse = energy_drift(n_walled_axes, 0.1, 4000);
    const double fine = energy_drift(n_walled_axes, 0.025, 16000);
    EXPECT_LT(coarse, 2e-3);
    EXPECT_LT(fine, coarse / 8.0);
  }
}

/// A disk of diameter d between walls in equilibrium. On each axis, K_N D - f = p L and L = d - 2 D, with the overlap
/// D, the adhesion f, the pressure p and the side L.
TEST(Walls, HoldADiskInTheEquilibriumOfTheirPressure) {
  Law law = cohesive_law();
  law += test::constant_adhesion(1.0);
  const double p = 50.0, overlap = (1.0 + p) / (1e5 + 2.0 * p);
  Packing<2> box = box_around_one_disk(law);
  const auto dynamics = make_dynamics(box, pressure(p), {time_step_of(box, 0.2), 0.1});
  dynamics->advance(20000, Motion::free);
  const Packing<2> rest = dynamics->packing();
  ASSERT_EQ(rest.contacts.size(), 4u);
  for (int w = 0; w < 4; ++w) {
    const Contact<2>& c = rest.contacts[w];
    EXPECT_EQ(c.i, 0);
    EXPECT_EQ(c.j, 1 + w);
    EXPECT_NEAR(c.gap, -overlap, 1e-9);
    EXPECT_EQ(c.normal, rest.walls[w].normal());
    EXPECT_NEAR(c.normal_force, p * (1.0 - 2.0 * overlap), 1e-4);
  }
  EXPECT_NEAR(rest.cell.matrix(0, 0), 1.0 - 2.0 * overlap, 1e-9);
  const Mat<2> stress = static_stress(rest);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(stress(a, a), p, 1e-3);
  EXPECT_NEAR(net_forces(rest).force[0].norm(), 0.0, 1e-6);
}

/// A disk spins between two walls. The friction forces of the two walls form a couple, which stops the disk.
TEST(Walls, FrictionActsWithTheDistanceOfThePlaneAsItsArm) {
  Law law = cohesive_law();
  law += test::without("rolling");
  Packing<2> box = box_around_one_disk(law);
  box.walls.resize(2);  // the other axis stays periodic
  box.cell.matrix(1, 1) = 10.0;
  const double spin = 1e-4;
  box.grains.angular_velocity[0][0] = spin;
  BoundaryControl<2> control = BoundaryControl<2>::fixed();
  box.walls[0].position = 4.5 + 1e-4;
  box.walls[1].position = 5.5 - 1e-4;
  const double arm = 0.5 - 1e-4, inertia = box.grains.inertia(0);
  // The friction at the two walls acts like two springs K_T at the lever arm `arm`: I w' = -2 K_T arm^2 angle, with the
  // moment of inertia I and the angular velocity w.
  const double frequency = std::sqrt(2.0 * 1e5 * arm * arm / inertia);
  const double dt = 0.01 / frequency;
  const auto dynamics = make_dynamics(box, control, {dt, 0.1});
  dynamics->advance(100, Motion::free);
  const Packing<2> end = dynamics->packing();
  EXPECT_NEAR(end.grains.angular_velocity[0][0] / spin, std::cos(1.0), 1e-4);
  EXPECT_NEAR(end.grains.orientation[0] * frequency / spin, std::sin(1.0), 1e-4);
  EXPECT_NEAR(end.grains.velocity[0].norm(), 0.0, 1e-12);
  for (const Contact<2>& c : end.contacts)
    EXPECT_NEAR(test::shear_spring(c).norm(), arm * end.grains.orientation[0], 1e-12);
}

TEST(Walls, MirroredBoxesMoveAsMirrorImages) {
  Packing<2> box = boxed(agitated_gas(40, cohesive_law()), 2, cohesive_law());
  Packing<2> mirrored = box;
  const double middle = 0.5 * (box.walls[0].position + box.walls[1].position);
  for (int i = 0; i < box.grains.size(); ++i) {
    mirrored.grains.position[i][0] = 2.0 * middle - box.grains.position[i][0];
    mirrored.grains.velocity[i][0] *= -1.0;
  }
  const double dt = time_step_of(box, 0.2);
  const auto one = make_dynamics(box, pressure(1.0), {dt, 0.05});
  const auto other = make_dynamics(mirrored, pressure(1.0), {dt, 0.05});
  one->advance(300, Motion::free);
  other->advance(300, Motion::free);
  const Packing<2> p = one->packing(), q = other->packing();
  EXPECT_GT(p.contacts.size(), 10u);
  // Collisions amplify rounding errors.
  EXPECT_NEAR(p.walls[0].velocity, -q.walls[1].velocity, 1e-6);
  for (int i = 0; i < p.grains.size(); ++i)
    EXPECT_NEAR(p.grains.velocity[i][0], -q.grains.velocity[i][0], 1e-5);
}

void expect_same_bits(const Packing<2>& p, const Packing<2>& q) {
  EXPECT_EQ(p.walls, q.walls);
  EXPECT_EQ(p.grains.position, q.grains.position);
  EXPECT_EQ(p.grains.velocity, q.grains.velocity);
  ASSERT_EQ(p.contacts.size(), q.contacts.size());
  for (std::size_t c = 0; c < p.contacts.size(); ++c) {
    EXPECT_EQ(p.contacts[c].j, q.contacts[c].j);
    EXPECT_EQ(test::shear_spring(p.contacts[c]), test::shear_spring(q.contacts[c]));
  }
}

TEST(Walls, ListsThreadsAndInstructionsLeaveNoTraceInTheBits) {
  Law frictionless = cohesive_law();
  frictionless += test::without("friction");
  frictionless += test::without("rolling");
  for (const Law& wall_law : {cohesive_law(), frictionless}) {
    const Packing<2> box = boxed(agitated_gas(200, cohesive_law()), 2, wall_law);
    const double dt = time_step_of(box, 0.2);
    const auto after = [&](DynamicsSettings settings, std::initializer_list<int> parts) {
      const auto dynamics = make_dynamics(box, pressure(1.0), settings);
      for (const int n : parts) dynamics->advance(n, Motion::free);
      return dynamics->packing();
    };
    const Packing<2> reference = after({dt, 1e-3}, {1500});
    int on_walls = 0;
    for (const Contact<2>& c : reference.contacts) on_walls += reference.is_wall(c.j);
    EXPECT_GT(on_walls, 3);
    expect_same_bits(reference, after({dt, 0.3}, {1500}));
    expect_same_bits(reference, after({dt, 0.05, 2}, {100, 1400}));
    for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2})
      if (supported(set)) expect_same_bits(reference, after({dt, 0.05, 1, set}, {1500}));
  }
}

/// A run saves the packing with its walls and with the histories of contacts with walls, so that the motion can
/// continue from the saved packing.
TEST(Walls, MotionGoesOnFromThePackingThatItLeft) {
  const Packing<2> box = boxed(agitated_gas(100, cohesive_law()), 2, cohesive_law());
  const double dt = time_step_of(box, 0.2);
  const auto first = make_dynamics(box, pressure(1.0), {dt, 0.05});
  first->advance(600, Motion::free);
  const Packing<2> middle = first->packing();
  const auto second = make_dynamics(middle, pressure(1.0), {dt, 0.05});
  const Packing<2> again = second->packing();
  expect_same_bits(middle, again);
}

/// The walls are rough, but there is no friction between grains. Grains can therefore start to spin only at the walls.
TEST(Walls, MayHaveFrictionWhereGrainsHaveNone) {
  Law smooth;
  smooth += test::linear(1e5);
  Packing<2> box = boxed(agitated_gas(60, smooth), 2, cohesive_law());
  const auto dynamics = make_dynamics(box, pressure(1.0), {time_step_of(box, 0.2), 0.05});
  dynamics->advance(3000, Motion::free);
  const Packing<2> end = dynamics->packing();
  double largest = 0.0;
  for (const auto& spin : end.grains.angular_velocity) largest = std::max(largest, std::abs(spin[0]));
  EXPECT_GT(largest, 1e-3);
  for (const Contact<2>& c : end.contacts) {
    if (!end.is_wall(c.j)) {
      EXPECT_TRUE(c.shear_force.isZero(0.0));
    }
  }
}

/// Functions that support only periodic boundaries must say so in their message.
TEST(Walls, AreRefusedWhereNothingKnowsThem) {
  Packing<2> box = box_around_one_disk(cohesive_law());
  find_contacts(box);
  const auto refuses = testing::ThrowsMessage<InputError>(testing::HasSubstr("this packing has walls; "));
  EXPECT_THAT([&] { (void)solve_statics(box, pressure(1.0), StaticSolverOptions{}); }, refuses);
}

TEST(FindContacts, RefusesAGrainBeyondAWall) {
  Packing<2> box = box_around_one_disk(cohesive_law());
  box.grains.position[0][0] = 4.49;
  EXPECT_THAT([&] { find_contacts(box); }, testing::ThrowsMessage<InputError>(testing::HasSubstr(
                                               "grain 0: the grain has its centre on or beyond a wall")));
}

}  // namespace
}  // namespace floc
