#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// Correlation of the forces of a state with the increments of a small step: Pearson's coefficients over the
/// contacts that touch, absent where one of the two does not vary.
struct ForceCorrelation {
  std::optional<double> normal;  ///< normal force with its increment, both with their sign
  std::optional<double> size;    ///< size of the force (normal and tangential) with that of its increment
};

/// Computes the correlation over the touching contacts of a network.
/// @param increments  one per contact of the network
template <int Dim>
ForceCorrelation force_correlation(const ContactNetwork<Dim>& network,
                                   const std::vector<ForceIncrement<Dim>>& increments);

}  // namespace floc
