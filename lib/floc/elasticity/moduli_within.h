#pragma once

#include <limits>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"

namespace floc {

/// Largest relative errors allowed in B and G; infinite if any error is allowed.
struct ModuliAccuracy {
  double B = std::numeric_limits<double>::infinity();
  double G = std::numeric_limits<double>::infinity();

  /// Whether the errors of some moduli are within these. A modulus that is known to vanish has no relative
  /// error and counts as within.
  bool met_by(const Moduli& moduli) const;
  /// Returns every fault as "name = value: requirement": at least one of the two has to be finite, and neither
  /// below the rounding error.
  std::vector<std::string> validate() const;
};

/// Returns the methods that need no other state, the cheapest first. For the states of a path of 60 grains they
/// took 0.15, 5.0 and 5.9 ms, and ModuliMethod::iterative 14 ms (`floc tradeoff`, data/tables/tradeoff); for
/// large packings the factor in double precision is cheaper than that in single precision (0.010 against 0.012
/// s at N = 1400, 1.3 against 4.1 s at 90 000, dense, one core).
std::vector<ModuliMethod> moduli_methods_by_cost(int n_grains);

/// Computes moduli by the cheapest of these methods whose own errors are within the accuracy: the bounds where
/// they bound B (Moduli::bounds_hold()), the principal stresses are equal and only B is required; a factor in
/// single precision where it finds no mechanism; the full factor otherwise. The full factor's moduli are
/// returned even if their errors are too large, see `accuracy.met_by()`.
/// @param options  settings of the solution; method and tolerance are replaced
/// @throws InputError with the faults of options and accuracy
template <int Dim>
[[nodiscard]] Moduli moduli_within(const Packing<Dim>& packing, ModuliOptions options,
                                   const ModuliAccuracy& accuracy);

}  // namespace floc
