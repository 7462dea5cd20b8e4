#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>

#include "floc/contact/softened_law.h"
#include "support/laws.h"

namespace floc {
namespace {

using test::at_gap;
using test::for_each_law_and_dimension;
using test::pair_at;
using test::parameters_of;
using test::slip_by;

constexpr double kSofter = 8.0;
constexpr double kStiffOverlap = 1e-4;

/// Overlap at which the elastic force of the softened contact equals that of the stiff contact at the overlap
/// kStiffOverlap.
template <class Law>
double softer_overlap() {
  return kStiffOverlap * std::pow(kSofter, 1.0 / force_exponent<typename Law::NormalModel>());
}

/// Calls check(law, softened law, dimension) for every law of the table and each of its dimensions.
template <class Check>
void for_each_softened_law(const Check& check) {
  for_each_law_and_dimension([&](const auto& law, auto dimension) {
    using Law = std::decay_t<decltype(law)>;
    const AnyContactLaw any = compose_law(softened(parameters_of(law), kSofter));
    ASSERT_TRUE(std::holds_alternative<Law>(any)) << "a softened law has the models of the law";
    check(law, std::get<Law>(any), dimension);
  });
}

TEST(Softening, KeepsForcesOfOverlapsThatAreLargerByTheCompliance) {
  for_each_softened_law([](const auto& law, const auto& soft, auto) {
    using Law = std::decay_t<decltype(law)>;
    const auto stiff_response = law.normal(pair_at(-kStiffOverlap));
    const auto soft_response = soft.normal(pair_at(-softer_overlap<Law>()));
    EXPECT_NEAR(soft_response.elastic, stiff_response.elastic, 1e-12 * stiff_response.elastic);
    EXPECT_EQ(soft_response.adhesive, stiff_response.adhesive);
  });
}

TEST(Softening, DividesStiffnessesAtTheForceByOneFactor) {
  for_each_softened_law([](const auto& law, const auto& soft, auto) {
    using Law = std::decay_t<decltype(law)>;
    const double elastic = law.normal(pair_at(-kStiffOverlap)).elastic;
    const ContactStiffness stiff_k = law.stiffness_at_force(pair_at(-kStiffOverlap), elastic);
    const ContactStiffness soft_k = soft.stiffness_at_force(pair_at(-softer_overlap<Law>()), elastic);
    const double ratio = std::pow(kSofter, 1.0 / force_exponent<typename Law::NormalModel>());
    EXPECT_NEAR(soft_k.normal * ratio, stiff_k.normal, 1e-12 * stiff_k.normal);
    EXPECT_NEAR(soft_k.tangential * ratio, stiff_k.tangential, 1e-12 * stiff_k.tangential);
    EXPECT_NEAR(soft_k.rolling * ratio, stiff_k.rolling, 1e-12 * stiff_k.rolling);
    EXPECT_NEAR(soft_k.twisting * ratio, stiff_k.twisting, 1e-12 * stiff_k.twisting);
  });
}

TEST(Softening, KeepsTheCapsOfSprings) {
  for_each_softened_law([](const auto& law, const auto& soft, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    const auto yielded = [](const auto& of, double gap) {
      test::ContactHistoryOf<Law, Dim> history;
      ContactMotion<Dim> motion = at_gap<Dim>(gap);
      motion.slip = slip_by<Dim>(1.0);
      motion.relative_rotation[0] = 100.0;
      motion.twist = 100.0;
      return of.respond(motion, history);
    };
    const auto p = yielded(law, -kStiffOverlap), q = yielded(soft, -softer_overlap<Law>());
    EXPECT_NEAR(q.shear.norm(), p.shear.norm(), 1e-12 * p.shear.norm());
    EXPECT_NEAR(q.rolling.norm(), p.rolling.norm(), 1e-12 * p.rolling.norm());
    EXPECT_NEAR(q.twisting, p.twisting, 1e-12 * std::abs(p.twisting));
  });
}

/// Softening does not change the ratio of the damping coefficient to sqrt(m K_N). The restitution of collisions
/// therefore stays the same.
TEST(Softening, KeepsTheDampingRatio) {
  for_each_softened_law([](const auto& law, const auto& soft, auto) {
    using Law = std::decay_t<decltype(law)>;
    const CollisionMass mass{1.0 / 3.0, 2.0 / 3.0};
    const double stiff_c = law.damping_coefficient(mass), soft_c = soft.damping_coefficient(mass);
    const double ratio = Law::kDampingFollowsStiffness ? 1.0 : std::sqrt(kSofter);
    EXPECT_NEAR(soft_c * ratio, stiff_c, 1e-12 * stiff_c);
  });
}

TEST(SofteningLimit, IsATenthOfTheRangeAndAHundredthOfTheModulus) {
  LawParameters p;
  p.normal = LinearRepulsion{1e5};
  p.adhesion = TailAdhesion{1.0, 1e-3};
  EXPECT_NEAR(softening_limit(p, 2, 1.0, 1.0).largest, 10.0, 1e-9);    // limited by adhesion: s F0/K_N = D0/10
  EXPECT_NEAR(softening_limit(p, 2, 1.0, 200.0).largest, 5.0, 1e-9);   // limited by pressure: s P/K_N = 1/100
  EXPECT_NEAR(softening_limit(p, 3, 0.1, 400.0).largest, 10.0, 1e-9);  // limited by adhesion
  EXPECT_NEAR(softening_limit(p, 3, 0.1, 2e3).largest, 5.0, 1e-9);     // limited by pressure: s P a/K_N = 1/100
  p.adhesion.reset();
  EXPECT_NEAR(softening_limit(p, 2, 1.0, 1.0).largest, 1000.0, 1e-6);
  EXPECT_EQ(softening_limit(p, 2, 1.0, 0.0).fault(1e300), "");
  p.normal = LinearRepulsion{1e2};
  p.adhesion = TailAdhesion{1.0, 1e-3};
  EXPECT_LT(softening_limit(p, 2, 1.0, 0.0).largest, 1.0);
  EXPECT_NE(softening_limit(p, 2, 1.0, 0.0).fault(1.001), "");
  EXPECT_EQ(softening_limit(p, 2, 1.0, 0.0).fault(1.0), "");
  p.adhesion = ConstantAdhesion{1.0};
  EXPECT_EQ(softening_limit(p, 2, 1.0, 0.0).largest, 0.0);
  LawParameters hertz;
  hertz.normal = HertzRepulsion{0.91e6, 0.3};  // so that E/(1 - nu^2) = 1e6
  EXPECT_NEAR(softening_limit(hertz, 3, 1e-3, 100.0).largest, 100.0, 1e-9);
}

TEST(SofteningLimit, WordsNameTheLargestFactor) {
  LawParameters p;
  p.normal = LinearRepulsion{1e5};
  p.adhesion = TailAdhesion{1.0, 1e-3};
  const SofteningLimit limit = softening_limit(p, 2, 1.0, 1.0);
  EXPECT_EQ(limit.fault(10.0), "");
  EXPECT_NE(limit.fault(10.1).find("expected at most 10"), std::string::npos) << limit.fault(10.1);
}

}  // namespace
}  // namespace floc
