#pragma once

#include "floc/geometry/frame.h"
#include "floc/rigid/kernels/body_lanes.h"

namespace floc {

/// Contacts of disks, spheres and planes (RoundGroup), as many as fill a register.
template <class Isa, int Dim, bool Cell>
struct RoundModel {
  using Group = RoundGroup<Dim, Cell>;
  using P = Pack<Isa>;
  using V = Vec<Dim, P>;
  using Tangential = Shear<Dim, P>;
  using Impulse = Vec<Group::kImpulse, P>;
  using Bodies = BodyLanes<Isa, Dim>;

  /// Returns the impulses that solve the contacts.
  [[gnu::always_inline]] static Impulse impulse(const Group& group, int lane, const Bodies& i, const Bodies& j,
                                                const V& stretch, const Impulse& before) {
    const Impulse free = unlimited(group, lane, i, j, stretch, before);
    const P normal = lanes::max(free[0], P(0.0));
    return limited(free, P::load(group.friction + lane) * normal, normal);
  }

  /// Adds impulses to the motion of the bodies.
  /// @return the impulses in space
  [[gnu::always_inline]] static V push(const Group& group, int lane, const Impulse& impulse, Bodies& i,
                                       Bodies& j) {
    const V normal = load<Isa>(group.normal, lane);
    const Tangential tangential = tangential_of(impulse);
    V in_space = from_shear<P>(normal, tangential);
    for (int a = 0; a < Dim; ++a) in_space[a] += normal[a] * impulse[0];
    i.push(V(-in_space));
    j.push(in_space);
    // The moment of the opposite impulse at the arm a_i = arm_i n, and of the impulse at the arm a_j = -arm_j n.
    RotationVector<Dim, P> turn;
    if constexpr (Dim == 2) {
      turn = tangential;
    } else {
      turn = moment<P>(normal, tangential);
    }
    i.turn_round(scaled(-P::load(group.arm_i + lane), turn));
    j.turn_round(scaled(-P::load(group.arm_j + lane), turn));
    return in_space;
  }

  /// Returns contact_error() of the contacts.
  [[gnu::always_inline]] static P error(const Group& group, int lane, const Bodies& i, const Bodies& j,
                                        const V& stretch, const Impulse& impulse) {
    const Impulse free = unlimited(group, lane, i, j, stretch, impulse);
    const P most = P::load(group.friction + lane) * lanes::max(impulse[0], P(0.0));
    const Impulse projected = limited(free, most, lanes::max(free[0], P(0.0)));
    P square(0.0);
    for (int k = 1; k < Group::kImpulse; ++k)
      square += (projected[k] - impulse[k]) * (projected[k] - impulse[k]);
    return lanes::max(lanes::absolute(P(projected[0] - impulse[0])), sqrt(square));
  }

 private:
  [[gnu::always_inline]] static Tangential tangential_of(const Impulse& impulse) {
    return impulse.template tail<kShearComponents<Dim>>();
  }
  [[gnu::always_inline]] static RotationVector<Dim, P> scaled(const P& factor,
                                                              const RotationVector<Dim, P>& vector) {
    RotationVector<Dim, P> out;
    for (int a = 0; a < kRotations<Dim>; ++a) out[a] = factor * vector[a];
    return out;
  }

  /// Returns the impulse before the limits P >= 0 and |p_t| <= mu P are applied: the arguments of [ ]_+ and proj in the
  /// equations of RoundGroup.
  [[gnu::always_inline]] static Impulse unlimited(const Group& group, int lane, const Bodies& i,
                                                  const Bodies& j, const V& stretch, const Impulse& impulse) {
    V u = j.velocity() - i.velocity();
    add_stretch<Isa>(group, lane, stretch, u);
    const V normal = load<Isa>(group.normal, lane);
    const RotationVector<Dim, P> spin =
        scaled(P::load(group.arm_i + lane), i.spin()) + scaled(P::load(group.arm_j + lane), j.spin());
    // The velocity of the tip of the normal for this spin.
    Tangential turned;
    if constexpr (Dim == 2) {
      turned = spin;
    } else {
      turned = cross<P>(spin, normal);
    }
    const Tangential slip = to_shear<P>(normal, u) - turned;
    Impulse out;
    out[0] = P::load(group.keep_normal + lane) * impulse[0] -
             (P::load(group.inverse_normal + lane) * normal.dot(u) + P::load(group.bias_normal + lane));
    const P keep = P::load(group.keep_tangential + lane);
    const P inverse = P::load(group.inverse_tangential + lane);
    for (int k = 0; k < kShearComponents<Dim>; ++k)
      out[k + 1] = keep * impulse[k + 1] - (inverse * slip[k] + P::load(group.bias_tangential[k] + lane));
    return out;
  }

  /// Returns an impulse with the given normal component and the tangential vector of `free`, shortened to the length
  /// `most` if it is longer.
  [[gnu::always_inline]] static Impulse limited(const Impulse& free, const P& most, const P& normal) {
    Impulse out;
    out[0] = normal;
    if constexpr (Dim == 2) {
      out[1] = lanes::clamp_magnitude(free[1], most);
    } else {
      const P square = tangential_of(free).squaredNorm();
      const P factor = lanes::select(most * most < square, most / sqrt(square), P(1.0));
      for (int k = 1; k < Group::kImpulse; ++k) out[k] = factor * free[k];
    }
    return out;
  }
};

}  // namespace floc
