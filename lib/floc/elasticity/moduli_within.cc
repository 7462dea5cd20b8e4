#include "floc/elasticity/moduli_within.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/base/range.h"
#include "floc/packing/balance.h"

namespace floc {
namespace {

/// Smallest relative error of a modulus that may be required: the rounding error of the cell's volume.
constexpr double kMinError = 1e-14;
/// B_reuss counts as a lower bound on B_S, the bulk modulus under imposed stress, if the range of the principal
/// stresses, divided by their mean, is at most this share of the required relative accuracy of B. The bound holds
/// exactly only if the principal stresses are equal. If they are P (1 + delta_a), with the pressure P, the relative
/// error of the bound is about the largest delta_a.
constexpr double kAnisotropyShare = 0.01;
/// Largest number of grains for which a factor in single precision is cheaper than a factor in double precision.
constexpr int kMaxForSingle = 1000;

/// Returns whether the moduli may be taken as the mean of their bounds: only B is required, and the stress is nearly
/// isotropic.
template <int Dim>
bool bounds_suffice(const Packing<Dim>& packing, const ModuliOptions& options, const ModuliAccuracy& accuracy) {
  if (std::isfinite(accuracy.G) || options.strains == StrainSet::full) return false;
  const Vec<Dim> stress = static_stress(packing).diagonal();
  return stress.maxCoeff() - stress.minCoeff() <= kAnisotropyShare * accuracy.B * std::abs(stress.mean());
}

/// Returns whether the numbers of zero and negative eigenvalues in `m` are reliable. They are always reliable with
/// ModuliMethod::factor. With any other method, they are reliable only if both are zero.
bool fully_counted(const Moduli& m) {
  return m.method == ModuliMethod::factor || (m.n_mechanisms == 0 && m.n_negative == 0);
}

}  // namespace

bool ModuliAccuracy::met_by(const Moduli& m) const {
  const auto kept = [&m](double value, double error, double asked) {
    const bool vanishes = m.n_coupled_mechanisms > 0 && std::abs(value) <= error;
    return !std::isfinite(asked) || vanishes || error <= asked * (std::abs(value) - error);
  };
  return kept(m.B, m.B_error, B) && kept(m.G, m.G_error, G);
}

std::vector<std::string> ModuliAccuracy::validate() const {
  std::vector<std::string> faults;
  const auto check = [&](const char* name, double asked) {
    if (!(asked >= kMinError))
      faults.push_back(
          fmt::format("accuracy of {} = {}: must be at least {}, the rounding error", name, asked, kMinError));
  };
  check("B", B);
  check("G", G);
  if (!std::isfinite(B) && !std::isfinite(G))
    faults.push_back("accuracy: at least one of the accuracies of B and G must be finite");
  return faults;
}

std::vector<ModuliMethod> moduli_methods_by_cost(int n_grains) {
  if (n_grains > kMaxForSingle) return {ModuliMethod::bounds, ModuliMethod::factor};
  return {ModuliMethod::bounds, ModuliMethod::single_factor, ModuliMethod::factor};
}

template <int Dim>
Moduli moduli_within(const Packing<Dim>& packing, ModuliOptions options, const ModuliAccuracy& accuracy) {
  refuse_faults(accuracy.validate());
  options.tolerance = std::min(accuracy.B, accuracy.G);
  Moduli moduli;
  for (const ModuliMethod method : moduli_methods_by_cost(packing.grains.size())) {
    if (method == ModuliMethod::bounds && !bounds_suffice(packing, options, accuracy)) continue;
    options.method = method;
    moduli = elastic_moduli(packing, options);
    if (method == ModuliMethod::bounds && !moduli.failure.empty()) continue;
    if (accuracy.met_by(moduli) && fully_counted(moduli)) break;
  }
  return moduli;
}

template Moduli moduli_within(const Packing<2>&, ModuliOptions, const ModuliAccuracy&);
template Moduli moduli_within(const Packing<3>&, ModuliOptions, const ModuliAccuracy&);

}  // namespace floc
