#pragma once

#include "floc/elasticity/force_increments.h"
#include "floc/network/contact_network.h"
#include "floc/picture/packing_picture.h"

namespace floc {

/// Returns a picture of the forces of a packing: a line between the centres for each interaction, of the size
/// |F| = sqrt(F_N^2 + F_T^2) and of the kind given by the sign of the normal force. The unit is F0, or without
/// adhesion the mean compressive normal force. Rattlers are marked.
/// @param zero_force  largest normal force that counts as zero (force)
template <int Dim>
PackingPicture<Dim> equilibrium_forces(const Packing<Dim>& packing, double zero_force);

/// Returns a picture of the two phases of particle pressure: grains coloured by the sign of their pressure,
/// pale outside the largest connected part of their phase, and the bonds within either phase as lines.
/// Rattlers, and grains whose pressure is no more than zero_force/a^(Dim-1), are in neither phase.
/// @param zero_force  largest normal force that counts as zero (force)
template <int Dim>
PackingPicture<Dim> pressure_phases_of(const Packing<Dim>& packing, double zero_force);

/// Returns a picture of the forces that a small step of stress adds. Contacts that hold 95 % of its elastic
/// energy are lines as in equilibrium_forces(), in the colour of compression where the normal force grows; the
/// others are background. The unit is the stress times the largest diameter, in 3D times its square.
/// @param network  network of the packing   @param step  response of the network
template <int Dim>
PackingPicture<Dim> increment_forces(const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                                     const StepResponse<Dim>& step);

}  // namespace floc
