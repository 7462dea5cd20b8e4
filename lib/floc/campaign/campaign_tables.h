#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"
#include "floc/io/csv.h"
#include "floc/io/table.h"

namespace floc {

/// Outcome of a run of a campaign.
struct RunOutcome {
  int exit_code = 0;
  std::string command;   ///< command that failed; empty: none
  std::string words;     ///< message of that command
  double seconds = 0.0;  ///< processor time of the commands after the run
};

/// Names of the files in the directory of a run that hold its outcome: of the last attempt, and of a failed run that
/// is to be repeated.
inline constexpr const char* kOutcomeFile = "outcome.csv";
inline constexpr const char* kFailureFile = "failed.csv";

Table table_of(const RunOutcome& outcome);

/// Returns the outcome of the last run of a directory; none if it has not ended.
/// @throws InputError if a file does not hold an outcome
std::optional<RunOutcome> outcome_of(const std::string& directory);

/// Whether a run ended without failure.
bool is_done(const std::optional<RunOutcome>& outcome);

/// Returns "done", "failed", or "missing" for a run that has not ended.
const char* word_of(const std::optional<RunOutcome>& outcome);

/// Returns one row per run and collected state, for the runs that succeeded: case, the keys in which cases differ,
/// seed, step, branch, P_star, and the collected columns, empty if a column is not collected at that state.
/// @param directory  directory of the campaign
/// @throws InputError naming a file and what it lacks
Table collected_runs(const Campaign& campaign, const std::vector<CasePlan>& plans,
                     const std::string& directory);

/// Returns one row per case, state and column of numbers: number n of samples, mean, standard error, standard
/// deviation, lowest and highest value; then the reference, if any, and whether the means agree. They agree if they
/// differ by at most `allowed` = 2.6 sqrt(s^2/n + s_ref^2/n_ref), as means of the same quantity do in 99 of 100
/// cases.
/// @param runs  table of collected_runs()
Table means_of(const Campaign& campaign, const std::vector<CasePlan>& plans, const CsvTable& runs);

/// Returns the table of fits with its columns, without rows.
Table empty_fits(const Campaign& campaign);

/// Adds the output of `floc fit LAW --format csv` for a case: a row per sample, and one row for all of them, which is
/// the pooled fit if the law has one, and otherwise the mean over samples. This last row is compared with references.
void add_fit(const Campaign& campaign, const CampaignCase& one, const CampaignFit& fit, const CsvTable& printed,
             Table& table);

/// Returns one row per run: its outcome and its cost (processor time of its analyses, wall time of its states; s).
Table outcomes_of(const Campaign& campaign, const std::vector<CasePlan>& plans, const std::string& directory);

/// Returns the sum of a column; cells without a number are left out.
double sum_of(const CsvTable& table, const std::string& column);

}  // namespace floc
