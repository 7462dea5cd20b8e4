#pragma once

#include <limits>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"

namespace floc {

/// Largest relative errors that solving may leave in B and G; infinite: any.
struct ModuliAccuracy {
  double B = std::numeric_limits<double>::infinity();
  double G = std::numeric_limits<double>::infinity();

  /// Whether the errors that come with moduli are within these. A modulus that is known to vanish has no
  /// relative error, and counts as within.
  bool met_by(const Moduli& moduli) const;
  /// Every fault as "name = value: requirement": one of the two is asked for, no less than rounding leaves.
  std::vector<std::string> validate() const;
};

/// Methods that need no other state, the cheapest first. For the states of a path of 60 grains they took 0.15,
/// 5.0 and 5.9 ms, and ModuliMethod::iterative 14 ms (`floc tradeoff`, data/tables/tradeoff); for large
/// packings the factor is the cheaper of the two (0.010 against 0.012 s at N = 1400, 1.3 against 4.1 s at 90
/// 000, dense, one core).
std::vector<ModuliMethod> moduli_methods_by_cost(int n_grains);

/// Moduli by the cheapest of these methods whose own errors are within what is asked: the bounds where they
/// bound B (Moduli::bounds_hold()), the principal stresses are equal and nothing else is wanted, a single-precision factor where it finds no mechanism, the full factor otherwise. The last is given
/// even where its errors are not within, see `accuracy.met_by()`.
/// @param options  of the solution; method and tolerance are chosen
/// @throws InputError with the faults of options and accuracy
template <int Dim>
[[nodiscard]] Moduli moduli_within(const Packing<Dim>& packing, ModuliOptions options,
                                   const ModuliAccuracy& accuracy);

}  // namespace floc
