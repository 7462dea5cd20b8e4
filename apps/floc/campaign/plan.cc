#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "campaign/commands.h"
#include "campaign/counted.h"
#include "campaign/option_faults.h"
#include "floc/base/error.h"
#include "floc/base/nearest_name.h"
#include "floc/base/read_file.h"
#include "floc/campaign/read_campaign.h"
#include "floc/campaign/snakefile.h"
#include "floc/campaign/starting_campaign.h"
#include "floc/io/atomic_file.h"
#include "floc/scene/starting_scene.h"
#include "floc/tables/column_reference.h"
#include "process/child_process.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

struct PlanArguments {
  std::string file;
  std::string name;
  std::string scene;
  std::string directory;
  Printing printing;
  bool overwrite = false;
};

const DescribedTable& described_table(const std::string& name) {
  const auto& tables = described_tables();
  return *std::ranges::find(tables, name, &DescribedTable::name);
}

/// Checks that every column that a campaign collects exists in its table. @throws InputError naming the line of the
/// campaign file and the column
void check_columns(const Campaign& campaign) {
  for (const Collection& collection : campaign.collections) {
    const std::string name = collection.table == "path" ? "path.csv" : collection.table;
    std::vector<std::string> names;
    for (const DescribedColumn& column : described_table(name).columns) names.push_back(column.name);
    for (const std::string& column : collection.columns)
      if (std::ranges::none_of(names, [&](const std::string& n) { return stands_for(n, column); }))
        throw InputError(collection.place,
                         fmt::format("columns = {}: the table {} has no column of this name; the nearest is {} "
                                     "(floc help columns {} lists all columns)",
                                     column, name, nearest_name(column, names), name));
  }
}

/// Checks that the commands of all [[collect]] and [[fit]] accept their options. @throws InputError naming all options
/// that they do not accept, with the lines of the campaign file
void check_options(const Campaign& campaign) {
  if (const auto faults = option_faults(campaign); !faults.empty())
    throw InputError("", fmt::format("{}", fmt::join(faults, "\n")));
}

/// Returns a text with the number of runs of a campaign and the expected processor time of all runs together.
std::string extent_of(const PlannedCampaign& planned) {
  const std::size_t n_seeds = planned.campaign.seeds.size();
  double cost = 0.0;
  for (const CasePlan& plan : planned.plans) cost += plan.cost * static_cast<double>(n_seeds);
  const auto n_rough = static_cast<std::size_t>(std::ranges::count(planned.plans, false, &CasePlan::is_priced));
  return fmt::format(
      "{} with {}: {}, expected to take {} on one core ({})", counted(planned.plans.size(), "case"),
      counted(n_seeds, "seed"), counted(planned.plans.size() * n_seeds, "run"), duration_text(cost),
      n_rough == 0 ? "by the tables of prices of their kinds"
                   : fmt::format("no table of prices applies to {}, whose time is a rough estimate",
                                 n_rough == planned.plans.size() ? "the cases" : counted(n_rough, "case")));
}

/// Writes a new file. @throws InputError if a file of this name exists already, because no file of a user may be
/// replaced
void write_new(const fs::path& path, const std::string& text) {
  if (fs::exists(path))
    throw InputError(path.string(), "this file exists already: expected the name of a new file");
  write_bytes_atomically(path.string(), text);
}

int start_campaign(const PlanArguments& arguments) {
  fs::path path(arguments.name);
  if (path.extension() != ".toml") path += ".toml";
  const std::string name = path.stem().string();
  const std::string own = starting_scene(name);  // throws if the name is not valid
  const fs::path scene = arguments.scene.empty() ? fs::path(name + "-scene.toml") : fs::path(arguments.scene);
  if (fs::exists(path))
    throw InputError(path.string(), "this file exists already: expected the name of a new file");
  if (arguments.scene.empty())
    write_new(path.parent_path() / scene, own);
  else if (!fs::is_regular_file(scene))
    throw InputError(scene.string(), "this file cannot be read: expected the name of a scene file (TOML)");
  const std::string relative =
      arguments.scene.empty()
          ? scene.string()
          : fs::absolute(scene).lexically_proximate(fs::absolute(path).parent_path()).generic_string();
  write_new(path, starting_campaign(name, relative));
  spdlog::info("wrote {0}{1}; next, run floc campaign check {0} and floc campaign plan {0} -o {2}",
               path.string(), arguments.scene.empty() ? " and " + (path.parent_path() / scene).string() : "",
               name);
  return kDone;
}

int check_campaign(const PlanArguments& arguments) {
  const PlannedCampaign planned = planned_campaign(arguments.file);
  const Campaign& campaign = planned.campaign;
  Table table{{"case"}, {}};
  table.columns.insert(table.columns.end(), campaign.keys.begin(), campaign.keys.end());
  for (const char* column : {"seed", "n_states", "expected_seconds", "directory"})
    table.columns.emplace_back(column);
  for (const CampaignRun& run : runs_of(campaign)) {
    const CampaignCase& one = campaign.cases[static_cast<std::size_t>(run.case_number)];
    const CasePlan& plan = planned.plans[static_cast<std::size_t>(run.case_number)];
    std::vector<TableValue> row = {one.label};
    for (const std::string& key : campaign.keys) row.push_back(or_undefined(value_of(one, key)));
    row.insert(row.end(), {static_cast<std::int64_t>(run.seed), static_cast<std::int64_t>(plan.states.size()),
                           plan.cost, run.directory});
    table.rows.push_back(std::move(row));
  }
  print_table(table, arguments.printing);
  spdlog::info("{}: no errors found; {}", arguments.file, extent_of(planned));
  return kDone;
}

/// Writes the files of a campaign into its directory. A file is replaced only if its content differs, so that Snakemake
/// does not repeat work that is up to date. Runs in the directory are kept.
int plan_campaign(const PlanArguments& arguments) {
  PlannedCampaign planned = planned_campaign(arguments.file);
  const fs::path directory(arguments.directory);
  const std::string scene = portable_scene(planned.campaign);
  planned.campaign.scene = scene;
  planned.campaign.scene_file = (directory / kCampaignScene).string();
  planned.plans = plan_cases(planned.campaign);  // file names in the cases are relative to `directory`
  const std::pair<const char*, std::string> files[] = {
      {kCampaignFile, read_file(arguments.file)},
      {kCampaignScene, scene},
      {"Snakefile", snakefile_of(planned.campaign, planned.plans, this_program())}};
  std::error_code failed;
  fs::create_directories(directory, failed);
  if (failed) throw IoError(arguments.directory, "this directory cannot be made: " + failed.message());
  const auto differs = [&](const char* name, const std::string& text) {
    return !fs::exists(directory / name) || read_file((directory / name).string()) != text;
  };
  for (const auto& [name, text] : files)
    if (!arguments.overwrite && fs::exists(directory / name) && differs(name, text))
      throw InputError(
          (directory / name).string(),
          "this file exists already with different content: give another directory, or give --overwrite, "
          "which replaces the plan and keeps the runs");
  for (const auto& [name, text] : files)
    if (differs(name, text)) write_bytes_atomically((directory / name).string(), text);
  spdlog::info("{}: {}. Next, run: cd {} && snakemake --cores 2", arguments.directory, extent_of(planned),
               arguments.directory);
  return kDone;
}

}  // namespace

PlannedCampaign planned_campaign(const std::string& file) {
  PlannedCampaign planned{read_campaign(file), {}};
  check_columns(planned.campaign);
  planned.plans = plan_cases(planned.campaign);
  check_options(planned.campaign);
  return planned;
}

Command add_campaign_new(CommandLine campaign) {
  CommandLine app = campaign.add_subcommand(
      "new", "write a commented campaign file NAME.toml and its scene, as a start for a new campaign");
  auto arguments = std::make_shared<PlanArguments>();
  app.add_option("NAME", arguments->name, "name of the campaign").required();
  app.add_option("--scene", arguments->scene, "scene file of the runs [NAME-scene.toml, which is written too]");
  return {app, [arguments] { return start_campaign(*arguments); }};
}

Command add_campaign_check(CommandLine campaign) {
  CommandLine app = campaign.add_subcommand(
      "check", "list all errors of a campaign file; print the runs and their expected processor time");
  auto arguments = std::make_shared<PlanArguments>();
  app.add_option("FILE", arguments->file, "campaign file (TOML)").required();
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return check_campaign(*arguments); }};
}

Command add_campaign_plan(CommandLine campaign) {
  CommandLine app =
      campaign.add_subcommand("plan", "write a directory with a Snakefile that has one rule per run");
  auto arguments = std::make_shared<PlanArguments>();
  app.add_option("FILE", arguments->file, "campaign file (TOML)").required();
  app.add_option("-o,--output", arguments->directory,
                 "directory of the campaign, which is made if it does not exist")
      .required();
  app.add_flag("--overwrite", arguments->overwrite,
               "replace the plan in the directory and keep the runs in it");
  return {app, [arguments] { return plan_campaign(*arguments); }};
}

}  // namespace floc
