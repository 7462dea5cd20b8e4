#include "floc/campaign/campaign_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/base/read_text.h"
#include "floc/campaign/campaign_cases.h"
#include "support/places.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

/// Campaign with the shipped oedometer scene, in which the stress on axis 2 increases to P* = 13.33.
Campaign oedometer() {
  Campaign campaign;
  campaign.scene_file = source_directory() + "/data/scenes/oedometer.toml";
  campaign.scene = read_text(campaign.scene_file);
  campaign.seeds = {1};
  set_cases({}, {}, "here", campaign);
  return campaign;
}

StateChoice at_pressure(double P_star, bool is_driven) {
  StateChoice choice;
  choice.kind = StateChoice::pressures;
  choice.branch = "load";
  choice.P_star = {P_star};
  choice.is_driven = is_driven;
  choice.place = "c.toml:7";
  return choice;
}

TEST(CampaignPlan, StatesOfAnOedometerAreChosenByTheStressOnTheDrivenAxis) {
  const Campaign campaign = oedometer();
  const CasePlan plan = plan_cases(campaign).front();
  const std::vector<int> chosen = chosen_states(at_pressure(13.33, true), campaign.cases[0], plan);
  ASSERT_EQ(chosen.size(), 1u);
  const auto number = static_cast<std::size_t>(chosen[0]);
  EXPECT_NEAR(*plan.states[number].P_driven_star, 13.33, 1e-12);
  EXPECT_FALSE(plan.states[number].P_star.has_value());
  // The path has eight steps per decade, so eight steps earlier the stress is ten times smaller.
  EXPECT_NEAR(*plan.states[number - 8].P_driven_star, 1.333, 0.15);
  // Under isotropic pressure the stress on the driven axis equals the pressure.
  EXPECT_EQ(plan.states[1].P_star, plan.states[1].P_driven_star);
}

TEST(CampaignPlan, PressuresThatNoStateIsKnownToHaveAreRefused) {
  const Campaign campaign = oedometer();
  const CasePlan plan = plan_cases(campaign).front();
  EXPECT_THAT([&] { (void)chosen_states(at_pressure(20.0, true), campaign.cases[0], plan); },
              testing::ThrowsMessage<InputError>(HasSubstr(
                  "c.toml:7: P_driven_star = 20: expected one of the pressures that case base reaches")));
  EXPECT_THAT(
      [&] { (void)chosen_states(at_pressure(13.33, false), campaign.cases[0], plan); },
      testing::ThrowsMessage<InputError>(HasSubstr("P_driven_star selects by the stress on the driven axis")));
}

}  // namespace
}  // namespace floc::test
