#include "floc/loading/run_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/contact/law_parameters.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"

namespace floc {
namespace {

using testing::HasSubstr;

AssemblyOptions assembly(AssemblyOptions::Protocol protocol) {
  AssemblyOptions a;
  a.protocol = protocol;
  a.pressure = 0.01;
  return a;
}

LoadStage hold(double at, const std::string& key, double value) {
  LoadStage stage;
  stage.name = "hold";
  stage.to = at;
  stage.set = {{key, value}};
  return stage;
}

TEST(PlanRun, WithoutLoadIsTheAssemblyAlone) {
  using Protocol = AssemblyOptions::Protocol;
  const auto direct = plan_run(assembly(Protocol::direct), test::cohesive_law(), {}, 2);
  ASSERT_EQ(direct.size(), 1u);
  EXPECT_EQ(direct[0].pressure, 0.01);
  const auto aggregation = plan_run(assembly(Protocol::aggregation), test::cohesive_law(), {}, 2);
  ASSERT_EQ(aggregation.size(), 2u);
  EXPECT_EQ(aggregation[0].pressure, 0.0);
  EXPECT_EQ(aggregation[1].pressure, 0.01);
  EXPECT_EQ(aggregation[1].branch, "assembly");
}

TEST(PlanRun, ChangesOfATurnHoldFromThereOn) {
  LoadStage up;
  up.name = "load";
  up.to = 1.0;
  up.steps = 2;
  const auto plan = plan_run(assembly(AssemblyOptions::Protocol::direct), test::cohesive_law(),
                             {hold(0.01, "adhesion.force", 0.0), up}, 2);
  ASSERT_EQ(plan.size(), 4u);
  EXPECT_EQ(plan[0].law, test::cohesive_law());
  for (int k = 1; k < 4; ++k) EXPECT_EQ(plan[k].law.pull_off_force(), 0.0) << k;
  EXPECT_EQ(plan[1].pressure, 0.01);
  EXPECT_EQ(plan[3].branch, "load");
}

TEST(PlanRun, RefusesChangesThatTheLawHasNoPlaceFor) {
  const AssemblyOptions direct = assembly(AssemblyOptions::Protocol::direct);
  Law law = test::cohesive_law();
  law += test::without("rolling");
  EXPECT_THAT(
      [&] { (void)plan_run(direct, law, {hold(0.01, "rolling.coefficient", 0.1)}, 2); },
      testing::ThrowsMessage<InputError>(HasSubstr("rolling.coefficient = 0.1: the contact law of the scene")));
  EXPECT_THAT(
      [&] { (void)plan_run(direct, law, {hold(0.01, "friction.stiffness", -1.0)}, 2); },
      testing::ThrowsMessage<InputError>(HasSubstr("contact.friction.stiffness = -1: must be positive")));
}

/// Returns a stage that drives the last axis while the other axes keep their length.
LoadStage oedometric(int n_axes) {
  LoadStage stage;
  stage.name = "load";
  stage.control = "oedometric";
  stage.axis = n_axes - 1;
  stage.axes.assign(static_cast<std::size_t>(n_axes), {AxisLoad::strain, 0.0});
  stage.axes.back() = {AxisLoad::stress, 1.0};
  stage.steps = 2;
  return stage;
}

TEST(PlanRun, TakesAsManyAxesAsTheSceneHasAndRefusesOthers) {
  const AssemblyOptions direct = assembly(AssemblyOptions::Protocol::direct);
  const Law law = test::cohesive_law();
  for (const int dimension : {2, 3})
    for (const int n_axes : {1, 2, 3, 4}) {
      if (n_axes == dimension) {
        const auto plan = plan_run(direct, law, {oedometric(n_axes), oedometric(n_axes)}, dimension);
        ASSERT_EQ(plan.size(), 5u);
        EXPECT_EQ(plan.back().axes.size(), static_cast<std::size_t>(dimension));
        continue;
      }
      EXPECT_THAT([&] { (void)plan_run(direct, law, {oedometric(n_axes)}, dimension); },
                  testing::ThrowsMessage<InputError>(HasSubstr("the stage \"load\" has loads for")))
          << n_axes << " in " << dimension;
    }
  LoadStage across = oedometric(2);
  across.axis = 2;
  EXPECT_THAT([&] { (void)plan_run(direct, law, {across}, 2); },
              testing::ThrowsMessage<InputError>(HasSubstr("drives axis 3: expected an axis from 1 to 2")));
}

TEST(PlanRun, RefusesEquilibriumWithoutPressureAndAdhesion) {
  EXPECT_THAT(
      [] {
        (void)plan_run(assembly(AssemblyOptions::Protocol::direct), test::cohesive_law(),
                       {hold(0.0, "adhesion.force", 0.0)}, 2);
      },
      testing::ThrowsMessage<InputError>(
          HasSubstr("the stage \"hold\" requires an equilibrium at zero pressure")));
}

TEST(LawNumber, IsFoundForEveryKeyOfAFullLaw) {
  LawParameters law = test::cohesive_law();
  for (const char* key :
       {"normal.stiffness", "adhesion.force", "adhesion.range", "damping.restitution", "friction.coefficient",
        "friction.stiffness", "rolling.coefficient", "rolling.stiffness"}) {
    double* const number = law_number(law, key);
    ASSERT_NE(number, nullptr) << key;
    const LawParameters before = law;
    *number *= 0.5;
    EXPECT_NE(law, before) << key;
  }
  EXPECT_EQ(law_number(law, "friction"), nullptr);
  EXPECT_EQ(test::law_number(law, "rolling.stiffness"), 5.0);
}

}  // namespace
}  // namespace floc
