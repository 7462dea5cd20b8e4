#include "floc/packing/contact_forces.h"

#include <variant>

#include "floc/contact/law_table.h"

namespace floc {
namespace {

/// Springs are at their cap when shortening by rounding could not be told from reaching it.
constexpr double kAtCap = 1.0 - 1e-12;

template <class Law, int Dim>
void refresh(const Law& law, const Packing<Dim>& packing, Contact<Dim>& c) {
  const TwoPartVec<Dim> r = exact_branch(packing, c);
  c.gap = surface_gap<Dim>(r, packing.grains.radius[c.i], packing.grains.radius[c.j]);
  c.normal = rounded<Dim>(r).normalized();

  ContactHistory<Law, Dim> history;
  if constexpr (Law::kHasFriction) history.shear = c.shear_spring;
  if constexpr (Law::kHasRolling) history.roll = c.rolling_spring;
  const ContactMotion<Dim> still{c.gap, 0.0, 0.0, Shear<Dim>::Zero(), Spin<Dim>::Zero()};
  const ContactForces<Dim> f = law.respond(still, history);

  c.normal_force = f.normal.force();
  c.elastic_force = f.normal.elastic;
  c.shear_force = from_shear<double>(c.normal, f.shear);
  c.rolling_moment = -f.rolling;
  const ContactStiffness k = law.stiffness(c.gap);
  c.kn = k.normal;
  c.kt = k.tangential;
  c.kr = k.rolling;
  c.distant = c.gap >= 0.0;
  c.sliding = c.rolling_yield = false;
  if constexpr (Law::kHasFriction) {
    c.shear_spring = history.shear;
    c.sliding = !c.distant && history.shear.norm() >= kAtCap * law.friction.spring_limit(c.elastic_force);
  } else {
    c.shear_spring.setZero();
  }
  if constexpr (Law::kHasRolling) {
    c.rolling_spring = history.roll;
    c.rolling_yield = !c.distant && history.roll.norm() >= kAtCap * law.rolling.spring_limit(c.elastic_force);
  } else {
    c.rolling_spring.setZero();
  }
}

}  // namespace

template <int Dim>
void refresh_contact(const Packing<Dim>& packing, Contact<Dim>& contact) {
  std::visit([&](const auto& law) { refresh(law, packing, contact); }, compose_law(packing.law));
}

template <int Dim>
void refresh_contacts(Packing<Dim>& packing) {
  std::visit(
      [&](const auto& law) {
        for (Contact<Dim>& c : packing.contacts) refresh(law, packing, c);
      },
      compose_law(packing.law));
  const double range = packing.law.range();
  std::erase_if(packing.contacts, [range](const Contact<Dim>& c) { return c.gap >= 0.0 && c.gap >= range; });
}

template void refresh_contact(const Packing<2>&, Contact<2>&);
template void refresh_contact(const Packing<3>&, Contact<3>&);
template void refresh_contacts(Packing<2>&);
template void refresh_contacts(Packing<3>&);

}  // namespace floc
