#pragma once

#include "floc/base/random.h"
#include "floc/packing/packing.h"

namespace floc {

/// How a packing is shaken before it is compressed again.
struct Vibration {
  double dilation = 1.0;    ///< of all lengths first, so that no grain touches another
  double collisions = 0.0;  ///< per grain; each event counts for two grains
};

/// Lets hard, smooth grains move freely in a cell at rest and collide elastically, event by event, until each
/// has had that many collisions on average. Exact up to rounding; contacts of the packing are not touched.
/// @pre no two grains overlap, and some move
template <int Dim>
void collide(Packing<Dim>& packing, double collisions);

/// Shakes a packing: dilates it, forgets its contacts, gives the grains Maxwell velocities, lets them collide
/// and stops them [AR2007]. Spins, which smooth grains keep, are zero.
/// @throws InputError if grains still overlap after the dilation
template <int Dim>
void vibrate(Packing<Dim>& packing, const Vibration& vibration, RandomStream& random);

}  // namespace floc
