#pragma once

#include <utility>

namespace floc {

/// Static normal force of a contact at one gap, with its elastic and adhesive parts and its stiffnesses. The struct
/// contains all values that the other models of a contact law need from the normal law and the adhesion. Friction and
/// rolling resistance use `elastic`, because the caps on their forces do not depend on the adhesion (docs/physics.md,
/// "Friction"). Dashpots use `touches`, because they act while the surfaces touch.
template <class T>
struct NormalResponse {
  /// Type of the result of a comparison: bool or, if T is a SIMD vector, one bool per lane.
  using Mask = decltype(std::declval<T>() < std::declval<T>());

  T elastic;   ///< elastic part FNe of the normal force, a repulsion >= 0 (force)
  T adhesive;  ///< adhesive part FNa of the normal force, <= 0 (force)
  /// Stiffness -dF/dh of the normal force F (elastic and adhesive part) at the gap h, along the present path of loading
  /// or unloading (force/length).
  T stiffness;
  /// Stiffness -dF/dh of the normal force F (elastic and adhesive part) at the gap h, for small reversible motions
  /// (force/length). Elastic moduli are computed from this stiffness.
  T elastic_stiffness;
  T shear_stiffness = T(0);  ///< tangential stiffness K_T, if the normal law determines it (force/length)
  Mask touches{};            ///< whether the surfaces touch, by the criterion of the normal law

  T force() const { return elastic + adhesive; }
};

}  // namespace floc
