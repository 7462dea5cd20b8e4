#include "floc/packing/tile.h"

#include <gtest/gtest.h>

#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "support/contact_laws.h"
#include "support/network_packings.h"
#include "support/springs.h"

namespace floc {
namespace {

/// Returns a random packing whose springs carry forces.
template <int Dim>
Packing<Dim> loaded_packing() {
  Law law = test::elastic_law(1.0, 0.7, 0.01);
  if (Dim == 3) law += test::twisting_spring(1e6, 0.02);
  Packing<Dim> packing = test::random_packing<Dim>(Dim == 2 ? 7 : 5, 3, law);
  test::stretch_at_random(packing);
  return packing;
}

template <class T>
class Tile : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Tile, Dimensions);

TYPED_TEST(Tile, HasTheContactsThatItsPositionsHave) {
  constexpr int kDim = TypeParam::value;
  const Packing<kDim> unit = loaded_packing<kDim>();
  Vec<kDim, int> copies = Vec<kDim, int>::Constant(2);
  copies[0] = 3;
  const Packing<kDim> whole = tiled(unit, copies);
  Packing<kDim> found = whole;
  found.contacts.clear();
  find_contacts(found);
  ASSERT_EQ(whole.contacts.size(), unit.contacts.size() * copies.prod());
  ASSERT_EQ(whole.contacts.size(), found.contacts.size());
  for (std::size_t c = 0; c < found.contacts.size(); ++c) {
    const Contact<kDim>& p = whole.contacts[c];
    const Contact<kDim>& q = found.contacts[c];
    EXPECT_EQ(std::tie(p.i, p.j, p.image), std::tie(q.i, q.j, q.image));
    EXPECT_NEAR(p.gap, q.gap, 1e-14);
    EXPECT_NEAR((p.normal - q.normal).norm(), 0.0, 1e-14);
  }
}

TYPED_TEST(Tile, KeepsTheForceOnEveryGrainAndTheStress) {
  constexpr int kDim = TypeParam::value;
  Packing<kDim> unit = loaded_packing<kDim>();
  refresh_contacts(unit);
  Packing<kDim> whole = tiled<kDim>(unit, Vec<kDim, int>::Constant(2));
  refresh_contacts(whole);  // computes the forces of the copied springs
  EXPECT_NEAR((static_stress(whole) - static_stress(unit)).norm(), 0.0, 1e-14);
  const auto in_unit = net_forces(unit);
  const auto in_whole = net_forces(whole);
  const int n = unit.grains.size();
  for (int k = 0; k < whole.grains.size(); ++k) {
    EXPECT_NEAR((in_whole.force[k] - in_unit.force[k % n]).norm(), 0.0, 1e-14);
    EXPECT_NEAR((in_whole.moment[k] - in_unit.moment[k % n]).norm(), 0.0, 1e-14);
  }
}

}  // namespace
}  // namespace floc
