#include "floc/campaign/campaign_cases.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace floc {
namespace {

using testing::ElementsAre;

std::vector<std::string> labels_of(const Campaign& campaign) {
  std::vector<std::string> labels;
  for (const CampaignCase& one : campaign.cases) labels.push_back(one.label);
  return labels;
}

TEST(CampaignCases, OfAGridAreAllCombinationsTheLastAxisFirst) {
  Campaign campaign;
  set_cases({{"contact.friction.coefficient", {"0.3", "0.5"}, ""}, {"grains.count", {"20", "40"}, ""}}, {}, "",
            campaign);
  EXPECT_THAT(labels_of(campaign), ElementsAre("coefficient=0.3_count=20", "coefficient=0.3_count=40",
                                               "coefficient=0.5_count=20", "coefficient=0.5_count=40"));
  EXPECT_THAT(campaign.keys, ElementsAre("contact.friction.coefficient", "grains.count"));
  EXPECT_EQ(value_of(campaign.cases[2], "contact.friction.coefficient"), "0.5");
  EXPECT_EQ(value_of(campaign.cases[2], "grains.count"), "20");
}

TEST(CampaignCases, HaveKeysAsLongAsItTakesToTellThemApart) {
  Campaign campaign;
  set_cases({{"contact.friction.coefficient", {"0.3"}, ""}, {"contact.rolling.coefficient", {"0"}, ""}}, {}, "",
            campaign);
  EXPECT_THAT(labels_of(campaign), ElementsAre("friction.coefficient=0.3_rolling.coefficient=0"));
}

TEST(CampaignCases, ListedAreCombinedWithTheGridAndKeepTheirNames) {
  Campaign campaign;
  set_cases({{"grains.count", {"20", "40"}, ""}},
            {{"soft ones", {{"contact.normal.stiffness", "1e4", ""}}, ""}, {"", {{"run.seed", "7", ""}}, ""}},
            "", campaign);
  EXPECT_THAT(labels_of(campaign),
              ElementsAre("soft-ones_count=20", "soft-ones_count=40", "seed=7_count=20", "seed=7_count=40"));
  EXPECT_THAT(campaign.keys, ElementsAre("contact.normal.stiffness", "run.seed", "grains.count"));
}

TEST(CampaignCases, HaveDirectoriesOfTheirOwn) {
  Campaign campaign;
  set_cases({{"a.file", {"'x/y'", "'x y'", "'../z'"}, ""}}, {}, "", campaign);
  EXPECT_THAT(labels_of(campaign), ElementsAre("file=x-y", "file=x-y-2", "file=-z"));
}

TEST(CampaignCases, WithoutChangesAreTheSceneItself) {
  Campaign campaign;
  set_cases({}, {}, "here", campaign);
  EXPECT_THAT(labels_of(campaign), ElementsAre("base"));
}

}  // namespace
}  // namespace floc
