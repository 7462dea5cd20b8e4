#include "floc/assembly/saved_start.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/springs.h"

namespace floc {
namespace {

const Vec<2, int> kAlone = Vec<2, int>::Ones();

/// Returns a compressed packing of moving, rotated disks. The springs of its contacts carry forces.
Packing<2> pressed_disks() {
  Packing<2> packing = test::agitated_gas(30, test::cohesive_law());
  const double squeeze = 0.85;
  packing.cell.matrix *= squeeze;
  packing.cell.velocity.setConstant(0.1);
  for (Vec<2>& x : packing.grains.position) x *= squeeze;
  for (int i = 0; i < packing.grains.size(); ++i) {
    packing.grains.angular_velocity[i].setConstant(0.3);
    packing.grains.orientation[i] = 0.1 * i;
  }
  find_contacts(packing);
  for (std::size_t c = 0; c < packing.contacts.size(); ++c) {
    test::shear_spring(packing.contacts[c]).setConstant(1e-8 * (1.0 + static_cast<double>(c)));
    test::rolling_spring(packing.contacts[c]).setConstant(-1e-8 * (1.0 + static_cast<double>(c)));
  }
  refresh_contacts(packing);
  return packing;
}

bool remembers(const Contact<2>& c) {
  return test::shear_spring(c)[0] != 0.0 || test::rolling_spring(c)[0] != 0.0;
}

TEST(SavedStart, UnderItsOwnLawIsThePackingAtRest) {
  const Packing<2> saved = pressed_disks();
  const Packing<2> start = start_from<2>(saved, saved.law, kAlone);
  EXPECT_EQ(mean_kinetic_energy(start), 0.0);
  EXPECT_TRUE(start.cell.velocity.isZero(0.0));
  EXPECT_EQ(start.grains.position, saved.grains.position);
  EXPECT_EQ(start.grains.orientation, saved.grains.orientation);
  ASSERT_EQ(start.contacts.size(), saved.contacts.size());
  ASSERT_GT(std::count_if(start.contacts.begin(), start.contacts.end(), remembers), 10);
  for (std::size_t k = 0; k < saved.contacts.size(); ++k) {
    const Contact<2>&p = saved.contacts[k], &q = start.contacts[k];
    EXPECT_EQ(std::tie(p.i, p.j, p.image), std::tie(q.i, q.j, q.image));
    EXPECT_EQ(std::tie(p.normal_force, p.shear_force, p.rolling_moment),
              std::tie(q.normal_force, q.shear_force, q.rolling_moment));
  }
}

TEST(SavedStart, CopiesEveryContactWithItsSprings) {
  const Packing<2> saved = pressed_disks();
  const Packing<2> start = start_from<2>(saved, saved.law, {3, 2});
  EXPECT_EQ(start.grains.size(), 6 * saved.grains.size());
  ASSERT_EQ(start.contacts.size(), 6 * saved.contacts.size());
  EXPECT_EQ(std::count_if(start.contacts.begin(), start.contacts.end(), remembers),
            6 * std::count_if(saved.contacts.begin(), saved.contacts.end(), remembers));
  EXPECT_NEAR((static_stress(start) - static_stress(saved)).norm() / static_stress(saved).norm(), 0.0, 1e-13);
}

TEST(SavedStart, LosesTheSpringsOfSlotsThatTheLawHasNot) {
  const Packing<2> saved = pressed_disks();
  Law law = saved.law;
  law += test::without("rolling");
  for (const Contact<2>& c : start_from<2>(saved, law, kAlone).contacts)
    EXPECT_EQ(test::rolling_spring(c)[0], 0.0);
  law += test::without("friction");
  for (const Contact<2>& c : start_from<2>(saved, law, kAlone).contacts) EXPECT_FALSE(remembers(c));
}

TEST(SavedStart, KeepsSpringsAndNotForcesUpToTheNewCaps) {
  const Packing<2> saved = pressed_disks();
  Law law = saved.law;
  law += test::changed("friction.stiffness", 0.5 * test::law_number(law, "friction.stiffness"));
  law += test::changed("rolling.coefficient", 0.0);  // no rolling resistance
  const Packing<2> start = start_from<2>(saved, law, kAlone);
  ASSERT_EQ(start.contacts.size(), saved.contacts.size());
  for (std::size_t k = 0; k < saved.contacts.size(); ++k) {
    EXPECT_EQ(test::shear_spring(start.contacts[k]), test::shear_spring(saved.contacts[k]));
    EXPECT_EQ(start.contacts[k].shear_force, 0.5 * saved.contacts[k].shear_force);
    EXPECT_EQ(start.contacts[k].rolling_moment[0], 0.0);
  }
}

TEST(SavedStart, FindsTheContactsOfALongerRange) {
  const Packing<2> saved = pressed_disks();
  Law law = saved.law;
  law += test::changed("adhesion.range", 0.2);
  Packing<2> found = saved;
  found.law = law;
  find_contacts(found);
  const Packing<2> start = start_from<2>(saved, law, kAlone);
  EXPECT_GT(start.contacts.size(), saved.contacts.size());
  EXPECT_EQ(start.contacts.size(), found.contacts.size());
}

}  // namespace
}  // namespace floc
