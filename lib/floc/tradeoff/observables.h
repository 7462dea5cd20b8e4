#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "floc/elasticity/moduli.h"
#include "floc/packing/state.h"

namespace floc {

/// Observables of one state that users quote: solid fraction, coordination by sign of the normal force, bulk and
/// shear modulus, Reuss bound, and force scales of the exponential tails of compressive and of tensile forces over
/// F1.
enum Observable { kPhi, kZPlus, kZMinus, kB, kG, kBReuss, kTailPlus, kTailMinus, kObservables };

/// Names of the observables in tables, and those of the quantities fitted to a whole path, which follow them.
inline constexpr std::array<const char*, kObservables> kObservableNames = {
    "phi", "z_plus", "z_minus", "B", "G", "B_reuss", "tail_plus", "tail_minus"};
inline constexpr std::array<const char*, 3> kFittedNames = {"lambda", "alpha", "Phi_max"};

/// Values of the observables; NaN if undefined (no tension, fewer than 10 forces in a tail, ...).
using Observation = std::array<double, kObservables>;

/// Computes the observables of a state.
/// @param state   state with forces and residuals in its contact list
/// @param moduli  sets the level at which they are computed; the solution of one state may start the next
Observation observe(const State<2>& state, ModuliSequence<2>& moduli);

/// Computes only the observables that `moduli` gives; the others are taken from `other`.
Observation observe_moduli(const State<2>& state, ModuliSequence<2>& moduli, const Observation& other);

/// Returns the scale that a difference of observable k is compared with: the mean size of both observations or, for a
/// part of z, that of the whole z.
double size_of(int k, const Observation& x, const Observation& y);

}  // namespace floc
