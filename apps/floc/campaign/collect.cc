#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>

#include "campaign/commands.h"
#include "floc/base/error.h"
#include "floc/campaign/campaign_tables.h"
#include "process/child_process.h"
#include "process/output.h"
#include "process/printing.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

struct CollectArguments {
  std::string directory;
  std::string table = "means";
  Printing printing;
  bool forget = false;
};

/// Fits a law to the successful runs of one case, and adds the results to `table`. If the fit fails, a message on
/// stderr names the log file of the fit.
void fit_case(const PlannedCampaign& planned, int case_number, int fit_number, const std::string& directory,
              Table& table) {
  const CampaignCase& one = planned.campaign.cases[static_cast<std::size_t>(case_number)];
  const CampaignFit& fit = planned.campaign.fits[static_cast<std::size_t>(fit_number)];
  std::vector<std::string> words = {"fit", fit.law};
  words.insert(words.end(), fit.options.begin(), fit.options.end());
  words.insert(words.end(), {"--format", "csv"});
  const std::size_t n_words = words.size();
  for (const CampaignRun& run : runs_of(planned.campaign)) {
    if (run.case_number == case_number && is_done(outcome_of(directory + "/" + run.directory)))
      words.push_back(run.directory);
  }
  if (words.size() == n_words) return;
  const fs::path base =
      fs::path(directory) / "fits" / fmt::format("{}-{}-{}", one.label, fit_number + 1, fit.law);
  fs::create_directories(base.parent_path());
  const std::string printed = base.string() + ".csv", log = base.string() + ".log";
  if (const int code = wait_for(start_floc(words, {directory, printed, log, false})); code != kDone)
    std::cerr << fmt::format("floc: case {}: floc fit {} failed with exit code {}, see its log {}\n", one.label,
                             fit.law, code, log);
  if (fs::file_size(printed) > 0) add_fit(planned.campaign, one, fit, CsvTable::read(printed), table);
}

Table fits_of(const PlannedCampaign& planned, const std::string& directory) {
  Table table = empty_fits(planned.campaign);
  for (int k = 0; k < static_cast<int>(planned.campaign.cases.size()); ++k)
    for (int fit = 0; fit < static_cast<int>(planned.campaign.fits.size()); ++fit)
      fit_case(planned, k, fit, directory, table);
  return table;
}

int collect(const CollectArguments& arguments) {
  const PlannedCampaign planned = campaign_of(arguments.directory);
  const auto& [campaign, plans] = planned;
  Table table;
  if (arguments.table == "runs") table = collected_runs(campaign, plans, arguments.directory);
  if (arguments.table == "means")
    table = means_of(campaign, plans, CsvTable::read(arguments.directory + "/runs.csv"));
  if (arguments.table == "fits") table = fits_of(planned, arguments.directory);
  if (arguments.table == "outcomes") table = outcomes_of(campaign, plans, arguments.directory);
  print_table(table, arguments.printing);
  return kDone;
}

/// Converts the exit code of a failed run to an exit code of `floc campaign outcome`. The exit codes of floc for a
/// missing result, for bad input and for a failed check are kept. All other codes, for example those of signals, become
/// kFailure.
int as_own(int code) {
  return code == kNotConverged || code == kBadInput || code == kVerificationFailed ? code : int{kFailure};
}

int report_outcome(const CollectArguments& arguments) {
  const auto [campaign, plans] = campaign_of(arguments.directory);
  Table table{{"case", "seed", "outcome", "exit_code", "command", "words"}, {}};
  int code = kDone, n_failed = 0;
  std::string lines;
  for (const CampaignRun& run : runs_of(campaign)) {
    const fs::path place = fs::path(arguments.directory) / run.directory;
    const auto outcome = outcome_of(place.string());
    table.rows.push_back(
        {campaign.cases[static_cast<std::size_t>(run.case_number)].label, static_cast<std::int64_t>(run.seed),
         word_of(outcome), outcome ? TableValue(std::int64_t{outcome->exit_code}) : TableValue(),
         or_undefined(outcome ? outcome->command : ""), or_undefined(outcome ? outcome->words : "")});
    if (is_done(outcome)) continue;
    ++n_failed;
    // A run without an outcome was killed or has not been started. It counts as kFailure.
    code = worse(code, outcome ? as_own(outcome->exit_code) : int{kFailure});
    lines += outcome ? fmt::format("\n  {}: floc {} failed with exit code {}: {}", run.directory,
                                   outcome->command, outcome->exit_code, outcome->words)
                     : fmt::format("\n  {}: this run has not ended", run.directory);
    // snakemake repeats a run whose outcome file is missing. The outcome file is renamed instead of removed, so that
    // the tables of the campaign still report the failure.
    if (arguments.forget && fs::exists(place / kOutcomeFile))
      fs::rename(place / kOutcomeFile, place / kFailureFile);
  }
  print_table(table, arguments.printing);
  const std::size_t n = table.rows.size();
  std::cerr << (n_failed == 0
                    ? fmt::format("floc: all {} runs are done\n", n)
                    : fmt::format("floc: {} of {} runs failed and are not in the tables of the campaign:{}\n",
                                  n_failed, n, lines));
  return code;
}

}  // namespace

Command add_campaign_collect(CommandLine campaign) {
  CommandLine app =
      campaign.add_subcommand("collect", "print a table of the results of all runs of a campaign");
  auto arguments = std::make_shared<CollectArguments>();
  app.add_option("DIR", arguments->directory, "directory that floc campaign plan wrote").required();
  app.add_option("--table", arguments->table,
                 "table to print. runs: the collected columns, one row per run and state; means: means over "
                 "the samples, computed from DIR/runs.csv; fits: fits to the samples of each case; outcomes: "
                 "exit code, error message and duration of each run")
      .one_of({"runs", "means", "fits", "outcomes"})
      .show_default();
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return collect(*arguments); }};
}

Command add_campaign_outcome(CommandLine campaign) {
  CommandLine app = campaign.add_subcommand(
      "outcome",
      "list the outcome of each run of a campaign; the exit code is the worst exit code of all runs");
  auto arguments = std::make_shared<CollectArguments>();
  app.add_option("DIR", arguments->directory, "directory that floc campaign plan wrote").required();
  app.add_flag(
      "--forget", arguments->forget,
      "rename the files that record failures, so that the next call of snakemake repeats the failed runs");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return report_outcome(*arguments); }};
}

}  // namespace floc
