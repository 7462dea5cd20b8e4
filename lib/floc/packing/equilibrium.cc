#include "floc/packing/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

double ratio(double value, double scale) {
  if (scale > 0.0) return value / scale;
  return value == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

/// Returns the mean magnitude of the normal forces of the bonds (force); 0 if there are none.
template <int Dim>
double mean_bond_force(const Packing<Dim>& packing) {
  double sum = 0.0;
  int n = 0;
  for (const Contact<Dim>& c : packing.contacts)
    if (c.bonded) sum += std::abs(c.normal_force), ++n;
  return n > 0 ? sum / n : 0.0;
}

/// Returns the residual of the stress (dimensionless). Without walls it is the largest deviation of a diagonal
/// component from the imposed stress, in units of F1/a^(Dim-1), where F1 is the force scale and a the largest diameter.
/// With walls it is wall_imbalance() divided by the imposed pressure, because with strong adhesion F1 is much larger
/// than the forces that the pressure causes.
template <int Dim>
double stress_residual(const Packing<Dim>& packing, const Vec<Dim>& target_stress, const Mat<Dim>& stress,
                       const ForceScale& scale) {
  const double unit = scale.force / std::pow(scale.length, Dim - 1);
  if (packing.walls.empty()) return ratio((stress.diagonal() - target_stress).cwiseAbs().maxCoeff(), unit);
  const double pressure = target_stress.mean();
  return ratio(wall_imbalance(packing, target_stress), pressure > 0.0 ? pressure : unit);
}

}  // namespace

template <int Dim>
ForceScale force_scale(const Packing<Dim>& packing, const Vec<Dim>& target_stress) {
  const double a = largest_diameter(packing.grains);
  double force = std::max(pull_off_force(packing), target_stress.mean() * std::pow(a, Dim - 1));
  // Bonds may bear tension without any adhesion of the law, and they may bear forces without any stress.
  if (!(force > 0.0))
    force = std::max(std::abs(target_stress.mean()) * std::pow(a, Dim - 1), mean_bond_force(packing));
  return {force, a};
}

template <int Dim>
GrainScales<Dim>::GrainScales(const Packing<Dim>& packing, const Vec<Dim>& target_stress)
    : radius_(packing.grains.radius),
      packing_(force_scale(packing, target_stress)),
      law_(packing.law),
      pressure_(target_stress.mean()),
      shared_(similar_sizes(radius_) || !(packing_.force > 0.0)) {}

template <int Dim>
ForceScale GrainScales<Dim>::of(int i) const {
  if (shared_) return packing_;
  const double d = 2.0 * radius_[i];
  return {std::max(law_.pull_off_force(radius_[i]), pressure_ * std::pow(d, Dim - 1)), d};
}

template <int Dim>
double GrainScales<Dim>::force_share(int i) const {
  return shared_ ? 1.0 : of(i).force / packing_.force;
}

template <int Dim>
double GrainScales<Dim>::work_share(int i) const {
  return shared_ ? 1.0 : force_share(i) * (2.0 * radius_[i] / packing_.length);
}

template <int Dim>
double reduced_pressure(const Packing<Dim>& packing, double pressure) {
  const double a = force_scale(packing, Vec<Dim>(Vec<Dim>::Zero())).length;
  const double F0 = pull_off_force(packing);
  return F0 > 0.0 ? std::pow(a, Dim - 1) * pressure / F0 : pressure / packing.law.contact_modulus(Dim, a);
}

template <int Dim>
double scaled_kinetic_energy(const Packing<Dim>& packing, const GrainScales<Dim>& scales,
                             const std::vector<bool>& counted) {
  double sum = 0.0;
  for (int i = 0; i < packing.grains.size(); ++i)
    if (counted.empty() || counted[i]) sum += twice_kinetic_energy(packing.grains, i) / scales.work_share(i);
  return packing.grains.size() == 0 ? 0.0 : 0.5 * sum / packing.grains.size();
}

template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress) {
  return residuals(packing, target_stress, static_stress(packing));
}

template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress, const Mat<Dim>& stress) {
  const GrainScales<Dim> scales(packing, target_stress);
  const ForceScale& scale = scales.of_packing();
  const Balance<Dim> net = net_forces(packing);
  Residuals r;
  for (int i = 0; i < packing.grains.size(); ++i) {
    const double force = net.force[i].norm() / scales.force_share(i);
    const double torque = net.moment[i].norm() / scales.work_share(i);
    if (r.worst_force_grain < 0 || force > r.force) r.force = force, r.worst_force_grain = i;
    if (r.worst_moment_grain < 0 || torque > r.moment) r.moment = torque, r.worst_moment_grain = i;
  }
  const double work = scale.force * scale.length;
  r.force = ratio(r.force, scale.force);
  r.moment = ratio(r.moment, work);
  r.stress = stress_residual(packing, target_stress, stress, scale);
  r.energy = ratio(scaled_kinetic_energy(packing, scales), work);
  return r;
}

template ForceScale force_scale(const Packing<2>&, const Vec<2>&);
template ForceScale force_scale(const Packing<3>&, const Vec<3>&);
template class GrainScales<2>;
template class GrainScales<3>;
template double scaled_kinetic_energy(const Packing<2>&, const GrainScales<2>&, const std::vector<bool>&);
template double scaled_kinetic_energy(const Packing<3>&, const GrainScales<3>&, const std::vector<bool>&);
template double reduced_pressure(const Packing<2>&, double);
template double reduced_pressure(const Packing<3>&, double);
template Residuals residuals(const Packing<2>&, const Vec<2>&);
template Residuals residuals(const Packing<3>&, const Vec<3>&);
template Residuals residuals(const Packing<2>&, const Vec<2>&, const Mat<2>&);
template Residuals residuals(const Packing<3>&, const Vec<3>&, const Mat<3>&);

}  // namespace floc
