#include "floc/packing/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/packing/balance.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

double ratio(double value, double scale) {
  if (scale > 0.0) return value / scale;
  return value == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

}  // namespace

template <int Dim>
ForceScale force_scale(const Packing<Dim>& packing, const Vec<Dim>& target_stress) {
  const double a = largest_diameter(packing.grains);
  return {std::max(packing.law.pull_off_force(), target_stress.mean() * std::pow(a, Dim - 1)), a};
}

template <int Dim>
double reduced_pressure(const Packing<Dim>& packing, double pressure) {
  const double a = force_scale(packing, Vec<Dim>(Vec<Dim>::Zero())).length;
  const double F0 = packing.law.pull_off_force();
  return F0 > 0.0 ? std::pow(a, Dim - 1) * pressure / F0
                  : std::pow(a, Dim - 2) * pressure / packing.law.normal_stiffness;
}

template <int Dim>
Residuals residuals(const Packing<Dim>& packing, const Vec<Dim>& target_stress) {
  const ForceScale scale = force_scale(packing, target_stress);
  const Balance<Dim> net = net_forces(packing);
  Residuals r;
  for (int i = 0; i < packing.grains.size(); ++i) {
    const double force = net.force[i].norm();
    const double torque = net.moment[i].norm();
    if (r.worst_force_grain < 0 || force > r.force) r.force = force, r.worst_force_grain = i;
    if (r.worst_moment_grain < 0 || torque > r.moment) r.moment = torque, r.worst_moment_grain = i;
  }
  const double work = scale.force * scale.length;
  r.force = ratio(r.force, scale.force);
  r.moment = ratio(r.moment, work);
  r.stress = ratio((static_stress(packing).diagonal() - target_stress).cwiseAbs().maxCoeff(),
                   scale.force / std::pow(scale.length, Dim - 1));
  r.energy = ratio(mean_kinetic_energy(packing), work);
  return r;
}

template ForceScale force_scale(const Packing<2>&, const Vec<2>&);
template ForceScale force_scale(const Packing<3>&, const Vec<3>&);
template double reduced_pressure(const Packing<2>&, double);
template double reduced_pressure(const Packing<3>&, double);
template Residuals residuals(const Packing<2>&, const Vec<2>&);
template Residuals residuals(const Packing<3>&, const Vec<3>&);

}  // namespace floc
