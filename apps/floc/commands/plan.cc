#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "floc/base/error.h"
#include "floc/base/shell_word.h"
#include "floc/campaign/campaign_directory.h"
#include "floc/planning/plans_of_scene.h"
#include "process/command.h"
#include "process/fault.h"
#include "process/output.h"
#include "process/prices_option.h"
#include "process/printing.h"

namespace floc {
namespace {

struct PlanCommand {
  PlanWishes plan;
  std::string output;
  bool overwrite = false;
  std::string check;
  Printing printing;
};

void write_plan(const PlansOfScene& plans, const std::string& output) {
  write_output(output, plans.file(output));
  spdlog::info("wrote {0}; you may run next: floc {2} {0} -o {1}", shell_word(output),
               shell_word(std::filesystem::path(output).stem().string()),
               plans.best().n_samples > 1 ? "campaign plan" : "run");
}

int make_plan(const PlanCommand& arguments) {
  if (arguments.plan.scene == "-" && !arguments.output.empty())
    throw InputError(
        "--output " + arguments.output,
        "the file of a plan names the scene file: expected the name of a scene file in place of -");
  // write_output() refuses the name of the scene.
  std::error_code error;
  if (!arguments.output.empty() && !std::filesystem::equivalent(arguments.output, arguments.plan.scene, error))
    require_new_file(arguments.output, arguments.overwrite);
  const PlansOfScene plans(arguments.plan, [](const std::string& remark) { spdlog::info("{}", remark); });
  print_table(plans.table(), arguments.printing);
  if (!arguments.output.empty()) write_plan(plans, arguments.output);
  return kDone;
}

int check_plan_of(const PlanCommand& arguments) {
  if (!arguments.plan.scene.empty())
    throw InputError("--check " + arguments.check,
                     "expected no scene file beside the directory of a campaign: " + arguments.plan.scene);
  const auto [campaign, plans] = campaign_of(arguments.check);
  print_table(check_table(check_plan(campaign, plans, arguments.check)), arguments.printing);
  return kDone;
}

}  // namespace

Command add_plan(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "plan",
      "Choose the number of grains, the number of samples and the numerical settings of a "
      "scene for a given budget or for given errors");
  const auto arguments = std::make_shared<PlanCommand>();
  // The scene is not a required argument, because --check needs only a directory. The function that runs the command
  // checks that one of the two is given.
  app.add_option("SCENE", arguments->plan.scene, "scene file (TOML)");
  const Option budget =
      app.add_option("--budget", arguments->plan.budget,
                     "time that the runs may take on the given number of cores, such as 90s, 30min, "
                     "2h, 3d or 1y");
  const Option want =
      app.add_option(
             "--want", arguments->plan.wants,
             "NAME=ERROR,...: largest accepted relative errors of the means over states and samples, or of "
             "fitted values, such as phi=0.003,B=0.03,lambda=0.02")
          .delimiter(',')
          .one_argument_each();
  const Option cores = app.add_option("--cores", arguments->plan.cores,
                                      "number of cores, each of which makes one sample at a time")
                           .within(PlanRequest::kCores)
                           .show_default();
  const Option observables =
      app.add_option("--observables", arguments->plan.observables,
                     "NAME,...: observables whose errors the plan makes small if --want is not given [all]")
          .delimiter(',')
          .one_argument_each()
          .excludes(want);
  const Option set =
      app.add_option(
             "--set", arguments->plan.overrides,
             "KEY=VALUE: set one key of the scene to another value, e.g. contact.rolling.coefficient=0.5")
          .one_argument_each();
  add_prices_option(app, arguments->plan.prices);
  const Option pilot =
      app.add_flag("--pilot", arguments->plan.pilot,
                   "run a few small samples of the scene first, to measure the costs and the scatter "
                   "between samples");
  const Option output = app.add_option(
      "-o,--output", arguments->output,
      "file to write for the best plan: a campaign file, or a scene file if the plan has only one sample");
  const Option overwrite =
      app.add_flag("--overwrite", arguments->overwrite, "replace the file of --output if it exists already");
  app.add_option("--check", arguments->check,
                 "DIR: directory of a campaign that floc plan has written: compare its runs with the "
                 "errors and the cost that the plan predicts")
      .excludes(budget)
      .excludes(want)
      .excludes(cores)
      .excludes(observables)
      .excludes(set)
      .excludes(pilot)
      .excludes(output)
      .excludes(overwrite);
  add_printing_options(app, arguments->printing);
  return {app, [arguments]() -> int {
            if (!arguments->check.empty()) return check_plan_of(*arguments);
            if (arguments->plan.scene.empty())
              throw InputError("floc plan", "expected a scene file, or --check DIR");
            // A message about the scene may lack the name of the scene file. fault_of() adds this name.
            const Fault fault = fault_of(arguments->plan.scene, [&] { return make_plan(*arguments); });
            if (!fault.message.empty()) spdlog::error("floc: {}", fault.message);
            return fault.code;
          }};
}

}  // namespace floc
