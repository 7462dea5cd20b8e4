#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/packing/balance.h"
#include "floc/structure/carrying_forces.h"
#include "floc/structure/elastic_energy.h"
#include "support/crystals.h"

namespace floc::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Fixture: equal spheres of diameter a = 1 at random positions, with Hertz contacts of modulus E. The tangential
/// forces range from 0 to 0.3 times the normal force N.
class HertzAverages : public testing::Test {
 protected:
  void SetUp() override {
    packing_ = random_packing<3>(200, 4, elastic_law(1.0, 0.5, 0.0), 1.0);
    packing_.grains.radius.assign(packing_.grains.radius.size(), 0.5);
    find_contacts(packing_);
    make_hertzian(kE, kRatio, packing_);
    int k = 0;
    for (Contact<3>& c : packing_.contacts)
      c.shear_force = 0.1 * (k++ % 4) * c.normal_force * c.normal.unitOrthogonal();
    carrying_ = carrying_structure(packing_, 0.0, 1);
    forces_ = carrying_forces(packing_, carrying_);
  }

  /// Mean of a quantity over the contacts.
  double mean(const auto& of) const {
    double sum = 0.0;
    for (const Contact<3>& c : packing_.contacts) sum += of(c);
    return sum / static_cast<double>(packing_.contacts.size());
  }
  double mean_force() const {
    return mean([](const Contact<3>& c) { return c.normal_force; });
  }
  /// Stiffness number (E/P)^(2/3). The pressure P = z Phi <N>/(pi a^2) is that of a packing in which all branches have
  /// the length a.
  double kappa() const { return std::cbrt(std::pow(kE * kPi / (forces_.z * phi() * mean_force()), 2)); }
  double phi() const { return solid_fraction(packing_); }

  static constexpr double kE = 3.0, kRatio = 14.0 / 17.0;
  Packing<3> packing_;
  CarryingStructure carrying_;
  CarryingForces forces_;
};

TEST_F(HertzAverages, GiveThePressure) {
  const double Nr = mean([&](const Contact<3>& c) { return c.normal_force * branch(packing_, c).norm(); });
  const double P = static_stress(packing_).trace() / 3.0;
  EXPECT_NEAR(forces_.z * phi() * Nr / kPi / P, 1.0, 1e-12);
}

TEST_F(HertzAverages, GiveTheOverlap) {
  const double h = mean([](const Contact<3>& c) { return std::pow(-c.gap, 1.5); });
  EXPECT_NEAR(h * forces_.z * phi() * std::pow(kappa(), 1.5) / (3.0 * kPi), 1.0, 1e-12);
}

TEST_F(HertzAverages, GiveTheElasticEnergy) {
  const double Z = mean([&](const Contact<3>& c) {
    const double r = c.shear_force.norm() / c.normal_force;
    return std::pow(c.normal_force / mean_force(), 5.0 / 3.0) * (1.0 + 5.0 * r * r / (6.0 * kRatio));
  });
  EXPECT_GT(Z, forces_.Z_five_thirds);
  const double w = kE * 2.80345735 * Z * std::pow(forces_.z, -2.0 / 3.0) * std::pow(phi(), -5.0 / 3.0) *
                   std::pow(kappa(), -2.5);
  EXPECT_NEAR(elastic_energy_per_grain(packing_) / w, 1.0, 1e-8);  // the prefactor has only nine digits
}

TEST_F(HertzAverages, GiveTheLargestPressure) {
  double N = 0.0;
  for (const Contact<3>& c : packing_.contacts) N = std::max(N, c.normal_force);
  const double p = kE * 2.0 * std::cbrt(3.0) * std::pow(kPi, -2.0 / 3.0) / std::cbrt(forces_.z * phi()) *
                   std::cbrt(N / mean_force()) / std::sqrt(kappa());
  EXPECT_NEAR(largest_contact_pressure(packing_).value() / p, 1.0, 1e-12);
}

}  // namespace
}  // namespace floc::test
