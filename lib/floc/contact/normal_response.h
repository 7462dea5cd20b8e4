#pragma once

#include <utility>

namespace floc {

/// Static normal force of a contact at one gap, with its elastic and adhesive parts and its stiffnesses. The
/// other models of a law read nothing else of the normal law and the adhesion. Friction and rolling resistance
/// read `elastic`, because their caps do not depend on the adhesion (docs/physics.md, "Friction"); dashpots
/// read `touches`, because they act while the surfaces touch.
template <class T>
struct NormalResponse {
  /// Bool, or one bool per lane of a SIMD vector.
  using Mask = decltype(std::declval<T>() < std::declval<T>());

  T elastic;    ///< elastic part FNe of the normal force, a repulsion >= 0 (force)
  T adhesive;   ///< adhesive part FNa of the normal force, <= 0 (force)
  T stiffness;  ///< -dF/dh of the force F = FNe + FNa over the gap h, along the path taken (force/length)
  /// -dF/dh of the force F over the gap h for small reversible motions, used for elastic moduli (force/length).
  T elastic_stiffness;
  T shear_stiffness = T(0);  ///< tangential stiffness K_T, if the normal law determines it (force/length)
  Mask touches{};            ///< whether the surfaces touch, as the normal law defines it

  T force() const { return elastic + adhesive; }
};

}  // namespace floc
