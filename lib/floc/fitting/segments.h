#pragma once

#include <optional>

#include "floc/fitting/regimes.h"

namespace floc {

/// Divides a consolidation curve of 1/Phi against ln P* into at most three parts. The first part is a recompression
/// line, along which 1/Phi falls by kappa >= 0 per unit of ln P*. The second part is the steeper line of regime II. In
/// the third part, the curve bends towards Phi_max and is described by another line or by the power law of regime III.
/// The first two lines meet between the last point of the recompression line and the first point of regime II. Each
/// part may be missing, but at least one of the second and the third part is present.
///
/// The function chooses the division with the smallest information criterion. This is Bayes' criterion for n points,
/// but with the penalty for p parameters multiplied by n/(n - p - 1), because some tables of laboratories have only n =
/// 8 rows. The probability of a division is in proportion to exp(-criterion/2). The probability of each position of one
/// end of regime II is the sum over all positions of the other end. Of more than kMostPlaces points, means over groups
/// are divided (grouped()).
/// @param bends  whether the curve may bend away from the line of regime II
/// @return the regimes; absent if the solid fraction grows nowhere as in regime II or III. Without regime II,
/// `end_of_two` equals `n_plateau`. `all_in_one` is true if a constant or an elastic line explains the curve better
/// than any division
[[nodiscard]] std::optional<Regimes> find_segments(const LawPoints& points, bool bends = true);

}  // namespace floc
