#pragma once

#include "floc/base/lanes.h"
#include "floc/rigid/kernels/body_lanes.h"
#include "floc/rigid/kernels/sweep_kernels.h"

namespace floc {

/// Loops over the groups of contacts of a model (RoundModel and CoupledModel), for one instruction set.
template <class Isa, class Model>
struct GroupLoop {
  using Group = typename Model::Group;
  using P = Pack<Isa>;
  static constexpr int Dim = Group::kDim;
  static constexpr int kImpulse = Group::kImpulse;
  using Impulse = Vec<kImpulse, P>;
  using Bodies = BodyLanes<Isa, Dim>;

  static void solve(Group* groups, int n, double* bodies, const SweepStart& start, GroupSums& sums) {
    Totals<Dim> gain{};
    Totals<1> change{};
    const Vec<Dim, P> stretch = all_lanes(start.stretch);
    for (Group* group = groups; group != groups + n; ++group) {
      if (!start.over_all && group->is_idle) continue;
      Totals<1> size{};
      for (int lane = 0; lane < kGroup; lane += P::kWidth)
        solve_lanes(*group, lane, bodies, stretch, P(start.share), gain, change, size);
      if (start.over_all) group->is_idle = size.sum(0) == 0.0;
    }
    for (int a = 0; a < Dim; ++a) sums.gain[a] = gain.sum(a);
    sums.change = change.sum(0);
  }

  static GroupErrors errors(const Group* groups, int n, const double* bodies, const double* stretch) {
    Totals<1> sum{}, number{};
    Lanes worst = {};
    const Vec<Dim, P> rate = all_lanes(stretch);
    for (const Group* group = groups; group != groups + n; ++group)
      for (int lane = 0; lane < kGroup; lane += P::kWidth) {
        const Bodies i(bodies, group->i + lane), j(bodies, group->j + lane);
        const Impulse impulse = load<Isa>(group->impulse, lane);
        const P error = Model::error(*group, lane, i, j, rate, impulse);
        lanes::max(P::load(worst + lane), error).store(worst + lane);
        sum.add(0, lane, impulse[0]);
        number.add(0, lane, lanes::select(P(0.0) < impulse[0], P(1.0), P(0.0)));
      }
    GroupErrors out{0.0, sum.sum(0), number.sum(0)};
    for (const double error : worst) out.worst = out.worst < error ? error : out.worst;
    return out;
  }

  static void extrapolate(double* bodies, double* start, double* earlier_start, int n, double share) {
    constexpr int kMotion = BodyRow<Dim>::kMotion, kWidth = P::kWidth < kMotion ? P::kWidth : kMotion;
    using Vector = typename VectorOf<kWidth>::Type;
    const auto read = [](const double* from) {
      Vector out;
      __builtin_memcpy(&out, from, sizeof(Vector));
      return out;
    };
    const auto write = [](const Vector& numbers, double* to) {
      __builtin_memcpy(to, &numbers, sizeof(Vector));
    };
    for (int i = 0; i < n; ++i, bodies += BodyRow<Dim>::kSize, start += kMotion, earlier_start += kMotion)
      for (int k = 0; k < kMotion; k += kWidth) {
        const Vector last = read(start + k);
        const Vector now = read(bodies + k) + share * (last - read(earlier_start + k));
        write(last, earlier_start + k);
        write(now, start + k);
        write(now, bodies + k);
      }
  }

 private:
  /// n sums for each lane. The sums over the lanes are made at the end, in a fixed order.
  template <int n>
  struct Totals {
    double of[n][kGroup];

    [[gnu::always_inline]] void add(int k, int lane, const P& numbers) {
      (P::load(of[k] + lane) + numbers).store(of[k] + lane);
    }
    double sum(int k) const {
      double out = 0.0;
      for (const double part : of[k]) out += part;
      return out;
    }
  };

  static Vec<Dim, P> all_lanes(const double* numbers) {
    Vec<Dim, P> out;
    for (int a = 0; a < Dim; ++a) out[a] = P(numbers[a]);
    return out;
  }

  [[gnu::always_inline]] static P squared(const Impulse& impulse) {
    P out = impulse[0] * impulse[0];
    for (int k = 1; k < kImpulse; ++k) out += impulse[k] * impulse[k];
    return out;
  }

  /// Solves the contacts of a group that fill one register.
  [[gnu::always_inline]] static void solve_lanes(Group& group, int lane, double* bodies,
                                                 const Vec<Dim, P>& stretch, const P& share, Totals<Dim>& gain,
                                                 Totals<1>& change, Totals<1>& size) {
    const Impulse last_start = load<Isa>(group.start, lane);
    Impulse start = load<Isa>(group.impulse, lane);
    const Impulse earlier_start = load<Isa>(group.earlier_start, lane);
    for (int k = 0; k < kImpulse; ++k) start[k] += share * (last_start[k] - earlier_start[k]);
    store<Isa>(last_start, group.earlier_start, lane);
    store<Isa>(start, group.start, lane);

    Bodies i(bodies, group.i + lane), j(bodies, group.j + lane);
    const Impulse impulse = Model::impulse(group, lane, i, j, stretch, start);
    store<Isa>(impulse, group.impulse, lane);
    Impulse difference;
    for (int k = 0; k < kImpulse; ++k) difference[k] = impulse[k] - start[k];
    const Vec<Dim, P> in_space = Model::push(group, lane, difference, i, j);
    if (group.touches_itself) add_both_sides(group, lane, bodies, i, j);
    i.write_motion(bodies, group.i + lane, group.moves_i + lane);
    j.write_motion(bodies, group.j + lane, group.moves_j + lane);

    if constexpr (Group::kCell) {
      const Vec<Dim, P> branch = load<Isa>(group.branch, lane);
      for (int a = 0; a < Dim; ++a) gain.add(a, lane, branch[a] * in_space[a]);
    }
    change.add(0, lane, squared(difference));
    size.add(0, lane, squared(impulse) + squared(start) + squared(last_start));
  }

  /// If a body touches its own image, adds the changes of both sides in `j`, which is written last.
  static void add_both_sides(const Group& group, int lane, const double* bodies, const Bodies& i, Bodies& j) {
    for (int l = 0; l < P::kWidth; ++l) {
      if (group.i[lane + l] != group.j[lane + l]) continue;
      const double* const row = bodies + group.i[lane + l] * BodyRow<Dim>::kSize;
      for (int k = 0; k < kDofs<Dim>; ++k) j.column[k].v[l] += i.column[k].v[l] - row[k];
    }
  }
};

}  // namespace floc
