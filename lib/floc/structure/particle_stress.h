#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns the stress of each grain, compression positive (force/length^(Dim-1)):
///
///   sigma_i = -(1/V_i) sum_j f_(j on i) (x) l_i,   V_i = volume of the grain / Phi
///
/// where l_i is the arm from the centre of grain i to the contact point with grain j, f are the static forces of all
/// interactions, (x) is the outer product, and Phi is the solid fraction. The sum of V_i sigma_i over the grains is
/// exactly the volume of the cell times static_stress().
template <int Dim>
std::vector<Mat<Dim>> particle_stress(const Packing<Dim>& packing);

/// Returns the pressure of each grain, the trace of its stress divided by Dim (stress).
template <int Dim>
std::vector<double> particle_pressure(const Packing<Dim>& packing);

/// Returns the pressures of the grains, with zero for each pressure whose sign is not significant: a pressure of at most
/// zero_force/a^(Dim-1) in magnitude, where a is the largest diameter.
/// @param pressure    pressure of each grain (stress)
/// @param zero_force  largest force that counts as zero (force)
template <int Dim>
std::vector<double> pressure_beyond_zero(const Packing<Dim>& packing, std::vector<double> pressure,
                                         double zero_force);

/// Returns the pressures as above, with zero for rattlers, too. The forces of rattlers are rounding errors.
/// @param rattler  whether each grain is a rattler
template <int Dim>
std::vector<double> pressure_beyond_zero(const Packing<Dim>& packing, std::vector<double> pressure,
                                         const std::vector<bool>& rattler, double zero_force);

}  // namespace floc
