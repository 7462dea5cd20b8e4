#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Cell, periodicity and dimension as a file of another program gives them.
struct ListedSpace {
  std::string place;  ///< place in the file, for messages
  /// Three lattice vectors with three components each (length); empty: the file has none.
  std::vector<std::vector<double>> cell;
  /// Whether the packing is periodic along each vector; empty: not given in the file.
  std::vector<bool> periodic;
  /// Words of the file about periodicity and the expectation, for messages: pbc="F F F", expected T in every direction.
  std::string boundary;
  std::optional<int> dimension;  ///< none: not given in the file
  /// Whether the grains lie in the middle of the third side, where LAMMPS requires them in two dimensions.
  bool mid_plane = false;
};

/// Decides the dimension of a packing, and takes the part of the cell that this dimension uses. The first of these
/// that is given decides: `--dimension`, the number of vectors of `--cell`, the dimension that the file states.
/// Otherwise grains and cell decide. Grains of different z are spheres. Grains of one z are spheres too if the cell
/// has tilts along z, or if it is periodic and so low that each grain touches its own image across z. Any others of
/// one z are disks, as programs without a second dimension list them. A note about a guess, or about a periodicity
/// that the file does not give, is added to `remarks`, or to `inconsistencies` if the disks would touch as spheres.
/// @param listed  grains on input; cell and cell_place are set
/// @return 2 or 3
/// @throws InputError naming place and words of a file that is not periodic if no other cell is given
int settle_space(const ListedSpace& space, const ImportOptions& options, ListedPacking& listed);

/// Checks that all disks have the same z. @throws InputError naming a grain at a different height
void require_one_plane(const ListedPacking& listed);

}  // namespace floc
