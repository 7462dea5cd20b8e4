#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/laws.h"

namespace floc {
namespace {

using test::at_gap;
using test::for_each_kind_of_law_and_dimension;
using test::pull_off_force;
using test::slip_by;
using test::stiffness_at;

/// Overlap of a compressed contact (length).
constexpr double kOverlap = 1e-4;

template <int Dim>
ContactMotion<Dim> sheared(double gap, double slip) {
  ContactMotion<Dim> motion = at_gap<Dim>(gap);
  motion.slip = slip_by<Dim>(slip);
  return motion;
}

template <int Dim>
ContactMotion<Dim> rolled(double gap, double rotation) {
  ContactMotion<Dim> motion = at_gap<Dim>(gap);
  motion.relative_rotation[0] = rotation;
  return motion;
}

template <int Dim>
ContactMotion<Dim> twisted(double gap, double twist) {
  ContactMotion<Dim> motion = at_gap<Dim>(gap);
  motion.twist = twist;
  return motion;
}

TEST(TangentialStiffness, IsTheSlopeOfTheShearForceInTheTangentPlane) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    constexpr int n = kShearComponents<Dim>;
    using Dual = ceres::Jet<double, n>;
    test::ContactHistoryOf<Law, Dim, Dual> history;
    ContactMotion<Dim, Dual> motion = at_gap<Dim, Dual>(Dual(-kOverlap));
    // The slips of about 1e-6 are a hundredth of the slip at which the contact slides.
    for (int a = 0; a < n; ++a) motion.slip[a] = Dual(1e-6 * (a + 1), a);
    const auto forces = law.respond(motion, history);
    const double kt = stiffness_at(law, -kOverlap).tangential;
    if constexpr (requires { law.friction.tangential_stiffness; })
      EXPECT_EQ(kt, law.friction.tangential_stiffness);
    else
      EXPECT_EQ(kt > 0.0, Law::kHasFriction);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) EXPECT_DOUBLE_EQ(forces.shear[a].v[b], a == b ? kt : 0.0);
  });
}

TEST(TangentialStiffness, IsTheDifferenceQuotientOfTheShearForce) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    const double step = 1e-8;
    test::ContactHistoryOf<Law, Dim> plus, minus;
    const auto up = law.respond(sheared<Dim>(-kOverlap, step), plus);
    const auto down = law.respond(sheared<Dim>(-kOverlap, -step), minus);
    const double kt = stiffness_at(law, -kOverlap).tangential;
    EXPECT_NEAR((up.shear[0] - down.shear[0]) / (2 * step), kt, 1e-14 * kt);
  });
}

TEST(RollingStiffness, IsTheSlopeOfTheMoment) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    constexpr int n = kRotations<Dim>;
    using Dual = ceres::Jet<double, n>;
    test::ContactHistoryOf<Law, Dim, Dual> history;
    ContactMotion<Dim, Dual> motion = at_gap<Dim, Dual>(Dual(-kOverlap));
    for (int a = 0; a < n; ++a) motion.relative_rotation[a] = Dual(1e-5 * (a + 1), a);
    const auto forces = law.respond(motion, history);
    const double kr = stiffness_at(law, -kOverlap).rolling;
    if constexpr (Law::kHasRolling) {
      EXPECT_EQ(kr, law.rolling.rolling_stiffness);
    }
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) EXPECT_DOUBLE_EQ(forces.rolling[a].v[b], a == b ? kr : 0.0);
  });
}

TEST(TwistingStiffness, IsTheSlopeOfTheMoment) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    using Dual = ceres::Jet<double, 1>;
    test::ContactHistoryOf<Law, Dim, Dual> history;
    ContactMotion<Dim, Dual> motion = at_gap<Dim, Dual>(Dual(-kOverlap));
    motion.twist = Dual(1e-5, 0);
    const double ktw = stiffness_at<Dim>(law, -kOverlap).twisting;
    EXPECT_EQ(ktw > 0.0, Law::kHasTwisting);
    EXPECT_DOUBLE_EQ(law.respond(motion, history).twisting.v[0], ktw);
  });
}

TEST(FrictionCap, IsMuTimesTheElasticPart) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    test::ContactHistoryOf<Law, Dim> history;
    const double shear = law.respond(sheared<Dim>(-kOverlap, 1.0), history).shear.norm();
    if constexpr (Law::kHasFriction) {
      EXPECT_NEAR(shear, law.friction.coefficient * test::elastic_force_at(law, -kOverlap), 1e-14 * shear);
    } else {
      EXPECT_EQ(shear, 0.0);
    }
  });
}

TEST(FrictionCap, IsMuF0WhereTheNetNormalForceIsZero) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    if constexpr (Law::kHasFriction && test::kAdheres<Law>) {
      const double f0 = pull_off_force(law);
      const double h0 = test::free_overlap(law);
      test::ContactHistoryOf<Law, Dim> history;
      const auto forces = law.respond(sheared<Dim>(-h0, -1.0), history);
      EXPECT_NEAR(forces.normal.force(), 0.0, 1e-15 * f0);
      EXPECT_NEAR(forces.shear[0], -law.friction.coefficient * f0, 1e-15 * f0);
    }
  });
}

TEST(FrictionCap, KeepsTheDirectionOfTheSpring) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    if constexpr (Law::kHasFriction && Dim == 3) {
      test::ContactHistoryOf<Law, Dim> history;
      ContactMotion<Dim> motion = at_gap<Dim>(-kOverlap);
      motion.slip << 3.0, -4.0, 0.0;
      const Vec<3> force = law.respond(motion, history).shear;
      const double cap = law.friction.coefficient * test::elastic_force_at(law, -kOverlap);
      EXPECT_NEAR((force - cap * Vec<3>(0.6, -0.8, 0.0)).norm(), 0.0, 1e-14 * cap);
    }
  });
}

TEST(RollingCap, IsMuRTimesTheElasticPart) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    test::ContactHistoryOf<Law, Dim> history;
    const double moment = law.respond(rolled<Dim>(-kOverlap, 1.0), history).rolling.norm();
    if constexpr (Law::kHasRolling) {
      EXPECT_NEAR(moment, law.rolling.coefficient * test::elastic_force_at(law, -kOverlap), 1e-14 * moment);
    } else {
      EXPECT_EQ(moment, 0.0);
    }
  });
}

TEST(TwistingCap, IsMuTwTimesTheElasticPart) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    test::ContactHistoryOf<Law, Dim> history;
    const auto forces = law.respond(twisted<Dim>(-kOverlap, -1.0), history);
    if constexpr (Law::kHasTwisting)
      EXPECT_DOUBLE_EQ(forces.twisting, -law.twisting.coefficient * test::elastic_force_at(law, -kOverlap));
    else
      EXPECT_EQ(forces.twisting, 0.0);
    EXPECT_EQ(forces.rolling.norm(), 0.0);
    EXPECT_EQ(forces.shear.norm(), 0.0);
  });
}

TEST(Springs, AreCutBackWithTheCapAndDoNotComeBack) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    test::ContactHistoryOf<Law, Dim> history;
    ContactMotion<Dim> motion = sheared<Dim>(-kOverlap, 1.0);
    motion.relative_rotation[0] = 1.0;
    motion.twist = 1.0;
    const auto full = law.respond(motion, history);
    const auto half = law.respond(at_gap<Dim>(-kOverlap / 2), history);
    const auto again = law.respond(at_gap<Dim>(-kOverlap), history);
    const double share = half.normal.elastic / full.normal.elastic;
    EXPECT_NEAR(half.shear[0], share * full.shear[0], 1e-14 * full.shear[0]);
    EXPECT_NEAR(half.rolling[0], share * full.rolling[0], 1e-14 * full.rolling[0]);
    EXPECT_EQ(again.shear[0], half.shear[0]);
    EXPECT_EQ(again.rolling[0], half.rolling[0]);
    EXPECT_NEAR(half.twisting, share * full.twisting, 1e-14 * full.twisting);
    EXPECT_EQ(again.twisting, half.twisting);
  });
}

TEST(Springs, BelowTheirCapsFeelNoChangeOfTheNormalForce) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    test::ContactHistoryOf<Law, Dim> history;
    ContactMotion<Dim> motion = sheared<Dim>(-kOverlap, 1e-6);
    motion.relative_rotation[0] = 1e-5;
    motion.twist = 1e-5;
    const auto before = law.respond(motion, history);
    const auto after = law.respond(at_gap<Dim>(-3 * kOverlap), history);
    EXPECT_EQ(after.shear, before.shear);
    EXPECT_EQ(after.rolling, before.rolling);
    EXPECT_EQ(after.twisting, before.twisting);
  });
}

TEST(Springs, AreClearedWhenTheSurfacesPart) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    const double holding = law.holding_range(test::pair_at(0.0).reduced_radius);
    for (const double beyond : {0.0, 1e-9, 0.5 * law.range(), 2 * law.range() + 1e-3}) {
      const double parted = holding + beyond;
      SCOPED_TRACE(parted);
      test::ContactHistoryOf<Law, Dim> history;
      ContactMotion<Dim> motion = sheared<Dim>(-kOverlap, 1e-6);
      motion.relative_rotation[0] = 1e-5;
      motion.twist = 1e-5;
      law.respond(motion, history);
      law.respond(at_gap<Dim>(parted), history);
      const auto forces = law.respond(at_gap<Dim>(-kOverlap), history);
      EXPECT_EQ(forces.shear.norm(), 0.0);
      EXPECT_EQ(forces.rolling.norm(), 0.0);
      EXPECT_EQ(forces.twisting, 0.0);
    }
  });
}

}  // namespace
}  // namespace floc
