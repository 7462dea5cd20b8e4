#include "floc/elasticity/chain.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <numbers>

#include "floc/base/error.h"

namespace floc {
namespace {

constexpr double kR = 0.7;  // radius

/// Returns stiffnesses with the given ratio K_R/(K_N R^2).
ChainStiffness stiffness(double rolling) {
  return {2.0, 1.4, rolling * 2.0 * kR * kR};
}

/// Returns the largest relative error that rounding can cause. The first term is 8 rounding units for each of about 5
/// matrix entries per contact. The second term is the condition number times the square of 35 rounding units.
double largest_bound(int n, double condition) {
  const double unit = std::numeric_limits<double>::epsilon();
  return 50.0 * n * unit + 1200.0 * unit * unit * condition;
}

/// Expects that the error of a compliance is within its error bound, and that the bound is small.
/// @param size  largest accepted error bound, divided by the exact value
void expect_within_bound(const BoundedValue& solved, double exact, double size, const char* what, int n,
                         double rolling) {
  EXPECT_LE(std::abs(solved.value - exact), solved.error) << what << " n = " << n << ", K_R = " << rolling;
  EXPECT_LE(solved.error, size * exact) << what << " n = " << n << ", K_R = " << rolling;
}

TEST(Chain, StraightIsItsClosedFormWithinTheBoundHoweverSoft) {
  for (const double rolling : {1.0, 1e-2, 1e-4, 1e-6, 1e-8})
    for (const int n : {2, 3, 4, 7, 20, 100, 500, 1000, 2000}) {
      const ChainStiffness k = stiffness(rolling);
      const SolvedChain solved = solve_chain(bent_chain(n, 0.0), kR, k);
      const double size = largest_bound(n, solved.condition);
      expect_within_bound(solved.axial, chain_axial_compliance(n, k), size, "axial", n, rolling);
      expect_within_bound(solved.transverse, chain_transverse_compliance(n, kR, k), size, "transverse", n,
                          rolling);
      expect_within_bound(solved.rolling, chain_rolling_compliance(n, k), size, "rolling", n, rolling);
      expect_within_bound(solved.end_disk, end_disk_deflection(n, kR, k), size, "end disk", n, rolling);
    }
}

TEST(Chain, BeyondDoublePrecisionTheBoundSaysThatNoDigitIsLeft) {
  int n_refused = 0;
  for (const double rolling : {1e-10, 1e-12, 1e-14, 1e-16, 1e-18, 1e-20, 1e-22, 1e-25, 1e-28})
    for (const int n : {20, 200, 2000}) {
      const ChainStiffness k = stiffness(rolling);
      const BoundedValue solved = solve_chain(bent_chain(n, 0.0), kR, k).transverse;
      if (solved.resolved())
        EXPECT_LE(std::abs(solved.value - chain_transverse_compliance(n, kR, k)), solved.error)
            << "n = " << n << ", K_R = " << rolling;
      else
        ++n_refused;
    }
  EXPECT_GT(n_refused, 0);
  EXPECT_FALSE(solve_chain(bent_chain(2000, 0.0), kR, stiffness(1e-28)).transverse.resolved());
}

/// Returns the compliance of the end of a chain whose first disk is fixed. The chain is statically determinate. The
/// motion of its end under a load is therefore the sum of the contributions of the contacts.
Eigen::Matrix3d compliance_by_statics(const std::vector<Vec<2>>& branches, double R, const ChainStiffness& k) {
  Vec<2> end = Vec<2>::Zero();
  for (const Vec<2>& b : branches) end += 2.0 * R * b;
  const Vec<2> along = end.normalized();
  const Vec<2> across(-along[1], along[0]);
  Vec<2> centre = Vec<2>::Zero();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Vec<2>& b : branches) {
    const Vec<2> contact = centre + R * b - 0.5 * end;  // from the middle of the chord to the contact
    centre += 2.0 * R * b;
    const Vec<2> t(-b[1], b[0]);
    // Three unit loads: a force along the chord and a force across it, both at the middle of the chord, and a moment.
    Eigen::RowVector3d normal(along.dot(b), across.dot(b), 0.0), shear(along.dot(t), across.dot(t), 0.0);
    const auto moment_of = [&](const Vec<2>& force) {
      return -(contact[0] * force[1] - contact[1] * force[0]);
    };
    const Eigen::RowVector3d moment(moment_of(along), moment_of(across), 1.0);
    sum += normal.transpose() * normal / k.normal + shear.transpose() * shear / k.tangential +
           moment.transpose() * moment / k.rolling;
  }
  return sum;
}

TEST(Chain, BentIsWhatStaticsSays) {
  for (const double rolling : {1.0, 1e-4, 1e-8})
    for (const int n : {3, 10, 200})
      for (const double degrees : {0.5, 1.0, 1.7}) {
        const ChainStiffness k = stiffness(rolling);
        const auto branches = bent_chain(n, degrees * std::numbers::pi / 180.0);
        const Eigen::Matrix3d exact = compliance_by_statics(branches, kR, k);
        const SolvedChain solved = solve_chain(branches, kR, k);
        // a curved chain is soft in some directions and stiff in others, so the bound is larger than for a straight
        // chain
        constexpr double size = 1e-6;
        expect_within_bound(solved.axial, exact(0, 0), size, "axial", n, rolling);
        expect_within_bound(solved.transverse, exact(1, 1), size, "transverse", n, rolling);
        expect_within_bound(solved.rolling, exact(2, 2), size, "rolling", n, rolling);
      }
}

TEST(Chain, EndDiskDeflectionTendsToTheCantilever) {
  const ChainStiffness k = stiffness(1e-2);
  constexpr int n = 100000;
  const double l = 2.0 * (n - 1.0) * kR;
  EXPECT_NEAR(end_disk_deflection(n, kR, k) / (l * l * l / (3.0 * 2.0 * kR * k.rolling)), 1.0, 3.0 / n);
}

TEST(Chain, RefusesWhatIsNone) {
  const ChainStiffness k = stiffness(1.0);
  EXPECT_THROW(chain_axial_compliance(1, k), InputError);
  EXPECT_THROW(chain_transverse_compliance(3, -1.0, k), InputError);
  EXPECT_THROW(chain_rolling_compliance(3, {1.0, 1.0, 0.0}), InputError);
  EXPECT_THROW(end_disk_deflection(3, 1.0, {1.0, std::numeric_limits<double>::quiet_NaN(), 1.0}), InputError);
  EXPECT_THROW(solve_chain({}, 1.0, k), InputError);
  EXPECT_THROW(solve_chain({Vec<2>(1.0, 0.0), Vec<2>(-1.0, 0.0)}, 1.0, k), InputError);
}

}  // namespace
}  // namespace floc
