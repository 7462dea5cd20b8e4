#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns the stress of each grain, compression positive (force/length^(Dim-1)):
///
///   sigma_i = -(1/V_i) sum_j f_(j on i) (x) l_i,   V_i = volume of the grain / Phi
///
/// with l_i the arm from the centre to the contact point, static forces, all interactions. The sum of V_i
/// sigma_i over the grains is the volume of the cell times static_stress(), exactly.
template <int Dim>
std::vector<Mat<Dim>> particle_stress(const Packing<Dim>& packing);

/// Returns the pressure of each grain: trace of its stress over Dim.
template <int Dim>
std::vector<double> particle_pressure(const Packing<Dim>& packing);

/// Returns the pressures whose sign is significant; others are set to zero. These are the pressures of
/// rattlers, whose forces are rounding, and pressures of at most zero_force/a^(Dim-1), the one of a force
/// `zero_force` on the largest grain.
/// @param pressure  of each grain (stress)
template <int Dim>
std::vector<double> pressure_beyond_zero(const Packing<Dim>& packing, std::vector<double> pressure,
                                         const std::vector<bool>& rattler, double zero_force);

}  // namespace floc
