#include <gtest/gtest.h>

#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/dynamics.h"
#include "support/contact_laws.h"
#include "support/springs.h"

namespace floc {
namespace {

/// Returns two grains that shear relative to each other. They have two contacts, each with its own spring.
template <int Dim>
Packing<Dim> twice_in_contact() {
  Packing<Dim> packing;
  packing.cell.matrix *= 4.0;
  packing.law = test::law_of({test::linear(1e3), test::coulomb(10.0, 1e3)});
  packing.grains = Grains<Dim>::with_size(2);
  packing.grains.radius = {0.5, 0.4};
  packing.grains.mass = {1.0, 0.6};
  for (Vec<Dim>& x : packing.grains.position) x.setConstant(2.0);
  // Grain 1 lies before grain 0 along the cell. Sorting the grains by position therefore exchanges them.
  packing.grains.position[0][0] = 2.4;
  packing.grains.position[1][0] = 1.52;
  packing.grains.velocity[0][1] = 0.02;
  for (const int key : {0, 1}) {
    Contact<Dim> c;
    c.j = 1;
    c.key = key;
    test::shear_spring(c)[Dim == 2 ? 0 : 1] = key == 0 ? 1e-4 : -3e-4;
    packing.contacts.push_back(c);
  }
  refresh_contacts(packing);
  return packing;
}

template <int Dim>
void expect_two_contacts(const Packing<Dim>& packing, double tolerance) {
  ASSERT_EQ(packing.contacts.size(), 2u);
  EXPECT_EQ(packing.contacts[0].key, 0);
  EXPECT_EQ(packing.contacts[1].key, 1);
  // Both springs change by the same slip, so their difference stays constant.
  const Shear<Dim> difference =
      test::shear_spring(packing.contacts[0]) - test::shear_spring(packing.contacts[1]);
  EXPECT_NEAR(difference.norm(), 4e-4, tolerance);
}

template <int Dim>
void expect_two_contacts_in_motion() {
  const Packing<Dim> start = twice_in_contact<Dim>();
  // The skin is so narrow that neighbour lists are rebuilt frequently.
  const auto dynamics = make_dynamics(start, BoundaryControl<Dim>::fixed(), {1e-3, 1e-4});
  expect_two_contacts(dynamics->packing(), 1e-18);
  for (int k = 0; k < 5; ++k) dynamics->advance(4, Motion::free);
  const Packing<Dim> end = dynamics->packing();
  expect_two_contacts(end, 1e-9);
  EXPECT_GT((test::shear_spring(end.contacts[0]) - test::shear_spring(start.contacts[0])).norm(), 1e-4);
}

TEST(SeveralContactsOfAPair, KeepTheirMemoriesInMotion) {
  expect_two_contacts_in_motion<2>();
  expect_two_contacts_in_motion<3>();
}

}  // namespace
}  // namespace floc
