#pragma once

#include <string>

#include "floc/io/state_file.h"
#include "floc/picture/packing_picture.h"

namespace floc {

/// Quantity of a state that a picture shows.
enum class Shown {
  equilibrium,        ///< contact forces
  isotropic_step,     ///< increments of the contact forces in a small step of pressure
  deviatoric_step,    ///< increments of the contact forces in a small step of sigma_1 - sigma_2
  particle_pressure,  ///< pressure of each grain, as its colour
  phases,             ///< grains under pressure and under tension, and the bonds within either kind
  grains,             ///< grains alone
};

/// Draws a state, with its numbers as caption.
/// @throws InputError if a step of stress has no solution because of a mechanism
template <int Dim>
PackingPicture<Dim> picture_of(const std::string& file, const State<Dim>& state, Shown shown);

/// Draws the changes from one state to another on the geometry of the first: contacts lost and gained, and the
/// displacements of the grains without their affine part.
/// @throws InputError if the two states are not of the same grains
template <int Dim>
PackingPicture<Dim> picture_of_changes(const std::string& before_file, const State<Dim>& before,
                                       const std::string& after_file, const State<Dim>& after);

}  // namespace floc
