#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/campaign/campaign_plan.h"

namespace floc {

/// For one quantity, the value that a plan promised and the value that the runs achieved.
struct PlanCheck {
  std::string quantity;  ///< name of an observable, or "cost"
  std::string unit;      ///< "1" for relative errors, "s" for the processor time
  double promised;
  /// For an observable, the half width of the 95 % interval of the mean, divided by the mean. For the cost, the
  /// processor time of the runs (s). Absent if it is not known.
  std::optional<double> achieved;
  std::optional<double> mean;  ///< mean over states and samples, or fitted value
  int n_samples = 0;           ///< number of samples that succeeded
};

/// Compares the runs of a campaign with the promises of floc plan. For each promised observable, the achieved error is
/// the half width t s/sqrt(n) of the 95 % interval of the mean over n samples. Here t is Student's factor, and s is the
/// standard deviation between the samples; the value of a sample is the mean over its states, or the value for its path
/// (such as K0). The half widths of the parameters of the consolidation law are computed by the jackknife, from at
/// least three samples. The last comparison concerns the processor time.
/// @param directory  directory of the campaign
/// @throws InputError if floc plan has not made the campaign, or if fewer than two samples have succeeded
std::vector<PlanCheck> check_plan(const Campaign& campaign, const std::vector<CasePlan>& plans,
                                  const std::string& directory);

}  // namespace floc
