#pragma once

#include <optional>

#include "floc/base/vec.h"

namespace floc {

/// Offset of the lattice vector of an axis along the first axis, imposed by a simple shear.
struct ImposedOffset {
  int axis;       ///< axis of the lattice vector, > 0
  double offset;  ///< (length)
};

/// Load on the boundary of an equilibrium: a stress or a length on each axis, and the shear of the lattice.
template <int Dim>
struct LoadTarget {
  Vec<Dim> stress =
      Vec<Dim>::Zero();  ///< stress on axes under stress, compression positive (force/length^(Dim-1))
  Vec<Dim> side = Vec<Dim>::Zero();  ///< length imposed on other axes (length); zero on axes under stress
  std::optional<ImposedOffset> offset = {};  ///< absent: the lattice is not sheared

  static LoadTarget normal_stress(const Vec<Dim>& stress) { return {stress}; }

  bool strained(int axis) const { return side[axis] > 0.0; }
  bool any_strained() const { return side.maxCoeff() > 0.0; }
  /// Whether zero stress is imposed on every axis.
  bool unloaded() const { return !any_strained() && stress.isZero(0.0); }
  /// Stress imposed on each axis, or carried where a length is imposed. It sets the scale of forces.
  /// @param carried  stress of the packing
  Vec<Dim> stress_with(const Mat<Dim>& carried) const {
    Vec<Dim> out = stress;
    for (int a = 0; a < Dim; ++a)
      if (strained(a)) out[a] = carried(a, a);
    return out;
  }
};

}  // namespace floc
