#include "floc/packing/balance.h"

namespace floc {

template <int Dim>
Balance<Dim> net_forces(const Packing<Dim>& packing) {
  const Grains<Dim>& g = packing.grains;
  Balance<Dim> net{std::vector<Vec<Dim>>(g.size(), Vec<Dim>::Zero()),
                   std::vector<RotationVector<Dim>>(g.size(), RotationVector<Dim>::Zero())};
  if (!packing.gravity.isZero(0.0))
    for (int i = 0; i < g.size(); ++i) net.force[i] = g.mass[i] * packing.gravity;
  for (const Contact<Dim>& c : packing.contacts) {
    const Vec<Dim> on_i = c.shear_force - c.normal_force * c.normal;
    const bool on_grain = !packing.is_wall(c.j);
    net.force[c.i] += on_i;
    if (on_grain) net.force[c.j] -= on_i;
    // Both forces act at the contact point, so that angular momentum is conserved exactly.
    const RotationVector<Dim> of_springs = spring_moment(c);
    net.moment[c.i] += moment<double>(c.arm_i, on_i) + of_springs;
    if (on_grain) net.moment[c.j] -= moment<double>(c.arm_j, on_i) + of_springs;
  }
  return net;
}

template <int Dim>
double mean_repulsive_force(const Packing<Dim>& packing) {
  double sum = 0.0;
  int n = 0;
  for (const Contact<Dim>& c : packing.contacts)
    if (c.elastic_force > 0.0) sum += c.elastic_force, ++n;
  return n == 0 ? 0.0 : sum / n;
}

template <int Dim>
Mat<Dim> static_stress(const Packing<Dim>& packing) {
  Mat<Dim> sum = Mat<Dim>::Zero();
  for (const Contact<Dim>& c : packing.contacts) {
    const Vec<Dim> on_j = c.normal_force * c.normal - c.shear_force;
    sum += on_j * stress_lever(packing, c).transpose();
  }
  return sum / packing.cell.volume();
}

template <int Dim>
Mat<Dim> boundary_stress(const Packing<Dim>& packing) {
  Mat<Dim> sum = Mat<Dim>::Zero();
  for (const Contact<Dim>& c : packing.contacts) {
    const bool on_wall = packing.is_wall(c.j);
    if (c.image.isZero() && !on_wall) continue;
    const Vec<Dim> on_j = c.normal_force * c.normal - c.shear_force;
    const Vec<Dim> shift = on_wall ? Vec<Dim>(packing.grains.position[c.i] + stress_lever(packing, c))
                                   : packing.cell.shift(c.image);
    sum += on_j * shift.transpose();
  }
  if (!packing.gravity.isZero(0.0))
    for (int i = 0; i < packing.grains.size(); ++i)
      sum -= packing.grains.mass[i] * packing.gravity * packing.grains.position[i].transpose();
  return sum / packing.cell.volume();
}

template <int Dim>
double twice_kinetic_energy(const Grains<Dim>& g, int i) {
  const double rotation = g.are_round()
                              ? g.inertia(i) * g.angular_velocity[i].squaredNorm()
                              : g.angular_velocity[i].dot(g.inertia_tensor(i) * g.angular_velocity[i]);
  return g.mass[i] * g.velocity[i].squaredNorm() + rotation;
}

template <int Dim>
double mean_kinetic_energy(const Packing<Dim>& packing) {
  const Grains<Dim>& g = packing.grains;
  double twice = 0.0;
  for (int i = 0; i < g.size(); ++i) twice += twice_kinetic_energy(g, i);
  return g.size() == 0 ? 0.0 : 0.5 * twice / g.size();
}

template Balance<2> net_forces(const Packing<2>&);
template Balance<3> net_forces(const Packing<3>&);
template double mean_repulsive_force(const Packing<2>&);
template double mean_repulsive_force(const Packing<3>&);
template Mat<2> static_stress(const Packing<2>&);
template Mat<3> static_stress(const Packing<3>&);
template Mat<2> boundary_stress(const Packing<2>&);
template Mat<3> boundary_stress(const Packing<3>&);
template double twice_kinetic_energy(const Grains<2>&, int);
template double twice_kinetic_energy(const Grains<3>&, int);
template double mean_kinetic_energy(const Packing<2>&);
template double mean_kinetic_energy(const Packing<3>&);

}  // namespace floc
