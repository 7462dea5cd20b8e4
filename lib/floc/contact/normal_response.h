#pragma once

#include <utility>

namespace floc {

/// Static normal response of a contact at one gap, repulsion and adhesion together. Other slots read nothing
/// else of the normal law and the adhesion: friction and rolling read `elastic`, because their caps do not
/// depend on the adhesion (docs/physics.md, "Friction"), and dashpots act while the surfaces touch.
template <class T>
struct NormalResponse {
  using Mask = decltype(std::declval<T>() < std::declval<T>());  ///< bool, or one per lane

  T elastic;                 ///< elastic repulsion FNe, >= 0 (force)
  T adhesive;                ///< adhesive part FNa, <= 0 (force)
  T stiffness;               ///< dF/d(overlap) = -dF/dh of the sum, along the path taken (force/length)
  T elastic_stiffness;       ///< -dF/dh for small reversible motions, used by the network (force/length)
  T shear_stiffness = T(0);  ///< K_T, where the normal law gives one (force/length)
  Mask touches{};            ///< whether the surfaces touch, as the law defines it

  T force() const { return elastic + adhesive; }
};

}  // namespace floc
