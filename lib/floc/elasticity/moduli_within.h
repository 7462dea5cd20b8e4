#pragma once

#include <limits>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"

namespace floc {

/// Largest relative errors allowed in the moduli B and G; infinite if any error is allowed.
struct ModuliAccuracy {
  double B = std::numeric_limits<double>::infinity();
  double G = std::numeric_limits<double>::infinity();

  /// Returns whether the errors of the given moduli are within these limits. A modulus that is known to be zero has no
  /// relative error and counts as within the limits.
  bool met_by(const Moduli& moduli) const;
  /// Returns every invalid limit as "name = value: requirement": at least one of the two limits has to be finite, and
  /// none may be below the rounding error.
  std::vector<std::string> validate() const;
};

/// Returns the methods that need no previous state, the cheapest first. For the states of a path of 60 grains they took
/// 0.15, 5.0 and 5.9 ms; ModuliMethod::iterative took 14 ms (`floc tradeoff`, data/tables/tradeoff). For large packings
/// a factor in double precision is cheaper than one in single precision (0.010 s and 0.012 s for 1400 grains, 1.3 s and
/// 4.1 s for 90 000, dense packings, one core).
std::vector<ModuliMethod> moduli_methods_by_cost(int n_grains);

/// Computes moduli by the cheapest method of moduli_methods_by_cost() whose errors are within the accuracy. The bounds
/// are used if they are guaranteed (Moduli::bounds_hold()), the principal stresses are equal and only B is required; a
/// factor in single precision is used if it finds no mechanism; otherwise the factor in double precision is used. Its
/// moduli are returned even if their errors are too large, see accuracy.met_by().
/// @param options  settings of the solution; method and tolerance are replaced
/// @throws InputError if an option or the accuracy is invalid
template <int Dim>
[[nodiscard]] Moduli moduli_within(const Packing<Dim>& packing, ModuliOptions options,
                                   const ModuliAccuracy& accuracy);

}  // namespace floc
