#pragma once

#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Returns the packing with its rattlers pushed against other grains, so that neighbours at small gaps do not
/// depend on the places of rattlers in their cages [AR2007]. Each rattler is pushed towards the grain nearest
/// to it, and half as much towards the second nearest, and slides along the grains it meets until Dim grains
/// hold it. Only grains that are not rattlers are obstacles, so the result depends neither on numbering nor on
/// where the cell is cut. A rattler that meets no grain within two largest diameters stays where it is.
/// Contacts of the result are those of the given packing, and have no meaning for rattlers.
///
/// @param rattler  one entry per grain
template <int Dim>
Packing<Dim> with_pushed_rattlers(const Packing<Dim>& packing, const std::vector<bool>& rattler);

}  // namespace floc
