#include "floc/assembly/sieve_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/assembly/size_classes.h"

namespace floc {
namespace {

using Kind = DiameterDistribution::Kind;

const SieveCurve kSand{{0.125, 0.25, 0.5, 1.0, 2.0, 4.0}, {0, 4, 18, 45, 80, 100}};

GrainOptions sieved(const SieveCurve& curve, int dimension, int count) {
  GrainOptions grains;
  grains.count = count;
  grains.diameter.kind = Kind::sieve;
  grains.diameter.quantiles = DiameterDistribution::Quantiles::middle;
  grains.diameter.curve = curve;
  grains.diameter.dimension = dimension;
  grains.diameter.min = curve.sizes.front();
  grains.diameter.max = curve.sizes.back();
  return grains;
}

GrainOptions drawn_from(Kind kind, double exponent, int count) {
  GrainOptions grains;
  grains.count = count;
  grains.diameter.kind = kind;
  grains.diameter.quantiles = DiameterDistribution::Quantiles::middle;
  grains.diameter.exponent = exponent;
  grains.diameter.median = 0.3;
  grains.diameter.sigma = 0.5;
  grains.diameter.min = 0.1;
  grains.diameter.max = 1.0;
  return grains;
}

TEST(SieveCurve, IsLinearInTheLogarithmOfTheSize) {
  EXPECT_NEAR(passing_at(kSand, std::sqrt(0.5)), 0.5 * (0.18 + 0.45), 1e-15);
  EXPECT_EQ(passing_at(kSand, 0.1), 0.0);
  EXPECT_EQ(passing_at(kSand, 4.0), 1.0);
  EXPECT_EQ(passing_at(kSand, 5.0), 1.0);
}

TEST(SieveCurve, OfTwoSievesHasTheQuantilesOfAPowerLaw) {
  // If equal intervals of ln d contain equal masses, the number density of diameters d is proportional to
  // d^-(Dim + 1).
  for (const int dimension : {2, 3}) {
    DiameterDistribution power;
    power.kind = Kind::power_law;
    power.min = 0.2;
    power.max = 3.0;
    power.exponent = dimension + 1.0;
    for (const double share : {1e-6, 0.1, 0.5, 0.9, 0.999999})
      EXPECT_NEAR(number_quantile({{0.2, 3.0}, {0, 100}}, dimension, share), diameter_quantile(power, share),
                  1e-12);
  }
}

TEST(SieveCurve, ManyGrainsGiveBackItsPassing) {
  for (const int dimension : {2, 3})
    for (const SizeClass& c : size_classes(sieved(kSand, dimension, 200'000), dimension)) {
      EXPECT_NEAR(c.passing, passing_at(kSand, c.to), 1e-3) << dimension << "D, " << c.to;
      EXPECT_EQ(c.passing_asked, passing_at(kSand, c.to));
    }
}

TEST(SieveCurve, SizesThatHoldNothingHaveNoGrains) {
  const SieveCurve gap{{0.1, 0.2, 0.4, 0.8}, {0, 50, 50, 100}};
  const auto classes = size_classes(sieved(gap, 3, 1000), 3);
  ASSERT_EQ(classes.size(), 3u);
  EXPECT_EQ(classes[1].n_grains, 0);
  EXPECT_EQ(classes[1].share_asked, 0.0);
  EXPECT_NEAR(classes[2].share, 0.5, 0.02);
}

TEST(SieveCurve, CutOffCountsWhatIsLeftAsTheWhole) {
  const SieveCurve cut = cut_curve(kSand, 0.3, 3.0);
  EXPECT_EQ(cut.sizes, (std::vector<double>{0.3, 0.5, 1.0, 2.0, 3.0}));
  EXPECT_EQ(cut.passing.front(), 0.0);
  EXPECT_EQ(cut.passing.back(), 100.0);
  const double all = passing_at(kSand, 3.0) - passing_at(kSand, 0.3);
  for (const double d : {0.4, 0.5, 1.3, 2.9})
    EXPECT_NEAR(passing_at(cut, d), (passing_at(kSand, d) - passing_at(kSand, 0.3)) / all, 1e-14);
}

TEST(SizeClasses, OfManyGrainsAreTheClosedFormOfTheirDistribution) {
  for (const int dimension : {2, 3})
    for (const GrainOptions& grains :
         {drawn_from(Kind::uniform, 0, 100'000), drawn_from(Kind::power_law, 3, 100'000),
          drawn_from(Kind::power_law, dimension + 1.0, 100'000), drawn_from(Kind::power_law, 5, 100'000),
          drawn_from(Kind::power_law, -2, 100'000), drawn_from(Kind::lognormal, 0, 100'000)})
      for (const SizeClass& c : size_quarters(grains, dimension)) {
        ASSERT_TRUE(c.share_asked.has_value());
        EXPECT_NEAR(c.share, *c.share_asked, 2e-3) << dimension << "D, " << grains.diameter.exponent;
      }
}

TEST(SizeClasses, OfSphereVolumesDrawnAtTheMiddleOfEqualSharesAreEqual) {
  for (const SizeClass& c : size_quarters(drawn_from(Kind::power_law, kUniformByVolume, 300), 3)) {
    EXPECT_NEAR(c.share, 0.25, 0.0031);
    EXPECT_NEAR(*c.share_asked, 0.25, 1e-15);
  }
  // If the quantiles include both ends of the size distribution, one grain has the largest size.
  GrainOptions ends = drawn_from(Kind::power_law, kUniformByVolume, 300);
  ends.diameter.quantiles = DiameterDistribution::Quantiles::ends;
  EXPECT_NEAR(size_quarters(ends, 3).back().share, 0.354, 5e-4);
  EXPECT_EQ(ends.largest(), 1.0);
}

TEST(SizeClasses, OfSingleSizesAreNotAskedFor) {
  GrainOptions list;
  list.count = 3;
  list.diameter.kind = Kind::list;
  list.diameter.values = {1.0, 2.0, 1.0};
  list.diameter.min = 1.0;
  list.diameter.max = 2.0;
  const auto quarters = size_quarters(list, 2);
  ASSERT_EQ(quarters.size(), 4u);
  EXPECT_EQ(quarters[0].n_grains, 2);
  EXPECT_NEAR(quarters[3].share, 4.0 / 6.0, 1e-15);
  EXPECT_FALSE(quarters[3].share_asked.has_value());
  list.diameter.kind = Kind::constant;
  list.diameter.max = 1.0;
  EXPECT_TRUE(size_quarters(list, 2).empty());
}

TEST(GrainOptions, EndsAreThoseOfTheGrainsDrawn) {
  for (const GrainOptions& grains :
       {sieved(kSand, 3, 57), drawn_from(Kind::uniform, 0, 57), drawn_from(Kind::lognormal, 0, 57)}) {
    const std::vector<double> drawn = equally_spaced_diameters(grains.diameter, grains.count);
    EXPECT_EQ(grains.smallest(), drawn.front());
    EXPECT_EQ(grains.largest(), drawn.back());
    EXPECT_LT(grains.largest(), grains.diameter.max);
  }
}

}  // namespace
}  // namespace floc
