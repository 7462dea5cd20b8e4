#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"
#include "floc/io/csv.h"
#include "floc/io/table.h"

namespace floc {

/// Outcome of a run or of a fit of a campaign: the floc command that failed, if any, and processor times.
struct RunOutcome {
  int exit_code = 0;
  std::string command;   ///< floc command that failed; empty if none failed
  std::string words;     ///< error message of that command
  double seconds = 0.0;  ///< processor time of the commands that made tables after the run (s); 0 for a fit
  /// Processor time (s) of the last attempt of the run; 0 for a fit; absent in directories that older versions of floc
  /// wrote.
  std::optional<double> run_seconds = {};
};

/// Names of the files with the outcome of a run, in the directory of the run. kOutcomeFile contains the outcome of the
/// last attempt. If the last attempt failed and the run is to be repeated, kOutcomeFile is renamed to kFailureFile.
inline constexpr const char* kOutcomeFile = "outcome.csv";
inline constexpr const char* kFailureFile = "failed.csv";
/// End of the name of the file with the outcome of a fit, see path_of_fit().
inline constexpr const char* kFitOutcome = "-outcome.csv";

Table table_of(const RunOutcome& outcome);

/// Returns the outcome of the last attempt of the run in a directory; absent if the run has not ended.
/// @throws InputError if a file with an outcome is not valid
std::optional<RunOutcome> outcome_of(const std::string& directory);

/// Returns whether a run has ended without failure.
bool is_done(const std::optional<RunOutcome>& outcome);

/// Returns "done" or "failed", or "missing" if the run has not ended.
const char* word_of(const std::optional<RunOutcome>& outcome);

/// Returns the path of the files of a fit to a case, without the end of their names. The end is ".csv" for the table
/// that floc fit printed, ".log" for its messages, and "-outcome.csv" for its outcome.
/// @param fit_number  index of the fit in `campaign.fits`; the number in the path is larger by 1
std::string path_of_fit(const Campaign& campaign, int case_number, int fit_number,
                        const std::string& directory);

/// A fit to the runs of a case whose floc command ended with an exit code other than 0.
struct UnsuccessfulFit {
  int case_number = 0;
  int fit_number = 0;  ///< index of the fit in the campaign
  RunOutcome outcome;
};

/// Returns the fits of a campaign that were not successful when its table of fits was made.
/// @param directory  directory of the campaign
/// @throws InputError if a file with an outcome is not valid
std::vector<UnsuccessfulFit> unsuccessful_fits(const Campaign& campaign, const std::string& directory);

/// Returns a table of the runs that succeeded, with one row per run and collected state. The columns of the table are
/// case, the keys in which the cases differ, seed, step, branch, P_star, and the collected columns. A cell is empty if
/// its column is not collected at that state.
/// @param directory  directory of the campaign
/// @throws InputError if a file of a run is missing or does not fit the campaign; the message names this file
Table collected_runs(const Campaign& campaign, const std::vector<CasePlan>& plans,
                     const std::string& directory);

/// Returns a table with one row per case, state and collected column of numbers: the number n of samples, and the mean,
/// standard error, standard deviation s, lowest and highest value over the samples. The campaign may have a reference
/// for the column: a mean over n_ref samples with the standard deviation s_ref. The row then also tells whether the two
/// means agree. They agree if they differ by at most `allowed` = 2.6 sqrt(s^2/n + s_ref^2/n_ref). Two means of the same
/// quantity agree in 99 of 100 comparisons.
/// @param runs  table that collected_runs() returns
Table means_of(const Campaign& campaign, const std::vector<CasePlan>& plans, const CsvTable& runs);

/// Returns the table of fits, with its columns but without rows.
Table empty_fits(const Campaign& campaign);

/// Adds to the table of fits the results that `floc fit LAW --format csv` printed for a case: one row per sample and
/// parameter, and one row per parameter for all samples. The row for all samples contains the value of the pooled fit
/// if the law has a pooled fit, and otherwise the mean over the samples. This value is compared with the reference.
void add_fit(const Campaign& campaign, const CampaignCase& one, const CampaignFit& fit, const CsvTable& printed,
             Table& table);

/// Returns a table with one row per run: how the run ended, the wall time of its states, and the processor times of its
/// tables and of the run itself (s).
Table outcomes_of(const Campaign& campaign, const std::vector<CasePlan>& plans, const std::string& directory);

/// Returns the sum of the numbers in a column; cells without a number are left out.
double sum_of(const CsvTable& table, const std::string& column);

}  // namespace floc
