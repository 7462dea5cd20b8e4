#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/verification/verify_rigid.h"
#include "support/rigid_gas.h"

namespace floc::test {
namespace {

using ::testing::HasSubstr;

/// Returns a load with constant length of the first axis and a pressure of 1 on the last axis.
template <int Dim>
LoadTarget<Dim> held_aside(const Packing<Dim>& packing) {
  LoadTarget<Dim> load = LoadTarget<Dim>::normal_stress(Vec<Dim>::Ones());
  load.stress[0] = 0.0;
  load.side[0] = packing.cell.matrix(0, 0);
  return load;
}

template <int Dim>
LoadTarget<Dim> under_shear(const Packing<Dim>& packing, double strain) {
  LoadTarget<Dim> load = held_aside(packing);
  load.offset =
      ImposedOffset{Dim - 1, packing.cell.matrix(Dim - 1, 0) + strain * packing.cell.matrix(Dim - 1, Dim - 1)};
  return load;
}

template <int Dim>
void expect_holds(const std::vector<Criterion>& criteria) {
  for (const Criterion& c : criteria)
    EXPECT_TRUE(c.holds) << c.name << " " << c.value.value_or(0.0) << " " << c.where;
}

/// Shears a packing at rest. Expects that the lengths are the imposed ones, and that the recorded forces are those of
/// the last time step. Also expects identical results, bit for bit, with several threads and after interruptions.
template <int Dim>
void expect_sheared(const RigidGas& gas, double strain) {
  const RigidEnd<Dim> rest = relaxed<Dim>(make_rigid_gas<Dim>(gas));
  ASSERT_EQ(rest.status, RelaxationStatus::converged) << rest.reason;
  const LoadTarget<Dim> load = under_shear(rest.packing, strain);
  const RigidEnd<Dim> end = relaxed_under<Dim>(load, rest.packing);
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  EXPECT_EQ(end.report.ending, "moving");
  EXPECT_EQ(end.packing.cell.matrix(0, 0), rest.packing.cell.matrix(0, 0));
  EXPECT_EQ(end.packing.cell.matrix(Dim - 1, 0), load.offset->offset);
  const State<Dim> state = state_in_motion(end, load);
  expect_holds<Dim>(verify_motion(state));
  expect_same(end, relaxed_under<Dim>(load, rest.packing, rigid_options(), true));
  RelaxationOptions options = rigid_options();
  options.threads = 2;
  expect_same(end, relaxed_under<Dim>(load, rest.packing, options));
}

TEST(StrainOfRigidGrains, ShearsDisks) {
  expect_sheared<2>({.count = 60, .friction = 0.5}, 0.03);
}

TEST(StrainOfRigidGrains, ShearsPentagons) {
  expect_sheared<2>({.count = 40, .shape = ShapeOptions{.kind = PolygonOptions{5}}, .friction = 0.5}, -0.02);
}

TEST(StrainOfRigidGrains, ShearsStickySpheres) {
  expect_sheared<3>({.count = 40, .friction = 0.3, .adhesion = 0.1}, 0.01);
}

TEST(StrainOfRigidGrains, ShearsPolyhedra) {
  expect_sheared<3>({.count = 16, .shape = ShapeOptions{.kind = CutOptions{}, .count = 4}, .friction = 0.5},
                    0.01);
}

/// Without contacts, grains move only with the imposed strain, so their reduced coordinates are constant. The duration
/// of the motion follows from the strain rate.
TEST(StrainOfRigidGrains, CarriesAGasAlong) {
  Packing<2> gas = make_rigid_gas<2>({.count = 10});
  gas.cell.matrix *= 4.0;
  for (Vec<2>& x : gas.grains.position) x *= 4.0;
  LoadTarget<2> load = under_shear(gas, 0.02);
  load.side[0] *= std::exp(0.01);
  RelaxationOptions options = rigid_options();
  options.contact_dynamics.inertial_number = 0.05;
  options.cell_mass = 1e9;  // so that the axis under stress keeps its length
  const RigidEnd<2> end = relaxed_under<2>(load, gas, options);
  ASSERT_EQ(end.status, RelaxationStatus::converged);
  const double unit = std::sqrt(largest_mass(gas.grains));
  EXPECT_NEAR(end.report.time, 0.02 / 0.05 * unit, 1e-12 * unit);
  for (int i = 0; i < 10; ++i)
    EXPECT_LT(
        (end.packing.cell.reduced(end.packing.grains.position[i]) - gas.cell.reduced(gas.grains.position[i]))
            .norm(),
        1e-7);
}

/// Computes the momentum balance of the recorded time step again, with the recorded forces. At the end of the step, two
/// disks in contact must neither separate nor approach each other.
TEST(StrainOfRigidGrains, RecordedForcesStopTheApproach) {
  const RigidEnd<2> rest = relaxed<2>(make_rigid_gas<2>({.count = 60, .friction = 0.5}));
  const LoadTarget<2> load = under_shear(rest.packing, 0.02);
  const RigidEnd<2> end = relaxed_under<2>(load, rest.packing);
  ASSERT_TRUE(end.report.motion);
  const double dt = end.report.motion->time_step;
  const Packing<2>& p = end.packing;
  const Balance<2> net = net_forces(p);
  // Equation of motion of the axis under stress.
  double mass = 0.0;
  for (const double m : p.grains.mass) mass += m;
  const double side = p.cell.matrix(1, 1);
  Mat<2> rate = p.cell.rate();
  rate(1, 1) += dt * p.cell.volume() * (static_stress(p)(1, 1) - 1.0) /
                (end.report.motion->cell_mass * mass * side * side);
  const auto velocity = [&](int i) -> Vec<2> {
    return p.grains.velocity[i] + dt / p.grains.mass[i] * net.force[i];
  };
  const double tolerance = 20.0 * end.report.motion->sweep_tolerance * dt * mean_repulsive_force(p);
  int n = 0;
  for (const Contact<2>& c : p.contacts) {
    const Vec<2> r = c.arm_i - c.arm_j;
    const double closing = (velocity(c.j) - velocity(c.i) + rate * r).dot(c.normal);
    const double gap_left = c.gap > 0.0 ? c.gap / dt : 0.1 * c.gap / dt;
    EXPECT_NEAR(closing + gap_left, 0.0, tolerance / std::min(p.grains.mass[c.i], p.grains.mass[c.j]));
    ++n;
  }
  EXPECT_GT(n, 40);
}

/// A strain that is much smaller than one of a time step ends in a step that is cut off. The recorded forces are
/// nevertheless those of a usual step, and their stress is about that before the strain. The forces of the short step
/// would grow without limit, since its impulses also change the velocities.
TEST(StrainOfRigidGrains, RecordsTheStressOfAUsualStepAfterAnyStrain) {
  const RigidEnd<2> rest = relaxed<2>(make_rigid_gas<2>({.count = 60, .friction = 0.5}));
  const RigidEnd<2> moving = relaxed_under<2>(under_shear(rest.packing, 0.02), rest.packing);
  const double before = static_stress(moving.packing)(1, 1);
  for (const double strain : {1e-5, 1e-6, 1e-8, 1e-12}) {
    SCOPED_TRACE(strain);
    const LoadTarget<2> load = under_shear(moving.packing, strain);
    const RigidEnd<2> end = relaxed_under<2>(load, moving.packing);
    ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
    EXPECT_GT(static_stress(end.packing)(1, 1), 0.5 * before);
    EXPECT_LT(static_stress(end.packing)(1, 1), 2.0 * before);
    expect_holds<2>(verify_motion(state_in_motion(end, load)));
  }
}

TEST(StrainOfRigidGrains, VerificationFindsWrongForcesAndVelocities) {
  const RigidEnd<2> rest = relaxed<2>(make_rigid_gas<2>({.count = 60, .friction = 0.5}));
  const LoadTarget<2> load = under_shear(rest.packing, 0.02);
  const State<2> state = state_in_motion(relaxed_under<2>(load, rest.packing), load);
  const auto fails = [](const State<2>& spoiled) {
    std::string names;
    for (const Criterion& c : verify_motion(spoiled))
      if (!c.holds) names += std::string(c.name) + " ";
    return names;
  };
  EXPECT_EQ(fails(state), "");
  State<2> spoiled = state;
  Contact<2>& c = spoiled.packing.contacts[5];
  c.elastic_force = c.normal_force *= 1.5;
  EXPECT_THAT(fails(spoiled), HasSubstr("step"));
  spoiled = state;
  spoiled.packing.grains.velocity[state.packing.contacts[5].i] *= -1.0;
  EXPECT_THAT(fails(spoiled), HasSubstr("step"));
  spoiled = state;
  spoiled.packing.contacts.erase(spoiled.packing.contacts.begin() + 5);
  EXPECT_THAT(fails(spoiled), HasSubstr("step"));
  spoiled = state;
  spoiled.packing.grains.position[state.packing.contacts[5].i][0] += 1e-6;
  EXPECT_THAT(fails(spoiled), HasSubstr("geometry"));
  spoiled = state;
  spoiled.target_side[0] *= 1.001;
  EXPECT_THAT(fails(spoiled), HasSubstr("length"));
}

/// Under an oedometric load, one axis keeps its length. The stress along this axis is not imposed: it follows from the
/// balanced forces.
template <int Dim>
void expect_held(const RigidGas& gas, RigidForces forces) {
  const RigidEnd<Dim> rest = relaxed<Dim>(make_rigid_gas<Dim>(gas));
  ASSERT_EQ(rest.status, RelaxationStatus::converged) << rest.reason;
  LoadTarget<Dim> load = held_aside(rest.packing);
  load.stress[Dim - 1] = 3.0;
  RelaxationOptions options = rigid_options();
  options.contact_dynamics.forces = forces;
  const RigidEnd<Dim> end = relaxed_under<Dim>(load, rest.packing, options);
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  expect_holds<Dim>(verify_rigid(state_in_motion(end, load), default_gap_tolerance(end.packing)));
  const Mat<Dim> stress = static_stress(end.packing);
  EXPECT_NEAR(stress(Dim - 1, Dim - 1), 3.0, 1e-5);
  EXPECT_GT(stress(0, 0), 0.1);
  EXPECT_EQ(end.packing.cell.matrix(0, 0), rest.packing.cell.matrix(0, 0));
}

TEST(StrainOfRigidGrains, HoldsALength) {
  expect_held<2>({.count = 60, .friction = 0.5}, RigidForces::closest);
  expect_held<2>({.count = 40, .shape = ShapeOptions{.kind = PolygonOptions{5}}, .friction = 0.5},
                 RigidForces::canonical);
  expect_held<3>({.count = 40, .friction = 0.3}, RigidForces::closest);
}

TEST(StrainOfRigidGrains, NeedsAStressAndAnOpenCell) {
  const Packing<2> gas = make_rigid_gas<2>({.count = 10});
  LoadTarget<2> load = held_aside(gas);
  load.side[1] = gas.cell.matrix(1, 1);
  EXPECT_THAT([&] { relaxed_under<2>(load, gas); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("the lengths of all axes are imposed")));
  load = held_aside(gas);
  load.side[0] = 0.1;
  const RigidEnd<2> end = relaxed_under<2>(load, gas);
  EXPECT_EQ(end.status, RelaxationStatus::gave_up);
  EXPECT_EQ(end.report.ending, "closed");
  EXPECT_THAT(end.reason, HasSubstr("the imposed length of axis 1 is 0.1"));
}

}  // namespace
}  // namespace floc::test
