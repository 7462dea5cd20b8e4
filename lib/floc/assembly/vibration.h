#pragma once

#include "floc/base/random.h"
#include "floc/packing/packing.h"

namespace floc {

/// Vibration of a packing: the grains are moved apart, collide for some time, and are then compressed again.
struct Vibration {
  /// Factor by which the cell and the distances between the centres of grains are multiplied at the start, to separate
  /// all grains.
  double dilation = 1.0;
  /// mean number of collisions of a grain; each collision counts for both of its grains
  double collisions = 0.0;
};

/// Moves the grains as hard, smooth bodies that collide elastically in a cell at rest, until a grain has had
/// `collisions` collisions on average. There are no time steps: the motion is computed from collision to collision and
/// is exact up to rounding. The list of contacts of the packing is not changed.
/// @pre no two grains overlap, and some grains move
template <int Dim>
void collide(Packing<Dim>& packing, double collisions);

/// Vibrates a packing [AR2007]: moves its grains apart (Vibration::dilation), removes its contacts, gives the grains
/// random velocities (Maxwell distribution), lets the grains collide (collide()), and sets their velocities and spins
/// to zero.
/// @throws InputError if grains still overlap after they have been moved apart
template <int Dim>
void vibrate(Packing<Dim>& packing, const Vibration& vibration, RandomStream& random);

}  // namespace floc
