#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// Correlation between the forces of a state and their increments in a small step: Pearson's coefficients over the
/// touching contacts. A coefficient is absent if one of its two quantities does not vary.
struct ForceCorrelation {
  std::optional<double> normal;  ///< normal force and its increment, both with their sign
  std::optional<double>
      size;  ///< magnitude of the force (normal and tangential) and magnitude of its increment
};

/// Computes the correlation over the touching contacts of a network.
/// @param increments  increment of the force in each contact of the network
template <int Dim>
ForceCorrelation force_correlation(const ContactNetwork<Dim>& network,
                                   const std::vector<ForceIncrement<Dim>>& increments);

}  // namespace floc
