#pragma once

#include <optional>

#include "floc/contact/mobilised.h"
#include "floc/packing/packing.h"

namespace floc {

/// Recomputes gap, normal, static forces, stiffnesses and flags of one contact from the positions of its grains
/// and what it remembers, by the packing's law. Springs beyond their cap are cut back; those of a parted
/// contact, or of a slot that the law does not have, are cleared. `contact.i`, `j`, `image` and the history are
/// read, everything else is written.
template <int Dim>
void refresh_contact(const Packing<Dim>& packing, Contact<Dim>& contact);

/// The same for every contact of the packing; contacts out of the law's range are removed.
template <int Dim>
void refresh_contacts(Packing<Dim>& packing);

/// Whether the surfaces of a contact touch at its gap, by the law and by what the contact remembers.
template <int Dim>
bool touches(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Which springs of a contact are at their caps, by its elastic force and its history; none for a distant
/// attraction.
/// @param tolerance  relative distance below the cap that still counts as being at it
template <int Dim>
Mobilised mobilised(const Law& law, const Contact<Dim>& contact, double tolerance);

/// Gives a contact of a packing forces that were measured or read: the elastic part, the history and any
/// stiffness not given follow from the law. Shear force and moments are taken as they are, capped or not.
/// @param kn, kt  stiffnesses of the contact (force/length), those of the law where absent
/// @pre the contact touches, or is to be taken as touching; normal_force, shear_force and moments are set
template <int Dim>
void set_given_forces(const Packing<Dim>& packing, std::optional<double> kn, std::optional<double> kt,
                      double tolerance, Contact<Dim>& contact);

}  // namespace floc
