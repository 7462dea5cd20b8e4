#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/lattice_solution.h"

namespace floc {

/// Strength of the elements of a lattice.
struct ElementStrength {
  /// for each ElementKind, the tension at which an element of this kind breaks (force); infinite if it never breaks
  std::array<double, kElementKinds> tension{};

  /// Returns every invalid strength as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// State of a sample when one of its elements breaks.
struct Breakage {
  int element;    ///< index of the broken element in the lattice network
  double strain;  ///< measured component of the strain when the element broke, shortening positive
  double stress;  ///< measured component of the stress when the element broke, compression positive (stress)
};

struct FractureOptions {
  ElementStrength strength;
  /// Share of the largest stress so far, a number in kShare. The simulation ends when the stress has fallen below this
  /// share.
  double end_at = 0.2;
  static constexpr NumberRange kShare{.least = 0.0, .most = 1.0};
  int most_broken = 1'000'000;  ///< largest number of elements that may break; the simulation then ends
  /// Function that is called after each breakage, with the number of broken elements; if it returns false, the
  /// simulation ends.
  std::function<bool(const Breakage&, int n_broken)> observe = {};
};

/// Result of a simulation in which the elements of a sample break one by one.
struct FracturePath {
  std::vector<Breakage> broken;  ///< breakages in the order in which they happened
  /// strength of the sample: largest magnitude of the measured stress during the simulation; 0 if no element can break
  double strength = 0.0;
  double strain_at_strength = 0.0;  ///< measured strain when the measured stress had its largest magnitude
  std::string end;                  ///< reason why the simulation ended, as a sentence
};

/// Simulates the fracture of a sample, one element at a time:
/// 1. The load is increased in proportion to `load` until the first element reaches its strength. Until then
///    all elements are linear, so that this load follows from scaling one solution.
/// 2. This element is removed, and the lattice is solved again.
///
/// The next element may break at a smaller load than the last element. Under constant load, the sample would then fail
/// at once.
/// @param load  direction of the load; its magnitude has no influence
/// @param axis  axis of the load; the result contains the component of strain and stress that measured_component()
///              gives for the load and this axis
/// @throws InputError if an option is invalid
template <int Dim>
[[nodiscard]] FracturePath fracture(const LatticeNetwork<Dim>& network, LatticeSolver<Dim>& solver,
                                    const LatticeLoad<Dim>& load, int axis, const FractureOptions& options);

}  // namespace floc
