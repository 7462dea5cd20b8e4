#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "floc/geometry/frame.h"
#include "floc/rigid/gauss_seidel.h"
#include "support/step_contacts.h"

namespace floc::test {
namespace {

/// Periodic square or cubic lattice of touching grains with diameter 1 and mass 1.
template <int Dim>
struct PeriodicLattice {
  int side;
  double friction = 0.0;

  int size() const { return static_cast<int>(std::lround(std::pow(side, Dim))); }
  BodyMotion<Dim> bodies() const {
    BodyMotion<Dim> out = balls_and_ground<Dim>(size(), 1.0, 0.5);
    return out;
  }
  std::vector<StepContact<Dim>> contacts() const {
    std::vector<StepContact<Dim>> out;
    for (int i = 0; i < size(); ++i)
      for (int a = 0, stride = 1; a < Dim; ++a, stride *= side) {
        const Vec<Dim> normal = Vec<Dim>::Unit(a);
        const int j = i / stride % side == side - 1 ? i - stride * (side - 1) : i + stride;
        out.push_back(touching<Dim>(i, j, 0.5 * normal, -0.5 * normal, normal, friction));
        out.back().branch = normal;
      }
    return out;
  }
  /// Puts the cell under pressure.
  /// @param cell_mass  mass of the cell, divided by the mass of all grains and the squared side
  void load(BodyMotion<Dim>& bodies, double pressure, double step, double cell_mass) const {
    bodies.inverse_stretch_mass.setConstant(1.0 / (cell_mass * size() * side * side));
    bodies.stretch = -step * pressure * std::pow(side, Dim) * bodies.inverse_stretch_mass;
  }
};

template <int Dim>
void expect_a_cell_to_come_to_rest(int side, double cell_mass) {
  constexpr double kPressure = 2.0, kStep = 0.1;
  const PeriodicLattice<Dim> lattice{.side = side, .friction = 0.3};
  BodyMotion<Dim> bodies = lattice.bodies();
  lattice.load(bodies, kPressure, kStep, cell_mass);
  std::vector<StepContact<Dim>> contacts = lattice.contacts();
  const SweepResult result = GaussSeidel<Dim>(bodies, contacts).solve(1e-12, 200'000, 10);
  EXPECT_TRUE(result.converged) << result.residual;
  EXPECT_LT(bodies.stretch.norm(), 1e-9);
  // The pressure determines only the mean of the forces along the rows of grains; the forces of single rows may differ
  // from the mean.
  Vec<Dim> mean = Vec<Dim>::Zero();
  for (const StepContact<Dim>& c : contacts) mean += c.impulse[0] / kStep / lattice.size() * c.branch;
  for (int a = 0; a < Dim; ++a) EXPECT_NEAR(mean[a], kPressure, 1e-9);
}

TEST(GaussSeidel, ACellUnderPressureComesToRestOnItsGrains) {
  // Contacts of one colour are solved simultaneously. If the mass of the cell is small, their impulses move the cell
  // more than any grain.
  for (const double cell_mass : {1.0, 0.01, 1e-4}) {
    expect_a_cell_to_come_to_rest<2>(5, cell_mass);
    expect_a_cell_to_come_to_rest<2>(20, cell_mass);
    expect_a_cell_to_come_to_rest<3>(4, cell_mass);
  }
}

TEST(GaussSeidel, AnImposedRateOfStretchIsPartOfTheRelativeVelocity) {
  const PeriodicLattice<2> lattice{.side = 4};
  BodyMotion<2> bodies = lattice.bodies();
  bodies.stretch = {0.3, 0.2};
  std::vector<StepContact<2>> contacts = lattice.contacts();
  // The contacts are springs that close with the speed 1. The motion of the cell cancels only a part of this speed.
  for (StepContact<2>& c : contacts) {
    c.normal_compliance = 2.0;
    c.bias[0] = -1.0;
  }
  ASSERT_TRUE(GaussSeidel<2>(bodies, contacts).solve(1e-13, 1000).converged);
  EXPECT_EQ(bodies.stretch, Vec<2>(0.3, 0.2));
  for (const StepContact<2>& c : contacts)
    EXPECT_NEAR(c.impulse[0], (1.0 - c.branch.dot(bodies.stretch)) / 2.0, 1e-13);
}

/// Lattice with random velocities, in a cell under pressure.
template <int Dim>
struct RandomStep {
  BodyMotion<Dim> bodies;
  std::vector<StepContact<Dim>> contacts;

  RandomStep(bool round, bool cell) {
    const PeriodicLattice<Dim> lattice{.side = Dim == 2 ? 40 : 12, .friction = 0.5};
    std::mt19937 engine(5);
    std::normal_distribution<double> normal;
    const auto noise = [&] { return normal(engine); };
    bodies = lattice.bodies();
    contacts = lattice.contacts();
    for (int i = 0; i < lattice.size(); ++i) {
      bodies.velocity[i] = Vec<Dim>::NullaryExpr(noise);
      bodies.angular_velocity[i] = RotationVector<Dim>::NullaryExpr(noise);
    }
    for (StepContact<Dim>& c : contacts) {
      if (!round) c.arm_i += 0.1 * Vec<Dim>::NullaryExpr(noise);
      c.bias[0] = 0.1 * noise();
    }
    if (cell) lattice.load(bodies, 1.0, 0.1, 1.0);
  }
};

template <int Dim>
void expect_the_same_bits(bool round, bool cell) {
  RandomStep<Dim> expected(round, cell);
  GaussSeidel<Dim>(expected.bodies, expected.contacts).solve(1e-3, 200);
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512})
    for (const int threads : {1, 2, 3, 4}) {
      if (!supported(set)) continue;
      RandomStep<Dim> found(round, cell);
      GaussSeidel<Dim>(found.bodies, found.contacts, threads, set).solve(1e-3, 200);
      const std::string where = fmt::format("{} threads, instruction set {}", threads, static_cast<int>(set));
      EXPECT_EQ(found.bodies.velocity, expected.bodies.velocity) << where;
      EXPECT_EQ(found.bodies.angular_velocity, expected.bodies.angular_velocity) << where;
      EXPECT_EQ(found.bodies.stretch, expected.bodies.stretch) << where;
      for (std::size_t k = 0; k < found.contacts.size(); ++k)
        ASSERT_EQ(found.contacts[k].impulse, expected.contacts[k].impulse) << where << ", contact " << k;
    }
}

TEST(GaussSeidel, GivesTheSameBitsForAnyNumberOfThreadsAndInstructionSet) {
  for (const bool round : {true, false})
    for (const bool cell : {true, false}) {
      expect_the_same_bits<2>(round, cell);
      expect_the_same_bits<3>(round, cell);
    }
}

/// Presses a body against its own periodic image, in a cell whose side shrinks.
template <int Dim>
void expect_a_body_to_touch_its_image(bool round) {
  BodyMotion<Dim> bodies = balls_and_ground<Dim>(1, 2.0, 0.5);
  bodies.velocity[0].setLinSpaced(0.3, 0.7);
  bodies.angular_velocity[0].setLinSpaced(0.1, 0.2);
  bodies.inverse_stretch_mass.setConstant(0.8);
  bodies.stretch[0] = -1.0;
  const Vec<Dim> velocity = bodies.velocity[0], normal = Vec<Dim>::Unit(0);
  std::vector<StepContact<Dim>> contacts{touching<Dim>(0, 0, 0.5 * normal, -0.5 * normal, normal, 0.3)};
  contacts[0].branch = normal;
  if (!round) contacts[0].arm_i[1] = 0.2;
  const RotationVector<Dim> spin = bodies.angular_velocity[0];
  ASSERT_TRUE(GaussSeidel<Dim>(bodies, contacts).solve(1e-12, 1000).converged);
  // The impulses on both sides cancel, their moments do not.
  EXPECT_LT((bodies.velocity[0] - velocity).norm(), 1e-15);
  const Vec<Dim> in_space = contacts[0].frame * contacts[0].impulse;
  const RotationVector<Dim> turned =
      bodies.inverse_inertia[0] * moment<double>(Vec<Dim>(contacts[0].arm_j - contacts[0].arm_i), in_space);
  EXPECT_LT((bodies.angular_velocity[0] - spin - turned).norm(), 1e-13);
  // Both sides have the same velocity, and the spin turns the two arms in opposite directions, so that the normal
  // velocity is that of the cell and, for bodies that are not round, of the spin.
  const Vec<Dim> closing =
      cross<double>(bodies.angular_velocity[0], Vec<Dim>(contacts[0].arm_j - contacts[0].arm_i)) +
      bodies.stretch.cwiseProduct(normal);
  EXPECT_NEAR(closing[0], 0.0, 1e-11);
  EXPECT_GT(contacts[0].impulse[0], 0.0);
}

TEST(GaussSeidel, ABodyTouchesItsOwnImage) {
  for (const bool round : {true, false}) {
    expect_a_body_to_touch_its_image<2>(round);
    expect_a_body_to_touch_its_image<3>(round);
  }
}

/// Disks in a row on the ground, under a wall that is pressed down and moves only vertically.
struct RowUnderWall {
  int n_disks;
  BodyMotion<2> bodies;
  std::vector<StepContact<2>> contacts;

  RowUnderWall(int n, double impulse) : n_disks(n), bodies(balls_and_ground<2>(n + 1, 1.0, 0.5)) {
    const int wall = n, ground = n + 1;
    bodies.inverse_mass[wall] = {0.0, 0.1};
    bodies.inverse_inertia[wall].setZero();
    bodies.velocity[wall] = {0.5, -0.1 * impulse};
    for (int k = 0; k < n; ++k) {
      contacts.push_back(touching<2>(k, wall, {0.0, 0.5}, {0.0, 0.0}, {0.0, 1.0}, 0.2));
      contacts.push_back(touching<2>(k, ground, {0.0, -0.5}, {0.0, 0.0}, {0.0, -1.0}, 1.0));
    }
  }
};

TEST(GaussSeidel, AWallMovesAlongItsAxisOnly) {
  for (const int n : {2, 100}) {
    RowUnderWall row(n, 3.0);
    ASSERT_TRUE(GaussSeidel<2>(row.bodies, row.contacts, 2).solve(1e-12, 100'000).converged);
    // The wall slides over the disks, and its friction makes the disks roll.
    EXPECT_EQ(row.bodies.velocity[n][0], 0.5);
    EXPECT_NEAR(row.bodies.velocity[n][1], 0.0, 1e-12);
    double carried = 0.0;
    for (const StepContact<2>& c : row.contacts)
      if (c.j == n) carried += c.impulse[0];
    EXPECT_NEAR(carried, 3.0, 1e-10);
    EXPECT_EQ(row.bodies.velocity[n + 1], Vec<2>(0.0, 0.0)) << "the ground";
  }
}

TEST(GaussSeidel, ContactsOfAWallShareTheLastColour) {
  RowUnderWall row(100, 3.0);
  EXPECT_EQ(GaussSeidel<2>(row.bodies, row.contacts).n_colours(), 64);
}

TEST(GaussSeidel, LeavesContactsOfFixedBodiesAlone) {
  BodyMotion<2> bodies = balls_and_ground<2>(1, 1.0, 0.5);
  bodies.inverse_mass[0].setZero();
  bodies.inverse_inertia[0].setZero();
  bodies.velocity[0] = {0.0, -1.0};
  std::vector<StepContact<2>> contacts{touching<2>(0, 1, {0.0, 0.0}, {0.0, 0.0}, {0.0, -1.0}, 0.0)};
  EXPECT_TRUE(GaussSeidel<2>(bodies, contacts).solve(1e-12, 10).converged);
  EXPECT_EQ(contacts[0].impulse, Vec<2>(0.0, 0.0));
}

}  // namespace
}  // namespace floc::test
