#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <set>
#include <type_traits>
#include <vector>

#include "floc/base/random.h"
#include "support/law_units.h"
#include "support/laws.h"

namespace floc {
namespace {

using test::for_each_law;
using test::for_each_law_and_dimension;
using test::pair_at;
using test::parameters_of;

TEST(Table, EveryRowIsReachedByItsParametersAndKeepsThem) {
  for_each_law([](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    const LawParameters parameters = parameters_of(law);
    EXPECT_TRUE(parameters.validate().empty());
    const AnyContactLaw composed = compose_law(parameters);
    ASSERT_TRUE(std::holds_alternative<Law>(composed));
    EXPECT_EQ(parameters_of(std::get<Law>(composed)), parameters);
  });
}

TEST(Table, EveryCombinationOfKeywordsHasARowOfItsOwn) {
  std::set<std::size_t> rows;
  int n_combinations = 0;
  for (const double force : {-1.0, 0.5})
    for (const double range : {0.0, 1e-3})
      for (const bool damped : {false, true})
        for (const int springs : {0, 1, 2, 3}) {
          if (force < 0 && range > 0) continue;
          LawParameters p;
          p.normal = LinearRepulsion{1e5};
          if (force > 0 && range > 0) p.adhesion = TailAdhesion{force, range};
          if (force > 0 && range == 0) p.adhesion = ConstantAdhesion{force};
          if (damped) p.damping = ViscousDamping{0.5, DampingMass::grain};
          if (springs > 0) p.friction = CoulombFriction{0.5, 1e5};
          if (springs > 1) p.rolling = RollingSpring{0.01, 10.0};
          if (springs > 2) p.twisting = TwistingSpring{0.01, 10.0};
          ++n_combinations;
          rows.insert(compose_law(p).index());
        }
  EXPECT_EQ(n_combinations, 24);
  EXPECT_EQ(rows.size(), 24u);
}

TEST(Table, TwistingAloneNeitherResistsRollingNorYieldsToIt) {
  LawParameters p;
  p.normal = LinearRepulsion{1e5};
  p.friction = CoulombFriction{0.5, 1e5};
  p.twisting = TwistingSpring{0.01, 10.0};
  std::visit(
      []<class Law>(const Law& law) {
        EXPECT_TRUE(Law::kHasTwisting);
        test::ContactHistoryOf<Law, 3> history;
        ContactMotion<3> motion = test::at_gap<3>(-1e-4);
        motion.relative_rotation = Vec<3>(0.1, 0.2, 0.0);
        motion.twist = 1.0;
        const ContactForces<3> f = law.respond(motion, history);
        EXPECT_EQ(f.rolling, Vec<3>::Zero());
        EXPECT_DOUBLE_EQ(f.twisting, 0.01 * f.normal.elastic);
        const Mobilised m = law.template mobilised<3>(f.normal.elastic, history, 0.0);
        EXPECT_FALSE(m.rolling);
        EXPECT_TRUE(m.twisting);
        const ContactStiffness k = law.template stiffness<3>(motion.pair, history);
        EXPECT_EQ(k.rolling, 0.0);
        EXPECT_EQ(k.twisting, 10.0);
      },
      compose_law(p));
}

TEST(Table, LiquidGoesWithLinearAndHertzContactsThatDoNotResistRolling) {
  int n_linear = 0, n_hertz = 0;
  for_each_law([&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    if (!Law::kHoldsLiquid) return;
    EXPECT_FALSE(Law::kHasRolling);
    n_linear += std::is_same_v<typename Law::NormalModel, LinearRepulsion>;
    n_hertz += std::is_same_v<typename Law::NormalModel, HertzRepulsion>;
  });
  EXPECT_EQ(n_linear, 4);
  EXPECT_EQ(n_hertz, 4);
}

TEST(Table, WithoutLiquidOrTensionThatPullsALawIsTheDryOne) {
  LawParameters p;
  p.normal = LinearRepulsion{1e5};
  p.friction = CoulombFriction{0.5, 1e5};
  const std::size_t dry = compose_law(p).index();
  p.adhesion = CapillaryAdhesion{0.072, 0.0, 0.01, 2.6};
  EXPECT_NE(compose_law(p).index(), dry);
  p.adhesion = CapillaryAdhesion{0.072, 0.0, 0.0, 2.6};
  EXPECT_EQ(compose_law(p).index(), dry);
  p.adhesion = CapillaryAdhesion{0.072, 90.0, 0.01, 2.6};
  EXPECT_EQ(compose_law(p).index(), dry);
}

TEST(Table, AdhesionOfNoForceIsNoAdhesion) {
  LawParameters p;
  p.normal = LinearRepulsion{1e5};
  const std::size_t bare = compose_law(p).index();
  p.adhesion = TailAdhesion{0.0, 1e-3};
  EXPECT_EQ(compose_law(p).index(), bare);
  EXPECT_EQ(std::visit([](const auto& law) { return law.range(); }, compose_law(p)), 0.0);
}

TEST(Table, RangeOfALawIsTheOneOfItsParameters) {
  for_each_law([](const auto& law) { EXPECT_EQ(law.range(), Law(parameters_of(law)).range()); });
}

TEST(EmptySlots, CostNoByteOfTheContactRecord) {
  for_each_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    const std::size_t components =
        history_size<typename Law::NormalModel>(Dim) + history_size<typename Law::TangentialModel>(Dim) +
        (Law::kHasRolling ? kRotations<Dim> : 0) + (Law::kHasTwisting ? 1 : 0) + (Law::kHoldsLiquid ? 1 : 0);
    using History = test::ContactHistoryOf<Law, Dim>;
    // In C++, an empty class has a size of one byte.
    EXPECT_EQ(sizeof(History), components > 0 ? components * sizeof(double) : 1u);
    EXPECT_EQ(std::is_empty_v<History>, components == 0);
  });
}

template <class Slot>
constexpr std::size_t kSlotBytes = std::is_empty_v<Slot> ? 0 : sizeof(Slot);

TEST(EmptySlots, CostNoByteOfTheLaw) {
  for_each_law([](const auto& law) {
    EXPECT_EQ(sizeof(law), kSlotBytes<decltype(law.repulsion)> + kSlotBytes<decltype(law.adhesion)> +
                               kSlotBytes<decltype(law.damping)> + kSlotBytes<decltype(law.friction)> +
                               kSlotBytes<decltype(law.rolling)> + kSlotBytes<decltype(law.twisting)>);
  });
}

/// Units that are powers of two, so that a conversion causes no rounding.
struct Units {
  double length = 0x1p-9;
  double force = 0x1p7;
  double mass = 0x1p20;
  /// unit of time: sqrt(mass length/force) = sqrt(2^4)
  double time = 0x1p2;
};

TEST(Units, RescalingByPowersOfTwoChangesNoBit) {
  for_each_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    const Units u;
    const Law other = std::get<Law>(compose_law(test::in_units(parameters_of(law), u.length, u.force)));
    const double damping = law.damping_coefficient(CollisionMass::between(1.0, 0.3));
    const double other_damping = other.damping_coefficient(CollisionMass::between(u.mass, 0.3 * u.mass));
    const double of_damping = u.force * u.time / u.length;
    EXPECT_EQ(
        other_damping,
        damping * (Law::kDampingFollowsStiffness ? of_damping / std::sqrt(u.force / u.length) : of_damping));

    test::ContactHistoryOf<Law, Dim> history, other_history;
    RandomStream random(3, Dim);
    for (int k = 0; k < 500; ++k) {
      SCOPED_TRACE(k);
      ContactMotion<Dim> m{pair_at(random.uniform(-2e-4, 2e-4)), random.normal(), damping, Shear<Dim>::Zero(),
                           RotationVector<Dim>::Zero()};
      for (double& x : m.slip) x = 2e-5 * random.normal();
      for (double& x : m.relative_rotation) x = 1e-3 * random.normal();
      const ContactMotion<Dim> other_m{
          {m.pair.gap * u.length, m.pair.reduced_radius * u.length, m.pair.reduced_mass * u.mass},
          m.gap_rate * u.length / u.time,
          other_damping,
          m.slip * u.length,
          m.relative_rotation};
      const auto f = law.respond(m, history);
      const auto other_f = other.respond(other_m, other_history);
      EXPECT_EQ(other_f.normal.elastic, f.normal.elastic * u.force);
      EXPECT_EQ(other_f.normal.adhesive, f.normal.adhesive * u.force);
      EXPECT_EQ(other_f.normal.stiffness, f.normal.stiffness * (u.force / u.length));
      EXPECT_EQ(other_f.viscous, f.viscous * u.force);
      EXPECT_EQ(other_f.shear, f.shear * u.force);
      EXPECT_EQ(other_f.rolling, f.rolling * (u.force * u.length));
      EXPECT_EQ(other.energy(other_m.pair), law.energy(m.pair) * (u.force * u.length));
    }
  });
}

}  // namespace
}  // namespace floc
