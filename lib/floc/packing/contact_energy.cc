#include "floc/packing/contact_energy.h"

#include <limits>

namespace floc {
namespace {

/// Energy of a spring; one without stiffness carries nothing.
double spring_energy(double squared_force, double stiffness) {
  return stiffness > 0.0 ? 0.5 * squared_force / stiffness : 0.0;
}

}  // namespace

template <int Dim>
double elastic_energy(const Contact<Dim>& c) {
  if (c.distant) return 0.0;
  const double N = c.elastic_force, h = -c.gap;
  const double normal = N > 0.0 && h > 0.0 ? N * N * h / (N + c.kn * h) : 0.0;
  return normal + spring_energy(c.shear_force.squaredNorm(), c.kt) +
         spring_energy(c.rolling_moment.squaredNorm(), c.kr) +
         spring_energy(c.twisting_moment * c.twisting_moment, c.ktw);
}

template <int Dim>
double kinetic_over_elastic_energy(const Packing<Dim>& packing) {
  const Grains<Dim>& g = packing.grains;
  double kinetic = 0.0, elastic = 0.0;
  for (int i = 0; i < g.size(); ++i) kinetic += 0.5 * g.mass[i] * g.velocity[i].squaredNorm();
  for (const Contact<Dim>& c : packing.contacts) elastic += elastic_energy(c);
  if (kinetic == 0.0) return 0.0;
  return elastic > 0.0 ? kinetic / elastic : std::numeric_limits<double>::infinity();
}

template double elastic_energy(const Contact<2>&);
template double elastic_energy(const Contact<3>&);
template double kinetic_over_elastic_energy(const Packing<2>&);
template double kinetic_over_elastic_energy(const Packing<3>&);

}  // namespace floc
