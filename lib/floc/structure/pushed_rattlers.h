#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns a packing with its rattlers pushed against other grains. Numbers of neighbours at small gaps then do not
/// depend on where rattlers lie between the grains around them [AR2007]. Each rattler is pushed towards the grain
/// nearest to it, and half as much towards the second nearest, and slides along the grains that it meets until Dim
/// grains stop it. Only grains that are not rattlers are obstacles, so the result depends neither on the numbering of
/// the grains nor on the borders of the periodic cell. A rattler that meets no grain within two largest diameters stays
/// at its place. The contacts are copied from the given packing, and are wrong for the rattlers that have moved.
///
/// @param rattler  whether each grain is a rattler (a grain that carries no force)
template <int Dim>
Packing<Dim> with_pushed_rattlers(const Packing<Dim>& packing, const std::vector<bool>& rattler);

}  // namespace floc
