#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/lattice_solution.h"

namespace floc {

/// Strength of the elements: the tension at which those of each kind break (force). Infinite: never.
struct ElementStrength {
  std::array<double, kElementKinds> tension{};  ///< by ElementKind

  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// One element that broke.
struct Breakage {
  int element;
  double strain;  ///< along the load when it broke, shortening positive
  double stress;  ///< that broke it, compression positive (stress)
};

struct FractureOptions {
  ElementStrength strength;
  /// Ends when the stress has fallen to this share of the largest.
  double end_at = 0.2;  ///< in kShare
  static constexpr NumberRange kShare{.least = 0.0, .most = 1.0};
  int most_broken = 1'000'000;
  /// Called after each breakage; false stops.
  std::function<bool(const Breakage&, int n_broken)> observe = {};
};

/// The breaking of a sample, one element at a time.
struct FracturePath {
  std::vector<Breakage> broken;  ///< in order of breaking
  double strength = 0.0;         ///< largest magnitude of the stress that it bore; 0 where nothing can break
  double strain_at_strength = 0.0;
  std::string end;  ///< why it ended, in words
};

/// Loads a sample in proportion to `load`, removes the first element that reaches its strength, and solves
/// again: the load then needed may be smaller (the sample gives way under a held stress) or larger. Every state
/// is elastic, so the stress that breaks the next element follows by scaling.
/// @param load  direction of the load, any magnitude; `axis`: the component that stress and strain are given of
/// @throws InputError with the faults of the options
template <int Dim>
[[nodiscard]] FracturePath fracture(const LatticeNetwork<Dim>& network, LatticeSolver<Dim>& solver,
                                    const LatticeLoad<Dim>& load, int axis, const FractureOptions& options);

}  // namespace floc
