#pragma once

#include <limits>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"

namespace floc {

/// Largest accepted relative errors of the moduli B and G; infinite for a modulus whose error does not matter.
struct ModuliAccuracy {
  double B = std::numeric_limits<double>::infinity();
  double G = std::numeric_limits<double>::infinity();

  /// Returns whether the errors of B and G in `moduli` are within these limits. If a modulus is known to be zero, its
  /// limit counts as met, because a zero has no relative error.
  bool met_by(const Moduli& moduli) const;
  /// Returns every invalid limit as "name = value: requirement". At least one of the limits on B and G has to be
  /// finite, and none may be below the rounding error.
  std::vector<std::string> validate() const;
};

/// Returns those methods of computing moduli that need no previous state, in ascending order of their cost. For the
/// states of a loading path of 60 grains, ModuliMethod::bounds, single_factor and factor took 0.15, 5.0 and 5.9 ms per
/// state; ModuliMethod::iterative took 14 ms (`floc tradeoff`, data/tables/tradeoff). For large packings a factor in
/// double precision is cheaper than a factor in single precision: 0.010 s and 0.012 s for 1400 grains, 1.3 s and 4.1 s
/// for 90 000 (dense packings, one core).
std::vector<ModuliMethod> moduli_methods_by_cost(int n_grains);

/// Computes moduli by the cheapest of three methods whose errors are within `accuracy`:
/// 1. The mean of the bounds: if the bounds are guaranteed (Moduli::bounds_hold()), the principal stresses are equal,
/// and only B is required.
/// 2. A factor in single precision: if it finds no mechanism.
/// 3. A factor in double precision. The moduli of this method are returned even if their errors are too large;
/// accuracy.met_by() tells whether the errors are small enough.
///
/// @param options   options of the solution; their method and tolerance are replaced
/// @param accuracy  largest relative errors of B and G
/// @throws InputError if an option or the accuracy is invalid
template <int Dim>
[[nodiscard]] Moduli moduli_within(const Packing<Dim>& packing, ModuliOptions options,
                                   const ModuliAccuracy& accuracy);

}  // namespace floc
