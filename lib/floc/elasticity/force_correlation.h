#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// How the forces of a state correlate with those that a small step adds: Pearson's coefficients over the
/// contacts that touch, absent where one of the two does not vary.
struct ForceCorrelation {
  std::optional<double> normal;  ///< of the normal force with its increment, both with their sign
  std::optional<double> size;  ///< of the size of the force (normal and tangential) with that of its increment
};

/// @param increments  one per contact of the network
template <int Dim>
ForceCorrelation force_correlation(const ContactNetwork<Dim>& network,
                                   const std::vector<ForceIncrement<Dim>>& increments);

}  // namespace floc
