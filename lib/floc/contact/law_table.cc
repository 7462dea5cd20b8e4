#include "floc/contact/law_table.h"

namespace floc {
namespace {

template <class Adhesion, class Damping>
AnyContactLaw with_friction(const LawParameters& p, const Adhesion& adhesion, const Damping& damping) {
  const LinearRepulsion repulsion{p.normal_stiffness};
  if (!p.friction || p.friction->coefficient == 0.0)
    return laws::Linear<Adhesion, Damping>{repulsion, adhesion, damping, {}, {}};
  const CoulombFriction friction{p.friction->coefficient, p.friction->stiffness};
  if (!p.rolling || p.rolling->coefficient == 0.0)
    return laws::Linear<Adhesion, Damping, CoulombFriction>{repulsion, adhesion, damping, friction, {}};
  const RollingSpring rolling{p.rolling->coefficient, p.rolling->stiffness};
  return laws::Linear<Adhesion, Damping, CoulombFriction, RollingSpring>{repulsion, adhesion, damping, friction,
                                                                         rolling};
}

template <class Adhesion>
AnyContactLaw with_damping(const LawParameters& p, const Adhesion& adhesion) {
  if (!p.damping) return with_friction(p, adhesion, NoDamping{});
  return with_friction(p, adhesion, ViscousDamping{p.damping->restitution, p.damping->mass});
}

}  // namespace

AnyContactLaw compose_law(const LawParameters& p) {
  if (p.pull_off_force() == 0.0) return with_damping(p, NoAdhesion{});
  if (p.adhesion->range == 0.0) return with_damping(p, ConstantAdhesion{p.adhesion->force});
  return with_damping(p, TailAdhesion{p.adhesion->force, p.adhesion->range});
}

}  // namespace floc
