#pragma once

#include <string>

#include "floc/io/state_file.h"
#include "floc/picture/packing_picture.h"

namespace floc {

/// Quantity of a state that is drawn.
enum class Shown {
  equilibrium,     ///< contact forces
  isotropic_step,  ///< increments of the contact forces if the pressure changes a little
  /// increments of the contact forces if the difference between the stresses on axes 1 and 2 changes a little
  deviatoric_step,
  particle_pressure,  ///< grains coloured by their pressure
  phases,  ///< grains coloured by the sign of their pressure; contacts between grains of the same sign
  kinds,   ///< contact forces of grains with corners, coloured by the kind of contact
  grains,  ///< grains without forces
};

/// Draws a state; the caption gives its pressure, solid fraction and coordination number.
/// @param file  name of the state file, for messages
/// @throws InputError if a mechanism lets the cell deform without resistance, because the contact network then cannot
/// balance a step of stress
template <int Dim>
PackingPicture<Dim> picture_of(const std::string& file, const State<Dim>& state, Shown shown);

/// Draws the changes from one state to another, with the grains at their positions in the first state. The changes are
/// lost and gained contacts, and the displacements of the grains relative to a uniform deformation of all grains with
/// the cell.
/// @throws InputError if the two states do not have the same grains
template <int Dim>
PackingPicture<Dim> picture_of_changes(const std::string& before_file, const State<Dim>& before,
                                       const std::string& after_file, const State<Dim>& after);

}  // namespace floc
