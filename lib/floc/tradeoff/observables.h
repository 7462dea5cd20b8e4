#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "floc/elasticity/moduli.h"
#include "floc/packing/state.h"

namespace floc {

/// Observables of one state that are usually reported: solid fraction, coordination numbers of contacts in compression
/// and in tension, bulk and shear modulus, Reuss bound of the bulk modulus, and decay forces of the exponential tails
/// of the distributions of compressive and tensile forces, over the typical force F1.
enum Observable { kPhi, kZPlus, kZMinus, kB, kG, kBReuss, kTailPlus, kTailMinus, kObservables };

/// Names of the observables in tables, followed by the names of the quantities fitted to a whole path.
inline constexpr std::array<const char*, kObservables> kObservableNames = {
    "phi", "z_plus", "z_minus", "B", "G", "B_reuss", "tail_plus", "tail_minus"};
inline constexpr std::array<const char*, 3> kFittedNames = {"lambda", "alpha", "Phi_max"};

/// Values of all observables of a state. A value is NaN if it is undefined, for example for fewer than 10 forces in a
/// tail or without tension.
using Observation = std::array<double, kObservables>;

/// Returns the observables of a state.
/// @param state  state with forces and residuals in its contact list
/// @param moduli  computes the moduli by a method and with a tolerance; it may start from the solution of the previous
/// state
Observation observe(const State<2>& state, ModuliSequence<2>& moduli);

/// Returns the observables of a state, of which only the moduli are computed by `moduli`; all others are copied from
/// `other`.
Observation observe_moduli(const State<2>& state, ModuliSequence<2>& moduli, const Observation& other);

/// Returns the size with which a difference of observable number k is compared: the mean absolute value in both
/// observations. For z_plus and z_minus it is the mean of the total coordination number.
double size_of(int k, const Observation& x, const Observation& y);

}  // namespace floc
