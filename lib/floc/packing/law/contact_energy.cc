#include "floc/packing/law/contact_energy.h"

#include <limits>
#include <variant>

#include "floc/packing/law/law_response.h"

namespace floc {
namespace {

template <class Law, int Dim>
ContactEnergy energy_of(const Law& law, const Packing<Dim>& packing, const Contact<Dim>& c) {
  const PairGeometry<> pair = pair_geometry(packing.grains, c);
  const auto history = packed_history<Law, Dim>(c.history);
  ContactEnergy energy;
  if (!c.distant) {
    energy.normal = c.bonded ? spring_energy(c.normal_force * c.normal_force, c.kn)
                             : law.template elastic_energy_of<Dim>(pair, c.elastic_force, c.kn, history);
    energy.elastic = energy.normal + spring_energy(c.shear_force.squaredNorm(), c.kt) +
                     spring_energy(c.rolling_moment.squaredNorm(), c.kr) +
                     spring_energy(c.twisting_moment * c.twisting_moment, c.ktw);
  }
  if (c.bonded) return energy;
  energy.attraction =
      law.template attraction_energy_of<Dim>(pair, history, acting_parameters(law, packing.grains, c));
  return energy;
}

}  // namespace

template <int Dim>
ContactEnergy contact_energy(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  return std::visit([&](const auto& law) { return energy_of(law, packing, contact); },
                    compose_law(packing.is_wall(contact.j) ? packing.wall_law : packing.law));
}

template <int Dim>
ContactEnergy contact_energy(const Packing<Dim>& packing) {
  ContactEnergy sum;
  const AnyContactLaw wall_law = compose_law(packing.wall_law);
  const auto add = [&](const auto& law, const Contact<Dim>& c) {
    const ContactEnergy energy = energy_of(law, packing, c);
    sum.elastic += energy.elastic;
    sum.normal += energy.normal;
    sum.attraction += energy.attraction;
  };
  std::visit(
      [&](const auto& law) {
        for (const Contact<Dim>& c : packing.contacts)
          if (packing.is_wall(c.j))
            std::visit([&](const auto& of_walls) { add(of_walls, c); }, wall_law);
          else
            add(law, c);
      },
      compose_law(packing.law));
  return sum;
}

template <int Dim>
double kinetic_over_elastic_energy(const Packing<Dim>& packing) {
  const Grains<Dim>& g = packing.grains;
  double kinetic = 0.0;
  for (int i = 0; i < g.size(); ++i) kinetic += 0.5 * g.mass[i] * g.velocity[i].squaredNorm();
  if (kinetic == 0.0) return 0.0;
  const double elastic = contact_energy(packing).elastic;
  return elastic > 0.0 ? kinetic / elastic : std::numeric_limits<double>::infinity();
}

#define FLOC_INSTANTIATE(Dim)                                                      \
  template ContactEnergy contact_energy(const Packing<Dim>&, const Contact<Dim>&); \
  template ContactEnergy contact_energy(const Packing<Dim>&);                      \
  template double kinetic_over_elastic_energy(const Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
