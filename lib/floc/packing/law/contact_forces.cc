#include "floc/packing/law/contact_forces.h"

#include <algorithm>
#include <variant>

#include "floc/packing/law/law_response.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/locate.h"

namespace floc {
namespace {

template <class Law, int Dim>
void refresh(const Law& law, const Packing<Dim>& packing, Contact<Dim>& c) {
  place(locate(packing, c), c);
  if (c.bonded) return;
  respond_to_motion<Law, Dim>(law, packing.grains, SurfaceMotion<Dim>{}, c);
}

template <class Law, int Dim>
bool interacts_at(const Law& law, const Grains<Dim>& grains, const Contact<Dim>& c) {
  return law.template interacts<Dim>(pair_geometry(grains, c), packed_history<Law, Dim>(c.history));
}

/// Recomputes either all contacts with walls (if `with_walls` is true) or all contacts between grains. Contacts whose
/// surfaces are too far apart to interact are removed.
template <int Dim>
void refresh_kind(Packing<Dim>& packing, bool with_walls) {
  if (packing.law.is_rigid()) {
    for (Contact<Dim>& c : packing.contacts)
      if (packing.is_wall(c.j) == with_walls) place(locate(packing, c), c);
    return;
  }
  std::visit(
      [&](const auto& law) {
        for (Contact<Dim>& c : packing.contacts)
          if (packing.is_wall(c.j) == with_walls) refresh(law, packing, c);
        std::erase_if(packing.contacts, [&](const Contact<Dim>& c) {
          return packing.is_wall(c.j) == with_walls && !c.bonded && !interacts_at(law, packing.grains, c);
        });
      },
      compose_law(with_walls ? packing.wall_law : packing.law));
}

/// Returns whether the tangential force of a rigid contact is at Coulomb's limit.
/// @param tolerance  largest accepted difference between the force and the limit, as a fraction of the limit
template <int Dim>
bool slides(const Law& law, const Contact<Dim>& c, double tolerance) {
  const double limit = law.friction_coefficient() * c.elastic_force;
  return limit > 0.0 && c.shear_force.norm() >= (1.0 - tolerance) * limit;
}

/// Completes a contact whose normal force, shear force and moments are given: sets its elastic force, history and
/// stiffnesses. The given forces need not satisfy the contact law exactly. The elastic force is the normal force
/// without the attraction by adhesion.
template <class Law, int Dim>
void set_forces(const Law& law, double pull_off_force, const Grains<Dim>& grains, std::optional<double> kn,
                std::optional<double> kt, double tolerance, Contact<Dim>& c) {
  const double elastic_force = std::max(c.normal_force + pull_off_force, 0.0);
  auto history = packed_history<Law, Dim>(c.history);
  law.template set_elastic_force<Dim>(pair_geometry(grains, c), elastic_force, history);
  c.history = unpacked_history<Law, Dim>(history);
  c.distant = !touches(law, grains, c) && interacts_at(law, grains, c);
  if (c.distant) {
    // Under a normal law with a history, surfaces may count as separated although they overlap. In this case the law
    // determines the forces between them.
    if constexpr (Law::kKeepsOverlap) respond_to_motion<Law, Dim>(law, grains, SurfaceMotion<Dim>{}, c);
    return;
  }
  c.elastic_force = elastic_force;
  const ContactStiffness k = law.stiffness_at_force(pair_geometry(grains, c), c.elastic_force);
  c.kn = kn.value_or(k.normal);
  c.kt = Law::kHasFriction ? kt.value_or(k.tangential) : 0.0;
  c.kr = k.rolling;
  c.ktw = k.twisting;
  // The springs get the stiffnesses of the law, even if other stiffnesses are given for the contact. With these
  // stiffnesses, the law reproduces the given forces and their limits.
  law.template set_force<Dim>(to_shear<double>(c.normal, c.shear_force), -c.rolling_moment, -c.twisting_moment,
                              k, history);
  set_mobilised(law, history, tolerance, c);
  c.history = unpacked_history<Law, Dim>(history);
}

}  // namespace

template <int Dim>
void refresh_contact(const Packing<Dim>& packing, Contact<Dim>& contact) {
  if (packing.law_of(contact).is_rigid()) return place(locate(packing, contact), contact);
  std::visit([&](const auto& law) { refresh(law, packing, contact); }, compose_law(packing.law_of(contact)));
}

template <int Dim>
void refresh_contacts(Packing<Dim>& packing) {
  refresh_kind(packing, false);
  if (!packing.walls.empty()) refresh_kind(packing, true);
}

template <int Dim>
bool touches(const Packing<Dim>& packing, const Contact<Dim>& contact) {
  if (contact.bonded) return true;
  if (packing.law_of(contact).is_rigid()) return contact.elastic_force > 0.0 || contact.gap <= 0.0;
  return std::visit([&](const auto& law) { return touches(law, packing.grains, contact); },
                    compose_law(packing.law_of(contact)));
}

template <int Dim>
Mobilised mobilised(const Law& parameters, const Contact<Dim>& contact, double tolerance) {
  if (contact.distant || contact.bonded) return {};
  if (parameters.is_rigid()) return {.sliding = slides(parameters, contact, tolerance)};
  return std::visit(
      [&]<class Law>(const Law& law) {
        return law.template mobilised<Dim>(contact.elastic_force, packed_history<Law, Dim>(contact.history),
                                           tolerance);
      },
      compose_law(parameters));
}

template <int Dim>
void set_given_forces(const Packing<Dim>& packing, std::optional<double> kn, std::optional<double> kt,
                      double tolerance, Contact<Dim>& contact) {
  const Law& own = packing.law_of(contact);
  if (own.is_rigid()) {
    contact.elastic_force = std::max(contact.normal_force + pull_off_force(packing, contact), 0.0);
    contact.kn = kn.value_or(0.0);
    contact.kt = kt.value_or(0.0);
    contact.sliding = slides(own, contact, tolerance);
    return;
  }
  std::visit(
      [&](const auto& law) {
        set_forces(law, pull_off_force(packing, contact), packing.grains, kn, kt, tolerance, contact);
      },
      compose_law(own));
}

#define FLOC_INSTANTIATE(Dim)                                                                               \
  template void refresh_contact(const Packing<Dim>&, Contact<Dim>&);                                        \
  template void refresh_contacts(Packing<Dim>&);                                                            \
  template bool touches(const Packing<Dim>&, const Contact<Dim>&);                                          \
  template Mobilised mobilised(const Law&, const Contact<Dim>&, double tolerance);                          \
  template void set_given_forces(const Packing<Dim>&, std::optional<double>, std::optional<double>, double, \
                                 Contact<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
