#pragma once

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "floc/elasticity/moduli.h"
#include "floc/fitting/shear_test.h"
#include "floc/packing/state.h"
#include "floc/scene/scene.h"

namespace floc {

/// Observables that a study compares, in the order of declared_observables().
enum Observable {
  kPhi,
  kZPlus,
  kZMinus,
  kB,
  kG,
  kBReuss,
  kTailPlus,
  kTailMinus,
  kLambda,
  kAlpha,
  kPhiMax,
  kZ,
  kRattlers,
  kForceMoment,
  kMobilised,
  kWallContacts,
  kLateralRatio,
  kStressRatio,
  kBridges,
  kBridgeVolume,
  kPairs,
  kIndeterminacy,
  kForceFreedom,
  kK0,
  kConstrainedModulus,
  kPeakRatio,
  kCriticalRatio,
  kDilatancy,
  kLatticeE,
  kLatticeSpread,
  kTailGrain,
  kTailMatrix,
  kTailForces,
  kObservables
};

/// Values of all observables of a state. A value is NaN if it is undefined, for example the tail of a force
/// distribution with fewer than 10 forces above the mean. The values of observables of whole paths, and of observables
/// that the scene does not have, are NaN, too.
using Observation = std::array<double, kObservables>;

/// Data from which the value of an observable is computed.
enum class ObservableSource {
  state,   ///< one state: its geometry and its forces
  moduli,  ///< the elastic moduli of one state; their error depends on the method that computes them
  path,    ///< all states of a path, for example a fit to them
  lattice  ///< the lattice of cemented grains under a load, see lattice_study.h
};

/// Quantities of one state from which the values of observables are computed. A member is NaN if the state does not
/// have the quantity, for example a quantity of rigid contacts in a packing of elastic grains.
struct StateMeasures {
  double solid_fraction = 0.0;
  double z = 0.0, z_plus = 0.0, z_minus = 0.0, rattlers = 0.0;
  /// decay forces of two exponential tails, divided by the force scale F1: the tail of the compressive and the tail of
  /// the tensile forces
  double tail_plus = 0.0, tail_minus = 0.0;
  double force_moment = 0.0, mobilised = 0.0;
  double wall_contacts = 0.0, lateral_ratio = 0.0, stress_ratio = 0.0;
  double bridges = 0.0, bridge_volume = 0.0;
  double pairs = 0.0, indeterminacy = 0.0, force_freedom = 0.0;
  double B = 0.0, G = 0.0, B_reuss = 0.0;
};

/// Declaration of an observable: its name, its unit, its meaning, and its value in one state.
/// has_observable() of scene_observables.h gives the scenes that have it.
struct DeclaredObservable {
  const char* name;
  const char* unit;  ///< unit: "1", "F1" (the force scale) or "stress"
  const char* meaning;
  ObservableSource source;
  /// Function that returns the value in one state; null for observables of whole paths (path_value()) and of lattices.
  double (*value)(const StateMeasures&);
};

/// Returns all observables, in the order of `Observable`. New observables are added at the end, because tables and
/// scripts may rely on the order of earlier observables.
const std::array<DeclaredObservable, kObservables>& declared_observables();

/// Returns the names of all observables.
std::vector<std::string> observable_names();

/// Subject of a study: the states of a scene, or the lattice of its grains after a matrix has cemented them.
enum class Subject { states, lattice };

/// Returns the kind of a study as text: scene_kind() or, for cemented grains, "disks-cemented" or "spheres-cemented".
std::string kind_of_study(const Scene& scene, Subject subject);

/// Whether a study of this scene and subject has the observable.
bool applies(const DeclaredObservable& observable, const Scene& scene, Subject subject);

/// Returns the names of the observables that a study of this scene and subject has.
std::vector<std::string> observable_names(const Scene& scene, Subject subject);

/// Returns the unit of an observable in a scene: "1", "F1" (the force scale) or, for stresses, "Pa" ("N/m" in 2D) in SI
/// units and "reduced" in reduced units.
std::string unit_of(const DeclaredObservable& observable, const Scene& scene);

/// Requires that a study of this scene and subject has the observables with these names.
/// @throws InputError that names the first missing observable, the kind of the study, and the existing observable with
/// the most similar name
void require_observables(const std::vector<std::string>& names, const Scene& scene, Subject subject);

/// Returns the observables of a state, without the elastic moduli if the grains are rigid.
/// @param state  state with forces and residuals in its contact list
/// @param moduli  object that computes the elastic moduli; an iterative method may start from the solution for the
/// previous state
template <int Dim>
Observation observe(const State<Dim>& state, ModuliSequence<Dim>& moduli);

/// Returns the observables of a state except the elastic moduli, which are NaN.
/// @param state  state with forces in its contact list
template <int Dim>
Observation observe_structure(const State<Dim>& state);

/// Returns the observables of a state. The elastic moduli are computed, and all other values are copied from `other`.
/// @param moduli  object that computes the moduli
/// @param other  observables of this state, with moduli that were computed in another way
template <int Dim>
Observation observe_moduli(const State<Dim>& state, ModuliSequence<Dim>& moduli, const Observation& other);

/// Returns the stresses and strains of a state if it belongs to a test that drives one axis; otherwise absent.
template <int Dim>
std::optional<ShearPoint> test_point(const State<Dim>& state);

/// Returns the stresses at the start of the test to which a state belongs, with zero strains; absent if the state
/// belongs to no test.
template <int Dim>
std::optional<ShearPoint> start_of_test(const State<Dim>& state);

/// Returns the divisor that turns a difference between two observations into a relative difference: the mean of the two
/// absolute values. For each of the coordination numbers z_plus and z_minus, the divisor is instead the sum z_plus +
/// z_minus, averaged over the two observations, because one of the coordination numbers may be near zero.
/// @param k  number of the observable
double size_of(int k, const Observation& x, const Observation& y);

}  // namespace floc
