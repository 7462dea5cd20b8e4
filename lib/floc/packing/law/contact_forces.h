#pragma once

#include <optional>

#include "floc/contact/mobilised.h"
#include "floc/packing/packing.h"

namespace floc {

/// Recomputes gap, normal, static forces, stiffnesses and flags of one contact from the positions of its grains
/// and its history, by the packing's law. Springs beyond their cap are shortened to it; springs of a contact
/// that has parted, or of a slot that the law does not have, are set to zero. `contact.i`, `j`, `image` and the
/// history are read, all other members are written.
template <int Dim>
void refresh_contact(const Packing<Dim>& packing, Contact<Dim>& contact);

/// Refreshes every contact of the packing: refresh_contact() for each. Contacts out of the law's range are
/// removed.
template <int Dim>
void refresh_contacts(Packing<Dim>& packing);

/// Whether the surfaces of a contact touch, by the law of the packing at the contact's gap and history.
template <int Dim>
bool touches(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Springs of a contact that are at their caps, by its elastic force and its history; none for a distant
/// attraction.
/// @param tolerance  relative distance below the cap that still counts as being at it
template <int Dim>
Mobilised mobilised(const Law& law, const Contact<Dim>& contact, double tolerance);

/// Completes a contact whose forces were measured or read from a file: its elastic force, its history and any
/// stiffness not given follow from the law. Shear force and moments are not changed, even beyond their caps.
/// @param kn, kt  stiffnesses of the contact (force/length), those of the law where absent
/// @pre the contact touches, or is to be taken as touching; normal_force, shear_force and moments are set
template <int Dim>
void set_given_forces(const Packing<Dim>& packing, std::optional<double> kn, std::optional<double> kt,
                      double tolerance, Contact<Dim>& contact);

}  // namespace floc
