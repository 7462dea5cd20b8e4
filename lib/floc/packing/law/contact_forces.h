#pragma once

#include <optional>

#include "floc/contact/mobilised.h"
#include "floc/packing/packing.h"

namespace floc {

/// Recomputes the gap, normal, static forces, stiffnesses and flags of one contact by the contact law of the packing.
/// The results follow from the positions of the grains and from the history of the contact. Bonds and rigid contacts
/// keep their forces, which do not follow from the positions. Springs whose forces exceed their caps are shortened. The
/// length of a spring becomes zero if the surfaces have separated or if the law has no model for this spring. The
/// members i, j, image, key and history of `contact` have to be set before the call; all other members are overwritten.
template <int Dim>
void refresh_contact(const Packing<Dim>& packing, Contact<Dim>& contact);

/// Calls refresh_contact() for every contact of a packing and removes contacts whose surfaces are too far apart to
/// interact.
template <int Dim>
void refresh_contacts(Packing<Dim>& packing);

/// Returns whether the surfaces of a contact touch by the criterion of the contact law, at the present gap and history
/// of the contact.
template <int Dim>
bool touches(const Packing<Dim>& packing, const Contact<Dim>& contact);

/// Returns which springs of a contact have forces at their caps. The result follows from the elastic force and the
/// history of the contact. The springs of a distant attraction have no forces and are never at their caps.
/// @param tolerance  largest accepted difference between a force and its cap, as a fraction of the cap
template <int Dim>
Mobilised mobilised(const Law& law, const Contact<Dim>& contact, double tolerance);

/// Completes a contact whose forces were measured or read from a file. The elastic force, the history and all
/// stiffnesses that are not given follow from the contact law. The shear force and the moments are not changed, even if
/// they exceed their caps.
/// @param kn, kt  normal and tangential stiffness of the contact (force/length); an absent stiffness follows from the
/// law
/// @pre the surfaces touch, or are to be treated as touching; normal_force, shear_force and moments are set
template <int Dim>
void set_given_forces(const Packing<Dim>& packing, std::optional<double> kn, std::optional<double> kt,
                      double tolerance, Contact<Dim>& contact);

}  // namespace floc
