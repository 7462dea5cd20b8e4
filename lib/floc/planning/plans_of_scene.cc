#include "floc/planning/plans_of_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "floc/base/error.h"
#include "floc/planning/duration.h"
#include "floc/planning/pilot.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_prices.h"

namespace floc {
namespace {

/// Number of plans that floc plan lists.
constexpr int kPlans = 3;
/// Largest processor time of a pilot (s) if no budget is given.
constexpr double kPilotSeconds = 600.0;
/// If the ratio of the number of grains of a plan to the number of grains in the table exceeds this value, a remark
/// says that prices are extrapolated.
constexpr double kFarExtrapolation = 10.0;
constexpr double kSecondsPerHour = 3600.0;

PlanRequest request_of(const PlanWishes& wishes) {
  require_in_range("cores", wishes.cores, PlanRequest::kCores);
  PlanRequest request;
  request.cores = wishes.cores;
  request.observables = wishes.observables;
  if (!wishes.budget.empty()) request.budget = duration_of("--budget", wishes.budget);
  if (!request.budget && wishes.wants.empty())
    throw InputError("floc plan",
                     "expected --budget (time that may be spent) or --want (errors that are wanted)");
  return request;
}

Scene plannable_scene(const PlanWishes& wishes) {
  Scene scene = read_scene(wishes.scene, wishes.overrides);
  if (!scene.accuracy.empty())
    throw InputError(wishes.scene,
                     "floc plan chooses the numerical settings itself: remove the table [accuracy]");
  if (scene.starts_from_state())
    throw InputError(
        wishes.scene,
        "assembly.protocol = \"state\": a plan chooses the number of grains, which requires a gas in place of "
        "a saved state: expected \"direct\" or \"aggregation\"");
  return scene;
}

/// Returns the table of prices of a scene.
/// @throws InputError if no table applies and no pilot is requested
std::optional<PriceTable> prices_for(const PlanWishes& wishes, const Scene& scene,
                                     const PlansOfScene::Remark& tell) {
  ScenePrices found = prices_of(scene, wishes.prices);
  if (!found.table && !wishes.pilot)
    throw InputError(wishes.scene,
                     found.problem + "; --pilot measures the costs and the scatter of this scene");
  if (!found.table)
    tell(fmt::format("{}: {}; the plan is made from the pilot alone", wishes.scene, found.problem));
  return std::move(found.table);
}

PilotResult measured_pilot(const Scene& scene, const std::optional<PriceTable>& prices,
                           const std::optional<double>& budget, const PlansOfScene::Remark& tell) {
  const double limit = budget ? kShareOfPilot * *budget : kPilotSeconds;
  const PilotResult pilot = run_pilot(scene, limit, prices ? &*prices : nullptr);
  tell(
      fmt::format("pilot: a sample of {} grains takes {}; this time is proportional to the number of grains to "
                  "the power {:.2f}",
                  pilot.n_grains, duration_in_words(pilot.core_seconds), pilot.cost_exponent));
  return pilot;
}

/// Describes the best plan in words, and names the sources of error that the promised errors leave out.
void tell_best(const Plan& best, const PriceModel& model, const PlanRequest& request,
               const PlansOfScene::Remark& tell) {
  tell(fmt::format(
      "the best plan: {} sample{} of {} grains with {}, {} of processor time, {} on {} core{}. Errors are "
      "relative half "
      "widths of 95 % intervals",
      best.n_samples, best.n_samples == 1 ? "" : "s", best.n_grains, best.settings.name(),
      duration_in_words(best.core_seconds), duration_in_words(best.wall_seconds), request.cores,
      request.cores == 1 ? "" : "s"));
  if (request.wants.empty() && request.budget && best.wall_seconds < 0.5 * *request.budget)
    tell(fmt::format("the plan takes less than the budget: a plan has at most {} samples and {} grains here",
                     kMostSamples, model.most_grains()));
  if (!model.knows_settings())
    tell(
        "without a table of prices, the errors due to the numerical settings and to the finite number of "
        "grains are "
        "not known: the errors given here are due to the scatter between samples alone");
  else if (!model.knows_size_errors())
    tell(
        fmt::format("the table of prices has no rows of other numbers of grains: the error due to the finite "
                    "number of grains is not "
                    "known, and not part of the errors given here. No plan has fewer than {} grains",
                    model.least_grains()));
  if (best.n_grains > kFarExtrapolation * model.measured_grains())
    tell(fmt::format(
        "the prices were measured with {} grains: for this plan, they are extrapolated far beyond this number",
        model.measured_grains()));
}

/// Names, for each plan, the observables whose promised error is smaller than the table of prices can tell.
void tell_unknown_differences(const PlanChoice& choice, const PriceModel& model,
                              const PlansOfScene::Remark& tell) {
  for (std::size_t p = 0; p < choice.plans.size(); ++p) {
    const Plan& plan = choice.plans[p];
    std::vector<std::string> unknown;
    for (std::size_t k = 0; k < choice.observables.size(); ++k)
      if (const double h = model.unknown_difference(choice.observables[k], plan.settings);
          h > plan.errors[k].total())
        unknown.push_back(fmt::format("{} +- {:.2g}", choice.observables[k].name, h));
    if (!unknown.empty())
      tell(
          fmt::format("plan {} ({}): the table of prices knows the differences that these settings cause only "
                      "within intervals that exceed the promised errors: {}",
                      p + 1, plan.settings.name(), fmt::join(unknown, ", ")));
  }
}

}  // namespace

PlansOfScene::PlansOfScene(PlanWishes wishes, const Remark& tell)
    : wishes_(std::move(wishes)),
      request_(request_of(wishes_)),
      scene_(plannable_scene(wishes_)),
      model_(make_model(tell)),
      choice_(choose()) {
  tell_best(best(), model_, request_, tell);
  if (const auto replaced = replaced_settings(source(), scene_, best().settings); !replaced.empty())
    tell(fmt::format("the best plan replaces numerical settings of the scene: {}", fmt::join(replaced, "; ")));
  tell_unknown_differences(choice_, model_, tell);
}

PriceModel PlansOfScene::make_model(const Remark& tell) {
  std::optional<PriceTable> table = prices_for(wishes_, scene_, tell);
  prices_ = table ? table->name() : "pilot";
  std::optional<PilotResult> pilot;
  if (wishes_.pilot) pilot = measured_pilot(scene_, table, request_.budget, tell);
  return PriceModel(scene_, std::move(table), pilot);
}

PlanChoice PlansOfScene::choose() {
  model_.remove_settings([from = source(), this](const PricedSettings& s) { return !allows(from, scene_, s); });
  std::vector<std::string> names;
  for (const ObservablePrice& o : model_.observables()) names.push_back(o.name);
  request_.wants = wants_of(wishes_.wants, names);
  PlanChoice choice = choose_plans(model_, request_, kPlans);
  // The row "scene" of a table holds for the settings of the scene of the table.
  for (Plan& plan : choice.plans)
    if (plan.settings.parameter == "scene" && !changes_of(plan.settings, scene_).empty())
      plan.settings.value = "as in the table";
  return choice;
}

Table PlansOfScene::table() const {
  Table table{{"plan",          "observable",         "error",      "n_grains",  "n_samples",      "knob",
               "value",         "cpu_hours",          "wall_hours", "memory_mb", "error_settings", "error_size",
               "error_scatter", "tolerance",          "time_step",  "finish",    "patience",       "kind",
               "softening",     "assembly_softening", "masses"},
              {}};
  const std::string kind = scene_kind(scene_);
  for (std::size_t p = 0; p < choice_.plans.size(); ++p) {
    const Plan& plan = choice_.plans[p];
    const NumericalSettings& s = plan.settings.settings;
    for (std::size_t k = 0; k < choice_.observables.size(); ++k) {
      const PricedError& error = plan.errors[k];
      table.rows.push_back({static_cast<std::int64_t>(p + 1),
                            choice_.observables[k].name,
                            error.total(),
                            std::int64_t{plan.n_grains},
                            std::int64_t{plan.n_samples},
                            plan.settings.parameter,
                            plan.settings.value,
                            plan.core_seconds / kSecondsPerHour,
                            plan.wall_seconds / kSecondsPerHour,
                            plan.memory_mb,
                            error.settings,
                            choice_.observables[k].size ? TableValue(error.size) : TableValue(),
                            error.scatter,
                            s.tolerance,
                            s.time_step,
                            std::string(finish_name(s.finish)),
                            s.patience,
                            kind,
                            s.softening.load,
                            s.softening.assembly,
                            std::string(masses_name(s.equal_masses))});
    }
  }
  return table;
}

std::string PlansOfScene::file(const std::string& output) const {
  return plan_file(best(), choice_.observables, scene_, source(), output);
}

Table check_table(const std::vector<PlanCheck>& checks) {
  Table table{{"quantity", "unit", "promised", "achieved", "ratio", "mean", "n_samples"}, {}};
  for (const PlanCheck& c : checks)
    table.rows.push_back({c.quantity, c.unit, c.promised, or_undefined(c.achieved),
                          c.achieved ? TableValue(*c.achieved / c.promised) : TableValue(),
                          or_undefined(c.mean), std::int64_t{c.n_samples}});
  return table;
}

}  // namespace floc
