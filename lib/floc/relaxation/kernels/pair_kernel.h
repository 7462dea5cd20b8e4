#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include "floc/base/pack.h"
#include "floc/contact/contact_law.h"
#include "floc/contact/history_layout.h"
#include "floc/geometry/frame_turn.h"
#include "floc/relaxation/kernels/kernel_law.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// Template arguments for the kind of the second body of the pairs of a kernel: a grain in a rectangular lattice, a
/// grain in a triangular lattice, or a wall.
struct GrainsInRectangularLattice {
  static constexpr bool kWall = false, kTriangular = false;
};
struct GrainsInTriangularLattice {
  static constexpr bool kWall = false, kTriangular = true;
};
struct Walls {
  static constexpr bool kWall = true, kTriangular = false;
};

/// Loop that computes the forces of pairs for one kernel law (contact law for which kernels are compiled,
/// kernel_law.h). Like all kernel code, this class has the instruction set as a template argument, and all inline
/// functions that it calls have this argument, too.
template <class Isa, int Dim, class Second, class Law>
struct PairKernel {
  static constexpr bool kRotates = Law::kHasFriction;
  using P = Pack<Isa>;
  using V = Vec<Dim, P>;

  [[gnu::flatten]] static void compute(const void* any_law, const GrainView<Dim>& grains_given,
                                       const PairView<Dim>& pairs_given, int first, int last,
                                       const PairCell<Dim>& cell_given) {
    if (first == last) return;
    // Because of these local copies, the compiler may assume that the results written in the loop do not change the law
    // or the arrays.
    const Law law = *static_cast<const Law*>(any_law);
    const GrainView<Dim> grains = grains_given;
    WithoutHistory without_history;
    const Pairs pairs(pairs_given, without_history);
    const PairCell<Dim> cell = cell_given;
    // The geometry of the next pack of pairs (as many as fit a vector register) is computed together with the forces of
    // the present pack. Each computation is a long chain of dependent operations, and the processor does not look far
    // enough ahead to overlap the two chains by itself.
    PairKinematics now = kinematics(grains, pairs, first, cell);
    for (int p = first; p < last; p += P::kWidth) {
      const PairKinematics next = kinematics(grains, pairs, p + P::kWidth < last ? p + P::kWidth : p, cell);
      respond(law, now, pairs, p);
      now = next;
    }
  }

 private:
  /// Whether the history of a contact may contain vectors in its tangent plane. Such vectors have to be rotated with
  /// the plane.
  static constexpr bool kTurns = Dim == 3 && kRotates;
  struct NoTurn {};
  using Turn = std::conditional_t<kTurns, FrameTurn<P>, NoTurn>;

  /// Whether the contact law of the scene may lack history variables of `Law`, for which this kernel is compiled.
  /// Dashpot forces do not count as history variables here.
  static constexpr bool kMayLackHistory = !kHasSpecialKernels<typename Law::NormalModel>;
  static constexpr int kHistorySize = Law::template kHistorySize<Dim>;

  /// Memory for history variables that exist in the law of this kernel but not in the contact law of the scene, for one
  /// pack of pairs (as many as fit a vector register). The variables are zero and stay zero, since they belong to
  /// models without effect.
  struct WithoutHistory {
    alignas(64) double viscous[P::kWidth] = {};
    alignas(64) double history[kMayLackHistory ? HistoryLayout<Dim>::kSize : 1][P::kWidth] = {};
  };

  /// Integer type of the bit masks that are applied to indices of pairs: std::ptrdiff_t in 2D, int in 3D. With the
  /// types exchanged, GCC 12 orders the instructions differently, and time steps of disks with friction and of elastic
  /// spheres take a tenth longer.
  using Own = std::conditional_t<Dim == 2, std::ptrdiff_t, int>;

  /// Arrays of the pairs, with memory for every history variable of the law for which this kernel is compiled, even if
  /// the law of the scene has fewer.
  struct Pairs : PairView<Dim> {
    /// Bit masks applied to the index of a pair before a history variable is read: -1 if every pair has its own value;
    /// 0 if all packs of pairs share one pack of values.
    Own own_history[kMayLackHistory ? HistoryLayout<Dim>::kSize : 1];
    Own own_viscous = -1;

    Pairs(const PairView<Dim>& view, WithoutHistory& without_history) : PairView<Dim>(view) {
      if (this->viscous == nullptr) {
        this->viscous = without_history.viscous;
        own_viscous = 0;
      }
      if constexpr (kMayLackHistory) {
        for (int k = 0; k < HistoryLayout<Dim>::kSize; ++k) {
          own_history[k] = this->history[k] == nullptr ? 0 : -1;
          if (own_history[k] == 0) this->history[k] = without_history.history[k];
        }
      }
    }
    double* viscous_of(int p) const { return this->viscous + (p & own_viscous); }
    /// @tparam k index of a history variable among those of the law for which this kernel is compiled
    template <int k>
    double* history_of(int p) const {
      constexpr int place = history_place<Law, Dim>(k);
      if constexpr (kMayLackHistory) return this->history[place] + (p & own_history[place]);
      return this->history[place] + p;
    }
  };

  /// Geometry and relative motion of the two bodies of each pair, for one pack of pairs (as many as fit a vector
  /// register).
  struct PairKinematics {
    V n;
    P arm_i, arm_j;
    ContactMotion<Dim, P> motion;
    [[no_unique_address]] Turn turn;
  };

  /// Positions, velocities and spins of either the first or the second grains of a pack of pairs (as many as fit a
  /// vector register).
  struct GrainKinematics {
    V x, v;
    RotationVector<Dim, P> spin;
  };

  static PairKinematics kinematics(const GrainView<Dim>& grains, const PairView<Dim>& pairs, int p,
                                   const PairCell<Dim>& cell) {
    if constexpr (Second::kWall)
      return wall_kinematics(grains, pairs, p, cell);
    else
      return pair_kinematics(grains, pairs, p, cell);
  }

  template <class Gather>
  static GrainKinematics gather_grains(const GrainView<Dim>& grains, const int* grain, Gather gather) {
    GrainKinematics gathered;
    gather_axes(grains.x, grain, gather, gathered.x, std::make_integer_sequence<int, Dim>());
    gather_axes(grains.v, grain, gather, gathered.v, std::make_integer_sequence<int, Dim>());
    if constexpr (kRotates)
      gather_axes(grains.spin, grain, gather, gathered.spin,
                  std::make_integer_sequence<int, kRotations<Dim>>());
    return gathered;
  }
  /// Gathers the components of a vector, such as the velocity, for the grains of a pack of pairs. The loop over axes is
  /// unrolled, because a loop would store the gathered numbers in memory instead of registers.
  template <class Arrays, class Gather, class Vectors, int... axis>
  static void gather_axes(const Arrays& from, const int* grain, Gather gather, Vectors& to,
                          std::integer_sequence<int, axis...>) {
    ((to[axis] = gather(from[axis], grain)), ...);
  }

  static PairKinematics pair_kinematics(const GrainView<Dim>& grains, const PairView<Dim>& pairs, int p,
                                        const PairCell<Dim>& cell) {
    const GrainKinematics i = gather_grains(grains, pairs.i + p, Records<Isa>::gather_window);
    const GrainKinematics j = gather_grains(grains, pairs.j + p, Records<Isa>::gather);
    V r, affine;
    for (int a = 0; a < Dim; ++a) {
      r[a] = (j.x[a] - i.x[a]) + P::load(pairs.image[a] + p) * P(cell.lattice[a][a]);
      if constexpr (Second::kTriangular)
        for (int b = a + 1; b < Dim; ++b) r[a] += P::load(pairs.image[b] + p) * P(cell.lattice[a][b]);
    }
    for (int a = 0; a < Dim; ++a) {
      affine[a] = P(cell.strain_rate[a][a]) * r[a];
      if constexpr (Second::kTriangular)
        for (int b = a + 1; b < Dim; ++b) affine[a] += P(cell.strain_rate[a][b]) * r[b];
    }
    const P squared = r.squaredNorm();
    const P distance = sqrt(squared);
    // In 3D the square root and the division do not depend on each other and can overlap. In 2D the division needs the
    // root. This formula is kept, because it reproduces the results of earlier versions of floc bit for bit.
    const P inverse = Dim == 3 ? distance * (P(1.0) / squared) : P(1.0) / distance;
    const V n = r * inverse;
    const V centres = (j.v - i.v) + affine;
    PairKinematics a = normal_kinematics(n, distance, centres, pairs, p);
    a.arm_i = number(pairs.share_i, pairs, p) * distance;
    a.arm_j = distance - a.arm_i;
    if constexpr (kTurns) {
      const P time(cell.slip_time), per_length = time * inverse;
      const P along = per_length * a.motion.gap_rate;
      a.turn = {n, along, V(per_length * centres - along * n), RotationVector<Dim, P>(i.spin + j.spin), time};
      // `middle` is the time step times the length of the branch vector in the middle of the step. The velocities of
      // the grains, too, are those in the middle of the step.
      const P middle = distance * (time - P(0.5 * cell.slip_time) * along);
      const P arm_i = number(pairs.share_i, pairs, p) * middle;
      a.motion.slip = a.turn.slip(distance, RotationVector<Dim, P>(arm_i * i.spin + (middle - arm_i) * j.spin));
      add_rotation(a, RotationVector<Dim, P>(i.spin - j.spin), cell);
    } else if constexpr (kRotates) {
      // Equal spins of the two grains move their surfaces in opposite directions at the contact, so the contributions
      // of the two spins to the slip have equal signs.
      add_slip(a, centres, RotationVector<Dim, P>(a.arm_i * i.spin + a.arm_j * j.spin), cell);
      add_rotation(a, RotationVector<Dim, P>(i.spin - j.spin), cell);
    }
    return a;
  }

  /// Computes the kinematics of pairs of a grain and a wall. The point of the wall nearest to the centre of the grain
  /// moves with the wall along the normal. In the plane of the wall the peculiar velocity of this point is zero, like
  /// the mean peculiar velocity of the grains nearby.
  static PairKinematics wall_kinematics(const GrainView<Dim>& grains, const PairView<Dim>& pairs, int p,
                                        const PairCell<Dim>& cell) {
    const GrainKinematics i = gather_grains(grains, pairs.i + p, Records<Isa>::gather);
    const int* const wall = pairs.j + p;
    V n;
    for (int a = 0; a < Dim; ++a) n[a] = Records<Isa>::gather(cell.walls.normal[a], wall);
    const P distance = Records<Isa>::gather(cell.walls.level, wall) - n.dot(i.x);
    const V foot = Records<Isa>::gather(cell.walls.level_rate, wall) * n - i.v;
    PairKinematics a = normal_kinematics(n, distance, foot, pairs, p);
    a.arm_i = distance;
    a.arm_j = P(0.0);
    // The normal of a wall does not rotate. The contact frame rotates about the normal by the mean of the spins of the
    // two bodies; the spin of the wall is zero.
    if constexpr (kTurns) a.turn = {n, P(0.0), V(V::Zero()), i.spin, P(cell.slip_time)};
    if constexpr (kRotates) {
      add_slip(a, foot, RotationVector<Dim, P>(distance * i.spin), cell);
      add_rotation(a, i.spin, cell);
    }
    return a;
  }

  /// Returns the entries of the array `numbers` for one pack of pairs (as many as fit a vector register), whose first
  /// pair is p. If all pairs are equal, the array has entries for only one pack (PairView::own_numbers).
  static P number(const double* numbers, const PairView<Dim>& pairs, int p) {
    return P::load(numbers + (p & pairs.own_numbers));
  }

  /// Sets the normal, the gap and its rate, and the reduced radius and mass of a pack of pairs.
  /// @param velocity  velocity of the centre of grain j (or of the nearest point of the wall) relative to the centre of
  /// grain i
  static PairKinematics normal_kinematics(const V& n, const P& distance, const V& velocity,
                                          const PairView<Dim>& pairs, int p) {
    PairKinematics a;
    a.n = n;
    a.motion = {distance - number(pairs.radii, pairs, p), n.dot(velocity), P(0.0), Shear<Dim, P>::Zero(),
                RotationVector<Dim, P>::Zero()};
    if constexpr (Law::kNeedsReducedRadius)
      a.motion.pair.reduced_radius = number(pairs.reduced_radius, pairs, p);
    if constexpr (Law::kNeedsReducedMass) a.motion.pair.reduced_mass = number(pairs.reduced_mass, pairs, p);
    return a;
  }

  /// Sets the slip of the two surfaces in this time step, in 2D and at walls. (In other cases the slip depends on the
  /// rotation of the normal.)
  /// @param velocity  velocity of the centre of grain j (or of the nearest point of the wall) relative to the centre of
  /// grain i
  /// @param surfaces  lever arm times spin, summed over both bodies, from which the relative velocity of the surfaces
  /// follows
  static void add_slip(PairKinematics& a, const V& velocity, const RotationVector<Dim, P>& surfaces,
                       const PairCell<Dim>& cell) {
    a.motion.slip = P(cell.slip_time) * to_shear<P>(a.n, V(velocity - cross<P>(surfaces, a.n)));
  }

  /// Sets the rolling and twisting rotations of the two bodies in this time step. In 3D the rolling rotation is the
  /// component of the relative rotation perpendicular to the contact normal, the twisting rotation the component along
  /// the normal. The normal is taken in the middle of the step, so that both rotations are accurate to second order.
  static void add_rotation(PairKinematics& a, const RotationVector<Dim, P>& rotation,
                           const PairCell<Dim>& cell) {
    if constexpr (kTurns) {
      const V& middle = a.turn.mean_normal();
      if constexpr (Law::kHasRolling)
        a.motion.relative_rotation = P(cell.slip_time) * to_shear<P>(a.n, V(to_shear<P>(middle, V(rotation))));
      if constexpr (Law::kHasTwisting) a.motion.twist = P(cell.slip_time) * middle.dot(rotation);
    } else {
      a.motion.relative_rotation = P(cell.slip_time) * rolling_part<P>(a.n, rotation);
    }
  }

  static void respond(const Law& law, const PairKinematics& a, const Pairs& pairs, int p) {
    ContactMotion<Dim, P> motion = a.motion;
    if constexpr (Law::kHasDamping) motion.damping = number(pairs.damping, pairs, p);
    PackedHistory<kHistorySize, P> history;
    load(pairs, p, history, std::make_integer_sequence<int, kHistorySize>());
    if constexpr (kTurns) turn(a.turn, history, std::make_integer_sequence<int, kHistorySize>());
    typename Law::template PairParameters<P> parameters;
    if constexpr (Law::kHoldsLiquid)
      parameters = {P::load(pairs.strength + p), P::load(pairs.decay + p), P::load(pairs.reach + p)};
    const ContactForces<Dim, P> f = law.respond(motion, history, parameters);
    store(history, pairs, p, std::make_integer_sequence<int, kHistorySize>());

    V on_j = f.normal.force() * a.n;
    // If the contact law of the scene has no damping, the dashpot force added here is zero. The addition may turn a
    // component of -0 into +0, which has no effect on the sums of the forces.
    if constexpr (Law::kHasDamping) on_j += viscous(f.viscous, pairs.viscous_of(p)) * a.n;
    Moments moments;
    if constexpr (kRotates) {
      const V shear = from_shear<P>(a.n, f.shear);
      on_j -= shear;
      moments.of_unit_arm = moment<P>(a.n, shear);
      moments.of_springs = f.rolling;
      if constexpr (Law::kHasTwisting) moments.of_springs += f.twisting * a.n;
    }
    // Pairs with walls write rows (forces and moments) of the same kind as pairs of grains, since all rows are summed
    // together.
    if constexpr (Second::kWall && kTurns) {
      if (pairs.rows == RowKind::levers)
        store_row<RowKind::levers>(a, on_j, moments, pairs, p);
      else
        store_row<RowKind::moments>(a, on_j, moments, pairs, p);
    } else {
      store_row<kRowKind<Law, Dim>>(a, on_j, moments, pairs, p);
    }
  }

  struct Moments {
    RotationVector<Dim, P> of_unit_arm, of_springs;
  };

  template <RowKind kKind>
  static void store_row(const PairKinematics& a, const V& on_j, const Moments& moments,
                        const PairView<Dim>& pairs, int p) {
    using Layout = RowLayout<Dim, kKind>;
    P row[Layout::kSize];
    for (P& number : row) number = P(0.0);
    for (int b = 0; b < Dim; ++b) row[Layout::kForce + b] = on_j[b];
    if constexpr (kKind == RowKind::levers && Second::kWall) {
      // The moment on the wall is not used. The row therefore contains the whole moment on grain i instead of the
      // moment for a lever arm of unit length, together with a lever arm of 1.
      row[Layout::kArmI] = P(1.0);
      for (int b = 0; b < kRotations<Dim>; ++b)
        row[Layout::kUnitMoment + b] = a.arm_i * moments.of_unit_arm[b] - moments.of_springs[b];
    } else if constexpr (kKind == RowKind::levers) {
      row[Layout::kArmI] = a.arm_i;
      row[Layout::kArmJ] = a.arm_j;
      for (int b = 0; b < kRotations<Dim>; ++b) row[Layout::kUnitMoment + b] = moments.of_unit_arm[b];
    } else if constexpr (kKind == RowKind::moments) {
      for (int b = 0; b < kRotations<Dim>; ++b) {
        row[Layout::kMomentI + b] = a.arm_i * moments.of_unit_arm[b] - moments.of_springs[b];
        row[Layout::kMomentJ + b] = a.arm_j * moments.of_unit_arm[b] + moments.of_springs[b];
      }
    }
    double* const to = pairs.row + static_cast<std::ptrdiff_t>(Layout::kSize) * (p - pairs.with_row);
    Records<Isa>::store_rows(to, row);
  }

  /// Rotates the tangential vectors of the history from the previous to the present tangent plane of the contact.
  template <class History, int... k>
  static void turn(const Turn& turn, History& history, std::integer_sequence<int, k...>) {
    ((turn_number<k>(turn, history)), ...);
  }
  template <int k, class History>
  static void turn_number([[maybe_unused]] const Turn& turn, [[maybe_unused]] History& history) {
    if constexpr (begins_tangent<Law, Dim>(k)) {
      const V turned = turn(V(history.value[k], history.value[k + 1], history.value[k + 2]));
      for (int a = 0; a < Dim; ++a) history.value[k + a] = turned[a];
    }
  }

  template <class History, int... k>
  static void load(const Pairs& pairs, [[maybe_unused]] int p, History& history,
                   std::integer_sequence<int, k...>) {
    ((history.value[k] = P::load(pairs.template history_of<k>(p))), ...);
  }
  template <class History, int... k>
  static void store(const History& history, const Pairs& pairs, [[maybe_unused]] int p,
                    std::integer_sequence<int, k...>) {
    (history.value[k].store(pairs.template history_of<k>(p)), ...);
  }

  /// Returns the dashpot forces that act in this time step: the weighted mean (kDashpotShare) of the present forces
  /// `now` and the forces of the previous step in `last`. If one of the two forces of a pair is zero (no contact, or a
  /// new contact), the present force is returned. The present forces are then stored in `last`.
  static P viscous(const P& now, double* last) {
    const P before = P::load(last);
    now.store(last);
    const P both = P(kDashpotShare) * now + P(1.0 - kDashpotShare) * before;
    return blend(now * before == P(0.0), now, both);
  }
};

}  // namespace floc
