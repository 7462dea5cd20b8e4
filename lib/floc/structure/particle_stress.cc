#include "floc/structure/particle_stress.h"

#include <cmath>
#include <utility>

#include "floc/packing/grain_sizes.h"

namespace floc {

template <int Dim>
std::vector<Mat<Dim>> particle_stress(const Packing<Dim>& packing) {
  const Grains<Dim>& g = packing.grains;
  std::vector<Mat<Dim>> stress(g.size(), Mat<Dim>::Zero());
  for (const Contact<Dim>& c : packing.contacts) {
    const Vec<Dim> on_j = c.normal_force * c.normal - c.shear_force;
    stress[c.i] += on_j * c.arm_i.transpose();
    if (!packing.is_wall(c.j)) stress[c.j] -= on_j * c.arm_j.transpose();
  }
  // The volume V_i assigned to grain i is the volume of the grain divided by the solid fraction. For round grains, V_i
  // is V R_i^Dim / (sum of R_k^Dim over all grains k), where V is the volume of the cell, and R_i the radius of grain
  // i.
  const auto size = [&](int i) { return g.are_round() ? std::pow(g.radius[i], Dim) : g.volume(i); };
  double sum = 0.0;
  for (int i = 0; i < g.size(); ++i) sum += size(i);
  for (int i = 0; i < g.size(); ++i) stress[i] *= sum / (size(i) * packing.cell.volume());
  return stress;
}

template <int Dim>
std::vector<double> particle_pressure(const Packing<Dim>& packing) {
  std::vector<double> pressure;
  for (const Mat<Dim>& stress : particle_stress(packing)) pressure.push_back(stress.trace() / Dim);
  return pressure;
}

template <int Dim>
std::vector<double> pressure_beyond_zero(const Packing<Dim>& packing, std::vector<double> pressure,
                                         double zero_force) {
  const double zero_pressure = zero_force / std::pow(largest_diameter(packing.grains), Dim - 1);
  for (double& p : pressure)
    if (std::abs(p) <= zero_pressure) p = 0.0;
  return pressure;
}

template <int Dim>
std::vector<double> pressure_beyond_zero(const Packing<Dim>& packing, std::vector<double> pressure,
                                         const std::vector<bool>& rattler, double zero_force) {
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (rattler[i]) pressure[i] = 0.0;
  return pressure_beyond_zero(packing, std::move(pressure), zero_force);
}

template std::vector<Mat<2>> particle_stress(const Packing<2>&);
template std::vector<Mat<3>> particle_stress(const Packing<3>&);
template std::vector<double> particle_pressure(const Packing<2>&);
template std::vector<double> particle_pressure(const Packing<3>&);
template std::vector<double> pressure_beyond_zero(const Packing<2>&, std::vector<double>, double);
template std::vector<double> pressure_beyond_zero(const Packing<3>&, std::vector<double>, double);
template std::vector<double> pressure_beyond_zero(const Packing<2>&, std::vector<double>,
                                                  const std::vector<bool>&, double);
template std::vector<double> pressure_beyond_zero(const Packing<3>&, std::vector<double>,
                                                  const std::vector<bool>&, double);

}  // namespace floc
