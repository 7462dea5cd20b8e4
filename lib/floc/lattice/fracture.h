#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/lattice_solution.h"

namespace floc {

/// Strength of the elements: the tension at which elements of each kind break (force); infinite if they never
/// break.
struct ElementStrength {
  std::array<double, kElementKinds> tension{};  ///< by ElementKind

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// One element that broke.
struct Breakage {
  int element;
  double strain;  ///< along the load when it broke, shortening positive
  double stress;  ///< stress at which it broke, compression positive (stress)
};

struct FractureOptions {
  ElementStrength strength;
  /// Share of the largest stress at which the breaking ends.
  double end_at = 0.2;  ///< in kShare
  static constexpr NumberRange kShare{.least = 0.0, .most = 1.0};
  int most_broken = 1'000'000;
  /// Called after each breakage; false stops.
  std::function<bool(const Breakage&, int n_broken)> observe = {};
};

/// Fracture of a sample, one element at a time.
struct FracturePath {
  std::vector<Breakage> broken;  ///< in order of breaking
  double strength = 0.0;         ///< largest magnitude of the stress carried; 0 if no element can break
  double strain_at_strength = 0.0;
  std::string end;  ///< reason for which the breaking ended, in words
};

/// Loads a sample in proportion to `load`, removes the first element that reaches its strength, and solves
/// again. The load that breaks the next element may be smaller (under a held stress the sample would fail at
/// once) or larger. Every state is elastic, so the stress that breaks the next element follows by scaling.
/// @param load  direction of the load, of any magnitude
/// @param axis  component whose stress and strain are reported
/// @throws InputError with the faults of the options
template <int Dim>
[[nodiscard]] FracturePath fracture(const LatticeNetwork<Dim>& network, LatticeSolver<Dim>& solver,
                                    const LatticeLoad<Dim>& load, int axis, const FractureOptions& options);

}  // namespace floc
