#pragma once

#include <functional>
#include <string>
#include <variant>

#include "floc/packing/packing.h"

namespace floc {

/// Saved packing from which a run starts, in place of a gas.
struct SavedStart {
  /// Function that reads the packing. It is called only when the run begins, so that a large packing is held in
  /// memory only once.
  std::function<std::variant<Packing<2>, Packing<3>>()> read;
  /// Hash of the file of the packing, recorded as the parent of the first state.
  std::string sha256;
  Vec<3, int> copies = Vec<3, int>::Ones();  ///< number of copies side by side along each axis

  /// Reads the packing. @pre the packing has Dim dimensions
  template <int Dim>
  Packing<Dim> read_packing() const {
    return std::get<Packing<Dim>>(read());
  }
  template <int Dim>
  Vec<Dim, int> copies_along() const {
    return copies.head<Dim>();
  }
};

/// Prepares the start of a run from a saved packing: sets the grains to rest, replaces the contact law and
/// tiles the packing. Grains keep their positions and orientations. Contacts follow from the positions and the
/// new law. Each contact keeps the elongations of its springs (not their forces), shortened to the caps of the
/// new law. Springs of a model that the new law does not have are dropped; springs of an added model start at
/// rest. Tiling an equilibrium under its own law gives the same equilibrium.
/// @param copies  number of copies along each lattice vector, >= 1
/// @throws InputError if find_contacts() throws it
template <int Dim>
Packing<Dim> start_from(Packing<Dim> saved, const Law& law, const Vec<Dim, int>& copies);

}  // namespace floc
