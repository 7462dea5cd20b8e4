#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "floc/packing/packing.h"

namespace floc {

/// Stresses of a saved packing that a run imposes at its start.
struct KeptStress {
  /// stress on each axis (force/length^(Dim-1)), which was imposed or resulted from an imposed strain
  std::vector<double> stress;
  int axis = 0;  ///< axis along which the packing was driven, counted from 0
};

/// Saved packing from which a run starts instead of from a gas.
struct SavedStart {
  /// Function that reads the packing from its file. It is called only when the run begins, so that a large packing is
  /// in memory only once.
  std::function<std::variant<Packing<2>, Packing<3>>()> read;
  /// SHA-256 checksum of the file of the packing. The first state of the run records it as the checksum of the parent
  /// state.
  std::string sha256;
  bool has_shapes = false;  ///< whether the grains of the packing have shapes
  /// number of copies of the packing that are joined side by side along each axis
  Vec<3, int> copies = Vec<3, int>::Ones();
  /// Stresses of the saved packing that are imposed at the start; absent if one pressure is imposed on all axes.
  std::optional<KeptStress> kept = {};

  /// Reads the packing from its file.
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

/// Prepares the start of a run from a saved packing: sets the grains to rest, replaces the contact law, and joins
/// copies of the packing side by side. The grains keep their positions and orientations. If the saved packing is in
/// equilibrium and the law does not change, the result is in equilibrium, too.
///
/// Contacts of disks and spheres are found anew from the positions, under the new law. Each contact keeps the
/// elongations of its springs (not their forces); elongations that exceed the limits of the new law are shortened.
/// Springs that only the old law has are removed; springs that only the new law has start with zero elongation. Contact
/// points of grains with shapes keep their repulsive and tangential forces, whatever the law.
/// @param law  contact law of the run
/// @param copies  number of copies along each lattice vector, >= 1
/// @throws InputError if find_contacts() throws it
template <int Dim>
Packing<Dim> start_from(Packing<Dim> saved, const Law& law, const Vec<Dim, int>& copies);

}  // namespace floc
