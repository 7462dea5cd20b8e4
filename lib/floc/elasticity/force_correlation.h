#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/force_increments.h"

namespace floc {

/// Pearson's correlation coefficients, over the touching contacts, between the forces of a state and their increments
/// in a small step of stress or strain. A coefficient is absent if one of the two correlated quantities has equal
/// values in all contacts.
struct ForceCorrelation {
  std::optional<double> normal;  ///< coefficient for the normal force and its increment, both with their signs
  /// coefficient for the magnitude of the contact force (normal and tangential) and the magnitude of its increment
  std::optional<double> size;
};

/// Computes the correlation between forces and force increments over the touching contacts of a network.
/// @param increments  increment of the forces in each contact of the network
template <int Dim>
ForceCorrelation force_correlation(const ContactNetwork<Dim>& network,
                                   const std::vector<ForceIncrement<Dim>>& increments);

}  // namespace floc
