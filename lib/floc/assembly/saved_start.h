#pragma once

#include <functional>
#include <string>
#include <variant>

#include "floc/packing/packing.h"

namespace floc {

/// A saved packing that a run starts from in place of a gas.
struct SavedStart {
  /// Called when the run begins, so that a large packing is held only once.
  std::function<std::variant<Packing<2>, Packing<3>>()> read;
  std::string sha256;                        ///< hash of the file, the parent of the first state
  Vec<3, int> copies = Vec<3, int>::Ones();  ///< number of copies side by side along each axis

  /// @pre the packing has Dim dimensions
  template <int Dim>
  Packing<Dim> read_packing() const {
    return std::get<Packing<Dim>>(read());
  }
  template <int Dim>
  Vec<Dim, int> copies_along() const {
    return copies.head<Dim>();
  }
};

/// Prepares the start of a run from a saved packing: at rest, under another contact law, tiled. Grains keep
/// their positions and orientations. Contacts follow from the positions and the law. Each keeps its springs
/// (displacements, not forces), shortened to the caps of the law. Springs of a slot that the law does not have
/// are dropped; those of a new slot start at rest. Tiling an equilibrium under its own law gives the same
/// equilibrium.
/// @param copies  number of copies along each lattice vector, >= 1
/// @throws InputError as find_contacts()
template <int Dim>
Packing<Dim> start_from(Packing<Dim> saved, const Law& law, const Vec<Dim, int>& copies);

}  // namespace floc
