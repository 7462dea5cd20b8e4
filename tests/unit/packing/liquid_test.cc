#include "floc/packing/liquid/liquid.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "floc/base/random.h"
#include "floc/contact/adhesion/capillary_adhesion.h"

namespace floc {
namespace {

constexpr CapillaryAdhesion kWater{0.072, 0.0, 0.007, 2.6};

double mean_radius(double a, double b) {
  return 2.0 * reduced(a, b);
}

double sum_of(const std::vector<double>& volumes) {
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

TEST(ShareLiquid, ThreeTouchingSpheresShareByTheirMeanRadii) {
  const std::vector<BridgeablePair> pairs{
      {0.0, mean_radius(0.5, 0.75)}, {-1e-3, mean_radius(0.75, 1.0)}, {0.0, mean_radius(0.5, 1.0)}};
  const LiquidShares shares = share_liquid(kWater, 1.0, pairs);
  EXPECT_EQ(shares.n_bonds, 3);
  EXPECT_NEAR(shares.volume[0], 0.28251121, 5e-9);
  EXPECT_NEAR(shares.volume[1], 0.40358744, 5e-9);
  EXPECT_NEAR(shares.volume[2], 0.31390135, 5e-9);
}

/// Returns whether the pairs of a set can share the liquid. Each pair must touch, or its gap must be at most the
/// rupture distance of the bridge that the pair gets.
/// @param margin  relative change of the volumes of bridges
bool all_in_reach(const CapillaryAdhesion& law, double liquid, const std::vector<BridgeablePair>& pairs,
                  unsigned set, double margin) {
  double sum = 0.0;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if (set >> p & 1u) sum += pairs[p].radius;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    if ((set >> p & 1u) && pairs[p].gap > 0.0 &&
        pairs[p].gap > law.reach((1.0 + margin) * liquid * pairs[p].radius / sum))
      return false;
  return true;
}

/// Returns whether no pair outside the set is easier to reach than a pair inside the set. Touching pairs are the
/// easiest to reach; then follow the other pairs in the order of decreasing R'/gap^3 (R': reduced radius).
bool leaves_out_no_closer_pair(const std::vector<BridgeablePair>& pairs, unsigned set) {
  const auto ease = [](const BridgeablePair& p) {
    return p.gap > 0.0 ? p.radius / (p.gap * p.gap * p.gap) : std::numeric_limits<double>::infinity();
  };
  for (std::size_t in = 0; in < pairs.size(); ++in)
    for (std::size_t out = 0; out < pairs.size(); ++out)
      if ((set >> in & 1u) && !(set >> out & 1u) && ease(pairs[out]) > ease(pairs[in])) return false;
  return true;
}

/// Random small set of pairs, with a volume of liquid.
struct SmallCase {
  CapillaryAdhesion law = kWater;
  double liquid;
  std::vector<BridgeablePair> pairs;

  SmallCase(RandomStream& random, bool equal_grains) {
    law.contact_angle = 80.0 * random.uniform();
    liquid = std::pow(10.0, random.uniform(-3.0, 0.0));
    const int n = 1 + static_cast<int>(10.0 * random.uniform());
    for (int p = 0; p < n; ++p) {
      const double a = random.uniform(0.1, 1.0), b = random.uniform(0.1, 1.0);
      pairs.push_back({random.uniform(-0.2, 1.0), equal_grains ? 1.0 : mean_radius(a, b)});
    }
  }
  bool holds(unsigned set, double margin) const { return all_in_reach(law, liquid, pairs, set, margin); }
  unsigned sets() const { return 1u << pairs.size(); }
};

/// Compares the set of pairs to which share_liquid() gives liquid with every other set of the pairs.
void expect_brute_force(const SmallCase& c, bool any_set, int& n_partial) {
  const LiquidShares shares = share_liquid(c.law, c.liquid, c.pairs);
  unsigned own = 0;
  for (std::size_t p = 0; p < c.pairs.size(); ++p) {
    if (shares.volume[p] > 0.0) own |= 1u << p;
    ASSERT_TRUE(c.pairs[p].gap > 0.0 || shares.volume[p] > 0.0);
  }
  ASSERT_TRUE(c.holds(own, 1e-12));
  for (unsigned set = 0; set < c.sets(); ++set) {
    const bool larger = std::popcount(set) > shares.n_bonds;
    ASSERT_FALSE(larger && (any_set || leaves_out_no_closer_pair(c.pairs, set)) && c.holds(set, -1e-12));
  }
  ASSERT_EQ(std::popcount(own), shares.n_bonds);
  ASSERT_NEAR(sum_of(shares.volume), shares.n_bonds > 0 ? c.liquid : 0.0, 1e-12 * c.liquid);
  n_partial += shares.n_bonds > 0 && own != c.sets() - 1;
}

TEST(ShareLiquid, NoLargerSetThatLeavesOutNoCloserPairIsInReachOfItsOwnVolumes) {
  RandomStream random(17, 1);
  int n_partial = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(trial);
    expect_brute_force(SmallCase(random, false), false, n_partial);
  }
  EXPECT_GT(n_partial, 300);
}

TEST(ShareLiquid, NoLargerSetOfPairsOfEqualGrainsIsInReachAtAll) {
  RandomStream random(17, 2);
  int n_partial = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    SCOPED_TRACE(trial);
    expect_brute_force(SmallCase(random, true), true, n_partial);
  }
  EXPECT_GT(n_partial, 300);
}

/// share_liquid() does not accept a set of pairs if a pair outside the set is closer than a pair inside it. In this
/// test, pair 1 is closer than pair 2, so pairs 0 and 2 are not accepted. Pairs 0 and 1 cannot share the liquid,
/// because their bridges would be too small. Therefore only pair 0 gets liquid.
TEST(ShareLiquid, APairBehindOneThatIsNotReachedStaysDry) {
  const auto gap_of = [](double radius, double q) { return std::cbrt(radius / q); };
  const std::vector<BridgeablePair> pairs{{-0.1, 1.0}, {gap_of(10.0, 9.0), 10.0}, {gap_of(1.0, 8.0), 1.0}};
  const LiquidShares shares = share_liquid(kWater, 1.0, pairs);
  EXPECT_EQ(shares.volume, (std::vector<double>{1.0, 0.0, 0.0}));
  EXPECT_TRUE(all_in_reach(kWater, 1.0, pairs, 0b101, 0.0));
}

TEST(ShareLiquid, PairsOfOneRankGoByTheirOrder) {
  // Either pair could have a bridge alone, but both together cannot, because the two bridges would be too small.
  const double reach = kWater.reach(1.0), gap = 0.9 * reach;
  const LiquidShares shares = share_liquid(kWater, 1.0, std::vector<BridgeablePair>{{gap, 1.0}, {gap, 1.0}});
  EXPECT_EQ(shares.n_bonds, 1);
  EXPECT_EQ(shares.volume, (std::vector<double>{1.0, 0.0}));
}

TEST(ShareLiquid, WhereNothingIsInReachNoPairHoldsAny) {
  const LiquidShares shares = share_liquid(kWater, 1e-9, std::vector<BridgeablePair>{{0.5, 1.0}});
  EXPECT_EQ(shares.n_bonds, 0);
  EXPECT_EQ(shares.volume, std::vector<double>{0.0});
  EXPECT_EQ(share_liquid(kWater, 1.0, {}).n_bonds, 0);
}

TEST(BridgeSearch, KnowsTheLiquidOfAllGrainsAndHowFarToLook) {
  const std::array<double, 2> radius{1.0, 0.5};
  const BridgeSearch search(kWater, radius);
  EXPECT_NEAR(search.liquid(), 0.0182 * 4.0 / 3.0 * 3.14159265358979 * 1.125, 1e-14);
  LiquidShares shares;
  EXPECT_DOUBLE_EQ(search.reach_bound(shares), kWater.reach(search.liquid()));
  shares.n_bonds = 4;
  shares.radius_sum = 3.0;
  const double bound = kWater.reach(search.liquid() / 3.0);
  EXPECT_DOUBLE_EQ(search.reach_bound(shares), bound);
  EXPECT_EQ(search.wider(2.0 * bound, shares), 2.0 * bound);
  EXPECT_DOUBLE_EQ(search.wider(0.9 * bound, shares), bound);
  EXPECT_DOUBLE_EQ(search.wider(0.1 * bound, shares), 0.2 * bound);
}

}  // namespace
}  // namespace floc
