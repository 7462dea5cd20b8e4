#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "floc/elasticity/moduli.h"
#include "floc/packing/state.h"

namespace floc {

/// What users quote about one state: solid fraction, coordination by sign of the normal force, bulk and shear
/// modulus, Reuss bound, force scales of the exponential tails of compressive and of tensile forces over F1.
enum Observable { kPhi, kZPlus, kZMinus, kB, kG, kBReuss, kTailPlus, kTailMinus, kObservables };

/// Their names in tables, followed by those of the quantities fitted to a whole path.
inline constexpr std::array<const char*, kObservables> kObservableNames = {
    "phi", "z_plus", "z_minus", "B", "G", "B_reuss", "tail_plus", "tail_minus"};
inline constexpr std::array<const char*, 3> kFittedNames = {"lambda", "alpha", "Phi_max"};

/// One value each, not a number where undefined (no tension, fewer than 10 forces in a tail, ...).
using Observation = std::array<double, kObservables>;

/// @param state   forces and residuals in its contact list
/// @param moduli  sets the level at which they are computed, and keeps what one state leaves for the next
Observation observe(const State<2>& state, ModuliSequence<2>& moduli);

/// Only what `moduli` gives, the others as in `other`.
Observation observe_moduli(const State<2>& state, ModuliSequence<2>& moduli, const Observation& other);

/// The scale that a difference of observable k is compared with: its size, the mean of both observations; for a
/// part of z, that of the whole z.
double size_of(int k, const Observation& x, const Observation& y);

}  // namespace floc
