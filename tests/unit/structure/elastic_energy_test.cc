#include "floc/structure/elastic_energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/crystals.h"

namespace floc {
namespace {

TEST(ElasticEnergy, OfLinearCrystalsIsThatOfTheirSprings) {
  for (const test::CubicCrystal& crystal : test::cubic_crystals()) {
    Packing<3> packing = test::crystal_of(crystal, 0.99, 1.0, test::elastic_law(3.0, 0.5, 0.1));
    EXPECT_NEAR(elastic_energy_per_grain(packing), crystal.z / 2.0 * 0.5 * 3.0 * 1e-4, 1e-15) << crystal.name;
    packing.contacts[0].shear_force = {0.3, 0.0, 0.0};
    packing.contacts[0].rolling_moment[1] = 0.2;
    EXPECT_NEAR(contact_energy(packing, packing.contacts[0]).elastic, 1.5e-4 + 0.09 / 1.0 + 0.04 / 0.2, 1e-15);
    packing.contacts[0].distant = true;
    EXPECT_EQ(contact_energy(packing, packing.contacts[0]).elastic, 0.0);
  }
}

TEST(ElasticEnergy, OfHertzContactsIsTwoFifthsOfForceTimesOverlap) {
  // Face-centred cubic crystal with a = E = 1 and h = 0.01, whose energy per grain is 8e-6.
  Packing<3> packing =
      test::crystal_of(test::face_centred_cubic(), 0.99, 1.0, test::elastic_law(1.0, 0.5, 0.0));
  test::make_hertzian(1.0, 14.0 / 17.0, packing);
  EXPECT_NEAR(elastic_energy_per_grain(packing), 8e-6, 1e-17);
  packing.contacts[0].shear_force = {0.0, 1e-4, 0.0};
  EXPECT_NEAR(contact_energy(packing, packing.contacts[0]).elastic,
              8e-6 / 6.0 + 1e-8 / (2.0 * 0.05 * 14.0 / 17.0), 1e-17);
}

TEST(ElasticEnergy, IsTheIntegralOfTheForceOverTheOverlap) {
  // The formula must hold for every power q of N = h^q.
  for (const double q : {1.0, 1.5, 2.0, 3.0}) {
    Packing<3> pair;
    pair.grains = Grains<3>::with_size(2);
    Contact<3> c;
    c.j = 1;
    c.gap = -0.3;
    c.elastic_force = std::pow(0.3, q);
    c.kn = q * std::pow(0.3, q - 1.0);
    EXPECT_NEAR(contact_energy(pair, c).elastic, std::pow(0.3, q + 1.0) / (q + 1.0), 1e-16) << q;
  }
}

TEST(ContactPressure, OfHertzContactsHasItsClosedForm) {
  // For a = E = 1 and h = 1e-4, the contact pressure is (2 3^(1/3)/pi) N^(1/3) = 6.366198e-3.
  const double N = 1e-6 / 3.0;
  EXPECT_NEAR(hertz_contact_pressure(N, 1e-4, 0.25), 6.366198e-3, 1e-9);
  EXPECT_NEAR(hertz_contact_pressure(N, 1e-4, 0.25), 2.0 * std::cbrt(3.0 * N) / std::acos(-1.0), 1e-15);
  Packing<3> packing = test::crystal_of(test::simple_cubic(), 0.9999, 1.0, test::elastic_law(1.0, 0.0, 0.0));
  EXPECT_FALSE(largest_contact_pressure(packing));  // linear contacts have no Hertz pressure
  test::make_hertzian(1.0, 0.0, packing);
  EXPECT_NEAR(largest_contact_pressure(packing).value(), 6.366198e-3, 1e-9);
  packing.contacts.clear();
  EXPECT_FALSE(largest_contact_pressure(packing));
}

}  // namespace
}  // namespace floc
