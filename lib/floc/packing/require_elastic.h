#pragma once

#include <string>

#include "floc/base/error.h"
#include "floc/packing/packing.h"

namespace floc {

/// Checks that the contacts of a packing are elastic.
/// @param what  computation that needs stiffnesses, as the first part of the sentence "... only for elastic contacts"
/// @param place  name of the packing in the message, such as its file
/// @throws InputError if the contacts are rigid
template <int Dim>
void require_elastic(const Packing<Dim>& packing, const std::string& what,
                     const std::string& place = "packing") {
  if (packing.law.is_rigid())
    throw InputError(place, "the contacts of this packing are rigid and have no stiffness; " + what +
                                " only for elastic contacts. floc run and floc convert can give a packing "
                                "elastic contacts by another contact law");
}

/// Checks that all grains of a packing are disks or spheres.
/// @param what  computation that is valid for round grains, as the first part of the sentence "... only for disks and
/// spheres"
/// @param place  name of the packing in the message, such as its file
/// @throws InputError if grains have corners
template <int Dim>
void require_round(const Packing<Dim>& packing, const std::string& what, const std::string& place = "packing") {
  if (!packing.grains.are_round())
    throw InputError(place, "the grains of this packing have corners; " + what + " only for disks and spheres");
}

}  // namespace floc
