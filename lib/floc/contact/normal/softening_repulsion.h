#pragma once

#include <cmath>

#include "floc/base/lanes.h"
#include "floc/contact/declaration.h"
#include "floc/contact/pair_geometry.h"

namespace floc {

/// Repulsion that softens with the largest overlap D a contact has had: FNe = K_N d (1 - D/(2 l)) at overlap d, D counted
/// up to l, where half of the stiffness is left. Unloading and reloading below D are linear.
struct SofteningRepulsion {
  double normal_stiffness;  ///< K_N of a new contact (force/length)
  double softening_length;  ///< l (length)

  static constexpr const char* kKeyword = "softening";
  static constexpr Number<SofteningRepulsion> kNumbers[] = {
      {"stiffness", &SofteningRepulsion::normal_stiffness, Unit::stiffness, "K_N", Requirement::positive,
       "a positive number (K_N, force per length)", "normal stiffness of a new contact"},
      {"length", &SofteningRepulsion::softening_length, Unit::length, "l_soft", Requirement::positive,
       "a positive number (length)", "overlap at which half of the stiffness is left"}};
  static constexpr Memory kMemory[] = {
      {"largest_overlap", MemoryKind::scalar, Unit::length, "largest overlap so far; 0 for surfaces apart"}};

  /// Called before the force in every motion.
  template <class T>
  void remember(const PairGeometry<T>& pair, T* memory) const {
    memory[0] = lanes::select(pair.gap < T(0), lanes::max(memory[0], T(-pair.gap)), T(0));
  }
  template <class T>
  T force(const PairGeometry<T>& pair, const T* memory) const {
    const T overlap = lanes::max(T(0), T(-pair.gap));
    return T(normal_stiffness) * overlap * (T(1) - T(0.5 / softening_length) * largest(overlap, memory));
  }
  template <class T>
  T stiffness(const PairGeometry<T>& pair, const T* memory) const {
    const T overlap = lanes::max(T(0), T(-pair.gap));
    const T half = T(0.5 / softening_length);
    // As long as this overlap is the largest, and counts, more of it softens the contact further.
    const T still_softens =
        lanes::select(overlap < memory[0], T(0), lanes::select(overlap < T(softening_length), T(1), T(0)));
    const T slope = T(normal_stiffness) * (T(1) - half * largest(overlap, memory)) -
                    T(normal_stiffness) * overlap * half * still_softens;
    return lanes::select(pair.gap < T(0), slope, T(0));
  }
  /// Of a contact that is loaded for the first time.
  template <class T>
  T energy(const PairGeometry<T>& pair) const {
    const T overlap = lanes::max(T(0), T(-pair.gap));
    const T soft = lanes::min(overlap, T(softening_length));
    return T(0.5 * normal_stiffness) * soft * soft * (T(1) - T(1.0 / (3.0 * softening_length)) * soft) +
           T(0.25 * normal_stiffness) * (overlap * overlap - soft * soft);
  }
  /// Stiffness where the elastic force is FNe > 0: that of a contact of which only the force is known, taken as new.
  double stiffness_at_force(double) const { return normal_stiffness; }
  /// Modulus of a packing of grains of diameter a that a pressure is measured against: K_N/a^(Dim-2).
  double modulus(int dim, double diameter) const { return normal_stiffness / std::pow(diameter, dim - 2); }
  /// No contact is stiffer.
  double stiffness_bound() const { return normal_stiffness; }

  bool operator==(const SofteningRepulsion&) const = default;

 private:
  template <class T>
  T largest(const T& overlap, const T* memory) const {
    return lanes::min(lanes::max(memory[0], overlap), T(softening_length));
  }
};

}  // namespace floc
