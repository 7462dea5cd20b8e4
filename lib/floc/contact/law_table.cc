#include "floc/contact/law_table.h"

#include <cassert>

#include "floc/base/error.h"
#include "floc/contact/neutral.h"

namespace floc {
namespace {

/// Returns the parameters of a contact law without the models that have no effect.
LawParameters acting(LawParameters law) {
  LawParameters::for_each_slot(law, [](const char*, auto& slot) {
    const bool acts = slot.visit([](const auto& model) {
      if constexpr (requires { model.acts(); }) return model.acts();
      return true;
    });
    if constexpr (requires { slot.reset(); })
      if (!acts) slot.reset();
  });
  if (!law.friction) {
    law.rolling.reset();
    law.twisting.reset();
  }
  if (law.twisting && !law.rolling) law.rolling = kNeutral<RollingSpring>;
  if (law.adhesion.holds<TailAdhesion>())
    if (const TailAdhesion tail = law.adhesion.get<TailAdhesion>(); tail.tail_range == 0.0)
      law.adhesion = ConstantAdhesion{tail.pull_off_force};
  return law;
}

AnyContactLaw composed(const LawParameters& law) {
  if (law.normal.holds<RigidContact>())
    throw InputError(
        "contact.normal",
        "law = \"rigid\": rigid contacts have no force law from which forces, stiffnesses or energies "
        "could be computed");
  return std::visit(
      []<class... Models>(const Models&... models) -> AnyContactLaw {
        if constexpr (kIsCompiled<Models...>) return ContactLaw<Models...>{models...};
        assert(!"the law was not checked: validate() refuses it");
        return {};
      },
      law.normal.variant(), law.adhesion.variant(), law.damping.variant(), law.friction.variant(),
      law.rolling.variant(), law.twisting.variant());
}

}  // namespace

AnyContactLaw compose_law(const LawParameters& parameters) {
  return composed(acting(parameters));
}

AnyContactLaw compose_with_friction(const LawParameters& parameters) {
  LawParameters law = acting(parameters);
  if (!law.friction) {
    if (law.normal.holds<HertzRepulsion>())
      law.friction = kNeutral<MindlinFriction>;
    else
      law.friction = kNeutral<CoulombFriction>;
  }
  return composed(law);
}

}  // namespace floc
