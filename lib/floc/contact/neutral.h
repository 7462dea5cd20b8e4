#pragma once

#include "floc/contact/damping/critical_damping.h"
#include "floc/contact/damping/viscous_damping.h"
#include "floc/contact/rolling/rolling_spring.h"
#include "floc/contact/tangential/coulomb_friction.h"
#include "floc/contact/tangential/mindlin_friction.h"
#include "floc/contact/twisting/twisting_spring.h"

namespace floc {

/// Object of type `Model` without effect, for a composed contact law that must have a model of this type. The cap on
/// the force of a neutral spring is zero, so the stiffness of the spring may be any positive number.
template <class Model>
inline constexpr Model kNeutral{};
template <>
inline constexpr ViscousDamping kNeutral<ViscousDamping>{1.0};
template <>
inline constexpr CriticalDamping kNeutral<CriticalDamping>{0.0};
template <>
inline constexpr CoulombFriction kNeutral<CoulombFriction>{0.0, 1.0};
template <>
inline constexpr MindlinFriction kNeutral<MindlinFriction>{0.0};
template <>
inline constexpr RollingSpring kNeutral<RollingSpring>{0.0, 1.0};
template <>
inline constexpr TwistingSpring kNeutral<TwistingSpring>{0.0, 1.0};

}  // namespace floc
