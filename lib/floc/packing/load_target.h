#pragma once

#include <optional>

#include "floc/base/vec.h"

namespace floc {

/// How far the lattice vector of an axis reaches along the first axis: what a simple shear imposes.
struct ImposedOffset {
  int axis;       ///< of the lattice vector, not the first
  double offset;  ///< (length)
};

/// What an equilibrium imposes on the boundary: on each axis a stress or a length, and how much it is sheared.
template <int Dim>
struct LoadTarget {
  Vec<Dim> stress = Vec<Dim>::Zero();  ///< on axes under stress, compression positive (force/length^(Dim-1))
  Vec<Dim> side = Vec<Dim>::Zero();    ///< of the other axes (length); zero on axes under stress
  std::optional<ImposedOffset> offset = {};  ///< absent: the lattice is not sheared

  static LoadTarget normal_stress(const Vec<Dim>& stress) { return {stress}; }

  bool strained(int axis) const { return side[axis] > 0.0; }
  bool any_strained() const { return side.maxCoeff() > 0.0; }
  /// Whether nothing is imposed but zero stress.
  bool unloaded() const { return !any_strained() && stress.isZero(0.0); }
  /// The stress imposed on each axis, or carried where no stress is imposed. It sets the scale of forces.
  /// @param carried  stress of the packing
  Vec<Dim> stress_with(const Mat<Dim>& carried) const {
    Vec<Dim> out = stress;
    for (int a = 0; a < Dim; ++a)
      if (strained(a)) out[a] = carried(a, a);
    return out;
  }
};

}  // namespace floc
