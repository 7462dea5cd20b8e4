#include "floc/neighbors/spread_liquid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/neighbors/pairs.h"
#include "floc/packing/law/contact_forces.h"
#include "support/contact_laws.h"
#include "support/network_packings.h"
#include "support/wet_packings.h"

namespace floc {
namespace {

using test::all_volumes;
using test::liquid_of;

Law wet_law(double water, const std::string& formation = "gap") {
  Law law = test::elastic_law(1.0, 0.7, 0.0);
  law += test::liquid(0.01, 0.0, water, 2.5, "exponential", formation);
  return law;
}

/// Applies the rule for the formation of liquid bridges to all pairs of grains with gaps of up to `reach`. Returns the
/// number of bridges.
template <int Dim>
int bonds_over_all_pairs(const Packing<Dim>& packing, double reach) {
  std::vector<BridgeablePair> pairs;
  const std::vector<double>& radius = packing.grains.radius;
  for (const NeighborPair<Dim>& p : find_pairs(packing.cell, packing.grains, reach)) {
    Contact<Dim> c;
    c.i = p.i, c.j = p.j, c.image = p.image;
    pairs.push_back(
        {branch(packing, c).norm() - radius[p.i] - radius[p.j], 2.0 * reduced(radius[p.i], radius[p.j])});
  }
  return share_liquid(*packing.law.liquid(), liquid_of(packing), pairs).n_bonds;
}

template <int Dim>
int count_bonds(const Packing<Dim>& packing) {
  int n = 0;
  for (const Contact<Dim>& c : packing.contacts) n += bridge_volume(packing, c) > 0.0;
  return n;
}

template <int Dim>
void expect_every_bridge_to_be_found(double grains_per_volume) {
  for (const double water : {1e-4, 3e-3, 3e-2})
    for (unsigned seed = 0; seed < 3; ++seed) {
      SCOPED_TRACE(::testing::Message() << Dim << "D, w = " << water << ", seed " << seed);
      const auto packing = test::random_packing<Dim>(30, seed, wet_law(water), grains_per_volume);
      EXPECT_EQ(count_bonds(packing), bonds_over_all_pairs(packing, 1.0));
      EXPECT_NEAR(all_volumes(packing), liquid_of(packing), 1e-12 * liquid_of(packing));
      for (const Contact<Dim>& c : packing.contacts) {
        EXPECT_TRUE(c.gap < 0.0 || bridge_volume(packing, c) > 0.0);
        EXPECT_LE(c.gap, range_of(packing, c) * (1.0 + 1e-12));
      }
    }
}

TEST(SpreadLiquid, FindsEveryBridgeInDensePackings) {
  expect_every_bridge_to_be_found<2>(1.2);
  expect_every_bridge_to_be_found<3>(1.2);
}

TEST(SpreadLiquid, FindsEveryBridgeWhereGrainsAreFarApartAndFewShareTheLiquid) {
  expect_every_bridge_to_be_found<2>(0.5);
  expect_every_bridge_to_be_found<3>(0.4);
}

TEST(SpreadLiquid, LosesNoBridgeBetweenGrainsOfATenthOfTheSizeOfOthers) {
  auto packing = test::random_packing<3>(60, 4, wet_law(5e-3), 1.2);
  for (int i = 0; i < packing.grains.size(); i += 2) packing.grains.radius[i] *= 0.1;
  find_contacts(packing);
  EXPECT_EQ(count_bonds(packing), bonds_over_all_pairs(packing, 1.0));
  EXPECT_GT(count_bonds(packing), 30);
}

TEST(SpreadLiquid, OnceMoreChangesNothing) {
  auto packing = test::random_packing<3>(30, 2, wet_law(5e-3), 0.8);
  const auto before = packing.contacts;
  const LiquidChange change = spread_liquid(packing);
  EXPECT_TRUE(change.nothing());
  ASSERT_EQ(packing.contacts.size(), before.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(packing.contacts[k].history, before[k].history);
    EXPECT_EQ(packing.contacts[k].normal_force, before[k].normal_force);
  }
}

TEST(SpreadLiquid, CountsWhatFormsAndBreaksWhenGrainsHaveMoved) {
  auto packing = test::random_packing<3>(30, 2, wet_law(5e-3), 0.8);
  const int before = count_bonds(packing);
  for (int i = 0; i < packing.grains.size(); ++i)
    packing.grains.position[i] += Vec<3>::Constant(i % 2 ? 0.03 : -0.03);
  refresh_contacts(packing);
  EXPECT_NEAR(all_volumes(packing), liquid_of(packing), 1e-12 * liquid_of(packing));  // no volume is lost
  const LiquidChange change = spread_liquid(packing);
  EXPECT_GT(change.n_formed, 0);
  EXPECT_GT(change.n_broken, 0);
  EXPECT_EQ(count_bonds(packing), before + change.n_formed - change.n_broken);
  EXPECT_NEAR(all_volumes(packing), liquid_of(packing), 1e-12 * liquid_of(packing));
}

TEST(SpreadLiquid, BridgesThatFormOnContactNeedOne) {
  const auto across = test::random_packing<3>(30, 2, wet_law(5e-3), 0.8);
  auto packing = test::random_packing<3>(30, 2, wet_law(5e-3, "contact"), 0.8);
  int n_distant = 0;
  for (const Contact<3>& c : packing.contacts) n_distant += c.distant;
  EXPECT_EQ(n_distant, 0);
  EXPECT_EQ(count_bonds(packing), static_cast<int>(packing.contacts.size()));
  EXPECT_LT(packing.contacts.size(), across.contacts.size());
  // When the grains separate, bridges remain until their rupture distance.
  packing.cell.matrix *= 1.05;
  for (Vec<3>& x : packing.grains.position) x *= 1.05;
  refresh_contacts(packing);
  spread_liquid(packing);
  n_distant = 0;
  for (const Contact<3>& c : packing.contacts) n_distant += c.distant;
  EXPECT_GT(n_distant, 0);
  EXPECT_NEAR(all_volumes(packing), liquid_of(packing), 1e-12 * liquid_of(packing));
}

TEST(SpreadLiquid, DoesNothingWithoutLiquid) {
  auto packing = test::random_packing<2>(30, 2, wet_law(0.0), 1.2);
  const auto dry = test::random_packing<2>(30, 2, test::elastic_law(1.0, 0.7, 0.0), 1.2);
  ASSERT_EQ(packing.contacts.size(), dry.contacts.size());
  for (std::size_t k = 0; k < dry.contacts.size(); ++k) {
    EXPECT_EQ(packing.contacts[k].history, dry.contacts[k].history);
    EXPECT_EQ(packing.contacts[k].normal_force, dry.contacts[k].normal_force);
  }
}

}  // namespace
}  // namespace floc
