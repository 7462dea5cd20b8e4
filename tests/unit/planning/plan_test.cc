#include "floc/planning/plan.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "floc/base/error.h"
#include "floc/fitting/student_t.h"
#include "floc/planning/pilot.h"
#include "floc/planning/plan_file.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_prices.h"
#include "floc/scene/scene_softening.h"
#include "support/message_of.h"
#include "support/places.h"

namespace floc {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Exponent of the processor times in prices(): they are proportional to N^kExponent for N grains.
constexpr double kExponent = 1.25;

/// Price table with simple numbers. A sample of 100 grains and 10 states takes 2 s with the settings of the scene. The
/// settings "fast" are four times cheaper and have an error of 1e-3 in phi. The scatter between samples is 0.02 for phi
/// and 0.1 for B. With 25 grains, the finite size changes phi by 0.02 and B by 0.4.
PriceTable prices() {
  std::string csv =
      "knob,value,observable,cost_ratio,core_seconds,error_before_high,error_after_high,mean_difference,mean_"
      "stderr,"
      "mean_error95,n_grains,n_samples,tolerance,time_step,finish,patience,kappa,sample_scatter,n_states,"
      "unit\n";
  const auto add = [&](const char* knob, const char* value, double seconds, int n, double step, double phi,
                       double b, double phi_mean, double b_mean, double stderr_phi, double stderr_b) {
    const auto row = [&](const char* name, double error, double mean, double stderr_of, double scatter) {
      csv += fmt::format("{},{},{},{},{},{},,{},{},{},{},9,1e-5,{},auto,1,1e5,{},10,1\n", knob, value, name,
                         seconds / 8.0, seconds, error, mean, stderr_of, 2.0 * stderr_of, n, step, scatter);
    };
    row("phi", phi, phi_mean, stderr_phi, 0.02);
    row("B", b, b_mean, stderr_b, 0.1);
  };
  add("strict", "all", 8.0, 100, 0.07, 0, 0, 0, 0, 0, 0);
  add("scene", "as it is", 2.0, 100, 0.36, 1e-5, 1e-4, 1e-4, 1e-3, 1e-3, 1e-2);
  add("patience", "fast", 0.5, 100, 0.3, 1e-3, 2e-4, 0, 0, 1e-3, 1e-2);
  add("count", "25", 2.0 * std::pow(0.25, kExponent), 25, 0.36, 0, 0, 0.02, 0.4, 1e-6, 1e-6);
  return read_price_table(csv, "prices.csv");
}

Scene scene(const std::vector<std::string>& changes = {}) {
  return read_scene(test::source_directory() + "/data/scenes/demo.toml", changes);
}

/// Returns a scene with ten equilibria (2 in the assembly, 8 in the loading), which is the number of states in the
/// samples of prices().
Scene scene_of_ten_states() {
  return scene({"assembly.pressure=0.01", "load.0.to=1", "load.0.steps_per_decade=3", "load.1.to=0.01",
                "load.1.steps_per_decade=1"});
}

class Plans : public testing::Test {
 protected:
  const Scene scene_ = scene_of_ten_states();
  const PriceModel model_{scene_, prices()};

  const PricedSettings& settings(const std::string& name) const {
    return *std::find_if(model_.settings().begin(), model_.settings().end(),
                         [&](const PricedSettings& s) { return s.name() == name; });
  }
  std::string refusal(const PlanRequest& request) const {
    return test::message_of([&] { (void)choose_plans(model_, request, 3); });
  }
};

TEST_F(Plans, PricesFollowTheLawsOfTheModel) {
  const ObservablePrice& phi = model_.observable("phi", "");
  const PricedSettings& plain = settings("scene as it is");
  EXPECT_NEAR(model_.core_seconds(plain, 100), 2.0, 1e-12);
  EXPECT_NEAR(model_.core_seconds(plain, 400), 2.0 * std::pow(4.0, kExponent), 1e-6);
  const PricedError one = model_.error(phi, plain, 100, 1), many = model_.error(phi, plain, 400, 16);
  EXPECT_NEAR(one.scatter, student_t_95(8) * 0.02, 1e-12);
  EXPECT_NEAR(many.scatter, one.scatter / 8.0, 1e-12) << "sqrt(4 x 16) as small";
  // The error due to finite size is c/N for N grains, where c follows from 0.02 = c (1/25 - 1/100). For 100 grains,
  // this error is 0.02/3.
  EXPECT_NEAR(one.size, 0.02 / 3.0, 1e-6);
  EXPECT_NEAR(many.size, one.size / 4.0, 1e-12);
  // The difference of the two means is within its statistical error, so only the error of single states counts.
  EXPECT_DOUBLE_EQ(one.settings, 1e-5);
}

TEST_F(Plans, MoreStatesAndOtherRangesOfStepsCostAccordingly) {
  const PricedSettings& plain = settings("scene as it is");
  const PriceModel longer(
      scene({"load.0.to=1", "load.0.steps_per_decade=8", "load.1.to=0.01", "load.1.steps_per_decade=2"}),
      prices());
  // The path has 22 states instead of 10. Each of the additional states takes only 0.3 times as long as each of the
  // first 10 states.
  EXPECT_NEAR(longer.core_seconds(plain, 100) / model_.core_seconds(plain, 100),
              1.0 + 0.3 * (22.0 / 10.0 - 1.0), 1e-9);
}

/// Cost and errors of a plan, computed by the formulas of the documentation from the numbers of the table.
struct ByHand {
  double seconds, phi, b;
};
ByHand by_hand(bool fast, int n_grains, int n_samples) {
  const double t = student_t_95(8), root = std::sqrt(100.0 / n_grains / n_samples);
  return {(fast ? 0.5 : 2.0) * std::pow(n_grains / 100.0, kExponent),
          (fast ? 1e-3 : 1e-5) + 0.02 / 0.03 / n_grains + t * 0.02 * root,
          (fast ? 2e-4 : 1e-4) + 0.4 / 0.03 / n_grains + t * 0.1 * root};
}

TEST_F(Plans, TheBestInABudgetIsThatOfAllCombinations) {
  for (const double budget : {10.0, 60.0, 1800.0})
    for (const int cores : {1, 3}) {
      double best = std::numeric_limits<double>::infinity();
      for (const bool fast : {false, true})
        for (const int n_grains : numbers_of_grains(model_))
          for (int n = kLeastSamples; n <= kMostSamples; ++n) {
            const ByHand one = by_hand(fast, n_grains, n);
            if (std::ceil(static_cast<double>(n) / cores) * one.seconds > budget * (1 + 1e-12)) break;
            best = std::min(best, 0.5 * (std::log(one.phi) + std::log(one.b)));
          }
      PlanRequest request;
      request.budget = budget;
      request.cores = cores;
      const Plan plan = choose_plans(model_, request, 1).plans.front();
      EXPECT_LE(plan.wall_seconds, budget * (1 + 1e-11));
      EXPECT_NEAR(0.5 * (std::log(plan.errors[0].total()) + std::log(plan.errors[1].total())), best, 1e-5)
          << budget << " s on " << cores;
    }
}

TEST_F(Plans, TheCheapestThatKeepsWantsIsThatOfAllCombinations) {
  for (const auto& [phi, b] : {std::pair(0.02, 0.3), std::pair(0.004, 0.05), std::pair(1.5e-3, 1.0)}) {
    double best = std::numeric_limits<double>::infinity();
    for (const bool fast : {false, true})
      for (const int n_grains : numbers_of_grains(model_))
        for (int n = kLeastSamples; n <= kMostSamples; ++n) {
          const ByHand one = by_hand(fast, n_grains, n);
          if (one.phi > phi || one.b > b) continue;
          best = std::min(best, n * one.seconds);
          break;
        }
    PlanRequest request;
    request.wants = {{"phi", phi}, {"B", b}};
    const Plan plan = choose_plans(model_, request, 1).plans.front();
    EXPECT_LE(plan.errors[0].total(), phi);
    EXPECT_LE(plan.errors[1].total(), b);
    EXPECT_NEAR(plan.core_seconds / best, 1.0, 1e-3) << phi << ", " << b;
  }
}

/// With several cores, the plan with the least processor time may take longer than the budget while another plan with
/// the same errors fits into it.
TEST_F(Plans, ErrorsThatABudgetGivesAreGrantedWithinIt) {
  for (const double budget : {1.0, 10.0, 60.0, 1800.0})
    for (const int cores : {1, 3, 8, 64, 1024}) {
      SCOPED_TRACE(testing::Message() << budget << " s on " << cores << " cores");
      PlanRequest request;
      request.budget = budget;
      request.cores = cores;
      request.observables = {"phi"};
      const double error = choose_plans(model_, request, 1).plans.front().errors.front().total();
      request.observables = {};
      request.wants = {{"phi", error * (1.0 + 1e-9)}};
      const Plan plan = choose_plans(model_, request, 1).plans.front();
      EXPECT_LE(plan.wall_seconds, budget * (1.0 + 1e-11));
      EXPECT_LE(plan.errors.front().total(), error * (1.0 + 1e-9));
    }
}

TEST_F(Plans, AreSortedAndEachHasOtherSettings) {
  PlanRequest request;
  request.budget = 100.0;
  const PlanChoice choice = choose_plans(model_, request, 3);
  ASSERT_EQ(choice.plans.size(), 2u) << "the reference is no choice";
  EXPECT_NE(choice.plans[0].settings.name(), choice.plans[1].settings.name());
}

TEST_F(Plans, MoreBudgetNeverGivesLargerErrors) {
  double before = std::numeric_limits<double>::infinity();
  for (double budget = 1.0; budget < 1e12; budget *= 10.0) {
    PlanRequest request;
    request.budget = budget;
    request.observables = {"phi"};
    const double error = choose_plans(model_, request, 1).plans.front().errors.front().total();
    EXPECT_LE(error, before * (1 + 1e-12)) << budget;
    before = error;
  }
}

TEST_F(Plans, WhatCannotBeHadIsRefusedWithTheNearestThatCan) {
  PlanRequest tiny;
  tiny.budget = 0.05;
  EXPECT_THAT(refusal(tiny),
              AllOf(HasSubstr("--budget 0.05 s"),
                    HasSubstr("a single sample of the smallest size, 25 grains, takes 0.0888 s")));
  PlanRequest below;
  below.wants = {{"phi", 1e-6}};
  EXPECT_THAT(refusal(below), HasSubstr("phi=1e-06: expected at least "));
  PlanRequest none;
  none.wants = {{"K0", 0.1}};
  EXPECT_THAT(refusal(none),
              HasSubstr("K0 is not a quantity of this scene that the table prices.csv contains: expected one "
                        "of phi, B; the nearest is "));
  PlanRequest dear;
  dear.wants = {{"phi", 2e-3}};
  dear.budget = 5.0;
  EXPECT_THAT(refusal(dear), AllOf(HasSubstr("the requested errors take "),
                                   HasSubstr("; the nearest errors that the budget allows are phi=0.0")));
  // The message names the smallest error that is possible. A request for this error must be accepted.
  const std::string words = refusal(below);
  const std::size_t at = words.find("at least ") + 9;
  below.wants = {{"phi", std::stod(words.substr(at))}};
  EXPECT_EQ(refusal(below), "");
}

/// Returns the wants "NAME=ERROR,..." at the end of a message.
std::vector<std::pair<std::string, double>> wants_in(const std::string& message) {
  std::vector<std::pair<std::string, double>> wants;
  std::istringstream text(message.substr(message.find(" are ") + 5));
  for (std::string one; std::getline(text, one, ',');)
    wants.emplace_back(one.substr(0, one.find('=')), std::stod(one.substr(one.find('=') + 1)));
  return wants;
}

TEST_F(Plans, TheNearestErrorsOfAMessageAreGranted) {
  int n_refused = 0;
  for (const double budget : {0.2, 0.7, 2.0, 5.0, 9.0, 20.0, 100.0, 1e3})
    for (const double phi : {1.5e-3, 3e-3, 0.01, 0.03})
      for (const double b : {0.0, 0.02, 0.2}) {
        PlanRequest request;
        request.budget = budget;
        request.wants = {{"phi", phi}};
        if (b > 0.0) request.wants.emplace_back("B", b);
        const std::string words = refusal(request);
        if (words.empty()) continue;
        SCOPED_TRACE(words);
        ASSERT_THAT(words, HasSubstr("nearest errors that "));
        ++n_refused;
        request.wants = wants_in(words);
        EXPECT_EQ(refusal(request), "");
      }
  EXPECT_GT(n_refused, 20);
}

/// Where the table knows one number of grains alone, nothing is known about the error of small samples.
TEST_F(Plans, KeepTheNumberOfGrainsWhereTheErrorOfTheSizeIsNotKnown) {
  PriceTable table = prices();
  std::erase_if(table.rows, [](const PriceRow& row) { return row.parameter == "count"; });
  const PriceModel model(scene_, table);
  EXPECT_FALSE(model.knows_size_errors());
  EXPECT_TRUE(model_.knows_size_errors());
  PlanRequest request;
  request.budget = 1e4;
  for (const Plan& plan : choose_plans(model, request, 3).plans) EXPECT_GE(plan.n_grains, scene_.grains.count);
}

/// The rows of prices() have intervals of +- 2 standard errors.
TEST_F(Plans, TheTableTellsHowExactlyItKnowsADifference) {
  EXPECT_DOUBLE_EQ(model_.unknown_difference(model_.observable("phi", ""), settings("patience fast")), 2e-3);
  EXPECT_DOUBLE_EQ(model_.unknown_difference(model_.observable("B", ""), settings("scene as it is")), 2e-2);
}

TEST_F(Plans, FilesNameTheNumberOfCores) {
  PlanRequest request;
  request.budget = 100.0;
  request.cores = 7;
  const PlanChoice choice = choose_plans(model_, request, 1);
  const PlanSource source{test::source_directory() + "/data/scenes/demo.toml", {}, "prices.csv", request.cores};
  EXPECT_THAT(plan_file(choice.plans.front(), choice.observables, scene_, source, "p.toml"),
              HasSubstr("cd p && snakemake --cores 7\n"));
}

TEST_F(Plans, WantsAreNamesOfObservablesOrKeysOfAccuracy) {
  const std::vector<std::string> names = {"phi", "B", "G", "z_plus"};
  const auto wants = wants_of({"phi=0.01", "moduli=0.1", "z=0.2"}, names);
  EXPECT_THAT(wants, testing::ElementsAre(std::pair("phi", 0.01), std::pair("B", 0.1), std::pair("G", 0.1),
                                          std::pair("z_plus", 0.2)));
  for (const char* bad : {"phi", "phi=", "phi=-1", "phi=0", "phi=nan", "phi=inf", "=1", "psi=1", "lambda=0.1"})
    EXPECT_THROW((void)wants_of({bad}, names), InputError) << bad;
  EXPECT_THROW((void)wants_of({"phi=1", "phi=2"}, names), InputError);
}

/// The table of prices() with additional rows for softer springs. With these springs, a sample takes half of the time.
PriceTable soft_prices() {
  PriceTable table = prices();
  for (const char* name : {"phi", "B"}) {
    PriceRow row = *table.find("scene", "as it is", name);
    row.parameter = "softening";
    row.value = "10";
    row.settings.softening = {10.0, 10.0};
    row.core_seconds *= 0.5;
    row.cost_ratio *= 0.5;
    table.rows.push_back(row);
  }
  return table;
}

TEST(PriceModelOfAScene, CostsAsMuchAsItsSofteningSays) {
  const auto seconds = [](const std::optional<PriceTable>& table, std::vector<std::string> changes) {
    for (const char* fixed : {"assembly.pressure=0.01", "load.0.to=1", "load.0.steps_per_decade=3",
                              "load.1.to=0.01", "load.1.steps_per_decade=1"})
      changes.push_back(fixed);
    const Scene soft = scene(changes);
    const PriceModel model(soft, table);
    return model.core_seconds(model.settings_of_scene(), 100);
  };
  EXPECT_NEAR(seconds(prices(), {}), 2.0, 1e-12);
  // If the table has no row for softening, 0.7 of the time is proportional to 1/sqrt(softening).
  const double tenth = 0.3 + 0.7 / std::sqrt(10.0);
  EXPECT_NEAR(seconds(prices(), {"equilibrium.softening=10"}), 2.0 * tenth, 1e-9);
  EXPECT_NEAR(seconds(prices(), {"assembly.softening=10"}), 2.0 * (0.57 * tenth + 0.43), 1e-9);
  // If the table has a row for a softening, the time in this row is used. For smaller softenings, the time is
  // interpolated by a power law.
  EXPECT_NEAR(seconds(soft_prices(), {"equilibrium.softening=10"}), 1.0, 1e-9);
  EXPECT_NEAR(seconds(soft_prices(), {"load.0.softening=10", "load.1.softening=10"}), 2.0 * (0.57 + 0.43 * 0.5),
              1e-9);
  EXPECT_NEAR(seconds(soft_prices(), {"equilibrium.softening=3.1622776601683795"}), std::sqrt(2.0), 1e-9);
}

TEST(PriceModelOfAScene, CostsAsMuchAsItsMassesSay) {
  const auto seconds = [](const std::optional<PriceTable>& table, const std::string& masses) {
    const Scene here = scene(
        {"grains.diameter={distribution=\"uniform\", min=0.25, max=1.0}", "equilibrium.masses=" + masses});
    const PriceModel model(here, table);
    return model.core_seconds(model.settings_of_scene(), 100);
  };
  // If the table has no row for masses, 0.7 of the time is proportional to the root of the smallest mass.
  EXPECT_NEAR(seconds(prices(), "equal") / seconds(prices(), "own"), 0.3 + 0.7 * 0.25, 1e-9);
  PriceTable table = prices();
  for (const char* name : {"phi", "B"}) {
    PriceRow row = *table.find("scene", "as it is", name);
    row.parameter = "masses";
    row.value = "equal";
    row.settings.equal_masses = true;
    row.core_seconds *= 0.4;
    table.rows.push_back(row);
  }
  EXPECT_NEAR(seconds(table, "equal") / seconds(table, "own"), 0.4, 1e-9);
}

/// The errors of z_plus and z_minus in tables are relative to their sum. Those of plans are relative to their means, as
/// the scatter between samples is.
TEST(PriceModelOfAScene, ErrorsOfCoordinationNumbersAreRelativeToTheirMeans) {
  PriceTable table = prices();
  const std::vector<PriceRow> rows = table.rows;
  for (const auto& [name, mean] : {std::pair("z_plus", 3.0), std::pair("z_minus", 1.0)})
    for (PriceRow row : rows) {
      if (row.observable != "phi") continue;
      row.observable = name;
      row.reference_value = mean;
      table.rows.push_back(row);
    }
  const Scene here = scene();
  const PriceModel model(here, table);
  const PricedSettings fast = *std::ranges::find(model.settings(), "patience", &PricedSettings::parameter);
  const auto error = [&](const char* name) { return model.error(model.observable(name, ""), fast, 50, 4); };
  for (const auto& [name, factor] : {std::pair("z_plus", 4.0 / 3.0), std::pair("z_minus", 4.0)}) {
    EXPECT_NEAR(error(name).settings / error("phi").settings, factor, 1e-12) << name;
    EXPECT_NEAR(error(name).size / error("phi").size, factor, 1e-12) << name;
    EXPECT_EQ(error(name).scatter, error("phi").scatter) << name;
  }
}

/// The number of time steps is proportional to the root of the stiffness.
TEST(PriceModelOfAScene, CostsTheRootOfTheStiffness) {
  const auto seconds = [](const std::string& stiffness) {
    const Scene here =
        scene({"contact.normal.stiffness=" + stiffness, "contact.friction.stiffness=" + stiffness});
    const PriceModel model(here, prices());
    return model.core_seconds(model.settings_of_scene(), 100);
  };
  EXPECT_NEAR(seconds("1e6") / seconds("1e5"), std::sqrt(10.0), 1e-9);
  EXPECT_NEAR(seconds("1e4") / seconds("1e5"), std::sqrt(0.1), 1e-9);
}

TEST(ChangesOfAScene, GiveItTheSofteningOfThePlan) {
  const auto softened = [](const Scene& from, const Softening& softening) {
    PricedSettings settings;
    settings.parameter = "softening";
    settings.settings = settings_of(from);
    settings.settings.softening = softening;
    return changes_of(settings, from);
  };
  EXPECT_THAT(softened(scene(), {10.0, 10.0}),
              testing::IsSupersetOf({"equilibrium.softening=10", "assembly.softening=10"}));
  EXPECT_THAT(softened(scene(), {10.0, 1.0}),
              testing::IsSupersetOf({"equilibrium.softening=1", "assembly.softening=10"}));
  EXPECT_THAT(softened(scene(), {}), testing::Each(Not(HasSubstr("softening"))));
  // If a stage sets a softening of its own, changes_of() replaces it too. The changes are also valid for scenes with
  // stages that impose a strain.
  EXPECT_THAT(softened(scene({"load.1.softening=3"}), {}), testing::Contains("load.1.softening=1"));
  const Scene oedometer = read_scene(test::source_directory() + "/data/scenes/oedometer.toml", {});
  const std::vector<std::string> changes = softened(oedometer, {2.0, 2.0});
  EXPECT_NO_THROW((void)read_scene(test::source_directory() + "/data/scenes/oedometer.toml", changes));
}

TEST(ChangesOfAScene, GiveItTheMassesOfThePlan) {
  const auto changes = [](const Scene& from, bool equal) {
    PricedSettings settings;
    settings.parameter = "masses";
    settings.settings = settings_of(from);
    settings.settings.equal_masses = equal;
    return changes_of(settings, from);
  };
  EXPECT_THAT(changes(scene(), true), testing::Contains("equilibrium.masses=equal"));
  EXPECT_THAT(changes(scene(), false), testing::Each(Not(HasSubstr("masses"))));
  EXPECT_THAT(changes(scene({"equilibrium.masses=equal"}), false), testing::Contains("equilibrium.masses=own"));
}

TEST(ChangesOfAScene, GiveAllItsPartsTheTimeStepOfThePlan) {
  const auto changes = [](const Scene& from) {
    PricedSettings settings;
    settings.parameter = "time_step";
    settings.settings = settings_of(from);
    settings.settings.time_step = 0.2;
    return changes_of(settings, from);
  };
  EXPECT_THAT(changes(scene()),
              testing::AllOf(testing::Contains("run.time_step=0.2"),
                             testing::Not(testing::Contains(HasSubstr("assembly.time_step")))));
  EXPECT_THAT(changes(scene({"assembly.time_step=0.3", "load.1.time_step=0.1"})),
              testing::IsSupersetOf({"run.time_step=0.2", "assembly.time_step=0.2", "load.1.time_step=0.2"}));
}

TEST(PriceModelOfAScene, KeepsTheNumberOfListedGrains) {
  const Scene listed =
      scene({"grains.count=3", "grains.diameter={distribution=\"list\", values=[0.5, 0.7, 1.0]}"});
  const PriceModel model(listed, prices());
  EXPECT_EQ(model.least_grains(), 3);
  EXPECT_EQ(model.most_grains(), 3);
}

TEST(PriceModelOfAScene, TakesCostAndScatterFromAPilotAndSettingsFromTheTable) {
  const Scene here = scene_of_ten_states();
  const PilotResult pilot{50, 20, 3.0, 1.5, {{"phi", "", 0.04, 19, std::nullopt}}};
  const PriceModel both(here, prices(), pilot), alone(here, std::nullopt, pilot);
  for (const PriceModel* model : {&both, &alone})
    EXPECT_NEAR(model->core_seconds(model->settings_of_scene(), 50), 3.0, 1e-9);
  EXPECT_NEAR(both.core_seconds(both.settings_of_scene(), 200), 3.0 * std::pow(4.0, kExponent), 1e-5)
      << "the exponent of the table";
  EXPECT_NEAR(alone.core_seconds(alone.settings_of_scene(), 200), 24.0, 1e-9);
  EXPECT_NEAR(alone.error(alone.observable("phi", ""), alone.settings_of_scene(), 50, 1).scatter,
              student_t_95(19) * 0.04, 1e-12);
  // The two scatters are combined: 0.04 with 19 degrees of freedom at 50 grains, and 0.02 with 8 degrees of
  // freedom at 100 grains.
  EXPECT_NEAR(both.error(both.observable("phi", ""), both.settings_of_scene(), 100, 1).scatter,
              student_t_95(27) * std::sqrt((19 * 0.04 * 0.04 / 2.0 + 8 * 0.02 * 0.02) / 27.0), 1e-12);
  EXPECT_GT(both.error(both.observable("phi", ""), both.settings_of_scene(), 50, 1).settings, 0.0);
  EXPECT_EQ(alone.error(alone.observable("phi", ""), alone.settings_of_scene(), 50, 1).settings, 0.0);
}

TEST(PriceModelOfAScene, TakesTheExponentFromWhicheverHasTheLargerSamples) {
  const Scene here = scene_of_ten_states();
  PilotResult pilot{50, 20, 3.0, 1.5, {}};
  for (const auto& [largest_grains, exponent] : {std::pair{99, kExponent}, {100, kExponent}, {101, 1.5}}) {
    pilot.largest_grains = largest_grains;
    const PriceModel model(here, prices(), pilot);
    EXPECT_NEAR(model.core_seconds(model.settings_of_scene(), 50), 3.0, 1e-9);
    EXPECT_NEAR(model.core_seconds(model.settings_of_scene(), 200), 3.0 * std::pow(4.0, exponent), 1e-5)
        << largest_grains << " grains in the pilot, 100 in the table";
  }
}

/// Settings with loose sweeps are cheap or have small errors in the shipped tables, and are left out all the same.
TEST(PriceModelOfAScene, LeavesOutLooseSweeps) {
  for (const char* name : {"polyhedra_demo", "rigid_disks_demo", "pentagons_demo"}) {
    const Scene here = read_scene(test::source_directory() + "/data/scenes/" + name + ".toml");
    const PriceModel model(here, prices_of(here, "").table);
    std::vector<std::string> names;
    for (const PricedSettings& settings : model.settings()) names.push_back(settings.name());
    EXPECT_THAT(names, testing::IsSupersetOf({"scene as it is", "sweep_tolerance 1e-04", "together careful"}))
        << name;
    for (const char* loose :
         {"sweep_tolerance 1e-01", "sweep_tolerance 1e-02", "together coarse", "together medium"})
      EXPECT_THAT(names, Not(testing::Contains(loose))) << name;
  }
}

/// A pilot that clearly takes longer than its limit is refused before anything is run, and the message names a budget.
TEST(Pilot, IsRefusedBeforeAnythingIsRun) {
  const Scene long_path = scene({"grains.count=200", "load.0.steps_per_decade=1000"});
  const auto start = std::chrono::steady_clock::now();
  std::string message;
  try {
    (void)run_pilot(long_path, 8.0);
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, AllOf(HasSubstr("--pilot: the samples of 200 grains would not be complete within 8 s"),
                             HasSubstr("expected a --budget of at least ")));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(4)) << "half of the limit";
}

TEST(Pilot, MeasuresTheExponentOnAsManyGrainsAsItsTimeAllows) {
  const Scene here = scene({"grains.count=20", "load.0.steps_per_decade=1", "load.1.steps_per_decade=1"});
  const PilotResult pilot = run_pilot(here, 8.0);
  EXPECT_EQ(pilot.n_grains, 20);
  EXPECT_GE(pilot.largest_grains, 40);
  EXPECT_LE(pilot.largest_grains, 400);
  EXPECT_GE(pilot.cost_exponent, 0.8);
  EXPECT_LE(pilot.cost_exponent, 2.0);
}

}  // namespace
}  // namespace floc
