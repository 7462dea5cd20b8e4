#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "floc/elasticity/moduli.h"
#include "floc/packing/state.h"

namespace floc {

/// Observables of one state that are usually reported: solid fraction; coordination number of contacts in compression,
/// and of contacts in tension; bulk modulus; shear modulus; Reuss bound on the bulk modulus; decay force of the
/// exponential tail of the distribution of compressive contact forces, and of that of tensile forces, over the typical
/// force F1.
enum Observable { kPhi, kZPlus, kZMinus, kB, kG, kBReuss, kTailPlus, kTailMinus, kObservables };

/// Names of the observables in tables; kFittedNames has the names of the quantities fitted to a whole path.
inline constexpr std::array<const char*, kObservables> kObservableNames = {
    "phi", "z_plus", "z_minus", "B", "G", "B_reuss", "tail_plus", "tail_minus"};
inline constexpr std::array<const char*, 3> kFittedNames = {"lambda", "alpha", "Phi_max"};

/// Values of all observables of a state. A value is NaN if it is undefined, for example the tail of a force
/// distribution if fewer than 10 forces are beyond the mean.
using Observation = std::array<double, kObservables>;

/// Returns the observables of a state.
/// @param state  state with forces and residuals in its contact list
/// @param moduli  computes the elastic moduli; its iteration may start from the solution for the previous state
Observation observe(const State<2>& state, ModuliSequence<2>& moduli);

/// Returns the observables of a state, of which only the elastic moduli are computed.
/// @param moduli  computes the moduli
/// @param other  observables of this state; all values except the moduli are copied from it
Observation observe_moduli(const State<2>& state, ModuliSequence<2>& moduli, const Observation& other);

/// Returns the size by which a difference between two observations is divided to give a relative difference: the mean
/// of the two absolute values. The coordination numbers z_plus and z_minus are compared with the mean of their sum,
/// because one of them may be near zero.
/// @param k  number of the observable
double size_of(int k, const Observation& x, const Observation& y);

}  // namespace floc
