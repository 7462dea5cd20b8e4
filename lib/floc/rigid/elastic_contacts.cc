#include "floc/rigid/elastic_contacts.h"

#include <vector>

#include "floc/contact/law_parameters.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/law/contact_response.h"

namespace floc {
namespace {

/// A contact counts as sliding if its tangential force differs from Coulomb's limit by at most this fraction of the
/// limit.
constexpr double kAtSpringLimit = 1e-12;

}  // namespace

template <int Dim>
void add_springs(const Packing<Dim>& packing, const Contact<Dim>& c, double dt, StepContact<Dim>& step) {
  const LawParameters& law = packing.law_of(c).parameters();
  step.normal_compliance = 1.0 / (law.normal.get<LinearRepulsion>().normal_stiffness * dt * dt);
  step.bias[0] += c.gap / dt;
  if (!law.friction.holds<CoulombFriction>()) return;
  const double kt = law.friction.get<CoulombFriction>().tangential_stiffness;
  step.tangential_compliance = 1.0 / (kt * dt * dt);
  step.bias.template tail<Dim - 1>() +=
      (step.frame.transpose() * c.shear_force).template tail<Dim - 1>() / (kt * dt);
}

template <int Dim>
void set_spring_forces(Packing<Dim>& packing) {
  for (Contact<Dim>& c : packing.contacts) set_given_forces(packing, {}, {}, kAtSpringLimit, c);
  const std::vector<SurfaceMotion<Dim>> unmoved(packing.contacts.size());
  respond<Dim>(packing, unmoved, packing.contacts);
  for (Contact<Dim>& c : packing.contacts) c.distant = false;
}

#define FLOC_INSTANTIATE(Dim)                                                                        \
  template void add_springs(const Packing<Dim>&, const Contact<Dim>&, double dt, StepContact<Dim>&); \
  template void set_spring_forces(Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
