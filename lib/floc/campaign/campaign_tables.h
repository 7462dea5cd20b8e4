#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"
#include "floc/io/csv.h"
#include "floc/io/table.h"

namespace floc {

/// How a run ended.
struct RunOutcome {
  int exit_code = 0;
  std::string command;   ///< that failed; empty: none
  std::string words;     ///< what it said
  double seconds = 0.0;  ///< processor time of the commands after the run
};

/// The file in the directory of a run that says how it ended, and the one that does so for a failed run that is
/// to be made again.
inline constexpr const char* kOutcomeFile = "outcome.csv";
inline constexpr const char* kFailureFile = "failed.csv";

Table table_of(const RunOutcome& outcome);

/// How the run of a directory ended last time; nothing if it has not.
/// @throws InputError if a file does not hold an outcome
std::optional<RunOutcome> outcome_of(const std::string& directory);

/// Whether it ended, and without failure.
bool is_done(const std::optional<RunOutcome>& outcome);

/// "done", "failed", or "missing" for a run that has not ended.
const char* word_of(const std::optional<RunOutcome>& outcome);

/// One row per run and state collected, for the runs that succeeded: case, the keys in which cases differ,
/// seed, step, branch, P_star, and the columns collected; empty where a column is not collected at that state.
/// @param directory  of the campaign
/// @throws InputError naming a file and what it lacks
Table collected_runs(const Campaign& campaign, const std::vector<CasePlan>& plans,
                     const std::string& directory);

/// One row per case, state and column of numbers: number n of samples, mean, standard error, standard
/// deviation, lowest and highest; then the reference, if any, and whether the means agree: differ by at most
/// `allowed` = 2.6 sqrt(s^2/n + s_ref^2/n_ref), as means of the same quantity do in 99 of 100 cases.
/// @param runs  as collected_runs() makes it
Table means_of(const Campaign& campaign, const std::vector<CasePlan>& plans, const CsvTable& runs);

/// The columns of the table of fits, without rows.
Table empty_fits(const Campaign& campaign);

/// Adds what `floc fit LAW --format csv` printed for a case: each sample, and one row for all of them, the
/// pooled fit where the law has one, otherwise the mean over samples. This row is compared with references.
void add_fit(const Campaign& campaign, const CampaignCase& one, const CampaignFit& fit, const CsvTable& printed,
             Table& table);

/// One row per run: how it ended, and what it took (processor time of its analyses, wall time of its states).
Table outcomes_of(const Campaign& campaign, const std::vector<CasePlan>& plans, const std::string& directory);

/// Sum of a column, cells without a number left out.
double sum_of(const CsvTable& table, const std::string& column);

}  // namespace floc
