#pragma once

#include <algorithm>
#include <cmath>

#include "floc/base/lanes.h"
#include "floc/contact/contact_load.h"
#include "floc/contact/declaration.h"
#include "floc/contact/model_traits.h"
#include "floc/contact/pair_geometry.h"

namespace floc::test {

/// A normal law with one stiffness while the overlap grows beyond what it ever was and another one below that
/// [Walton and Braun, J. Rheol. 30, 949 (1986)], for tests of laws that remember: the contact loses energy where
/// the second is the larger one, and would gain it where it is smaller. The surfaces part as soon as they no longer
/// press, at an overlap that the larger stiffness leaves.
struct HystereticRepulsion {
  double normal_stiffness;  ///< K1, while the overlap grows (force/length)
  double unloading;         ///< K2, below the largest overlap (force/length)

  static constexpr Memory kMemory[] = {{"largest_overlap", MemoryKind::scalar, Unit::length, ""}};

  template <class T>
  void remember(const PairGeometry<T>& pair, T* memory) const {
    memory[0] = lanes::select(pair.gap < T(0), lanes::max(memory[0], T(-pair.gap)), T(0));
  }
  template <class T>
  T force(const PairGeometry<T>& pair, const T* memory) const {
    const T unloaded = T(normal_stiffness) * memory[0] - T(unloading) * (memory[0] + pair.gap);
    return lanes::select(pair.gap < T(0), lanes::max(unloaded, T(0)), T(0));
  }
  template <class T>
  T stiffness(const PairGeometry<T>& pair, const T* memory) const {
    const T slope = lanes::select(T(0) < memory[0] + pair.gap, T(unloading), T(normal_stiffness));
    return lanes::select(touches(pair, memory), slope, T(0));
  }
  template <class T>
  T elastic_stiffness(const PairGeometry<T>& pair, const T* memory) const {
    return lanes::select(touches(pair, memory), T(unloading), T(0));
  }
  /// What unloading gives back.
  template <class T>
  T energy(const PairGeometry<T>& pair, const T* memory) const {
    const T elastic = force(pair, memory);
    return T(0.5 / unloading) * elastic * elastic;
  }
  template <class T>
  auto touches(const PairGeometry<T>& pair, const T* memory) const {
    return T(0) < force(pair, memory);
  }
  /// At its gap the contact carries this force on the line of unloading.
  void set_force(const PairGeometry<>& pair, double elastic, double* memory) const {
    const double left = -pair.gap - elastic / unloading;  // overlap at which the surfaces would part
    memory[0] = unloading > normal_stiffness
                    ? std::max(-pair.gap, left * unloading / (unloading - normal_stiffness))
                    : -pair.gap;
  }
  double stiffness_at_force(const PairGeometry<>&, double) const { return unloading; }
  double stiffness_bound(const PairGeometry<>&, const ContactLoad&) const { return unloading; }
};

}  // namespace floc::test
