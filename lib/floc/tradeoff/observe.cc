#include <cmath>
#include <numeric>

#include "floc/base/error.h"
#include "floc/elasticity/indeterminacy.h"
#include "floc/fitting/force_distribution.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/rigid/static_forces.h"
#include "floc/structure/axial_test.h"
#include "floc/structure/coordination.h"
#include "floc/structure/force_moments.h"
#include "floc/tradeoff/observables.h"

namespace floc {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Fits an exponential tail to the forces above their mean, and returns the decay force (force); NaN if the fit is not
/// possible.
/// @param sign  1 for the tail of the compressive normal forces, -1 for the tail of the tensile normal forces
template <int Dim>
double tail_of(const Packing<Dim>& packing, double sign) {
  std::vector<double> sizes;
  for (const Contact<Dim>& c : packing.contacts)
    if (sign * c.normal_force > 0.0) sizes.push_back(sign * c.normal_force);
  if (sizes.empty()) return kNoValue;
  const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
  // A single random draw is enough, because draws determine only the p-value of the fit, which is not used.
  const ForceFit fit = fit_exponential_tail("", sizes, mean, {.n_draws = 1});
  return fit.found() ? fit.parameters.front().value.value_or(kNoValue) : kNoValue;
}

template <int Dim>
void measure_bridges(const Packing<Dim>& packing, StateMeasures& m) {
  m.bridges = m.bridge_volume = kNoValue;
  if (!holds_liquid(packing)) return;
  int n = 0;
  double volume = 0.0;
  for (const Contact<Dim>& c : packing.contacts) {
    if (packing.is_wall(c.j) || !(bridge_volume(packing, c) > 0.0)) continue;
    ++n;
    volume += bridge_volume(packing, c);
  }
  m.bridges = static_cast<double>(n) / packing.grains.size();
  m.bridge_volume = n > 0 ? volume / n / std::pow(largest_diameter(packing.grains), 3) : kNoValue;
}

template <int Dim>
void measure_rigid(const State<Dim>& state, double zero_force, StateMeasures& m) {
  m.pairs = m.indeterminacy = m.force_freedom = kNoValue;
  const Packing<Dim>& packing = state.packing;
  if (!packing.law.is_rigid()) return;
  const auto n = static_cast<double>(packing.grains.size());
  m.pairs = 2.0 * static_cast<double>(n_touching_pairs(packing)) / n;
  m.indeterminacy = rigid_indeterminacy(packing, zero_force).degree / n;
  m.force_freedom = force_freedom(state).value_or(kNoValue);
}

template <int Dim>
void measure_contacts(const State<Dim>& state, StateMeasures& m) {
  const Packing<Dim>& packing = state.packing;
  const double force = force_scale(packing, state.target_stress).force;
  // Forces below `zero_force` count as zero. This limit does not depend on the tolerance of the run. Otherwise
  // coordination numbers would differ between settings even for equal packings.
  const double zero_force = EquilibriumTolerance{}.force * force;
  const Coordination c = coordination(packing, zero_force);
  m.solid_fraction = solid_fraction(packing);
  m.z = c.z;
  m.z_plus = c.z_plus;
  m.z_minus = c.z_minus;
  m.rattlers = c.rattler_fraction;
  m.tail_plus = tail_of(packing, 1.0) / force;
  m.tail_minus = tail_of(packing, -1.0) / force;
  const ForceMoments moments = force_moments(packing);
  m.force_moment = moments.Z[0];
  m.mobilised = moments.M1;
  m.wall_contacts = 0.0;
  for (const Contact<Dim>& contact : packing.contacts)
    if (packing.is_wall(contact.j) && !contact.distant) m.wall_contacts += 1.0 / packing.grains.size();
  measure_bridges(packing, m);
  measure_rigid(state, zero_force, m);
}

template <int Dim>
void measure_test(const State<Dim>& state, StateMeasures& m) {
  m.lateral_ratio = m.stress_ratio = kNoValue;
  const std::optional<ShearPoint> point = test_point(state);
  if (!point) return;
  m.lateral_ratio = point->lateral_stress / point->axial_stress;
  const int axis = state.path.turn.axis;
  m.stress_ratio = state.path.turn.is_simple_shear()
                       ? -state.stress(0, axis) / state.stress(axis, axis)
                       : measure_axial_test<Dim>(axis, Vec<Dim>(state.stress.diagonal()),
                                                 Vec<Dim>(Vec<Dim>::Zero()), nullptr)
                             .mobilised;
}

template <int Dim>
void measure_moduli(const State<Dim>& state, ModuliSequence<Dim>& sequence, StateMeasures& m) {
  m.B = m.G = m.B_reuss = kNoValue;
  if (state.packing.law.is_rigid()) return;
  const Moduli moduli = sequence.next(state.packing, state.target_stress.isZero(0.0));
  m.B = moduli.failure.empty() ? moduli.B : kNoValue;
  m.G = moduli.failure.empty() ? moduli.G : kNoValue;
  m.B_reuss = moduli.bounds.B_reuss;
}

/// Copies into the observation `x` the values of all observables that are computed from the data `source`.
void take(const StateMeasures& m, ObservableSource source, Observation& x) {
  const auto& observables = declared_observables();
  for (std::size_t k = 0; k < observables.size(); ++k)
    if (observables[k].source == source) x[k] = observables[k].value(m);
}

}  // namespace

template <int Dim>
Observation observe_moduli(const State<Dim>& state, ModuliSequence<Dim>& sequence, const Observation& other) {
  StateMeasures m;
  measure_moduli(state, sequence, m);
  Observation x = other;
  take(m, ObservableSource::moduli, x);
  return x;
}

template <int Dim>
Observation observe_structure(const State<Dim>& state) {
  Observation x;
  x.fill(kNoValue);
  StateMeasures m;
  measure_contacts(state, m);
  measure_test(state, m);
  take(m, ObservableSource::state, x);
  return x;
}

template <int Dim>
Observation observe(const State<Dim>& state, ModuliSequence<Dim>& moduli) {
  return observe_moduli(state, moduli, observe_structure(state));
}

template <int Dim>
std::optional<ShearPoint> test_point(const State<Dim>& state) {
  const StageReference& turn = state.path.turn;
  if (turn.empty()) return std::nullopt;
  const Vec<Dim> before = Eigen::Map<const Vec<Dim>>(turn.sides.data());
  const Vec<Dim> strain = axial_strain<Dim>(before, state.packing.cell.matrix.diagonal());
  const Vec<Dim> stress = state.stress.diagonal();
  const double axial = stress[turn.axis];
  return ShearPoint{axial, (stress.sum() - axial) / (Dim - 1), strain[turn.axis], strain.sum()};
}

template <int Dim>
std::optional<ShearPoint> start_of_test(const State<Dim>& state) {
  const StageReference& turn = state.path.turn;
  if (turn.empty()) return std::nullopt;
  const Vec<Dim> stress = Eigen::Map<const Vec<Dim>>(turn.stress.data());
  const double axial = stress[turn.axis];
  return ShearPoint{axial, (stress.sum() - axial) / (Dim - 1), 0.0, 0.0};
}

template Observation observe_structure(const State<2>&);
template Observation observe_structure(const State<3>&);
template Observation observe(const State<2>&, ModuliSequence<2>&);
template Observation observe(const State<3>&, ModuliSequence<3>&);
template Observation observe_moduli(const State<2>&, ModuliSequence<2>&, const Observation&);
template Observation observe_moduli(const State<3>&, ModuliSequence<3>&, const Observation&);
template std::optional<ShearPoint> test_point(const State<2>&);
template std::optional<ShearPoint> test_point(const State<3>&);
template std::optional<ShearPoint> start_of_test(const State<2>&);
template std::optional<ShearPoint> start_of_test(const State<3>&);

}  // namespace floc
