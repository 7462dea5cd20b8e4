#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>

#include "campaign/commands.h"
#include "campaign/counted.h"
#include "campaign/log_reason.h"
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
  bool keep_going = false;
};

/// Converts the exit code of a child process to an exit code of this program. The exit codes of floc for success, for
/// an invalid command line, for a missing result, for bad input and for a failed check are kept. All other codes, for
/// example those of signals, become kFailure.
int as_own(int code) {
  constexpr std::array<int, 5> kKept = {kDone, kUsage, kNotConverged, kBadInput, kVerificationFailed};
  return std::ranges::count(kKept, code) > 0 ? code : int{kFailure};
}

/// Returns the directories of the successful runs of a case, relative to the directory of the campaign.
std::vector<std::string> successful_runs(const Campaign& campaign, int case_number,
                                         const std::string& directory) {
  std::vector<std::string> runs;
  for (const CampaignRun& run : runs_of(campaign))
    if (run.case_number == case_number && is_done(outcome_of(directory + "/" + run.directory)))
      runs.push_back(run.directory);
  return runs;
}

/// Starts floc fit in the directory of a campaign, and waits for it. If it fails, or has no result for some sample, a
/// message on stderr names its log file.
/// @param base   path of the files of the fit, see path_of_fit()
/// @param label  label of the case, for the message
RunOutcome run_fit(const CampaignFit& fit, const std::vector<std::string>& runs, const std::string& directory,
                   const std::string& base, const std::string& label) {
  std::vector<std::string> words = {"fit", fit.law};
  words.insert(words.end(), fit.options.begin(), fit.options.end());
  words.insert(words.end(), {"--format", "csv"});
  words.insert(words.end(), runs.begin(), runs.end());
  const std::string log = base + ".log";
  RunOutcome outcome;
  outcome.exit_code = wait_for(start_floc(words, {directory, base + ".csv", log, false}));
  if (outcome.exit_code == kDone) return outcome;
  outcome.command = "fit " + fit.law;
  outcome.words =
      outcome.exit_code == kNotConverged ? reason_of_no_fit(log) : reason_of_failure(outcome.exit_code, log);
  std::cerr << fmt::format("floc: case {}: floc {} {} {}: {} (see the log {})\n", label, outcome.command,
                           outcome.exit_code == kNotConverged
                               ? "has no result for one sample or more, exit code"
                               : "failed with exit code",
                           outcome.exit_code, outcome.words, log);
  return outcome;
}

/// Fits a law to the successful runs of one case, and adds the results to `table`. The outcome of the fit is written to
/// a file.
/// @return exit code of the fit
int fit_case(const PlannedCampaign& planned, int case_number, int fit_number, const std::string& directory,
             Table& table) {
  const CampaignCase& one = planned.campaign.cases[static_cast<std::size_t>(case_number)];
  const CampaignFit& fit = planned.campaign.fits[static_cast<std::size_t>(fit_number)];
  const std::string base = path_of_fit(planned.campaign, case_number, fit_number, directory);
  fs::create_directories(fs::path(base).parent_path());
  fs::remove(base + kFitOutcome);
  const std::vector<std::string> runs = successful_runs(planned.campaign, case_number, directory);
  // Without a successful run, there is nothing to fit. The failures of the runs are reported instead.
  if (runs.empty()) return kDone;
  const RunOutcome outcome = run_fit(fit, runs, directory, base, one.label);
  write_csv(base + kFitOutcome, table_of(outcome));
  const std::string printed = base + ".csv";
  if (fs::file_size(printed) > 0) add_fit(planned.campaign, one, fit, CsvTable::read(printed), table);
  return as_own(outcome.exit_code);
}

/// Makes the table of fits.
/// @param code  receives the worst exit code of all fits
Table fits_of(const PlannedCampaign& planned, const std::string& directory, int& code) {
  Table table = empty_fits(planned.campaign);
  code = kDone;
  for (int k = 0; k < static_cast<int>(planned.campaign.cases.size()); ++k)
    for (int fit = 0; fit < static_cast<int>(planned.campaign.fits.size()); ++fit)
      code = worse(code, fit_case(planned, k, fit, directory, table));
  return table;
}

int collect(const CollectArguments& arguments) {
  const PlannedCampaign planned = campaign_of(arguments.directory);
  const auto& [campaign, plans] = planned;
  Table table;
  int code = kDone;
  if (arguments.table == "runs") table = collected_runs(campaign, plans, arguments.directory);
  if (arguments.table == "means")
    table = means_of(campaign, plans, CsvTable::read(arguments.directory + "/runs.csv"));
  if (arguments.table == "fits") table = fits_of(planned, arguments.directory, code);
  if (arguments.table == "outcomes") table = outcomes_of(campaign, plans, arguments.directory);
  print_table(table, arguments.printing);
  return arguments.keep_going ? int{kDone} : code;
}

/// Adds a row for each failed fit to the table of outcomes, and a text about these fits to `message`. A law that cannot
/// be fitted to some sample is no failure: the page of the campaign tells it.
/// @return worst exit code of the failed fits
int add_failed_fits(const Campaign& campaign, const std::string& directory, Table& table,
                    std::string& message) {
  int code = kDone;
  std::size_t n_failed = 0;
  std::string lines;
  for (const auto& [case_number, fit_number, outcome] : unsuccessful_fits(campaign, directory)) {
    if (outcome.exit_code == kNotConverged) continue;
    ++n_failed;
    const std::string& label = campaign.cases[static_cast<std::size_t>(case_number)].label;
    table.rows.push_back(
        {label, {}, "failed", std::int64_t{outcome.exit_code}, outcome.command, or_undefined(outcome.words)});
    code = worse(code, as_own(outcome.exit_code));
    lines += fmt::format("\n  case {}: floc {} failed with exit code {}: {}", label, outcome.command,
                         outcome.exit_code, outcome.words);
  }
  if (n_failed > 0) message += fmt::format("floc: {} failed:{}\n", counted(n_failed, "fit"), lines);
  return code;
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
  const std::size_t n = table.rows.size();
  std::string message =
      n_failed > 0 ? fmt::format("floc: {} of {} failed and are not in the tables of the campaign:{}\n",
                                 n_failed, counted(n, "run"), lines)
      : n == 1     ? "floc: the only run is done\n"
                   : fmt::format("floc: all {} runs are done\n", n);
  code = worse(code, add_failed_fits(campaign, arguments.directory, table, message));
  print_table(table, arguments.printing);
  std::cerr << message;
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
  app.add_flag(
      "--keep-going", arguments->keep_going,
      "exit with code 0 although fits failed, so that snakemake goes on; floc campaign outcome lists these "
      "fits");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return collect(*arguments); }};
}

Command add_campaign_outcome(CommandLine campaign) {
  CommandLine app = campaign.add_subcommand("outcome",
                                            "list the outcome of each run of a campaign, and the fits that "
                                            "failed; the exit code is the worst of all runs and fits");
  auto arguments = std::make_shared<CollectArguments>();
  app.add_option("DIR", arguments->directory, "directory that floc campaign plan wrote").required();
  app.add_flag("--forget", arguments->forget,
               "rename the files that record failures, so that the next call of snakemake repeats the failed "
               "runs");
  add_printing_options(app, arguments->printing);
  return {app, [arguments] { return report_outcome(*arguments); }};
}

}  // namespace floc
