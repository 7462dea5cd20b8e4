#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

#include "floc/contact/contact_law.h"
#include "floc/relaxation/kernels/pack.h"
#include "floc/relaxation/kernels/step_kernels.h"

/// The kernels' text. Everything here is a template on the instruction set, and calls nothing inline that is
/// not.
namespace floc {

template <class Isa, int Dim, LatticeShape kShape, bool kRotates>
struct GrainKernels {
  static_assert(Dim == 2, "orientations in 3D are not integrated yet");
  static constexpr int kRow = row_size(kRotates);
  static constexpr bool kTriangular = kShape == LatticeShape::triangular;
  using P = Pack<Isa>;
  using Row = typename VectorOf<kRow>::Type;

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
      const double* const spin = grains.spin + begin;
      double* const angle = grains.angle + begin;
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) angle[k] += drift.time_step * spin[k];
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
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < (kTriangular ? Dim : a + 1); ++b)
        sums.virial[a][b] = crossing_virial(pairs, plan, cell, a, b) +
                            block_sum(grains.force[a] + begin, grains.x[b] + begin, nullptr);
    for (int a = 0; a < Dim; ++a) accelerate(grains, begin, kick, a);
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < (kTriangular ? Dim : a + 1); ++b)
        sums.momentum_flux[a][b] = block_sum(grains.v[a] + begin, grains.v[b] + begin, grains.mass + begin);
    if constexpr (kRotates) {
      kick_rotation(grains, begin, kick.half_step);
      const double* const spin = grains.spin + begin;
      sums.rotation = block_sum(spin, spin, grains.inertia + begin);
    }
  }

 private:
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

  /// Force along a on the grains j of pairs across the boundary, times the component b of their image's
  /// displacement.
  static double crossing_virial(const PairView<Dim>& pairs, const BlockSumsPlan& plan,
                                const PairCell<Dim>& cell, int a, int b) {
    double virial = 0.0;
    for (int c = 0; c < plan.n_crossing; ++c) {
      const int p = plan.crossing[c];
      double shift = pairs.image[b][p] * cell.lattice[b][b];
      if constexpr (kTriangular)
        for (int e = b + 1; e < Dim; ++e) shift += pairs.image[e][p] * cell.lattice[b][e];
      virial += pairs.row[static_cast<std::ptrdiff_t>(kRow) * p + a] * shift;
    }
    return virial;
  }

  static void kick_rotation(const GrainView<Dim>& grains, int begin, double half_step) {
    const double* const inverse_inertia = grains.inverse_inertia + begin;
    const double* const torque = grains.torque + begin;
    double* const spin = grains.spin + begin;
#pragma GCC ivdep
    for (int k = 0; k < kGrainBlock; ++k) spin[k] += torque[k] * (half_step * inverse_inertia[k]);
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

  static void add_row(const PairView<Dim>& pairs, int place, Row& sum) {
    Row row;
    __builtin_memcpy(&row, pairs.row + place, sizeof(Row));
    sum += row;
  }

  /// Sums of the rows of each grain of the block. Rows of pairs that do not interact are zero and leave no
  /// trace, so the sums do not depend on which of them the list holds.
  static void sum_rows(const PairView<Dim>& pairs, const SideSumsPlan& plan, Row (&total)[kGrainBlock]) {
    const int* row = plan.row;
    for (int g = 0; g < SideSumsPlan::kGroups; ++g) {
      Row sum[kSumGroup] = {};
      for (const int* const end = row + plan.depth[g] * kSumGroup; row != end; row += kSumGroup)
        for (int l = 0; l < kSumGroup; ++l) add_row(pairs, row[l], sum[l]);
      for (int l = 0; l < kSumGroup; ++l) total[plan.grain[g * kSumGroup + l]] = sum[l];
    }
    for (int k = 0; k < plan.n_deep; ++k) {
      Row sum = total[plan.grain[k]];
      for (const int* const end = row + plan.n_beyond[k]; row != end; ++row) add_row(pairs, *row, sum);
      total[plan.grain[k]] = sum;
    }
  }

  static void sum_forces(const GrainView<Dim>& grains, const PairView<Dim>& pairs, const BlockSumsPlan& plan,
                         int begin) {
    Row as_i[kGrainBlock], as_j[kGrainBlock];
    sum_rows(pairs, plan.as_i, as_i);
    sum_rows(pairs, plan.as_j, as_j);
    for (int k = 0; k < kGrainBlock; ++k) {
      const Row force = as_j[k] - as_i[k];
      for (int a = 0; a < Dim; ++a) grains.force[a][begin + k] = force[a];
      if constexpr (kRotates) grains.torque[begin + k] = as_i[k][Dim] + as_j[k][Dim + 1];
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
  static constexpr int kRow = row_size(kRotates);
  using P = Pack<Isa>;
  using V = Vec<Dim, P>;

  [[gnu::flatten]] static void compute(const void* any_law, const GrainView<Dim>& grains,
                                       const PairView<Dim>& pairs, int first, int last,
                                       const PairCell<Dim>& cell) {
    const Law law = *static_cast<const Law*>(any_law);  // a copy that no store of the loop can alias
    PairKinematics kinematics[kPacksInFlight];
    for (int p = first; p < last;) {
      const int n_packs =
          (last - p < kPacksInFlight * P::kWidth ? last - p : kPacksInFlight * P::kWidth) / P::kWidth;
      for (int k = 0; k < n_packs; ++k) {
        if constexpr (Partner::kWall)
          kinematics[k] = wall_kinematics(grains, pairs, p + k * P::kWidth, cell);
        else
          kinematics[k] = pair_kinematics(grains, pairs, p + k * P::kWidth, cell);
      }
      for (int k = 0; k < n_packs; ++k, p += P::kWidth) respond(law, kinematics[k], pairs, p);
    }
  }

 private:
  /// Packs whose geometry is found before their forces: each half is short enough for several packs to be under
  /// way at once, where one long chain of operations would be waited for.
  static constexpr int kPacksInFlight = 8;

  /// Geometry and relative motion of one pack of pairs.
  struct PairKinematics {
    V n;
    P arm_i, arm_j;
    ContactMotion<Dim, P> motion;
  };

  /// Position and velocities of the first, or the second, grain of each pair of a pack.
  struct GrainKinematics {
    V x, v;
    RotationVector<Dim, P> spin;
  };

  template <class Gather>
  static GrainKinematics gather_grains(const GrainView<Dim>& grains, const int* grain, Gather gather) {
    GrainKinematics gathered;
    for (int a = 0; a < Dim; ++a) {
      gathered.x[a] = gather(grains.x[a], grain);
      gathered.v[a] = gather(grains.v[a], grain);
    }
    if constexpr (kRotates) gathered.spin[0] = gather(grains.spin, grain);
    return gathered;
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
      add_slip(a, centres, RotationVector<Dim, P>(a.arm_i * i.spin + a.arm_j * j.spin),
               RotationVector<Dim, P>(i.spin - j.spin), cell);
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

  /// @param surfaces  arms times spins: what turning moves the surface of i against that of j
  static void add_slip(PairKinematics& a, const V& velocity, const RotationVector<Dim, P>& surfaces,
                       const RotationVector<Dim, P>& rotation, const PairCell<Dim>& cell) {
    a.motion.slip = P(cell.slip_time) * to_shear<P>(a.n, V(velocity - cross<P>(surfaces, a.n)));
    a.motion.relative_rotation = P(cell.slip_time) * rotation;
  }

  static void respond(const Law& law, const PairKinematics& a, const PairView<Dim>& pairs, int p) {
    ContactMotion<Dim, P> motion = a.motion;
    if constexpr (Law::kHasDamping) motion.damping = P::load(pairs.damping + p);
    PackedMemory<Law::template kMemorySize<Dim>, P> memory;
    load(pairs, p, memory, std::make_integer_sequence<int, Law::template kMemorySize<Dim>>());
    const ContactForces<Dim, P> f = law.respond(motion, memory);
    store(memory, pairs, p, std::make_integer_sequence<int, Law::template kMemorySize<Dim>>());

    V on_j = f.normal.force() * a.n;
    if constexpr (Law::kHasDamping) on_j += viscous(f.viscous, pairs.viscous + p) * a.n;
    double* const row = pairs.row + static_cast<std::ptrdiff_t>(kRow) * p;
    if constexpr (kRotates) {
      const V shear = from_shear<P>(a.n, f.shear);
      on_j -= shear;
      const P unit = moment<P>(a.n, shear)[0];
      Records<Isa>::store_two(row + Dim, kRow, a.arm_i * unit - f.rolling[0], a.arm_j * unit + f.rolling[0]);
    }
    Records<Isa>::store_two(row, kRow, on_j[0], on_j[1]);
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

  /// What dashpots do in this step, given their present force and that of the step before, which it replaces.
  /// Nothing where the surfaces do not touch; a contact that is new has no step before.
  static P viscous(const P& now, double* last) {
    const P before = P::load(last);
    now.store(last);
    const P both = P(kDashpotShare) * now + P(1.0 - kDashpotShare) * before;
    return blend(now * before == P(0.0), now, both);
  }
};

/// The kernels of every alternative of the law table, in its order.
template <class Isa, LatticeShape kShape, class Laws>
struct StepKernelTable;
template <class Isa, LatticeShape kShape, class... Law>
struct StepKernelTable<Isa, kShape, std::variant<Law...>> {
  using Grains = std::conditional_t<kShape == LatticeShape::triangular, GrainsInTriangularLattice,
                                    GrainsInRectangularLattice>;
  static constexpr StepKernels<2> kTable[] = {
      {&GrainKernels<Isa, 2, kShape, Law::kHasFriction>::kick_and_drift,
       &PairKernel<Isa, 2, Grains, Law>::compute, &PairKernel<Isa, 2, Walls, Law>::compute,
       &GrainKernels<Isa, 2, kShape, Law::kHasFriction>::sum_and_kick}...};
};

template <class Isa>
const StepKernels<2>* step_kernel_table(LatticeShape shape) {
  return shape == LatticeShape::rectangular
             ? StepKernelTable<Isa, LatticeShape::rectangular, AnyContactLaw>::kTable
             : StepKernelTable<Isa, LatticeShape::triangular, AnyContactLaw>::kTable;
}

}  // namespace floc
