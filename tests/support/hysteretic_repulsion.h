#pragma once

#include <algorithm>
#include <cmath>

#include "floc/base/lanes.h"
#include "floc/contact/contact_load.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/pair_geometry.h"

namespace floc::test {

/// Normal law with two stiffnesses: K1 while the overlap is larger than ever before, and K2 at smaller overlaps [Walton
/// and Braun, J. Rheol. 30, 949 (1986)]. Tests use it as a law with a history. A contact dissipates energy if K2 > K1,
/// and would gain energy if K2 < K1. Surfaces separate when the force becomes zero. For K2 > K1, this happens while the
/// grains still overlap.
struct HystereticRepulsion {
  double normal_stiffness;  ///< K1, while the overlap grows (force/length)
  double unloading;         ///< K2, below the largest overlap (force/length)

  static constexpr History kHistory[] = {{"largest_overlap", HistoryKind::scalar, Unit::length, ""}};

  template <class T>
  void remember(const PairGeometry<T>& pair, T* history) const {
    history[0] = lanes::select(pair.gap < T(0), lanes::max(history[0], T(-pair.gap)), T(0));
  }
  template <class T>
  T force(const PairGeometry<T>& pair, const T* history) const {
    const T unloaded = T(normal_stiffness) * history[0] - T(unloading) * (history[0] + pair.gap);
    return lanes::select(pair.gap < T(0), lanes::max(unloaded, T(0)), T(0));
  }
  template <class T>
  T stiffness(const PairGeometry<T>& pair, const T* history) const {
    const T slope = lanes::select(T(0) < history[0] + pair.gap, T(unloading), T(normal_stiffness));
    return lanes::select(touches(pair, history), slope, T(0));
  }
  template <class T>
  T elastic_stiffness(const PairGeometry<T>& pair, const T* history) const {
    return lanes::select(touches(pair, history), T(unloading), T(0));
  }
  /// Elastic energy that the contact gives back when it is unloaded.
  template <class T>
  T energy(const PairGeometry<T>& pair, const T* history) const {
    const T elastic = force(pair, history);
    return T(0.5 / unloading) * elastic * elastic;
  }
  template <class T>
  auto touches(const PairGeometry<T>& pair, const T* history) const {
    return T(0) < force(pair, history);
  }
  /// Sets the history so that the contact is on the unloading line and its elastic force is `elastic` at the present
  /// gap.
  void set_force(const PairGeometry<>& pair, double elastic, double* history) const {
    const double left = -pair.gap - elastic / unloading;  // overlap at which the surfaces separate
    history[0] = unloading > normal_stiffness
                     ? std::max(-pair.gap, left * unloading / (unloading - normal_stiffness))
                     : -pair.gap;
  }
  double stiffness_at_force(const PairGeometry<>&, double) const { return unloading; }
  double stiffness_bound(const PairGeometry<>&, const ContactLoad&) const { return unloading; }
};

}  // namespace floc::test
