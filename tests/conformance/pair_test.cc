#include "support/pair.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "support/laws.h"
#include "support/springs.h"

namespace floc {
namespace {

using test::for_each_law;
using test::for_each_law_and_dimension;
using test::GrainStep;
using test::MovingPair;
using test::pair_at;

constexpr double kRadiusI = 0.5;
constexpr double kRadiusJ = 0.3;

template <int Dim>
Vec<Dim> direction() {
  if constexpr (Dim == 2)
    return {0.6, 0.8};
  else
    return {2.0 / 7, 3.0 / 7, 6.0 / 7};
}

/// Two unequal grains away from the origin, with an overlap of 1e-2 and stretched springs. With such a large overlap,
/// the test notices a wrong lever arm: the radius R instead of the distance l from the centre to the contact.
template <int Dim>
Packing<Dim> stretched_pair(const LawParameters& law) {
  Packing<Dim> packing;
  packing.cell.matrix *= 10.0;
  packing.law = law;
  packing.grains = Grains<Dim>::with_size(2);
  packing.grains.radius = {kRadiusI, kRadiusJ};
  packing.grains.mass = {1.0, 0.5};
  packing.grains.position[0].setConstant(3.0);
  packing.grains.position[1] = packing.grains.position[0] + (kRadiusI + kRadiusJ - 1e-2) * direction<Dim>();
  Contact<Dim> contact;
  contact.j = 1;
  test::rolling_spring(contact).setConstant(1e-3);
  if constexpr (Dim == 2)
    test::shear_spring(contact)[0] = 1e-5;
  else
    test::shear_spring(contact) = to_shear<double>(direction<3>(), {1e-5, 2e-5, -1e-5});
  if (law.friction.holds<MindlinFriction>())
    test::shear_spring(contact) *= 1e5;  // the history of this law contains a force, not a displacement
  packing.contacts.push_back(contact);
  return packing;
}

TEST(Pair, ForcesAreEqualAndOpposite) {
  for_each_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    Packing<Dim> packing = stretched_pair<Dim>(test::parameters_of(law));
    refresh_contacts(packing);
    ASSERT_EQ(packing.contacts.size(), 1u);
    const Balance<Dim> net = net_forces(packing);
    EXPECT_EQ(net.force[0], -net.force[1]);
    EXPECT_GT(net.force[0].norm(), 100.0);
  });
}

TEST(Pair, TorquesOfAllForcesAboutAnyPointVanish) {
  for_each_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    Packing<Dim> packing = stretched_pair<Dim>(test::parameters_of(law));
    refresh_contacts(packing);
    const Balance<Dim> net = net_forces(packing);
    RotationVector<Dim> total = net.moment[0] + net.moment[1];
    for (int i = 0; i < 2; ++i) total += moment<double>(packing.grains.position[i], net.force[i]);
    // Forces of 1e3 act at a distance of 3 from the origin, so the rounding error of the torque is about 1e-12. With
    // wrong lever arms (R instead of l), the torque would be 1e-2 F_T = 8e-3.
    EXPECT_NEAR(total.norm(), 0.0, 5e-12);
    if (Law::kHasFriction) {
      EXPECT_GT(packing.contacts[0].shear_force.norm(), 0.5);
    }
    if (Law::kHasRolling) {
      EXPECT_GT(packing.contacts[0].rolling_moment.norm(), 1e-2);
    }
  });
}

template <int Dim>
Mat<Dim> rotation(const RotationVector<Dim>& turn) {
  if constexpr (Dim == 2)
    return Eigen::Rotation2Dd(turn[0]).toRotationMatrix();
  else
    return Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
}

/// Stretches the springs of a pair. Then rotates the pair as a rigid body by `turn`, in n steps, about a point outside
/// the pair.
/// @return largest relative change of the forces, in axes that rotate with the pair
template <class Law, int Dim>
double force_change_on_turning(const Law& law, const RotationVector<Dim>& turn, int n) {
  const Vec<Dim> xi = Vec<Dim>::Constant(0.2);
  MovingPair<Law, Dim> pair(law, xi, xi + (kRadiusI + kRadiusJ - 1e-2) * direction<Dim>(), kRadiusI, kRadiusJ);
  GrainStep<Dim> stretch;
  stretch.displacement.template head<2>() << -0.8e-5, 0.6e-5;
  stretch.rotation.setConstant(1e-5);
  const ContactForces<Dim> start = pair.move(stretch, GrainStep<Dim>{});
  const Vec<Dim> shear_start = from_shear<double>(pair.normal(), start.shear);

  const Vec<Dim> centre = Vec<Dim>::Constant(-0.1);
  const Mat<Dim> step = rotation<Dim>(turn / n);
  ContactForces<Dim> end = start;
  for (int k = 0; k < n; ++k) {
    const auto rigid = [&](const Vec<Dim>& x) {
      return GrainStep<Dim>{(step - Mat<Dim>::Identity()) * (x - centre), turn / n};
    };
    end = pair.move(rigid(pair.position_i()), rigid(pair.position_j()));
  }
  const Mat<Dim> whole = rotation<Dim>(turn);
  double change = std::abs(end.normal.force() / start.normal.force() - 1.0);
  if constexpr (Law::kHasFriction) {
    const Vec<Dim> shear = from_shear<double>(pair.normal(), end.shear);
    change = std::max(change, (shear - whole * shear_start).norm() / shear_start.norm());
  }
  if constexpr (Law::kHasRolling) {
    RotationVector<Dim> expected = start.rolling;
    if constexpr (Dim == 3) expected = whole * expected;
    change = std::max(change, (end.rolling - expected).norm() / expected.norm());
  }
  return change;
}

constexpr double kChordError = 7e-3;

TEST(Objectivity, APairTurnedRigidlyIn2DKeepsItsForces) {
  for_each_law([](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    // Each step replaces an arc by its chord, which is shorter by the fraction turn^2/(24 n^2). For n = 5000, the
    // differences sum to a slip of 2.1e-8, at most 6e-3 of the spring elongation (3.5e-6 or more). This slip is
    // proportional to 1/n^2. With wrong lever arms, the slip would be 1e-2 turn for any n.
    const double coarse = force_change_on_turning<Law, 2>(law, RotationVector<2>(2.5), 5000);
    const double fine = force_change_on_turning<Law, 2>(law, RotationVector<2>(2.5), 20000);
    EXPECT_LT(coarse, kChordError);
    EXPECT_LT(fine, kChordError / 16 + 1e-8);
  });
}

TEST(Objectivity, APairTurnedRigidlyIn3DKeepsItsForces) {
  for_each_law([](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    const Vec<3> n = direction<3>();
    const Vec<3> across = Vec<3>(3, -2, 0).normalized();
    for (const Vec<3>& turn : {Vec<3>(2.5 * n), Vec<3>(2.5 * across), Vec<3>(1.4, -1.0, 1.2)}) {
      SCOPED_TRACE(::testing::Message() << "turn " << turn.transpose());
      EXPECT_LT((force_change_on_turning<Law, 3>(law, turn, 5000)), kChordError);
      EXPECT_LT((force_change_on_turning<Law, 3>(law, turn, 20000)), kChordError / 16 + 1e-8);
    }
  });
}

/// Simulates a head-on collision with the classical Runge-Kutta method. At the start, the gap is larger than the range
/// of the law.
/// @param step  time step in units of sqrt(m_eff/K_N)
/// @return speed of separation divided by speed of approach; 0 if the pair sticks
template <class Law>
double collide(const Law& law, double speed, double step) {
  const double mass = 1.0 * 0.5 / (1.0 + 0.5);
  const double damping = law.damping_coefficient(CollisionMass::between(1.0, 0.5));
  test::ContactHistoryOf<Law, 2> history;
  const auto acceleration = [&](double gap, double rate) {
    const auto f = law.template respond<2, double>(
        {pair_at(gap), rate, damping, Shear<2>::Zero(), RotationVector<2>::Zero()}, history);
    return (f.normal.force() + f.viscous) / mass;
  };
  const double dt = step * std::sqrt(mass / test::stiffness_bound(law));
  double h = law.range() + speed * dt;
  double v = -speed;
  for (int k = 0; k < static_cast<int>(50 / step) && (h <= law.range() || v < 0); ++k) {
    const double v1 = v, a1 = acceleration(h, v1);
    const double v2 = v + dt / 2 * a1, a2 = acceleration(h + dt / 2 * v1, v2);
    const double v3 = v + dt / 2 * a2, a3 = acceleration(h + dt / 2 * v2, v3);
    const double v4 = v + dt * a3, a4 = acceleration(h + dt * v3, v4);
    h += dt / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return h > law.range() ? v / speed : 0.0;
}

TEST(Collision, RestitutionWithoutAdhesionIsTheOneAskedFor) {
  for_each_law([](auto law) {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (!Law::kHasAdhesion && !Law::kDampingFollowsStiffness && test::kForgetsOverlap<Law>) {
      for (const double e : {0.015, 0.3, 0.9, 1.0}) {
        SCOPED_TRACE(e);
        if constexpr (Law::kHasDamping) law.damping.restitution = e;
        // The integration ends up to 1e-4 sqrt(m/K_N) after the end of the contact. In this time, damping reduces the
        // speed by at most the fraction 2 zeta sqrt(K_N/m) per unit of time; the damping ratio zeta is below 1.
        EXPECT_NEAR(collide(law, 1.0, 1e-4) / (Law::kHasDamping ? e : 1.0), 1.0, 3e-4);
      }
    }
  });
}

TEST(Collision, AdhesionAloneTakesNoEnergy) {
  for_each_law([](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (!Law::kHasDamping && test::kForgetsOverlap<Law>) {
      // The initial speed is 1, and the escape speed is 0.09. The error is of first order in the step of 1.8e-7,
      // because the force has a kink or, under constant adhesion, a jump of F0.
      EXPECT_NEAR(collide(law, 1.0, 1e-4), 1.0, 1e-5);
    }
  });
}

TEST(Collision, DampedAdhesivePairSticksBelowAnEscapeSpeedAndLosesMoreThanWithoutAdhesion) {
  for_each_law([](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    if constexpr (test::kAdheres<Law> && Law::kHasDamping) {
      EXPECT_EQ(collide(law, 1e-3, 1e-3), 0.0);
      const double fast = collide(law, 10.0, 1e-4);
      EXPECT_GT(fast, 0.0);
      EXPECT_LT(fast, law.damping.restitution);
    }
  });
}

}  // namespace
}  // namespace floc
