#pragma once

#include <optional>

#include "floc/base/vec.h"

namespace floc {

/// Simple shear imposed on the periodic cell: the component of one lattice vector along the first axis.
struct ImposedOffset {
  int axis;       ///< axis of the lattice vector, counted from 0; never 0
  double offset;  ///< component of the lattice vector along the first axis (length)
};

/// Load imposed on a packing: for each axis a stress or a side length of the cell, and possibly a simple shear of the
/// cell.
template <int Dim>
struct LoadTarget {
  /// Stress imposed on each axis, compression positive (force/length^(Dim-1)); not used on axes with an imposed side
  /// length.
  Vec<Dim> stress = Vec<Dim>::Zero();
  /// Side length of the cell imposed on each axis (length); zero on axes with an imposed stress.
  Vec<Dim> side = Vec<Dim>::Zero();
  /// Simple shear imposed on the cell; absent if the cell is not sheared.
  std::optional<ImposedOffset> offset = {};

  static LoadTarget normal_stress(const Vec<Dim>& stress) { return {stress}; }

  bool strained(int axis) const { return side[axis] > 0.0; }
  bool any_strained() const { return side.maxCoeff() > 0.0; }
  /// Whether zero stress is imposed on every axis.
  bool unloaded() const { return !any_strained() && stress.isZero(0.0); }
  /// Returns the stress on each axis for the force scale: the imposed stress or, on an axis with an imposed side
  /// length, the present stress of the packing.
  /// @param carried  present stress of the packing
  Vec<Dim> stress_with(const Mat<Dim>& carried) const {
    Vec<Dim> out = stress;
    for (int a = 0; a < Dim; ++a)
      if (strained(a)) out[a] = carried(a, a);
    return out;
  }
};

}  // namespace floc
