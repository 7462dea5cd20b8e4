#pragma once

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Determines the space that a packing fills from the data in its file (`listed.space`) and from the options of the
/// user. Sets the members cell, cell_place, ends and gravity of `listed`, in two or three dimensions.
///
/// The first of the following that is given determines the dimension:
///   1. the option `--dimension`
///   2. the number of vectors in the option `--cell`
///   3. the dimension in the file. If none is given, the dimension is guessed. Grains with different z are spheres.
/// Grains that all have the same z are spheres in two cases: the cell has tilts along z, or the packing is periodic
/// along z and the cell is so low that each grain slightly overlaps its own image along z. In all other cases the
/// grains are disks.
///
/// The first of the following that is given determines the boundary along an axis:
///   1. the option `--walls`
///   2. the option `--cell`: the axis is periodic
///   3. the file: the axis is periodic, or each end of the axis has a wall or is open.
/// If none is given, the axis is taken as periodic. The open ends of an axis are placed at the outermost points of the
/// grains.
///
/// A sentence about each guess is added to `listed.remarks`. The guess that grains are disks is doubtful if some of
/// them, as spheres, would touch their own images; the sentence is then added to `listed.inconsistencies`.
/// @param listed  on input, contains the space and the grains
/// @return 2 or 3
/// @throws InputError for a packing without grains, a periodic axis without a lattice vector, a cell that is skewed
/// across walls, a wall that cuts off more than a tenth of a grain's radius, or gravity in a packing that is periodic
/// along every axis
int settle_space(const ImportOptions& options, ListedPacking& listed);

/// Checks that all grains of a two-dimensional packing have the same z.
/// @throws InputError naming a grain with another z
void require_one_plane(const ListedPacking& listed);

}  // namespace floc
