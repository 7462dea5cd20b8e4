#pragma once

#include "floc/base/lanes.h"
#include "floc/contact/contact_load.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/pair_geometry.h"

namespace floc::test {

/// Normal law under which surfaces that have touched stay connected across a gap, as in the law of Johnson, Kendall and
/// Roberts [Proc. R. Soc. A 324, 301 (1971)]. For connected surfaces with an overlap d (negative for a gap) above -l,
/// the elastic force is FNe = K_N (d + l) and the adhesion is FNa = -K_N l. The surfaces separate at a gap l under a
/// tension of K_N l. When they meet, the force is zero, and the energy K_N l^2/2 is lost.
struct StickySpring {
  double normal_stiffness;  ///< K_N (force/length)
  double holding_gap;       ///< l (length)

  static constexpr bool kAdheres = true;
  static constexpr History kHistory[] = {
      {"has_met", HistoryKind::scalar, Unit::ratio, "1 while the surfaces touch, else 0"}};

  template <class T>
  void remember(const PairGeometry<T>& pair, T* history) const {
    const T holds = lanes::select(pair.gap < T(holding_gap), history[0], T(0));
    history[0] = lanes::select(pair.gap < T(0), T(1), holds);
  }
  template <class T>
  T force(const PairGeometry<T>& pair, const T* history) const {
    return lanes::select(touches(pair, history), T(normal_stiffness) * (T(holding_gap) - pair.gap), T(0));
  }
  template <class T>
  T attraction(const PairGeometry<T>& pair, const T* history) const {
    return lanes::select(touches(pair, history), T(-normal_stiffness * holding_gap), T(0));
  }
  template <class T>
  T stiffness(const PairGeometry<T>& pair, const T* history) const {
    return lanes::select(touches(pair, history), T(normal_stiffness), T(0));
  }
  /// Elastic energy K_N (d + l)^2/2. The energy of adhesion is -K_N l (d + l). Both energies are zero when the surfaces
  /// separate.
  template <class T>
  T energy(const PairGeometry<T>& pair, const T* history) const {
    const T elastic = force(pair, history);
    return T(0.5 / normal_stiffness) * elastic * elastic;
  }
  template <class T>
  T attraction_energy(const PairGeometry<T>& pair, const T* history) const {
    return T(-holding_gap) * force(pair, history);
  }
  template <class T>
  auto touches(const PairGeometry<T>& pair, const T* history) const {
    return pair.gap < lanes::select(T(0) < history[0], T(holding_gap), T(0));
  }
  void set_force(const PairGeometry<>&, double, double* history) const { history[0] = 1.0; }
  double holding_range(double /*reduced_radius*/) const { return holding_gap; }
  double pull_off_force(const PairGeometry<>&) const { return normal_stiffness * holding_gap; }
  double stiffness_at_force(const PairGeometry<>&, double) const { return normal_stiffness; }
  double stiffness_bound(const PairGeometry<>&, const ContactLoad&) const { return normal_stiffness; }
};

}  // namespace floc::test
