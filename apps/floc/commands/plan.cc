#include "floc/planning/plan.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

#include "campaign/commands.h"
#include "floc/base/error.h"
#include "floc/io/atomic_file.h"
#include "floc/planning/duration.h"
#include "floc/planning/pilot.h"
#include "floc/planning/plan_check.h"
#include "floc/planning/plan_file.h"
#include "floc/scene/read_scene.h"
#include "floc/scene/scene_kind.h"
#include "floc/scene/scene_prices.h"
#include "process/command.h"
#include "process/fault.h"
#include "process/output.h"
#include "process/prices_option.h"
#include "process/printing.h"

namespace floc {
namespace {

/// Largest number of plans that are printed.
constexpr int kPlans = 3;
/// Largest fraction of the budget that a pilot may take, and its largest processor time (s) if there is no
/// budget.
constexpr double kShareOfPilot = 0.2, kPilotSeconds = 600.0;
/// A message says that prices are extrapolated if a plan has more grains than the table of prices, by more than
/// this factor.
constexpr double kFarExtrapolation = 10.0;
constexpr double kSecondsPerHour = 3600.0;

struct PlanCommand {
  std::string scene;
  std::vector<std::string> overrides;
  std::string prices;
  std::string budget;
  std::vector<std::string> wants;
  std::string output;
  std::string check;
  bool pilot = false;
  PlanRequest request;
  Printing printing;
};

Table table_of(const PlanChoice& choice, const std::string& kind) {
  Table table{{"plan", "observable", "error", "n_grains", "n_samples", "knob", "value", "cpu_hours",
               "wall_hours", "memory_mb", "error_settings", "error_size", "error_scatter", "tolerance",
               "time_step", "finish", "patience", "kind"},
              {}};
  for (std::size_t p = 0; p < choice.plans.size(); ++p) {
    const Plan& plan = choice.plans[p];
    const NumericalSettings& s = plan.settings.settings;
    for (std::size_t k = 0; k < choice.observables.size(); ++k) {
      const PricedError& error = plan.errors[k];
      table.rows.push_back({static_cast<std::int64_t>(p + 1), choice.observables[k].name, error.total(),
                            std::int64_t{plan.n_grains}, std::int64_t{plan.n_samples}, plan.settings.parameter,
                            plan.settings.value, plan.core_seconds / kSecondsPerHour,
                            plan.wall_seconds / kSecondsPerHour, plan.memory_mb, error.settings, error.size,
                            error.scatter, s.tolerance, s.time_step, std::string(finish_name(s.finish)),
                            s.patience, kind});
    }
  }
  return table;
}

/// Returns the table of prices of a scene; absent if no table applies.
/// @throws InputError if no table applies and the user does not ask for a pilot
std::optional<PriceTable> prices_for(const PlanCommand& arguments, const Scene& scene) {
  ScenePrices found = prices_of(scene, arguments.prices);
  if (!found.table && !arguments.pilot)
    throw InputError(arguments.scene,
                     found.problem + "; --pilot measures the costs and the scatter of this scene");
  if (!found.table)
    spdlog::info("{}: {}; the plan is made from the pilot alone", arguments.scene, found.problem);
  return std::move(found.table);
}

PilotResult measured_pilot(const Scene& scene, const std::optional<double>& budget) {
  const double limit = budget ? kShareOfPilot * *budget : kPilotSeconds;
  const PilotResult pilot = run_pilot(scene, limit);
  spdlog::info("pilot: a sample of {} grains takes {}, which grows as the power {:.2f} of the number of grains",
               pilot.n_grains, duration_in_words(pilot.core_seconds), pilot.cost_exponent);
  return pilot;
}

/// Prints a summary of the best plan, and the contributions to the errors that it does not include.
void tell(const Plan& best, const PriceModel& model, const PlanRequest& request) {
  spdlog::info(
      "the best plan: {} sample{} of {} grains with {}, {} of processor time, {} on {} core{}. Errors are "
      "relative half "
      "widths of 95 % intervals",
      best.n_samples, best.n_samples == 1 ? "" : "s", best.n_grains, best.settings.name(),
      duration_in_words(best.core_seconds), duration_in_words(best.wall_seconds), request.cores,
      request.cores == 1 ? "" : "s");
  if (request.wants.empty() && request.budget && best.wall_seconds < 0.5 * *request.budget)
    spdlog::info(
        "this is less than the budget: a plan for this scene has at most {} samples and {} "
        "grains",
        kMostSamples, model.most_grains());
  if (!model.knows_settings())
    spdlog::info(
        "the errors due to the numerical settings and to the finite size are not known "
        "without a table of prices: the errors given here are due to the scatter between "
        "samples alone");
  if (best.n_grains > kFarExtrapolation * model.measured_grains())
    spdlog::info(
        "the prices were measured with {} grains: they are extrapolated to a much larger "
        "number",
        model.measured_grains());
}

void write_plan(const PlanChoice& choice, const Scene& scene, const PlanSource& source,
                const std::string& output) {
  const Plan& best = choice.plans.front();
  write_bytes_atomically(output, plan_file(best, choice.observables, scene, source, output));
  spdlog::info("wrote {0}; you may run next: floc {2} {0} -o {1}", output,
               std::filesystem::path(output).stem().string(), best.n_samples > 1 ? "campaign plan" : "run");
}

int make_plan(PlanCommand& arguments) {
  PlanRequest& request = arguments.request;
  if (!arguments.budget.empty()) request.budget = duration_of("--budget", arguments.budget);
  if (!request.budget && arguments.wants.empty())
    throw InputError("floc plan",
                     "expected --budget, the time that may be spent, or --want, the largest errors that "
                     "are accepted");
  const Scene scene = read_scene(arguments.scene, arguments.overrides);
  if (!scene.accuracy.empty())
    throw InputError(arguments.scene,
                     "floc plan chooses the numerical settings itself: remove the table [accuracy]");
  if (scene.starts_from_state())
    throw InputError(arguments.scene,
                     "assembly.protocol = \"state\": a plan chooses the number of grains, so the samples must "
                     "be made from a gas and not from a saved state: expected \"direct\" or \"aggregation\"");
  std::optional<PriceTable> table = prices_for(arguments, scene);
  const std::string prices = table ? table->name() : "pilot";
  std::optional<PilotResult> pilot;
  if (arguments.pilot) pilot = measured_pilot(scene, request.budget);
  PriceModel model(scene, std::move(table), pilot);
  const PlanSource source{arguments.scene, arguments.overrides, prices};
  model.remove_settings([&](const PricedSettings& settings) { return !allows(source, scene, settings); });
  std::vector<std::string> names;
  for (const ObservablePrice& o : model.observables()) names.push_back(o.name);
  request.wants = wants_of(arguments.wants, names);
  const PlanChoice choice = choose_plans(model, request, kPlans);
  print_table(table_of(choice, scene_kind(scene)), arguments.printing);
  tell(choice.plans.front(), model, request);
  if (!arguments.output.empty()) write_plan(choice, scene, source, arguments.output);
  return kDone;
}

int check_plan_of(const PlanCommand& arguments) {
  const auto [campaign, plans] = campaign_of(arguments.check);
  Table table{{"quantity", "unit", "promised", "achieved", "ratio", "mean", "n_samples"}, {}};
  for (const PlanCheck& c : check_plan(campaign, plans, arguments.check))
    table.rows.push_back({c.quantity, c.unit, c.promised, or_undefined(c.achieved),
                          c.achieved ? TableValue(*c.achieved / c.promised) : TableValue(),
                          or_undefined(c.mean), std::int64_t{c.n_samples}});
  print_table(table, arguments.printing);
  return kDone;
}

}  // namespace

Command add_plan(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "plan",
      "Choose the number of grains, the number of samples and the numerical settings of a "
      "scene for a given budget or for given errors");
  const auto arguments = std::make_shared<PlanCommand>();
  app.add_option("SCENE", arguments->scene, "scene file (TOML)");
  const Option budget =
      app.add_option("--budget", arguments->budget,
                     "time that the runs may take on the given number of cores, such as 90s, 30min, "
                     "2h, 3d or 1y");
  const Option want =
      app.add_option(
             "--want", arguments->wants,
             "NAME=ERROR,...: largest accepted relative errors of the means over states and samples, or of "
             "fitted values, such as phi=0.003,B=0.03,lambda=0.02")
          .delimiter(',')
          .one_argument_each();
  app.add_option("--cores", arguments->request.cores,
                 "number of cores, each of which makes one sample at a time")
      .within(PlanRequest::kCores)
      .show_default();
  app.add_option("--observables", arguments->request.observables,
                 "NAME,...: observables whose errors are made small if --want is not given [all]")
      .delimiter(',')
      .one_argument_each()
      .excludes(want);
  app.add_option("--set", arguments->overrides,
                 "KEY=VALUE: set one key of the scene to another value, e.g. contact.rolling.coefficient=0.5")
      .one_argument_each();
  add_prices_option(app, arguments->prices);
  const Option pilot =
      app.add_flag("--pilot", arguments->pilot,
                   "run a few small samples of the scene first, to measure the costs and the scatter "
                   "between samples");
  const Option output =
      app.add_option("-o,--output", arguments->output,
                     "campaign file to write, which makes the samples of the best plan; a scene file "
                     "if the plan has one sample");
  app.add_option("--check", arguments->check,
                 "DIR: directory of a campaign that floc plan has written: compare its runs with the "
                 "errors and the cost that the plan predicts")
      .excludes(budget)
      .excludes(want)
      .excludes(pilot)
      .excludes(output);
  add_printing_options(app, arguments->printing);
  return {app, [arguments]() -> int {
            if (!arguments->check.empty()) return check_plan_of(*arguments);
            if (arguments->scene.empty())
              throw InputError("floc plan", "expected a scene file, or --check DIR");
            const Fault fault = fault_of(arguments->scene, [&] { return make_plan(*arguments); });
            if (!fault.message.empty()) spdlog::error("floc: {}", fault.message);
            return fault.code;
          }};
}

}  // namespace floc
