#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

#include "floc/contact/contact_law.h"
#include "floc/geometry/frame_turn.h"
#include "floc/relaxation/kernels/pack.h"
#include "floc/relaxation/kernels/step_kernels.h"

/// The code of the kernels. Everything here is a template on the instruction set, and calls no inline function
/// that is not.
namespace floc {

template <class Isa, int Dim, LatticeShape kShape, bool kRotates>
struct GrainKernels {
  using Layout = RowLayout<Dim, kRotates>;
  static constexpr bool kTriangular = kShape == LatticeShape::triangular;
  using P = Pack<Isa>;
  using Row = typename VectorOf<Layout::kLanes>::Type;

  [[gnu::flatten]] static void kick_and_drift(const GrainView<Dim>& grains, int begin, const Kick<Dim>& kick,
                                              const Drift<Dim>& drift, BlockSums<Dim>& sums) {
    double moved_squared[kGrainBlock] = {};
    // In a triangular lattice an axis drifts with the velocities along those after it, kicked already.
    if constexpr (kTriangular)
      for (int a = 0; a < Dim; ++a) accelerate(grains, begin, kick, a);
    for (int a = 0; a < Dim; ++a) {
      if constexpr (!kTriangular) accelerate(grains, begin, kick, a);
      move(grains, begin, drift, a, moved_squared);
    }
    if constexpr (kRotates) {
      kick_rotation(grains, begin, kick.half_step);
      turn(grains, begin, drift.time_step);
    }
    P largest(0.0);
    for (int k = 0; k < kGrainBlock; k += P::kWidth) {
      const P consumed = P::load(moved_squared + k) * P::load(grains.inverse_skin_squared + begin + k);
      largest = blend(largest < consumed, consumed, largest);
    }
    sums.consumed_squared = 0.0;
    for (int l = 0; l < P::kWidth; ++l)
      if (sums.consumed_squared < largest.v[l]) sums.consumed_squared = largest.v[l];
  }

  [[gnu::flatten]] static void sum_and_kick(const GrainView<Dim>& grains, const PairView<Dim>& pairs,
                                            const BlockSumsPlan& plan, int begin, const PairCell<Dim>& cell,
                                            const Kick<Dim>& kick, BlockSums<Dim>& sums) {
    sum_forces(grains, pairs, plan, begin);
    // Sum over pairs of f r = sum over grains of F x + what the pairs across the boundary add.
    crossing_virial(pairs, plan, cell, sums.virial);
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < (kTriangular ? Dim : a + 1); ++b)
        sums.virial[a][b] += block_sum(grains.force[a] + begin, grains.x[b] + begin, nullptr);
    for (int a = 0; a < Dim; ++a) accelerate(grains, begin, kick, a);
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < (kTriangular ? Dim : a + 1); ++b)
        sums.momentum_flux[a][b] = block_sum(grains.v[a] + begin, grains.v[b] + begin, grains.mass + begin);
    if constexpr (kRotates) {
      kick_rotation(grains, begin, kick.half_step);
      sums.rotation = 0.0;
      for (int a = 0; a < kRotations<Dim>; ++a) {
        const double* const spin = grains.spin[a] + begin;
        sums.rotation += block_sum(spin, spin, grains.inertia + begin);
      }
    }
  }

  /// In the order of the pairs, as sum_rows() adds them; those of padding are zero and leave no trace.
  static void add_to_second_grains(const PairView<Dim>& pairs, int first, int last, double* sums) {
    const double* row = row_of(pairs, first) + Layout::kReadJ;
    for (int p = first; p < last; ++p, row += Layout::kSize) {
      double* const to = sums + static_cast<std::ptrdiff_t>(Layout::kLanes) * pairs.j[p];
      Row sum;
      __builtin_memcpy(&sum, to, sizeof(Row));
      add_row(row, sum);
      __builtin_memcpy(to, &sum, sizeof(Row));
    }
  }

 private:
  static const double* row_of(const PairView<Dim>& pairs, int p) {
    return pairs.row + static_cast<std::ptrdiff_t>(Layout::kSize) * (p - pairs.with_row);
  }

  /// Axes in ascending order: each reads the velocities, not yet changed, along those after it.
  static void accelerate(const GrainView<Dim>& grains, int begin, const Kick<Dim>& kick, int a) {
    double* const v = grains.v[a] + begin;
    const double* const force = grains.force[a] + begin;
    const double* const inverse_mass = grains.inverse_mass + begin;
    const double half_step = kick.half_step, keep = kick.keep[a][a], gain = kick.gain[a][a];
#pragma GCC ivdep
    for (int k = 0; k < kGrainBlock; ++k) v[k] = v[k] * keep + half_step * inverse_mass[k] * force[k] * gain;
    if constexpr (kTriangular) {
      for (int b = a + 1; b < Dim; ++b) {
        const double* const v_b = grains.v[b] + begin;
        const double* const force_b = grains.force[b] + begin;
        const double keep_b = kick.keep[a][b], gain_b = kick.gain[a][b];
#pragma GCC ivdep
        for (int k = 0; k < kGrainBlock; ++k)
          v[k] += v_b[k] * keep_b + half_step * inverse_mass[k] * force_b[k] * gain_b;
      }
    }
  }

  /// Moves the grains along one axis, and adds to the squares of their displacements since the list was built.
  static void move(const GrainView<Dim>& grains, int begin, const Drift<Dim>& drift, int a,
                   double (&moved_squared)[kGrainBlock]) {
    const double* const v = grains.v[a] + begin;
    double* const x = grains.x[a] + begin;
    const double* const x_list = grains.x_list[a] + begin;
    const double stretch = drift.stretch[a][a], step = drift.drift[a][a],
                 list_stretch = drift.list_stretch[a][a];
    if constexpr (!kTriangular) {
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) {
        x[k] = stretch * x[k] + step * v[k];
        const double moved = x[k] - list_stretch * x_list[k];
        moved_squared[k] += moved * moved;
      }
    } else {
      double moved[kGrainBlock];
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) {
        x[k] = stretch * x[k] + step * v[k];
        moved[k] = -list_stretch * x_list[k];
      }
      for (int b = a + 1; b < Dim; ++b) {
        const double* const v_b = grains.v[b] + begin;
        const double* const x_b = grains.x[b] + begin;
        const double* const x_list_b = grains.x_list[b] + begin;
        const double stretch_b = drift.stretch[a][b], step_b = drift.drift[a][b],
                     list_b = drift.list_stretch[a][b];
#pragma GCC ivdep
        for (int k = 0; k < kGrainBlock; ++k) {
          x[k] += stretch_b * x_b[k] + step_b * v_b[k];
          moved[k] -= list_b * x_list_b[k];
        }
      }
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) moved_squared[k] += (x[k] + moved[k]) * (x[k] + moved[k]);
    }
  }

  /// Force on the grains j of pairs across the boundary, times their image's displacement.
  static void crossing_virial(const PairView<Dim>& pairs, const BlockSumsPlan& plan, const PairCell<Dim>& cell,
                              double (&virial)[Dim][Dim]) {
    double sum[Dim][Dim] = {};
    for (int c = 0; c < plan.n_crossing; ++c) {
      const int p = plan.crossing[c];
      const double* const force = row_of(pairs, p) + Layout::kForce;
      for (int b = 0; b < Dim; ++b) {
        double shift = pairs.image[b][p] * cell.lattice[b][b];
        if constexpr (kTriangular)
          for (int e = b + 1; e < Dim; ++e) shift += pairs.image[e][p] * cell.lattice[b][e];
        for (int a = kTriangular ? 0 : b; a <= b; ++a) sum[a][b] += force[a] * shift;
      }
    }
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < (kTriangular ? Dim : a + 1); ++b) virial[a][b] = sum[a][b];
  }

  static void kick_rotation(const GrainView<Dim>& grains, int begin, double half_step) {
    const double* const inverse_inertia = grains.inverse_inertia + begin;
    for (int a = 0; a < kRotations<Dim>; ++a) {
      const double* const torque = grains.torque[a] + begin;
      double* const spin = grains.spin[a] + begin;
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) spin[k] += torque[k] * (half_step * inverse_inertia[k]);
    }
  }

  /// Turns the grains by their spins; nothing reads their orientations. In 3D q <- (1, spin dt/2) q, whose
  /// direction is right to second order, kept from growing.
  static void turn(const GrainView<Dim>& grains, int begin, double time_step) {
    if constexpr (Dim == 2) {
      const double* const spin = grains.spin[0] + begin;
      double* const angle = grains.orientation[0] + begin;
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) angle[k] += time_step * spin[k];
    } else {
      const double *const x = grains.spin[0] + begin, *const y = grains.spin[1] + begin,
                          *const z = grains.spin[2] + begin;
      double *const qw = grains.orientation[0] + begin, *const qx = grains.orientation[1] + begin,
                    *const qy = grains.orientation[2] + begin, *const qz = grains.orientation[3] + begin;
      const double half = 0.5 * time_step;
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) {
        const double a = half * x[k], b = half * y[k], c = half * z[k];
        const double keep = 1.0 - 0.5 * (a * a + b * b + c * c);
        const double w0 = qw[k], x0 = qx[k], y0 = qy[k], z0 = qz[k];
        qw[k] = keep * w0 - (a * x0 + b * y0 + c * z0);
        qx[k] = keep * x0 + (a * w0 + b * z0 - c * y0);
        qy[k] = keep * y0 + (b * w0 + c * x0 - a * z0);
        qz[k] = keep * z0 + (c * w0 + a * y0 - b * x0);
      }
    }
  }

  /// sum p q over a block, in eight interleaved parts: a fixed order that registers of any width can follow,
  /// and no chain of additions to wait for. @param weight  of each term, null for 1
  static double block_sum(const double* p, const double* q, const double* weight) {
    P part[8 / P::kWidth];
    for (P& pack : part) pack = P(0.0);
    for (int k = 0; k < kGrainBlock; k += 8) {
      for (int l = 0; l < 8; l += P::kWidth) {
        P term = P::load(p + k + l) * P::load(q + k + l);
        if (weight) term *= P::load(weight + k + l);
        part[l / P::kWidth] += term;
      }
    }
    double s[8];
    for (int l = 0; l < 8; l += P::kWidth) part[l / P::kWidth].store(s + l);
    return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
  }

  static void add_row(const double* from, Row& sum) {
    Row row;
    __builtin_memcpy(&row, from, sizeof(Row));
    sum += row;
  }

  /// Sums of the rows of each grain of the block. Rows of pairs that do not interact are zero and leave no
  /// trace, so the sums do not depend on which of them the list holds.
  /// @param first  the part that grains read of the row at place 0
  static void sum_rows(const double* first, const SideSumsPlan& plan, Row (&total)[kGrainBlock]) {
    const int* row = plan.row;
    for (int g = 0; g < SideSumsPlan::kGroups; ++g) {
      Row sum[kSumGroup] = {};
      for (const int* const end = row + plan.depth[g] * kSumGroup; row != end; row += kSumGroup)
        for (int l = 0; l < kSumGroup; ++l) add_row(first + row[l], sum[l]);
      for (int l = 0; l < kSumGroup; ++l) total[plan.grain[g * kSumGroup + l]] = sum[l];
    }
    for (int k = 0; k < plan.n_deep; ++k) {
      Row sum = total[plan.grain[k]];
      for (const int* const end = row + plan.n_beyond[k]; row != end; ++row) add_row(first + *row, sum);
      total[plan.grain[k]] = sum;
    }
  }

  static void sum_forces(const GrainView<Dim>& grains, const PairView<Dim>& pairs, const BlockSumsPlan& plan,
                         int begin) {
    Row as_i[kGrainBlock], as_j[kGrainBlock];
    sum_rows(pairs.row + Layout::kReadI, plan.as_i, as_i);
    if (plan.sums_as_j) {
      __builtin_memcpy(as_j, plan.sums_as_j, sizeof(as_j));
      __builtin_memset(plan.sums_as_j, 0, sizeof(as_j));
    } else {
      sum_rows(pairs.row + Layout::kReadJ, plan.as_j, as_j);
    }
    set_forces(grains, begin, as_i, as_j);
  }

  static void set_forces(const GrainView<Dim>& grains, int begin, const Row (&as_i)[kGrainBlock],
                         const Row (&as_j)[kGrainBlock]) {
    constexpr int kForceI = Layout::kForce - Layout::kReadI, kForceJ = Layout::kForce - Layout::kReadJ;
    if constexpr (Layout::kLanes == 8 && P::kWidth == 8) {
      constexpr int kMomentI = Layout::kMomentI - Layout::kReadI;
      static_assert(kForceJ == 0 && Layout::kMomentJ - Layout::kReadJ == Dim);
      for (int k = 0; k < kGrainBlock; k += 8) {
        Records<Isa>::transpose(
            [&](int l) {
              // Force and moment of i as those of j lie, the force turned round.
              const Row from_i =
                  __builtin_shufflevector(as_i[k + l], as_i[k + l], kForceI, kForceI + 1, kForceI + 2, kMomentI,
                                          kMomentI + 1, kMomentI + 2, 6, 7);
              return Row(as_j[k + l] + from_i * Row{-1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0, 1.0});
            },
            [&](int lane, const P& sums) {
              if (lane < Dim) sums.store(grains.force[lane] + begin + k);
              if (Dim <= lane && lane < 2 * Dim) sums.store(grains.torque[lane - Dim] + begin + k);
            });
      }
    } else {
      for (int k = 0; k < kGrainBlock; ++k) {
        for (int a = 0; a < Dim; ++a) grains.force[a][begin + k] = as_j[k][kForceJ + a] - as_i[k][kForceI + a];
        if constexpr (kRotates)
          for (int a = 0; a < kRotations<Dim>; ++a)
            grains.torque[a][begin + k] =
                as_i[k][Layout::kMomentI - Layout::kReadI + a] + as_j[k][Layout::kMomentJ - Layout::kReadJ + a];
      }
    }
  }
};

/// What the second body of a pair is.
struct GrainsInRectangularLattice {
  static constexpr bool kWall = false, kTriangular = false;
};
struct GrainsInTriangularLattice {
  static constexpr bool kWall = false, kTriangular = true;
};
struct Walls {
  static constexpr bool kWall = true, kTriangular = false;
};

template <class Isa, int Dim, class Partner, class Law>
struct PairKernel {
  static constexpr bool kRotates = Law::kHasFriction;
  using Layout = RowLayout<Dim, kRotates>;
  using P = Pack<Isa>;
  using V = Vec<Dim, P>;

  [[gnu::flatten]] static void compute(const void* any_law, const GrainView<Dim>& grains,
                                       const PairView<Dim>& pairs, int first, int last,
                                       const PairCell<Dim>& cell) {
    if (first == last) return;
    const Law law = *static_cast<const Law*>(any_law);  // a copy that no store of the loop can alias
    // The geometry of the next pack is found beside the forces of the present one: each is a long chain of
    // operations, most of which wait for the one before, and the processor does not see far enough ahead.
    PairKinematics now = kinematics(grains, pairs, first, cell);
    for (int p = first; p < last; p += P::kWidth) {
      const PairKinematics next = kinematics(grains, pairs, p + P::kWidth < last ? p + P::kWidth : p, cell);
      respond(law, now, pairs, p);
      now = next;
    }
  }

 private:
  /// Whether anything that the law remembers lies in the tangent plane, and turns with it.
  static constexpr bool kTurns = Dim == 3 && kRotates;
  struct NoTurn {};
  using Turn = std::conditional_t<kTurns, FrameTurn<P>, NoTurn>;

  /// Geometry and relative motion of one pack of pairs.
  struct PairKinematics {
    V n;
    P arm_i, arm_j;
    ContactMotion<Dim, P> motion;
    [[no_unique_address]] Turn turn;
  };

  /// Position and velocities of the first, or the second, grain of each pair of a pack.
  struct GrainKinematics {
    V x, v;
    RotationVector<Dim, P> spin;
  };

  static PairKinematics kinematics(const GrainView<Dim>& grains, const PairView<Dim>& pairs, int p,
                                   const PairCell<Dim>& cell) {
    if constexpr (Partner::kWall)
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
      if constexpr (Partner::kTriangular)
        for (int b = a + 1; b < Dim; ++b) r[a] += P::load(pairs.image[b] + p) * P(cell.lattice[a][b]);
    }
    for (int a = 0; a < Dim; ++a) {
      affine[a] = P(cell.strain_rate[a][a]) * r[a];
      if constexpr (Partner::kTriangular)
        for (int b = a + 1; b < Dim; ++b) affine[a] += P(cell.strain_rate[a][b]) * r[b];
    }
    const P distance = sqrt(r.squaredNorm());
    const V n = r * (P(1.0) / distance);
    const V centres = (j.v - i.v) + affine;
    PairKinematics a = normal_kinematics(n, distance, centres, pairs, p);
    a.arm_i = P::load(pairs.share_i + p) * distance;
    a.arm_j = distance - a.arm_i;
    if constexpr (kRotates) {
      // Both turn their surfaces the same way round.
      RotationVector<Dim, P> surfaces = a.arm_i * i.spin + a.arm_j * j.spin;
      if constexpr (kTurns) {
        const P inverse = P(1.0) / distance;
        a.turn = {n, V(centres * (P(cell.slip_time) * inverse)),
                  RotationVector<Dim, P>(P(cell.slip_time) * (i.spin + j.spin))};
        // The branch at the middle of the step, to which these velocities belong.
        surfaces = surfaces * (P(1.0) - P(0.5 * cell.slip_time) * a.motion.gap_rate * inverse);
      }
      add_slip(a, centres, surfaces, RotationVector<Dim, P>(i.spin - j.spin), cell);
    }
    return a;
  }

  /// The foot of a grain's centre on the plane moves with the wall, and across it as the grains around do on
  /// average.
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
    // The normal stays; about it the frame turns with the mean of the grain's spin and none.
    if constexpr (kTurns) a.turn = {n, V(V::Zero()), RotationVector<Dim, P>(P(cell.slip_time) * i.spin)};
    if constexpr (kRotates) add_slip(a, foot, RotationVector<Dim, P>(distance * i.spin), i.spin, cell);
    return a;
  }

  /// @param velocity  of j's centre against i's
  static PairKinematics normal_kinematics(const V& n, const P& distance, const V& velocity,
                                          const PairView<Dim>& pairs, int p) {
    PairKinematics a;
    a.n = n;
    a.motion = {distance - P::load(pairs.radii + p), n.dot(velocity), P(0.0), Shear<Dim, P>::Zero(),
                RotationVector<Dim, P>::Zero()};
    if constexpr (Law::kNeedsReducedRadius) a.motion.pair.reduced_radius = P::load(pairs.reduced_radius + p);
    if constexpr (Law::kNeedsReducedMass) a.motion.pair.reduced_mass = P::load(pairs.reduced_mass + p);
    return a;
  }

  /// In 3D across the normal of the middle of the step, which makes it right to second order.
  /// @param surfaces  arms times spins: what turning moves the surface of i against that of j
  static void add_slip(PairKinematics& a, const V& velocity, const RotationVector<Dim, P>& surfaces,
                       const RotationVector<Dim, P>& rotation, const PairCell<Dim>& cell) {
    if constexpr (kTurns) {
      const V& middle = a.turn.mean_normal();
      const V slip = to_shear<P>(middle, V(velocity - cross<P>(surfaces, middle)));
      a.motion.slip = P(cell.slip_time) * to_shear<P>(a.n, slip);
      if constexpr (Law::kHasRolling)
        a.motion.relative_rotation = P(cell.slip_time) * to_shear<P>(a.n, V(to_shear<P>(middle, V(rotation))));
      if constexpr (Law::kHasTwisting) a.motion.twist = P(cell.slip_time) * middle.dot(rotation);
    } else {
      a.motion.slip = P(cell.slip_time) * to_shear<P>(a.n, V(velocity - cross<P>(surfaces, a.n)));
      a.motion.relative_rotation = P(cell.slip_time) * rolling_part<P>(a.n, rotation);
    }
  }

  static void respond(const Law& law, const PairKinematics& a, const PairView<Dim>& pairs, int p) {
    ContactMotion<Dim, P> motion = a.motion;
    if constexpr (Law::kHasDamping) motion.damping = P::load(pairs.damping + p);
    PackedMemory<Law::template kMemorySize<Dim>, P> memory;
    load(pairs, p, memory, std::make_integer_sequence<int, Law::template kMemorySize<Dim>>());
    if constexpr (kTurns)
      turn(a.turn, memory, std::make_integer_sequence<int, Law::template kMemorySize<Dim>>());
    typename Law::template PairParameters<P> parameters;
    if constexpr (Law::kHoldsLiquid)
      parameters = {P::load(pairs.strength + p), P::load(pairs.decay + p), P::load(pairs.reach + p)};
    const ContactForces<Dim, P> f = law.respond(motion, memory, parameters);
    store(memory, pairs, p, std::make_integer_sequence<int, Law::template kMemorySize<Dim>>());

    V on_j = f.normal.force() * a.n;
    if constexpr (Law::kHasDamping) on_j += viscous(f.viscous, pairs.viscous + p) * a.n;
    P row[Layout::kSize];
    for (P& number : row) number = P(0.0);
    if constexpr (kRotates) {
      const V shear = from_shear<P>(a.n, f.shear);
      on_j -= shear;
      const RotationVector<Dim, P> unit = moment<P>(a.n, shear);
      RotationVector<Dim, P> springs = f.rolling;
      if constexpr (Law::kHasTwisting) springs += f.twisting * a.n;
      for (int b = 0; b < kRotations<Dim>; ++b) {
        row[Layout::kMomentI + b] = a.arm_i * unit[b] - springs[b];
        row[Layout::kMomentJ + b] = a.arm_j * unit[b] + springs[b];
      }
    }
    for (int b = 0; b < Dim; ++b) row[Layout::kForce + b] = on_j[b];
    double* const to = pairs.row + static_cast<std::ptrdiff_t>(Layout::kSize) * (p - pairs.with_row);
    Records<Isa>::store_rows(to, row);
  }

  /// Turns what the law remembers in the tangent plane into the present one.
  template <class Memory, int... k>
  static void turn(const Turn& turn, Memory& memory, std::integer_sequence<int, k...>) {
    ((turn_number<k>(turn, memory)), ...);
  }
  template <int k, class Memory>
  static void turn_number([[maybe_unused]] const Turn& turn, [[maybe_unused]] Memory& memory) {
    if constexpr (begins_tangent<Law, Dim>(k)) {
      const V turned = turn(V(memory.value[k], memory.value[k + 1], memory.value[k + 2]));
      for (int a = 0; a < Dim; ++a) memory.value[k + a] = turned[a];
    }
  }

  template <class Memory, int... k>
  static void load(const PairView<Dim>& pairs, [[maybe_unused]] int p, Memory& memory,
                   std::integer_sequence<int, k...>) {
    ((memory.value[k] = P::load(pairs.memory[memory_place<Law, Dim>(k)] + p)), ...);
  }
  template <class Memory, int... k>
  static void store(const Memory& memory, const PairView<Dim>& pairs, [[maybe_unused]] int p,
                    std::integer_sequence<int, k...>) {
    (memory.value[k].store(pairs.memory[memory_place<Law, Dim>(k)] + p), ...);
  }

  /// Dashpot forces in this step, given their present values and those of the step before, which they replace.
  /// Zero where the surfaces do not touch; a new contact has no step before.
  static P viscous(const P& now, double* last) {
    const P before = P::load(last);
    now.store(last);
    const P both = P(kDashpotShare) * now + P(1.0 - kDashpotShare) * before;
    return blend(now * before == P(0.0), now, both);
  }
};

/// The kernels of every alternative of the law table, in its order.
template <class Isa, int Dim, LatticeShape kShape, class Laws>
struct StepKernelTable;
template <class Isa, int Dim, LatticeShape kShape, class... Law>
struct StepKernelTable<Isa, Dim, kShape, std::variant<Law...>> {
  using Grains = std::conditional_t<kShape == LatticeShape::triangular, GrainsInTriangularLattice,
                                    GrainsInRectangularLattice>;
  /// No kernels of a law for another dimension.
  template <class L>
  static constexpr StepKernels<Dim> kernels_of() {
    if constexpr (L::kDimension != 0 && L::kDimension != Dim) {
      return {};
    } else {
      return {&GrainKernels<Isa, Dim, kShape, L::kHasFriction>::kick_and_drift,
              &PairKernel<Isa, Dim, Grains, L>::compute, &PairKernel<Isa, Dim, Walls, L>::compute,
              &GrainKernels<Isa, Dim, kShape, L::kHasFriction>::add_to_second_grains,
              &GrainKernels<Isa, Dim, kShape, L::kHasFriction>::sum_and_kick};
    }
  }
  static constexpr StepKernels<Dim> kTable[] = {kernels_of<Law>()...};
};

template <class Isa, int Dim>
const StepKernels<Dim>* step_kernel_table(LatticeShape shape) {
  return shape == LatticeShape::rectangular
             ? StepKernelTable<Isa, Dim, LatticeShape::rectangular, AnyContactLaw>::kTable
             : StepKernelTable<Isa, Dim, LatticeShape::triangular, AnyContactLaw>::kTable;
}

}  // namespace floc
