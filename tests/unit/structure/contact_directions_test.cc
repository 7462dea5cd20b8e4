#include "floc/structure/contact_directions.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

namespace floc {
namespace {

Contact<2> contact(const Vec<2>& normal, double force) {
  Contact<2> c;
  c.normal = normal;
  c.normal_force = force;
  return c;
}

/// Opposite directions count as the same direction. Contacts under tension and contacts at a distance are not counted.
TEST(ContactDirections, AreADensityOverHalfATurn) {
  Packing<2> packing;
  packing.contacts = {contact({1.0, 0.1}, 1.0), contact({-1.0, -0.1}, 1.0), contact({0.1, 1.0}, 4.0),
                      contact({1.0, 1.0}, -1.0)};
  packing.contacts.push_back(contact({1.0, 1.0}, 1.0));
  packing.contacts.back().distant = true;
  const ContactDirections d = contact_directions(packing, 4);
  EXPECT_EQ(d.n_contacts, 3);
  const double width = std::numbers::pi / 4;
  EXPECT_NEAR(std::accumulate(d.all.begin(), d.all.end(), 0.0) * width, 1.0, 1e-15);
  EXPECT_NEAR(d.all[0] * width, 2.0 / 3.0, 1e-15);
  EXPECT_NEAR(d.all[1] * width, 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(d.strong[1] * width, 1.0 / 3.0, 1e-15);  // the force of 4 is above the mean force of 2
  EXPECT_EQ(d.strong[0], 0.0);
}

}  // namespace
}  // namespace floc
