#pragma once

#include <optional>

#include "floc/fitting/regimes.h"

namespace floc {

/// Divides a consolidation curve of 1/Phi against ln P* into a recompression line of slope kappa >= 0, the line of regime
/// II, which is steeper, and what bends away from it towards Phi_max: a flatter line or the power law of regime III. The
/// recompression line meets the line of regime II between its last point and the next one. Each part but one of regimes
/// II and III may be missing.
///
/// The division has the smallest information criterion of all: that of Bayes, with the penalty of p parameters enlarged
/// by n/(n - p - 1), because tables of a laboratory have as few as n = 8 rows. The probability of a division is in
/// proportion to exp(-criterion/2); the range of the end of one part is taken over all ends of the other.
/// @param bends  whether the curve may bend away from the line of regime II
/// @return the regimes, of which `end_of_two == n_plateau` if there is no regime II; `all_in_one` is set if a constant or
/// an elastic line explains the curve better; absent if the solid fraction does not grow anywhere as it should
[[nodiscard]] std::optional<Regimes> find_segments(const LawPoints& points, bool bends = true);

}  // namespace floc
