#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "floc/base/random.h"
#include "support/hysteretic_repulsion.h"
#include "support/laws.h"
#include "support/normal_work.h"

namespace floc {
namespace {

using test::for_each_kind_of_law_and_dimension;
using test::pair_at;

/// Closed curve: a random sum of the first few harmonics.
class ClosedCurve {
 public:
  ClosedCurve(RandomStream& random, double mean, double amplitude) : mean_(mean) {
    for (auto& c : coefficients_) c = {amplitude * random.normal() / 2, amplitude * random.normal() / 2};
  }
  /// Value at a phase between 0 and 1.
  double at(double phase) const {
    double value = mean_;
    for (std::size_t k = 0; k < coefficients_.size(); ++k) {
      const double angle = 2 * std::numbers::pi * phase * static_cast<double>(k + 1);
      value += coefficients_[k][0] * std::cos(angle) + coefficients_[k][1] * std::sin(angle);
    }
    return value;
  }

 private:
  double mean_;
  std::array<std::array<double, 2>, 3> coefficients_;
};

/// Closed path of gap, slip and rotation of one contact.
template <int Dim>
class Loop {
 public:
  /// @param reach  scale of slip and rotation. With reach = 1, the springs reach their friction limits; with 1e-3, they
  /// stay far below the limits.
  Loop(RandomStream& random, double mean_gap, double gap_amplitude, double reach)
      : gap_(random, mean_gap, gap_amplitude) {
    // In 3D, the slip is in the plane normal to the third axis; in 2D, the slip has one component.
    for (int a = 0; a < Dim - 1; ++a) slip_.emplace_back(random, 0.0, 1e-4 * reach);
    for (int a = 0; a < kRotations<Dim>; ++a) rotation_.emplace_back(random, 0.0, 0.02 * reach);
  }
  double gap(double phase) const { return gap_.at(phase); }
  Shear<Dim> slip(double phase) const {
    Shear<Dim> value = Shear<Dim>::Zero();
    for (int a = 0; a < Dim - 1; ++a) value[a] = slip_[a].at(phase);
    return value;
  }
  RotationVector<Dim> rotation(double phase) const {
    RotationVector<Dim> value;
    for (int a = 0; a < kRotations<Dim>; ++a) value[a] = rotation_[a].at(phase);
    return value;
  }

 private:
  ClosedCurve gap_;
  std::vector<ClosedCurve> slip_, rotation_;
};

/// Work done on a contact along a loop. The work is integrated by the trapezoidal rule, which is exact for springs
/// below their friction limits.
struct LoopWork {
  double viscous = 0.0;
  double tangential = 0.0;
  double rolling = 0.0;
  double twisting = 0.0;
  double stored = 0.0;   ///< energy stored in the springs at the end
  double largest = 0.0;  ///< largest energy stored in the springs
};

template <class Law, int Dim>
LoopWork work_around(const Law& law, const Loop<Dim>& loop, int n_steps) {
  LoopWork work;
  test::ContactHistoryOf<Law, Dim> history;
  Shear<Dim> shear = Shear<Dim>::Zero();
  RotationVector<Dim> rolling = RotationVector<Dim>::Zero();
  double twisting = 0.0;
  const double dt = 1e-3;
  for (int k = 1; k <= n_steps; ++k) {
    const double from = static_cast<double>(k - 1) / n_steps;
    const double to = static_cast<double>(k) / n_steps;
    const double opening = loop.gap(to) - loop.gap(from);
    const ContactMotion<Dim> motion{pair_at(loop.gap(to)),
                                    opening / dt,
                                    law.damping_coefficient(CollisionMass::between(1.0, 0.5)),
                                    loop.slip(to) - loop.slip(from),
                                    loop.rotation(to) - loop.rotation(from),
                                    (loop.rotation(to) - loop.rotation(from))[kRotations<Dim> - 1]};
    const ContactForces<Dim> f = law.respond(motion, history);
    work.viscous -= f.viscous * opening;
    work.tangential += 0.5 * (shear + f.shear).dot(motion.slip);
    work.rolling += 0.5 * (rolling + f.rolling).dot(motion.relative_rotation);
    shear = f.shear;
    work.twisting += 0.5 * (twisting + f.twisting) * motion.twist;
    rolling = f.rolling;
    twisting = f.twisting;
    work.stored = 0.0;
    const ContactStiffness stiffness = test::stiffness_at<Dim>(law, loop.gap(to));
    if (stiffness.tangential > 0) work.stored += 0.5 * shear.squaredNorm() / stiffness.tangential;
    if (stiffness.rolling > 0) work.stored += 0.5 * rolling.squaredNorm() / stiffness.rolling;
    if (stiffness.twisting > 0) work.stored += 0.5 * twisting * twisting / stiffness.twisting;
    work.largest = std::max(work.largest, work.stored);
  }
  return work;
}

constexpr int kSteps = 2000;
constexpr int kLoops = 8;

/// Largest error of the trapezoidal rule, divided by the largest work along the path.
constexpr double kWorkError = 1e-4;

/// Returns the work done by the normal force when the gap goes through a closed loop.
/// @param gap  gap as a function of the phase from 0 to 1
template <int Dim, class Law, class Gap>
test::NormalWork<Law, Dim> normal_work_around(const Law& law, const Gap& gap) {
  test::NormalWork<Law, Dim> work(law, gap(0.0));
  for (int k = 1; k <= kSteps; ++k) work.move_to(gap(static_cast<double>(k) / kSteps));
  return work;
}

TEST(NormalForce, TakesNoWorkFromAClosedLoop) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    RandomStream random(9, Dim);
    for (int k = 0; k < kLoops; ++k) {
      SCOPED_TRACE(k);
      const Loop<Dim> loop(random, -1e-4, 1e-4, 1.0);
      const auto work = normal_work_around<Dim>(law, [&](double phase) { return loop.gap(phase); });
      EXPECT_GT(work.largest(), 0.0);
      if (test::kForgetsOverlap<decltype(law)>)
        EXPECT_NEAR(work.work(), 0.0, kWorkError * work.largest());
      else
        EXPECT_GE(work.work(), -kWorkError * work.largest());
    }
  });
}

/// Presses a new contact and releases it. The stiffness of the law is different on unloading.
/// @param unloading  stiffness K2 on unloading; the stiffness K1 on loading is 1e5
/// @return work that is lost in the cycle, and largest work along the path
std::array<double, 2> work_of_pressing(double unloading) {
  ContactLaw<test::HystereticRepulsion, NoAdhesion, NoDamping, NoFriction, NoRolling, NoTwisting> law{};
  law.repulsion = {1e5, unloading};
  const auto work = normal_work_around<2>(
      law, [](double phase) { return -1e-4 + 1.5e-4 * std::cos(2 * std::numbers::pi * phase); });
  return {work.work(), work.largest()};
}

TEST(NormalForce, OfALawThatCreatesEnergyIsFoundByTheSameMeasure) {
  const auto [lost, most] = work_of_pressing(2e5);
  // The lost energy is the fraction 1 - K1/K2 of the work of loading.
  EXPECT_NEAR(lost, 0.5 * most, 1e-2 * most);
  const auto [created, more] = work_of_pressing(0.9e5);
  EXPECT_LT(created, -100 * kWorkError * more);
}

/// Viscous forces act only while the law says that the surfaces touch. Under some laws, surfaces cease to touch while
/// the grains still overlap.
TEST(Dissipation, EndsWhereSurfacesNoLongerPressThoughTheyOverlap) {
  ContactLaw<test::HystereticRepulsion, NoAdhesion, ViscousDamping, NoFriction, NoRolling, NoTwisting> law{};
  law.repulsion = {1e5, 2e5};
  law.damping = {0.3, DampingMass::effective};
  test::ContactHistoryOf<decltype(law), 2> history;
  const auto viscous = [&](double gap) {
    ContactMotion<2> motion = test::at_gap<2>(gap);
    motion.gap_rate = 1.0;
    motion.damping = law.damping_coefficient(CollisionMass::between(1.0, 0.5));
    return law.respond(motion, history).viscous;
  };
  EXPECT_LT(viscous(-2e-4), 0.0);
  EXPECT_LT(viscous(-1.01e-4), 0.0);
  EXPECT_EQ(viscous(-0.99e-4), 0.0);  // for K2 = 2 K1, the surfaces separate at half of the largest overlap
  EXPECT_FALSE(law.touches<2>(test::pair_at(-0.99e-4), history));
  EXPECT_EQ(law.stiffness<2>(test::pair_at(-0.99e-4), history).normal, 0.0);
}

TEST(Dissipation, IsNeverNegativeAroundAClosedLoop) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    using Law = std::decay_t<decltype(law)>;
    RandomStream random(7, Dim);
    double slid = 0.0;
    for (int k = 0; k < kLoops; ++k) {
      SCOPED_TRACE(k);
      const Loop<Dim> loop(random, -1e-4, 1e-4, 1.0);
      const LoopWork work = work_around(law, loop, kSteps);
      // The force of a spring at its friction limit may reverse within one step. The work then has an error of the
      // order of the energy that changes in this step: the largest energy times about (length of the step/length of the
      // loop)^2.
      const double rounding = 1e-6 * work.largest + 1e-18;
      EXPECT_GE(work.viscous, 0.0);
      EXPECT_GE(work.tangential, -rounding);
      EXPECT_GE(work.rolling, -rounding);
      EXPECT_GE(work.twisting, -rounding);
      const double done = work.tangential + work.rolling + work.twisting;
      EXPECT_GE(done, work.stored - rounding);
      slid += done - work.stored;
      if (Law::kHasDamping) {
        EXPECT_GT(work.viscous, 0.0);
      }
    }
    if (Law::kHasFriction) {
      EXPECT_GT(slid, 1e-4);
    }
  });
}

TEST(Dissipation, IsZeroWhereNothingSlidesOrParts) {
  for_each_kind_of_law_and_dimension([](const auto& law, auto dimension) {
    constexpr int Dim = decltype(dimension)::value;
    // Under these laws, the tangential stiffness follows the normal stiffness. A decrease of the normal force reduces
    // the tangential stiffness and the shear force together, which dissipates energy.
    if (kFollowsNormalStiffness<typename std::decay_t<decltype(law)>::TangentialModel>) return;
    RandomStream random(8, Dim);
    for (int k = 0; k < kLoops; ++k) {
      SCOPED_TRACE(k);
      const Loop<Dim> loop(random, -1e-4, 1e-6, 1e-3);
      const LoopWork work = work_around(law, loop, kSteps);
      EXPECT_NEAR(work.tangential, 0.0, 1e-11 * work.largest);
      EXPECT_NEAR(work.rolling, 0.0, 1e-11 * work.largest);
      EXPECT_NEAR(work.twisting, 0.0, 1e-11 * work.largest);
      EXPECT_NEAR(work.stored, 0.0, 1e-11 * work.largest);
    }
  });
}

}  // namespace
}  // namespace floc
