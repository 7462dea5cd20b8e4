#pragma once

#include "floc/elasticity/force_increments.h"
#include "floc/network/contact_network.h"
#include "floc/picture/packing_picture.h"

namespace floc {

/// The forces a packing carries: a line between the centres for each interaction, |F| = sqrt(F_N^2 + F_T^2),
/// its kind by the sign of the normal force. The unit is F0, or without adhesion the mean compressive normal
/// force. Rattlers are marked.
/// @param zero_force  largest normal force that counts as zero (force)
PackingPicture equilibrium_forces(const Packing<2>& packing, double zero_force);

/// What a small step of stress adds to the forces: lines as above for the contacts that hold 95 % of its
/// elastic energy, compression where the normal force grows; the others are background. The unit is the largest
/// diameter times the stress.
/// @param network  of the packing   @param step  of the network
PackingPicture increment_forces(const Packing<2>& packing, const ContactNetwork<2>& network,
                                const StepResponse<2>& step);

}  // namespace floc
