#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// The space that a file of another program lists its grains in.
struct ListedSpace {
  std::string place;  ///< for messages
  /// Three lattice vectors with three components each (length); empty: the file has none.
  std::vector<std::vector<double>> cell;
  /// Whether the packing is periodic along each of them; empty: the file does not say.
  std::vector<bool> periodic;
  /// The words that say so and what they should be, for messages: pbc="F F F", expected T in every direction.
  std::string boundary;
  std::optional<int> dimension;  ///< none: the file does not say
  /// Whether the grains lie in the middle of the third side, where LAMMPS asks for them in two dimensions.
  bool mid_plane = false;
};

/// The dimension of a packing and the part of its cell that it uses, from `--dimension`, the number of vectors of
/// `--cell`, what the file states, or else from grains and cell: grains of different z are spheres, and so are those
/// of one z in a cell with tilts along it, or in a periodic cell so low that each touches its own image across z;
/// any others of one z are disks, as programs without a second dimension lay them out. What is guessed, and that a
/// file does not say whether it is periodic, goes into `remarks` or, where disks would touch as spheres, `inconsistencies`.
/// @param listed  with its grains; cell and cell_place are set
/// @throws InputError naming place and words of a file that is not periodic and not given another cell
int settle_space(const ListedSpace& space, const ImportOptions& options, ListedPacking& listed);

/// @throws InputError if the grains of a packing in two dimensions lie at different heights
void require_one_plane(const ListedPacking& listed);

}  // namespace floc
