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
/// The function returns the division with the smallest information criterion: that of Bayes, with the penalty
/// of p parameters multiplied by n/(n - p - 1), because laboratory tables have as few as n = 8 rows. The
/// probability of a division is proportional to exp(-criterion/2). The interval of one end of regime II follows
/// from the sum of these probabilities over all positions of the other end.
/// @return the regimes, with `end_of_two == n_plateau` if there is no regime II; `all_in_one` is set if a
/// constant or an elastic line describes the curve better; absent if no division fits, because the solid
/// fraction does not grow with pressure
[[nodiscard]] std::optional<Regimes> find_segments(const LawPoints& points);

}  // namespace floc
