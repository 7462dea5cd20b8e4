#pragma once

#include <optional>

#include "floc/base/vec.h"

namespace floc {

/// Offset along the first axis of the lattice vector of another axis, imposed by a simple shear.
struct ImposedOffset {
  int axis;       ///< axis of the lattice vector, counted from 0; never 0
  double offset;  ///< component of the lattice vector along the first axis (length)
};

/// Load on the boundary of a packing in equilibrium: a stress or a length on each axis, and the shear of the
/// lattice.
template <int Dim>
struct LoadTarget {
  /// Stress imposed on each axis, compression positive (force/length^(Dim-1)); not used on axes with an imposed
  /// length.
  Vec<Dim> stress = Vec<Dim>::Zero();
  Vec<Dim> side = Vec<Dim>::Zero();  ///< length imposed on an axis (length); zero on axes under stress
  /// Imposed offset of a lattice vector; absent: the lattice is not sheared.
  std::optional<ImposedOffset> offset = {};

  static LoadTarget normal_stress(const Vec<Dim>& stress) { return {stress}; }

  bool strained(int axis) const { return side[axis] > 0.0; }
  bool any_strained() const { return side.maxCoeff() > 0.0; }
  /// Whether zero stress is imposed on every axis.
  bool unloaded() const { return !any_strained() && stress.isZero(0.0); }
  /// Returns the stress on each axis: the imposed stress or, if a length is imposed, the stress that the
  /// packing carries. It determines the force scale.
  /// @param carried  stress of the packing
  Vec<Dim> stress_with(const Mat<Dim>& carried) const {
    Vec<Dim> out = stress;
    for (int a = 0; a < Dim; ++a)
      if (strained(a)) out[a] = carried(a, a);
    return out;
  }
};

}  // namespace floc
