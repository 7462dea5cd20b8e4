#pragma once

#include <optional>
#include <string>

#include "floc/io/listed_packing.h"
#include "floc/packing/packing.h"

/// Forces and stiffnesses of listed contacts.
namespace floc {

/// Forces that the file lists for a contact. The forces act on the first grain of the contact.
template <int Dim>
struct GivenForces {
  std::optional<double> normal;
  std::optional<Vec<Dim>> shear;
  std::optional<RotationVector<Dim>> rolling;
  /// Twisting moment; its sign does not change if the two grains are exchanged.
  std::optional<double> twisting;
};

/// Returns the listed forces of a contact, divided into components along the contact normal and across it.
/// @param reversed  whether the first grain of the contact is the second body in the row
/// @param normal  unit vector from the first body of the contact to the second
/// @throws InputError if listed forces contradict each other
template <int Dim>
GivenForces<Dim> given_forces(const ListedContact& listed, bool reversed, const Vec<Dim>& normal);

/// Replaces the forces and stiffnesses of a contact, which the law gave, by the listed forces and stiffnesses.
/// @throws InputError if a listed tangential, rolling or twisting force or stiffness does not exist in the law
template <int Dim>
void set_forces(const Packing<Dim>& packing, const ListedContact& listed, const GivenForces<Dim>& given,
                Contact<Dim>& c);

/// Checks one stiffness of a contact, if the file lists it.
/// @param name  name of the column of the stiffness
/// @param right  whether `value` is allowed
/// @param expected  description of the allowed values, for the message
/// @throws InputError if `value` is listed and not allowed
void require_stiffness(const ListedContact& listed, const char* name, const std::optional<double>& value,
                       bool right, const std::string& expected);

/// Checks that the stiffnesses of a contact across the normal and against rotations are not negative.
/// @throws InputError if one of them is negative
void require_stiffnesses(const ListedContact& listed);

}  // namespace floc
