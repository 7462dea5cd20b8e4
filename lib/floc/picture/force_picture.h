#pragma once

#include "floc/elasticity/force_increments.h"
#include "floc/network/contact_network.h"
#include "floc/picture/packing_picture.h"

namespace floc {

/// The forces a packing carries: a line between the centres for each interaction, |F| = sqrt(F_N^2 + F_T^2),
/// its kind by the sign of the normal force. The unit is F0, or without adhesion the mean compressive normal
/// force. Rattlers are marked.
/// @param zero_force  largest normal force that counts as zero (force)
template <int Dim>
PackingPicture<Dim> equilibrium_forces(const Packing<Dim>& packing, double zero_force);

/// The two phases of particle pressure: grains by the sign of their pressure, pale outside the largest
/// connected part of their phase, and the bonds within either phase as lines. Rattlers, and grains whose
/// pressure is no more than the zero force over a^(Dim-1), are in neither.
template <int Dim>
PackingPicture<Dim> pressure_phases_of(const Packing<Dim>& packing, double zero_force);

/// What a small step of stress adds to the forces: lines as in equilibrium_forces() for the contacts that hold
/// 95 % of its elastic energy, compression where the normal force grows; the others are background. The unit is
/// the stress times the largest diameter, in 3D its square.
/// @param network  of the packing   @param step  of the network
template <int Dim>
PackingPicture<Dim> increment_forces(const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                                     const StepResponse<Dim>& step);

}  // namespace floc
