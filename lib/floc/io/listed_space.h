#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Cell, periodicity and dimension of a packing as given in a file of another program.
struct ListedSpace {
  std::string place;  ///< place in the file, for messages
  /// Three lattice vectors with three components each (length); empty: the file gives no cell.
  std::vector<std::vector<double>> cell;
  /// Whether the packing is periodic along each lattice vector; empty: not given in the file.
  std::vector<bool> periodic;
  /// Text of the file about periodicity and the expected text, for messages, such as: pbc="F F F", expected T in every
  /// direction.
  std::string boundary;
  std::optional<int> dimension;  ///< 2 or 3; absent: not given in the file
  /// Whether the grains lie in the middle of the third side of the cell, as LAMMPS requires in two dimensions.
  bool mid_plane = false;
};

/// Decides the dimension of a packing, and sets the lattice vectors of this dimension. The first of these that is given
/// decides: `--dimension`, the number of vectors of `--cell`, the dimension in the file. If none is given, the
/// dimension is guessed from grains and cell. Grains of different z are spheres. Grains that all have the same z are
/// spheres if the cell has tilts along z, or if it is periodic and so low that each grain touches its own image along
/// z. Otherwise they are disks. A sentence about a guess, or about a periodicity that the file does not give, is added
/// to `remarks`, or to `inconsistencies` if some grains would touch their own images if they were spheres.
/// @param listed  contains the grains on input; its members cell and cell_place are set
/// @return 2 or 3
/// @throws InputError if the file says that the packing is not periodic, unless the user gives a cell
int settle_space(const ListedSpace& space, const ImportOptions& options, ListedPacking& listed);

/// Checks that all disks have the same z. @throws InputError naming a grain at a different height
void require_one_plane(const ListedPacking& listed);

}  // namespace floc
