#pragma once

#include <string>

#include "floc/io/state_file.h"
#include "floc/picture/packing_picture.h"

namespace floc {

/// What of a state a picture shows.
enum class Shown {
  equilibrium,        ///< the forces it carries
  isotropic_step,     ///< what a small step of pressure adds to them
  deviatoric_step,    ///< what a small step of sigma_1 - sigma_2 adds
  particle_pressure,  ///< as the colour of the grains
  phases,             ///< grains under pressure and under tension, and the bonds within either kind
  grains,             ///< nothing but grains
};

/// The picture of a state, its numbers as caption.
/// @throws InputError where a mechanism leaves a step of stress without a solution
template <int Dim>
PackingPicture<Dim> picture_of(const std::string& file, const State<Dim>& state, Shown shown);

/// What changed from one state to another, on the geometry of the first: contacts lost and gained, where the
/// grains went with the affine part taken off.
/// @throws InputError where the two are not of the same grains
template <int Dim>
PackingPicture<Dim> picture_of_changes(const std::string& before_file, const State<Dim>& before,
                                       const std::string& after_file, const State<Dim>& after);

}  // namespace floc
