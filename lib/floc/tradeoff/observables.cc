#include "floc/tradeoff/observables.h"

#include <numeric>
#include <vector>

#include "floc/fitting/force_distribution.h"
#include "floc/structure/coordination.h"

namespace floc {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Returns the decay force of the exponential tail that the distribution of contact forces has beyond the mean force
/// (force); NaN if it cannot be fitted.
/// @param sign  1 for compressive normal forces, -1 for tensile ones
double tail_of(const Packing<2>& packing, double sign) {
  std::vector<double> sizes;
  for (const Contact<2>& c : packing.contacts)
    if (sign * c.normal_force > 0.0) sizes.push_back(sign * c.normal_force);
  if (sizes.empty()) return kNoValue;
  const double mean = std::accumulate(sizes.begin(), sizes.end(), 0.0) / static_cast<double>(sizes.size());
  // The p-value of the fit is not used, so one random draw for it is enough.
  const ForceFit fit = fit_exponential_tail("", sizes, mean, {.n_draws = 1});
  return fit.found() ? fit.parameters.front().value.value_or(kNoValue) : kNoValue;
}

}  // namespace

Observation observe_moduli(const State<2>& state, ModuliSequence<2>& sequence, const Observation& other) {
  Observation x = other;
  const Moduli moduli = sequence.next(state.packing, state.target_stress.isZero(0.0));
  x[kB] = moduli.failure.empty() ? moduli.B : kNoValue;
  x[kG] = moduli.failure.empty() ? moduli.G : kNoValue;
  x[kBReuss] = moduli.bounds.B_reuss;
  return x;
}

Observation observe(const State<2>& state, ModuliSequence<2>& moduli) {
  Observation x;
  const double force = force_scale(state.packing, state.target_stress).force;
  // The largest contact force that counts as zero does not depend on the tolerance of the run: otherwise coordination
  // numbers would differ between settings although the packings are equal.
  const Coordination c = coordination(state.packing, EquilibriumTolerance{}.force * force);
  x[kPhi] = solid_fraction(state.packing);
  x[kZPlus] = c.z_plus;
  x[kZMinus] = c.z_minus;
  x[kTailPlus] = tail_of(state.packing, 1.0) / force;
  x[kTailMinus] = tail_of(state.packing, -1.0) / force;
  return observe_moduli(state, moduli, x);
}

double size_of(int k, const Observation& x, const Observation& y) {
  const auto size = [](const Observation& o, int of) {
    return of == kZPlus || of == kZMinus ? o[kZPlus] + o[kZMinus] : std::abs(o[static_cast<std::size_t>(of)]);
  };
  return 0.5 * (size(x, k) + size(y, k));
}

}  // namespace floc
