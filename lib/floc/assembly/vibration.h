#pragma once

#include "floc/base/random.h"
#include "floc/packing/packing.h"

namespace floc {

/// Vibration of a packing before it is compressed again.
struct Vibration {
  /// Factor by which all lengths are multiplied before the motion, so that no grains touch.
  double dilation = 1.0;
  double collisions = 0.0;  ///< mean number of collisions per grain; each collision counts for two grains
};

/// Moves the grains as hard, smooth bodies in a cell at rest, with elastic collisions, event by event, until
/// each grain has had `collisions` collisions on average. The motion is exact up to rounding. The contacts of
/// the packing are not changed.
/// @pre no two grains overlap, and some grains move
template <int Dim>
void collide(Packing<Dim>& packing, double collisions);

/// Shakes a packing [AR2007]: dilates it, removes its contacts, gives the grains random velocities (Maxwell
/// distribution), lets them collide (collide()) and stops them. Their spins are zero afterwards.
/// @throws InputError if grains still overlap after the dilation
template <int Dim>
void vibrate(Packing<Dim>& packing, const Vibration& vibration, RandomStream& random);

}  // namespace floc
