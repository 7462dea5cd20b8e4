#include "floc/relaxation/blocking_criterion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>
#include <set>
#include <string>

namespace floc {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(BlockingCriterion, EachDemandHasWordsOfItsOwn) {
  std::set<std::string> words;
  for (int d = 1; d < kDemands; ++d) words.insert(in_words({static_cast<Demand>(d), 3.0, 2e-5}));
  EXPECT_EQ(words.size(), kDemands - 1u);
  EXPECT_FALSE(words.contains(""));
  EXPECT_THAT(in_words({}), IsEmpty());
  std::cout << "words of " << words.size() << " demands\n";
}

/// The message gives the numbers of a criterion: for a comparison, the quantity and its limit; otherwise the number of
/// things that are counted.
TEST(BlockingCriterion, DemandsGiveTheirNumbers) {
  for (const Demand compared : {Demand::response, Demand::density, Demand::stress, Demand::rest,
                                Demand::pressure, Demand::energy_ratio})
    EXPECT_THAT(in_words({compared, 3.25e-4, 2e-5}), HasSubstr("3.25e-04 (limit 2e-05)"));
  for (const Demand counted : {Demand::mechanisms, Demand::stability, Demand::liquid})
    EXPECT_THAT(in_words({counted, 7.0}), HasSubstr(" 7 "));
}

TEST(BlockingCriterion, NamesTheResidualThatIsWorstAgainstItsTolerance) {
  const EquilibriumTolerance tolerance{1e-5, 1e-6, 1e-4, 1e-8};
  const Residuals within{5e-6, 5e-7, 5e-5, 5e-9, 4, 7};
  EXPECT_THAT(worst_residual(within, tolerance), IsEmpty());
  EXPECT_THAT(worst_residual({}, tolerance), IsEmpty());
  const auto beyond = [&](double Residuals::*residual, double value) {
    Residuals r = within;
    r.*residual = value;
    return worst_residual(r, tolerance);
  };
  EXPECT_EQ(beyond(&Residuals::force, 2e-5), "force residual 2.00e-05 (tolerance 1e-05), on grain 4");
  EXPECT_EQ(beyond(&Residuals::moment, 1e-6), "moment residual 1.00e-06 (tolerance 1e-06), on grain 7");
  EXPECT_THAT(beyond(&Residuals::stress, 1.0), StartsWith("stress residual 1.00e+00 (tolerance 1e-04)"));
  EXPECT_THAT(beyond(&Residuals::energy, 1e-7), StartsWith("energy residual 1.00e-07 (tolerance 1e-08)"));
}

}  // namespace
}  // namespace floc
