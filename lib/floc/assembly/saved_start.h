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
  std::string sha256;                        ///< of its file, the parent of the first state
  Vec<3, int> copies = Vec<3, int>::Ones();  ///< side by side along each axis

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

/// The start of a run from a saved packing: at rest, under another contact law, tiled. Grains keep their places
/// and orientations. Contacts are those that positions and law give; each keeps the springs it had
/// (displacements, not forces), cut back to the caps of the law. Springs of a slot that the law does not have
/// are lost, those of a new one begin at rest. The tiling of an equilibrium under its own law is that
/// equilibrium.
/// @param copies  along each lattice vector, >= 1
/// @throws InputError as find_contacts()
template <int Dim>
Packing<Dim> start_from(Packing<Dim> saved, const Law& law, const Vec<Dim, int>& copies);

}  // namespace floc
