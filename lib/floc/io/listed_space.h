#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Cell, periodicity and dimension that a file of another program gives for a packing.
struct ListedSpace {
  std::string place;  ///< place of these data in the file, for messages
  /// Three lattice vectors with three components each (length). Empty: the file gives no cell.
  std::vector<std::vector<double>> cell;
  /// Whether the packing is periodic along each lattice vector. Empty: the file does not say so.
  std::vector<bool> periodic;
  /// Words of the file about the periodicity, and the expected words, for messages, such as: pbc="F F F", expected T in
  /// every direction.
  std::string boundary;
  std::optional<int> dimension;  ///< 2 or 3; absent: the file does not give it
  /// Whether the grains lie in the middle of the cell along its third side, as LAMMPS requires in two dimensions.
  bool mid_plane = false;
};

/// Decides whether a packing is 2D or 3D, and sets the cell of `listed` to lattice vectors of this dimension. The first
/// of the following that is given determines the dimension:
///   1. the option `--dimension`
///   2. the number of vectors in the option `--cell`
///   3. the dimension in the file.
/// If none is given, the dimension is guessed. Grains with different z are spheres. Grains that all have the same z are
/// spheres if the cell has tilts along z, or if it is periodic along z and so low that each grain touches its own image
/// along z by a small overlap. Otherwise they are disks.
///
/// A sentence about the guess is added to `listed.remarks` or, if the grains are taken as disks but some would touch
/// their own images if they were spheres, to `listed.inconsistencies`. A sentence is also added to `listed.remarks` if
/// the file does not say whether the packing is periodic; it is then taken as periodic.
/// @param listed  contains the grains on input; its members cell and cell_place are set
/// @return 2 or 3
/// @throws InputError if the file says that the packing is not periodic, unless the user gives a cell
int settle_space(const ListedSpace& space, const ImportOptions& options, ListedPacking& listed);

/// Checks that all grains of a two-dimensional packing have the same z. @throws InputError naming a grain with another
/// z
void require_one_plane(const ListedPacking& listed);

}  // namespace floc
