#pragma once

#include <string>

#include "floc/fitting/consolidation.h"
#include "floc/fitting/law_estimate.h"

namespace floc {

/// Returns the physical range of a parameter of a consolidation law: solid fractions lie between 0 and `phi_limit`, other
/// parameters are not negative.
PhysicalRange range_of(const std::string& name, double phi_limit);

/// Adds the parameters of a fitted consolidation law, their 95 % intervals and warnings about them to `fit`.
/// @param last_phi  solid fraction at the highest pressure fitted; the lower bound of Phi_max if Phi_max has no value
void add_parameters(const LawEstimate& estimate, const Covariance& covariance, double last_phi,
                    ConsolidationFit& fit);

/// Adds the parameters of a fit to data that end before P1*, the pressure at which regime III begins: the slope lambda
/// of regime II, and lower bounds of Phi_max and P1*.
void bound_regime_three(const LawEstimate& reported, const Covariance& covariance, double last_phi,
                        ConsolidationFit& fit);

}  // namespace floc
