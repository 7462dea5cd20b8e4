#include "floc/elasticity/mean_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/elasticity/bounds.h"
#include "floc/packing/tile.h"
#include "floc/structure/carrying_forces.h"
#include "support/crystals.h"
#include "support/lattices.h"

namespace floc {
namespace {

TEST(MeanField, OfGlassBeadsHasItsPublishedNumbers) {
  // Arguments: coordination number z = 6, solid fraction Phi = 0.64, E = 70 GPa, nu = 0.3 and P = 100 kPa.
  // Stresses are in MPa.
  const double nu = 0.3;
  const HertzMeanField m =
      hertz_mean_field(6.0, 0.64, 70e3 / (1.0 - nu * nu), (2.0 - 2.0 * nu) / (2.0 - nu), 0.1);
  EXPECT_NEAR(m.kn_over_a, 566.2233, 5e-5);
  EXPECT_NEAR(m.B, 230.70013, 5e-6);
  EXPECT_NEAR(m.G_rough, 309.40958, 5e-6);
  EXPECT_NEAR(m.G_smooth, 138.42008, 5e-6);
}

/// Returns the solid fraction of a crystal whose neighbours are at a distance of one diameter, as mean field theory
/// assumes.
double solid_fraction_at_contact(const test::CubicCrystal& crystal) {
  return std::acos(-1.0) / (6.0 * crystal.volume);
}

TEST(MeanField, OfCrystalsIsTheirBulkModulusExactly) {
  for (const test::CubicCrystal& crystal : test::cubic_crystals()) {
    const double r = 0.99;
    const Packing<3> packing = test::crystal_of(crystal, r, 1.0, test::elastic_law(3.0, 2.0, 0.1));
    const ContactNetwork<3> network = contact_network(packing);
    const double B = crystal.z * 3.0 / (18.0 * crystal.volume * r);
    const double N = 3.0 * 0.01, P = crystal.z * N / (6.0 * crystal.volume * r * r);
    const Bounds bounds = elastic_bounds(network, P, {double(crystal.z), solid_fraction(packing)});
    EXPECT_NEAR(bounds.B_voigt, B, 1e-12) << crystal.name;
    EXPECT_NEAR(bounds.B_reuss, B, 1e-12) << crystal.name;
    // Mean field theory replaces the branch length r by the diameter a.
    const MeanFieldEstimates m = mean_field_estimates(network, crystal.z, solid_fraction_at_contact(crystal));
    EXPECT_NEAR(m.B_voigt, B * r, 1e-12) << crystal.name;
    EXPECT_NEAR(m.B_reuss, B * r, 1e-12) << crystal.name;
    EXPECT_NEAR(m.G_voigt_rough, 0.6 * (1.0 + 1.5 * 2.0 / 3.0) * B * r, 1e-12) << crystal.name;
    EXPECT_NEAR(m.G_voigt_smooth, 0.6 * B * r, 1e-12) << crystal.name;
    EXPECT_NEAR(m.Z_hat, 1.0, 1e-12) << crystal.name;
  }
}

TEST(MeanField, BoundsOfShearAreTheClosedSumsOverContacts) {
  // For any packing, the Voigt bounds are B = sum K_N r^2/(9 V) and G = sum r^2 [K_N (1 - 3q) + 3 q K_T]/(6 V),
  // with q = sum_(a<b) n_a^2 n_b^2 for the unit normal n of a contact.
  const Packing<3> packing = test::random_packing<3>(40, 5, test::elastic_law(1.0, 0.6, 0.1));
  const ContactNetwork<3> network = contact_network(packing);
  double B = 0.0, G = 0.0;
  for (const NetworkContact<3>& c : network.contacts) {
    const Vec<3> n2 = c.normal().cwiseAbs2();
    const double q = n2[0] * n2[1] + n2[1] * n2[2] + n2[2] * n2[0], r2 = c.branch.squaredNorm();
    B += c.kn * r2 / (9.0 * network.volume);
    G += r2 * (c.kn * (1.0 - 3.0 * q) + 3.0 * q * c.kt) / (6.0 * network.volume);
  }
  const Bounds bounds = elastic_bounds(network, 1.0, {6.0, 0.8});
  EXPECT_NEAR(bounds.B_voigt, B, 1e-12);
  EXPECT_NEAR(bounds.G_voigt, G, 1e-12);
}

TEST(MeanField, OfHertzContactsDependsOnTheDistributionOfForces) {
  // A face-centred cubic crystal with different overlaps and with tangential forces. The forces do not balance, which
  // does not matter for this test.
  Packing<3> packing = tiled<3>(
      test::crystal_of(test::face_centred_cubic(), 0.99, 1.0, test::elastic_law(1.0, 0.5, 0.0)), {2, 2, 2});
  const double ratio = 14.0 / 17.0, E = 2.0;
  for (std::size_t k = 0; k < packing.contacts.size(); ++k)
    packing.contacts[k].gap = -0.01 * (1.0 + 0.2 * static_cast<double>(k % 7));
  test::make_hertzian(E, ratio, packing);
  for (Contact<3>& c : packing.contacts) c.shear_force = 0.2 * c.normal_force * c.normal.unitOrthogonal();
  const CarryingForces f = carrying_forces(packing, carrying_structure(packing, 0.0, 2));
  const double Phi = solid_fraction(packing);
  const MeanFieldEstimates m = mean_field_estimates(contact_network(packing), f.z, Phi);
  EXPECT_NEAR(m.Z_hat, f.Z_five_thirds * (1.0 + 0.04 / ratio), 1e-12);
  EXPECT_NEAR(m.B_voigt / m.B_reuss, f.Z_third * m.Z_hat, 1e-12);
  EXPECT_GT(m.Z_hat, 1.05);
  // The pressure follows from the mean force: P = z Phi <N>/(pi a^2).
  double mean = 0.0;
  for (const Contact<3>& c : packing.contacts)
    mean += c.normal_force / static_cast<double>(packing.contacts.size());
  const double P = f.z * Phi * mean / std::acos(-1.0);
  EXPECT_NEAR(hertz_mean_field(f.z, Phi, E, ratio, P, f.Z_third).B, m.B_voigt, 1e-12);
}

TEST(MeanField, IsThatOfTheBoundsWhereSpringsAreEqual) {
  for (const double kt : {0.0, 0.6}) {
    Packing<2> packing = test::random_packing<2>(40, 3, test::elastic_law(1.0, kt, 0.1));
    const ContactNetwork<2> network = contact_network(packing);
    const MeanFieldEstimates m = mean_field_estimates(network, 4.0, 0.8);
    const Bounds bounds = elastic_bounds(network, 1.0, {4.0, 0.8});
    EXPECT_NEAR(m.B_voigt, bounds.B_voigt_printed, 1e-12);
    EXPECT_NEAR(m.G_voigt_rough, bounds.G_voigt_printed, 1e-12);
    EXPECT_NEAR(m.B_reuss, bounds.B_reuss_printed, 1e-12);
    EXPECT_NEAR(m.G_voigt_smooth, 0.5 * m.B_voigt, 1e-12);
  }
}

TEST(MeanField, OfNothingIsZero) {
  Packing<3> packing;
  packing.grains = Grains<3>::with_size(2);
  packing.grains.radius = {0.5, 0.5};
  const MeanFieldEstimates m = mean_field_estimates(contact_network(packing), 0.0, 0.1);
  EXPECT_EQ(m.B_voigt, 0.0);
  EXPECT_EQ(m.Z_hat, 0.0);
}

}  // namespace
}  // namespace floc
