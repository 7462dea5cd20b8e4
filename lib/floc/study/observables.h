#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "floc/elasticity/moduli.h"
#include "floc/packing/state.h"

namespace floc {

/// What users quote of one state: solid fraction, coordination by sign of the normal force, bulk and shear
/// modulus, Reuss bound, force scales of the exponential tails of compressive and of tensile forces over F1.
enum Observable { kPhi, kZPlus, kZMinus, kB, kG, kBReuss, kTailPlus, kTailMinus, kObservables };

/// Their names in tables, and after them those of what is fitted to a whole path.
inline constexpr std::array<const char*, kObservables> kObservableNames = {
    "phi", "z_plus", "z_minus", "B", "G", "B_reuss", "tail_plus", "tail_minus"};
inline constexpr std::array<const char*, 3> kFittedNames = {"lambda", "alpha", "Phi_max"};

/// One value each, not a number where undefined (no tension, fewer than 10 forces in a tail, ...).
using Observation = std::array<double, kObservables>;

/// @param state   forces and residuals in its contact list
/// @param moduli  which level they are computed at, and what is kept from state to state
Observation observe(const State<2>& state, ModuliSequence<2>& moduli);

/// Only what `moduli` gives, the others as in `other`.
Observation observe_moduli(const State<2>& state, ModuliSequence<2>& moduli, const Observation& other);

/// What a difference of observable k is measured against: its size, the mean of both observations; of a part of
/// z the whole.
double size_of(int k, const Observation& x, const Observation& y);

}  // namespace floc
