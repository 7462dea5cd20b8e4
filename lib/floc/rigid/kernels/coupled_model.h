#pragma once

#include "floc/geometry/frame.h"
#include "floc/rigid/kernels/body_lanes.h"

namespace floc {

/// Contacts of bodies of any shape (CoupledGroup), as many as fill a register.
template <class Isa, int Dim, bool Cell>
struct CoupledModel {
  using Group = CoupledGroup<Dim, Cell>;
  using P = Pack<Isa>;
  using V = Vec<Dim, P>;
  using Bodies = BodyLanes<Isa, Dim>;

  /// Returns the impulses that solve the contacts.
  [[gnu::always_inline]] static V impulse(Group& group, int lane, const Bodies& i, const Bodies& j,
                                          const V& stretch, const V& before) {
    CoupledResponse<Dim, P> response = response_of(group, lane);
    // The velocity without an impulse of the contact. The product A p contains the effect of the present impulse on the
    // velocities and the compliance.
    const V velocity = velocity_of(group, lane, i, j, stretch, before) - response.times(before);
    const V out = response.impulse(velocity);
    if constexpr (Dim == 3) {
      int n = 0;
      response.visit([&](const P& value) {
        if (++n == CoupledResponse<Dim>::kNumbers) value.store(group.response[n - 1] + lane);
      });
    }
    return out;
  }

  /// Adds impulses to the motion of the bodies.
  /// @return the impulses in space
  [[gnu::always_inline]] static V push(const Group& group, int lane, const V& impulse, Bodies& i, Bodies& j) {
    V in_space;
    for (int a = 0; a < Dim; ++a) {
      in_space[a] = P::load(group.frame[a] + lane) * impulse[0];
      for (int b = 1; b < Dim; ++b) in_space[a] += P::load(group.frame[Dim * b + a] + lane) * impulse[b];
    }
    const V opposite = -in_space;
    i.push(opposite);
    i.turn(moment<P>(load<Isa>(group.arm_i, lane), opposite));
    j.push(in_space);
    j.turn(moment<P>(load<Isa>(group.arm_j, lane), in_space));
    return in_space;
  }

  /// Returns contact_error() of the contacts.
  [[gnu::always_inline]] static P error(const Group& group, int lane, const Bodies& i, const Bodies& j,
                                        const V& stretch, const V& impulse) {
    const CoupledResponse<Dim, P> response = response_of(group, lane);
    const V velocity = velocity_of(group, lane, i, j, stretch, impulse);
    const P normal = lanes::max(P(0.0), P(impulse[0] - velocity[0] / response.normal()));
    const P limit = response.friction() * lanes::max(P(0.0), impulse[0]);
    P square(0.0);
    Vec<Dim - 1, P> slip;
    for (int k = 0; k < Dim - 1; ++k) {
      slip[k] = impulse[k + 1] - velocity[k + 1] / response.tangential();
      square += slip[k] * slip[k];
    }
    const P size = sqrt(square);
    const P factor = lanes::select(limit < size, limit / size, P(1.0));
    P difference(0.0);
    for (int k = 0; k < Dim - 1; ++k) {
      const P d = impulse[k + 1] - factor * slip[k];
      difference += d * d;
    }
    return lanes::max(lanes::absolute(P(impulse[0] - normal)), sqrt(difference));
  }

 private:
  [[gnu::always_inline]] static CoupledResponse<Dim, P> response_of(const Group& group, int lane) {
    CoupledResponse<Dim, P> response;
    int n = 0;
    response.visit([&](P& value) { value = P::load(group.response[n++] + lane); });
    return response;
  }

  /// Returns u + C p + b with the relative velocity u, the compliance C, the impulse p and the bias b, in the frames of
  /// the contacts.
  [[gnu::always_inline]] static V velocity_of(const Group& group, int lane, const Bodies& i, const Bodies& j,
                                              const V& stretch, const V& impulse) {
    V u = j.velocity() - i.velocity();
    u += cross<P>(j.spin(), load<Isa>(group.arm_j, lane));
    u -= cross<P>(i.spin(), load<Isa>(group.arm_i, lane));
    add_stretch<Isa>(group, lane, stretch, u);
    V out;
    for (int b = 0; b < Dim; ++b) {
      const Lanes& compliance = b == 0 ? group.normal_compliance : group.tangential_compliance;
      out[b] = P::load(group.bias[b] + lane) + P::load(compliance + lane) * impulse[b];
      for (int a = 0; a < Dim; ++a) out[b] += P::load(group.frame[Dim * b + a] + lane) * u[a];
    }
    return out;
  }
};

}  // namespace floc
