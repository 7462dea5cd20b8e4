#include <gtest/gtest.h>

#include <cmath>

#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/relaxation_options.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/few_grains.h"
#include "support/kernel_pair.h"

namespace floc {
namespace {

using test::KernelPair;

/// Law of glass beads. The units are the diameter a, the modulus E~ = E/(1 - nu^2) and, for motions, the mass.
Law glass_of_unit_modulus(double friction = 0.3) {
  Law law;
  law += test::hertz(1.0 - 0.09, 0.3);
  law += test::mindlin(friction);
  return law;
}

constexpr double kOverlap = 1e-4;
constexpr double kForce = 1e-4 / 300.0;  // normal force E~ sqrt(a) h^1.5/3
constexpr double kShear = 5e-8;          // half the friction limit, mu N/2
constexpr double kSlip = kShear / 4.117647e-3;

const std::vector<InstructionSet>& instruction_sets() {
  static const std::vector<InstructionSet> all = [] {
    std::vector<InstructionSet> sets;
    for (const auto set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512})
      if (supported(set)) sets.push_back(set);
    return sets;
  }();
  return all;
}

/// Pair with the overlap kOverlap and the slip kSlip. It carries the shear force kShear.
struct ShearedPair : KernelPair {
  explicit ShearedPair(InstructionSet set) : KernelPair(glass_of_unit_modulus(), kOverlap, set) {
    slip(Vec<3>(0.0, kSlip, 0.0));
  }
};
double shear_of(const KernelPair& pair) {
  return pair.tangential_force()[1];
}

TEST(Hertz, ForceStiffnessAndEnergyOfAPair) {
  const ContactLaw<HertzRepulsion, NoAdhesion, NoDamping, MindlinFriction, NoRolling, NoTwisting> law{
      {0.91, 0.3}, {}, {}, {0.3}, {}, {}};
  const PairGeometry<> pair(-kOverlap, 0.25);
  const auto response = law.normal(pair);
  EXPECT_NEAR(response.elastic, 3.333333e-7, 1e-13);
  EXPECT_NEAR(response.stiffness, 5e-3, 1e-16);
  EXPECT_NEAR(response.shear_stiffness, 4.117647e-3, 1e-9);
  EXPECT_NEAR(law.energy(pair), 1.333333e-11, 1e-17);
  const ContactStiffness k = law.stiffness_at_force(pair, response.elastic);
  EXPECT_NEAR(k.normal, 5e-3, 1e-15);
  EXPECT_NEAR(k.tangential, 4.117647e-3, 1e-9);

  const HertzRepulsion si{70e9, 0.3};  // beads of 1 mm with an overlap of 0.1 um
  const PairGeometry<> beads(-1e-7, 0.25e-3);
  EXPECT_NEAR(si.force(beads), 0.02564103, 1e-8);
  EXPECT_NEAR(si.stiffness(beads), 384615.4, 0.1);
  EXPECT_NEAR(si.shear_stiffness(beads), 316742.1, 0.1);
}

TEST(Hertz, UnloadingAtFixedSlipScalesTheShearForceThenSlides) {
  for (const InstructionSet set : instruction_sets()) {
    for (const auto& [x, expected] :
         {std::pair{0.5, 3.535534e-8}, {0.25, 1.25e-8}, {0.1, 3.162278e-9}, {4.0, kShear}}) {
      ShearedPair pair(set);
      EXPECT_NEAR(pair.normal_force(), kForce, 1e-9 * kForce);
      EXPECT_NEAR(shear_of(pair), kShear, 1e-6 * kShear);
      pair.approach(x * kOverlap);
      EXPECT_NEAR(shear_of(pair), expected, 1e-6 * kShear) << "x = " << x;
    }
  }
}

/// Overlap and slip increase in a constant ratio, and then decrease again along this path.
TEST(Hertz, ObliqueLoadingFollowsTheGrowingStiffness) {
  constexpr int kSteps = 4000;
  for (const InstructionSet set : instruction_sets()) {
    KernelPair pair(glass_of_unit_modulus(), 1e-30, set);
    for (int k = 1; k <= kSteps; ++k)
      pair.approach_and_slip(kOverlap * k / kSteps, Vec<3>(0.0, kSlip / kSteps, 0.0));
    EXPECT_NEAR(shear_of(pair), 2.0 / 3.0 * kShear, 5e-4 * kShear);
    for (int k = 1; k <= kSteps / 2; ++k)
      pair.approach_and_slip(kOverlap * (1.0 - 1.0 * k / kSteps), Vec<3>(0.0, -kSlip / kSteps, 0.0));
    EXPECT_NEAR(shear_of(pair), 5.892557e-9, 5e-4 * kShear);
  }
}

/// Computes the work of slip along closed paths of overlap and slip. A closed path must not gain energy.
TEST(Hertz, ClosedPathsGiveNoEnergyBack) {
  for (const InstructionSet set : instruction_sets()) {
    const auto slip = [](KernelPair& pair, double by) {
      const double before = shear_of(pair);
      pair.slip(Vec<3>(0.0, by, 0.0));
      return 0.5 * (before + shear_of(pair)) * by;
    };
    KernelPair deep(glass_of_unit_modulus(), 4.0 * kOverlap, set);
    double work = slip(deep, kSlip);
    deep.approach(kOverlap);
    work += slip(deep, -kSlip);
    deep.approach(4.0 * kOverlap);
    EXPECT_NEAR(shear_of(deep), 0.0, 1e-6 * kShear);
    EXPECT_NEAR(work, 3.035714e-13, 1e-18);

    KernelPair shallow(glass_of_unit_modulus(), kOverlap, set);
    work = slip(shallow, kSlip);
    shallow.approach(4.0 * kOverlap);
    work += slip(shallow, -kSlip);
    shallow.approach(kOverlap);
    EXPECT_NEAR(shear_of(shallow), -0.5 * kShear, 1e-6 * kShear);
    EXPECT_NEAR(work, 3.035714e-13, 1e-18);
    EXPECT_NEAR(std::pow(shear_of(shallow), 2) / (2.0 * 4.117647e-3), 7.589286e-14, 1e-19);

    ShearedPair ringing(set);
    for (int k = 0; k < 10; ++k) ringing.approach(0.81 * kOverlap), ringing.approach(kOverlap);
    EXPECT_NEAR(shear_of(ringing) / kShear, 0.3486784, 1e-6);
  }
}

TEST(Hertz, APartedContactForgets) {
  ShearedPair pair(widest_instruction_set());
  pair.approach(-1e-6);
  EXPECT_EQ(pair.force_on_j().norm(), 0.0);
  pair.approach(kOverlap);
  EXPECT_EQ(pair.tangential_force().norm(), 0.0);
}

TEST(Hertz, ARigidTurnKeepsTheShearForce) {
  const Vec<3> axis(0.3, 0.4, 1.2);
  constexpr int kSteps = 1000;
  for (const InstructionSet set : instruction_sets()) {
    KernelPair pair(glass_of_unit_modulus(1e4), kOverlap, set);
    pair.slip(Vec<3>(0.0, 0.1, 0.0));
    const Vec<3> start = pair.tangential_force(), x_i = pair.position(0), x_j = pair.position(1);
    for (int k = 1; k <= kSteps; ++k) {
      const Eigen::AngleAxisd turn(axis.norm() * k / kSteps, axis.normalized());
      pair.move({turn * x_i, turn * x_j}, {axis / kSteps, axis / kSteps}, 1.0);
    }
    const Vec<3> exact = Eigen::AngleAxisd(axis.norm(), axis.normalized()) * start;
    EXPECT_NEAR(pair.tangential_force().norm() / start.norm(), 1.0, 3e-6);
    EXPECT_LT((pair.tangential_force() - exact).norm() / start.norm(), 4e-6);
  }
}

/// Returns two beads after a head-on collision.
/// @param step  time step divided by sqrt(m/K_N) at the largest overlap
Packing<3> collided(double zeta, double speed, double step) {
  Packing<3> pair =
      test::unit_grains<3>({{4.0, 5.0, 5.0}, {5.0 + 1e-9, 5.0, 5.0}}, 10.0, glass_of_unit_modulus(0.0));
  pair.law += test::critical_damping(zeta);
  pair.grains.velocity = {Vec<3>(0.5 * speed, 0.0, 0.0), Vec<3>(-0.5 * speed, 0.0, 0.0)};
  const double deepest = std::pow(15.0 * speed * speed / 8.0, 0.4);
  const double dt = step / std::sqrt(0.5 * std::sqrt(deepest));
  const auto dynamics = make_dynamics(pair, BoundaryControl<3>::fixed(), {dt, 0.05});
  dynamics->advance(static_cast<int>(30.0 / step), Motion::free);
  return dynamics->packing();
}

double restitution(double zeta, double speed, double step) {
  const std::vector<Vec<3>> v = collided(zeta, speed, step).grains.velocity;
  return (v[1][0] - v[0][0]) / speed;
}

TEST(Hertz, RestitutionDoesNotDependOnTheSpeed) {
  for (const auto& [zeta, expected] :
       {std::pair{0.05, 0.841701}, {0.1, 0.707351}, {0.3, 0.335159}, {0.5, 0.127881}}) {
    const double coarse = restitution(zeta, 1e-3, 1e-3), fine = restitution(zeta, 1e-3, 5e-4);
    EXPECT_NEAR(2.0 * fine - coarse, expected, 2e-5) << zeta;
    EXPECT_NEAR(restitution(zeta, 1e-5, 1e-3), coarse, 1e-5) << zeta;
  }
}

TEST(Hertz, AHeavilyDampedPairNeverParts) {
  EXPECT_EQ(collided(0.98, 1e-3, 1e-3).contacts.size(), 1u);
  EXPECT_TRUE(collided(0.5, 1e-3, 1e-3).contacts.empty());
}

TEST(Hertz, ABeadPileOfFrictionRelaxesToEquilibriumAndContinuesToTheSameBits) {
  Law law = glass_of_unit_modulus();
  law += test::critical_damping(0.98);
  const Packing<3> gas = test::gas_of<3>(100, law, 0.45);
  const Vec<3> target = Vec<3>::Constant(std::pow(8395.0, -1.5));
  RelaxationOptions options;
  options.inertial_number_cap = 1e-2;
  auto relaxer = make_equilibrator<3>(options, gas, target);
  auto stopped = make_equilibrator<3>(options, gas, target);
  RelaxationStatus status = RelaxationStatus::running;
  for (int chunk = 0; status == RelaxationStatus::running; ++chunk) {
    status = relaxer->advance();
    ASSERT_EQ(stopped->advance(), status);
    if (chunk % 3 == 0) {
      const std::string progress = stopped->progress();
      stopped = make_equilibrator<3>(options, stopped->release_packing(), target, progress);
    }
  }
  ASSERT_EQ(status, RelaxationStatus::converged) << relaxer->report().blocking;
  const Residuals left = residuals(relaxer->packing(), target);
  EXPECT_TRUE(left.within(options.tolerance));
  test::expect_same_bits(relaxer->packing(), stopped->packing());
  EXPECT_GT(relaxer->packing().contacts.size(), 150u);
}

}  // namespace
}  // namespace floc
