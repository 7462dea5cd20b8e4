#pragma once

#include <optional>

#include "floc/fitting/regimes.h"

namespace floc {

/// Divides a consolidation curve of 1/Phi against ln P* into up to three parts: a recompression line of slope
/// kappa >= 0; the steeper line of regime II; and the rest, in which the curve bends towards Phi_max, described
/// by a flatter line or by the power law of regime III. The recompression line meets the line of regime II
/// between the last point of the former and the first point of the latter. A division may lack any of these
/// parts, but it has at least one of regimes II and III.
///
/// The division has the smallest information criterion of all: that of Bayes, with the penalty of p parameters enlarged
/// by n/(n - p - 1), because tables of a laboratory have as few as n = 8 rows. The probability of a division is in
/// proportion to exp(-criterion/2); the range of the end of one part is taken over all ends of the other.
/// @param bends  whether the curve may bend away from the line of regime II
/// @return the regimes, of which `end_of_two == n_plateau` if there is no regime II; `all_in_one` is set if a constant or
/// an elastic line explains the curve better; absent if the solid fraction does not grow anywhere as it should
[[nodiscard]] std::optional<Regimes> find_segments(const LawPoints& points, bool bends = true);

}  // namespace floc
