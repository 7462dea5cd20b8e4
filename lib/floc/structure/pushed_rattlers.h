#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// The packing with its rattlers pushed against the others, so that neighbours at small gaps do not depend on
/// where in their cages they were left [AR2007]. Each is pushed towards the grain nearest to it, and half as
/// much towards the second nearest, and slides along what it meets until Dim grains hold it. Only grains that
/// are not rattlers are obstacles, so the outcome depends neither on numbering nor on where the cell is cut. A
/// rattler that meets nothing within two largest diameters stays where it is. Contacts of the result are those
/// of the given packing, and mean nothing for rattlers.
///
/// @param rattler  one entry per grain
template <int Dim>
Packing<Dim> with_pushed_rattlers(const Packing<Dim>& packing, const std::vector<bool>& rattler);

}  // namespace floc
