#pragma once

#include "floc/elasticity/force_increments.h"
#include "floc/network/contact_network.h"
#include "floc/picture/packing_picture.h"

namespace floc {

/// Returns a picture of the contact forces of a packing. Each interaction is drawn as a line between the grain centres.
/// The width of the line shows the magnitude of the force, and the colour shows the sign of the normal force. The unit
/// of force is the pull-off force or, without adhesion, the mean compressive normal force. Rattlers are marked.
/// @param zero_force  largest normal force that counts as zero (force)
template <int Dim>
PackingPicture<Dim> equilibrium_forces(const Packing<Dim>& packing, double zero_force);

/// Returns a picture of the two phases of a packing: the grains with positive pressure (under pressure) and the grains
/// with negative pressure (under tension). The colour of a grain shows the sign of its pressure, and is pale outside
/// the largest connected cluster of each phase. Contacts between grains of the same phase are drawn as lines. Neither
/// phase contains rattlers, or grains whose pressure is at most zero_force/a^(Dim-1) in magnitude, where a is the
/// largest diameter.
/// @param zero_force  largest normal force that counts as zero (force)
template <int Dim>
PackingPicture<Dim> pressure_phases_of(const Packing<Dim>& packing, double zero_force);

/// Returns a picture of the contact forces of grains with corners. The colour of a line shows the kind of the contact.
/// In 3D, a contact is between a vertex and a face or two edges (one point), between an edge and a face (two points),
/// or between two faces. In 2D, a contact is between a vertex and a side, or between two sides. The kind follows from
/// the number of points with a force, see contact_pairs(). Rattlers are marked.
/// @param zero_force  largest normal force that counts as zero (force)
/// @throws InputError if the grains are disks or spheres
template <int Dim>
PackingPicture<Dim> contact_kinds_of(const Packing<Dim>& packing, double zero_force);

/// Returns a picture of the changes of the contact forces when the stress changes by a small increment. The contacts
/// that together contain 95 % of the elastic energy of the increment are drawn as lines whose width shows the change of
/// the force. A line has the colour of compression if the normal force grows, and the colour of tension if the normal
/// force falls. The other contacts are thin background lines. The unit of the changes of force is the increment of
/// stress times a (in 3D, a^2), where a is the largest diameter.
/// @param network  contact network of the packing
/// @param step  response of the network to the increment of stress
template <int Dim>
PackingPicture<Dim> increment_forces(const Packing<Dim>& packing, const ContactNetwork<Dim>& network,
                                     const StepResponse<Dim>& step);

}  // namespace floc
