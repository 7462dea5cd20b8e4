#pragma once

#include <cstddef>

#include "floc/base/pack.h"
#include "floc/relaxation/kernels/step_kernels.h"

namespace floc {

/// Loops over the grains of a block. Like all kernel code, this class has the instruction set as a template argument,
/// and all inline functions that it calls have this argument, too.
template <class Isa, int Dim, LatticeShape kShape, RowKind kRows>
struct GrainKernels {
  using Layout = RowLayout<Dim, kRows>;
  static constexpr bool kRotates = kRows != RowKind::forces;
  static constexpr bool kTriangular = kShape == LatticeShape::triangular;
  using P = Pack<Isa>;
  /// Number of vector registers that hold the sum of the rows (forces and moments) of all pairs of a grain: one for
  /// forces and, in 3D, one for moments. A register may contain further entries of a row; their sums are not used.
  static constexpr int kParts = Dim == 3 && kRotates ? 2 : 1;
  using Part = typename VectorOf<row_sum_size<Dim>(kRows) / kParts>::Type;
  struct Sum {
    Part part[kParts];
  };
  enum class Side { i, j };
  using Torques = double[kRotations<Dim>][kGrainBlock];

  [[gnu::flatten]] static void kick_and_drift(const GrainView<Dim>& grains, int begin, const Kick<Dim>& kick,
                                              const Drift<Dim>& drift, Rotation stands) {
    // In a triangular lattice, the drift along an axis depends on the kicked velocities along later axes, so all axes
    // are kicked first.
    if constexpr (kTriangular)
      for (int a = 0; a < Dim; ++a) accelerate(grains, begin, kick, a);
    for (int a = 0; a < Dim; ++a) {
      if constexpr (!kTriangular) accelerate(grains, begin, kick, a);
      move(grains, begin, drift, a);
    }
    if constexpr (kRotates) {
      if (stands == Rotation::at_end) {
        for (int a = 0; a < kRotations<Dim>; ++a)
          kick_rotation<1>(grains, begin, kick.half_step, a, grains.torque[a] + begin);
        turn(grains, begin, kick.half_step);
      }
    }
  }

  [[gnu::flatten]] static double motion_squared(const GrainView<Dim>& grains, int begin,
                                                const double (&list_stretch)[Dim][Dim]) {
    double moved_squared[kGrainBlock] = {};
    for (int a = 0; a < Dim; ++a) add_displacement(grains, begin, list_stretch, a, moved_squared);
    P largest(0.0);
    for (int k = 0; k < kGrainBlock; k += P::kWidth)
      keep_larger(P::load(moved_squared + k) * P::load(grains.inverse_skin_squared + begin + k), largest);
    return largest_lane(largest);
  }

  [[gnu::flatten]] static void sum_and_kick(const GrainView<Dim>& grains, const PairView<Dim>& pairs,
                                            const BlockSumsPlan& plan, int begin, const PairCell<Dim>& cell,
                                            const Kick<Dim>& kick, Rotation to, BlockSums<Dim>& sums) {
    alignas(64) Torques torque;
    sum_forces(grains, plan, begin, torque);
    // For the virial, the sum over pairs of force times branch vector equals the sum over grains of net force times
    // position, plus a contribution of the pairs that interact across the periodic boundary.
    crossing_virial(pairs, plan, cell, sums.virial);
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < (kTriangular ? Dim : a + 1); ++b)
        sums.virial[a][b] += block_sum(grains.force[a] + begin, grains.x[b] + begin, nullptr);
    for (int a = 0; a < Dim; ++a) accelerate(grains, begin, kick, a);
    sums.next_speed_squared = next_speed_squared(grains, begin, kick.half_step);
    for (int a = 0; a < Dim; ++a)
      for (int b = a; b < (kTriangular ? Dim : a + 1); ++b)
        sums.momentum_flux[a][b] =
            block_sum(grains.v[a] + begin, grains.v[b] + begin, masses(grains, grains.mass, begin));
    if constexpr (kRotates) {
      if (to == Rotation::in_middle) {
        for (int a = 0; a < kRotations<Dim>; ++a) kick_rotation<2>(grains, begin, kick.half_step, a, torque[a]);
        turn(grains, begin, kick.half_step);
      } else {
        for (int a = 0; a < kRotations<Dim>; ++a) kick_rotation<1>(grains, begin, kick.half_step, a, torque[a]);
        end_rotation(grains, begin, torque, sums);
      }
    }
  }

 private:
  static const double* row_of(const PairView<Dim>& pairs, int p) {
    return pairs.row + static_cast<std::ptrdiff_t>(Layout::kSize) * (p - pairs.with_row);
  }

  /// Returns the address of the entries of a block in one of these arrays: masses, inverse masses, moments of inertia,
  /// inverse moments of inertia.
  /// @param of_grains  array with the value of each grain; if all grains are equal, every block uses the values of the
  /// first block (GrainView::own_masses)
  /// @param begin  first grain of the block
  static const double* masses(const GrainView<Dim>& grains, const double* of_grains, int begin) {
    return of_grains + (begin & grains.own_masses);
  }

  /// Kicks the grains of a block along axis a. The axes have to be kicked in ascending order, because the kick along an
  /// axis reads the velocities along later axes, which must not have been kicked yet.
  static void accelerate(const GrainView<Dim>& grains, int begin, const Kick<Dim>& kick, int a) {
    double* const v = grains.v[a] + begin;
    const double* const force = grains.force[a] + begin;
    const double* const inverse_mass = masses(grains, grains.inverse_mass, begin);
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

  /// Moves the grains of a block along axis a over a time step.
  static void move(const GrainView<Dim>& grains, int begin, const Drift<Dim>& drift, int a) {
    const double* const v = grains.v[a] + begin;
    double* const x = grains.x[a] + begin;
    const double stretch = drift.stretch[a][a], step = drift.drift[a][a];
#pragma GCC ivdep
    for (int k = 0; k < kGrainBlock; ++k) x[k] = stretch * x[k] + step * v[k];
    if constexpr (kTriangular) {
      for (int b = a + 1; b < Dim; ++b) {
        const double* const v_b = grains.v[b] + begin;
        const double* const x_b = grains.x[b] + begin;
        const double stretch_b = drift.stretch[a][b], step_b = drift.drift[a][b];
#pragma GCC ivdep
        for (int k = 0; k < kGrainBlock; ++k) x[k] += stretch_b * x_b[k] + step_b * v_b[k];
      }
    }
  }

  /// Adds to `moved_squared` the square of the displacement of each grain along axis a since the neighbour lists were
  /// built.
  static void add_displacement(const GrainView<Dim>& grains, int begin, const double (&list_stretch)[Dim][Dim],
                               int a, double (&moved_squared)[kGrainBlock]) {
    const double* const x = grains.x[a] + begin;
    const double* const x_list = grains.x_list[a] + begin;
    const double stretch = list_stretch[a][a];
    if constexpr (!kTriangular) {
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) {
        const double moved = x[k] - stretch * x_list[k];
        moved_squared[k] += moved * moved;
      }
    } else {
      double moved[kGrainBlock];
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) moved[k] = -stretch * x_list[k];
      for (int b = a + 1; b < Dim; ++b) {
        const double* const x_list_b = grains.x_list[b] + begin;
        const double stretch_b = list_stretch[a][b];
#pragma GCC ivdep
        for (int k = 0; k < kGrainBlock; ++k) moved[k] -= stretch_b * x_list_b[k];
      }
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) moved_squared[k] += (x[k] + moved[k]) * (x[k] + moved[k]);
    }
  }

  /// For the grains of a block, returns an upper bound of (speed/skin)^2 after the next kick
  /// (BlockSums::next_speed_squared). The bound follows from (p + q)^2 <= 1.2 p^2 + 6 q^2, where p is the speed of a
  /// grain and q the change of this speed by the kick. Usually q is small compared with p.
  static double next_speed_squared(const GrainView<Dim>& grains, int begin, double half_step) {
    const double* const inverse_mass = masses(grains, grains.inverse_mass, begin);
    P largest(0.0);
    for (int k = 0; k < kGrainBlock; k += P::kWidth) {
      const P gain = P(half_step) * P::load(inverse_mass + k);
      P speed_squared(0.0), force_squared(0.0);
      for (int a = 0; a < Dim; ++a) {
        const P v = P::load(grains.v[a] + begin + k), force = P::load(grains.force[a] + begin + k);
        speed_squared += v * v;
        force_squared += force * force;
      }
      keep_larger((P(1.2) * speed_squared + P(6.0) * (gain * gain) * force_squared) *
                      P::load(grains.inverse_skin_squared + begin + k),
                  largest);
    }
    return largest_lane(largest);
  }

  static void keep_larger(const P& number, P& largest) {
    largest = blend(largest < number, number, largest);
  }

  static double largest_lane(const P& lanes) {
    double largest = 0.0;
    for (int l = 0; l < P::kWidth; ++l)
      if (largest < lanes.v[l]) largest = lanes.v[l];
    return largest;
  }

  /// Computes the contribution to the virial of the pairs that interact across the periodic boundary: the force on the
  /// second grain j times the vector from j to its periodic image.
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

  /// Kicks the spins of the grains of a block about axis a, over a time of `kHalves` half steps, with unchanged
  /// torques.
  template <int kHalves>
  static void kick_rotation(const GrainView<Dim>& grains, int begin, double half_step, int a,
                            const double* torque) {
    const double* const inverse_inertia = masses(grains, grains.inverse_inertia, begin);
    double* const spin = grains.spin[a] + begin;
#pragma GCC ivdep
    for (int k = 0; k < kGrainBlock; ++k) {
      const double half = torque[k] * (half_step * inverse_inertia[k]);
      spin[k] += half;
      if constexpr (kHalves == 2) spin[k] += half;
    }
  }

  /// Sets BlockSums::rotation, the sum of I w^2 over the grains of the block, with moment of inertia I and spin w.
  /// Stores the torques, which the first half kick of the next step reads.
  static void end_rotation(const GrainView<Dim>& grains, int begin, const Torques& torque,
                           BlockSums<Dim>& sums) {
    sums.rotation = 0.0;
    for (int a = 0; a < kRotations<Dim>; ++a) {
      const double* const spin = grains.spin[a] + begin;
      sums.rotation += block_sum(spin, spin, masses(grains, grains.inertia, begin));
      __builtin_memcpy(grains.torque[a] + begin, torque[a], sizeof(torque[a]));
    }
  }

  /// Rotates the grains of a block by their spins over a whole time step dt. In 3D the quaternion q of the orientation
  /// becomes (1, spin dt/2) q, where the real part 1 is reduced so that the length of q does not grow. The rotation is
  /// accurate to second order in dt. Forces do not depend on the orientations.
  static void turn(const GrainView<Dim>& grains, int begin, double half_step) {
    if constexpr (Dim == 2) {
      const double time_step = 2.0 * half_step;
      const double* const spin = grains.spin[0] + begin;
      double* const angle = grains.orientation[0] + begin;
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) angle[k] += time_step * spin[k];
    } else {
      const double *const x = grains.spin[0] + begin, *const y = grains.spin[1] + begin,
                          *const z = grains.spin[2] + begin;
      double *const qw = grains.orientation[0] + begin, *const qx = grains.orientation[1] + begin,
                    *const qy = grains.orientation[2] + begin, *const qz = grains.orientation[3] + begin;
#pragma GCC ivdep
      for (int k = 0; k < kGrainBlock; ++k) {
        const double a = half_step * x[k], b = half_step * y[k], c = half_step * z[k];
        const double keep = 1.0 - 0.5 * (a * a + b * b + c * c);
        const double w0 = qw[k], x0 = qx[k], y0 = qy[k], z0 = qz[k];
        qw[k] = keep * w0 - (a * x0 + b * y0 + c * z0);
        qx[k] = keep * x0 + (a * w0 + b * z0 - c * y0);
        qy[k] = keep * y0 + (b * w0 + c * x0 - a * z0);
        qz[k] = keep * z0 + (c * w0 + a * y0 - b * x0);
      }
    }
  }

  /// Returns the sum of the products p[k] q[k] over the grains k of a block, computed as eight interleaved partial
  /// sums. The order of additions is therefore independent of the width of the registers, and there is no long chain of
  /// dependent additions.
  /// @param weight  factors of the products; null stands for factors of 1
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

  template <Side side>
  static void add_row(const double* row, Sum& sum) {
    Part part;
    __builtin_memcpy(&part, row + Layout::kForce, sizeof(part));
    sum.part[0] += part;
    if constexpr (kRows == RowKind::levers) {
      __builtin_memcpy(&part, row + Layout::kUnitMoment, sizeof(part));
      sum.part[1] += row[side == Side::i ? Layout::kArmI : Layout::kArmJ] * part;
    } else if constexpr (kParts == 2) {
      __builtin_memcpy(&part, row + (side == Side::i ? Layout::kMomentI : Layout::kMomentJ), sizeof(part));
      sum.part[1] += part;
    }
  }

  /// Sums the rows (forces and moments) of the pairs of each grain of the block. The rows of pairs that do not interact
  /// are zero, so the result does not depend on how many such pairs are listed.
  /// @param first  address from which the places of rows are counted
  template <Side side>
  static void sum_rows(const double* first, const SideSumsPlan& plan, Sum (&total)[kGrainBlock]) {
    const int* row = plan.row;
    for (int g = 0; g < SideSumsPlan::kGroups; ++g) {
      Sum sum[kSumGroup] = {};
      for (const int* const end = row + plan.depth[g] * kSumGroup; row != end; row += kSumGroup)
        for (int l = 0; l < kSumGroup; ++l) add_row<side>(first + row[l], sum[l]);
      for (int l = 0; l < kSumGroup; ++l) total[plan.grain[g * kSumGroup + l]] = sum[l];
    }
    for (int k = 0; k < plan.n_deep; ++k) {
      Sum sum = total[plan.grain[k]];
      for (const int* const end = row + plan.n_beyond[k]; row != end; ++row) add_row<side>(first + *row, sum);
      total[plan.grain[k]] = sum;
    }
  }

  static void sum_forces(const GrainView<Dim>& grains, const BlockSumsPlan& plan, int begin, Torques& torque) {
    Sum as_i[kGrainBlock], as_j[kGrainBlock];
    sum_rows<Side::i>(plan.rows, plan.as_i, as_i);
    sum_rows<Side::j>(plan.rows, plan.as_j, as_j);
    set_forces(grains, begin, as_i, as_j, torque);
  }

  static void set_forces(const GrainView<Dim>& grains, int begin, const Sum (&as_i)[kGrainBlock],
                         const Sum (&as_j)[kGrainBlock], Torques& torque) {
    if constexpr (kParts == 2 && P::kWidth == 8) {
      constexpr int kMoments = sizeof(Part) / sizeof(double);
      for (int k = 0; k < kGrainBlock; k += 8) {
        Records<Isa>::transpose(
            [&](int l) {
              typename P::Vector i, j;
              __builtin_memcpy(&i, &as_i[k + l], sizeof(i));
              __builtin_memcpy(&j, &as_j[k + l], sizeof(j));
              return typename P::Vector(j + i * typename P::Vector{-1.0, -1.0, -1.0, -1.0, 1.0, 1.0, 1.0, 1.0});
            },
            [&](int lane, const P& sums) {
              if (lane < Dim) sums.store(grains.force[lane] + begin + k);
              if (kMoments <= lane && lane < kMoments + Dim) sums.store(torque[lane - kMoments] + k);
            });
      }
    } else {
      // In 2D one vector register holds the force, the moment on i and the moment on j.
      constexpr int kMomentI = Dim == 2 ? 2 : 0, kMomentJ = Dim == 2 ? 3 : 0;
      for (int k = 0; k < kGrainBlock; ++k) {
        const Sum &i = as_i[k], &j = as_j[k];
        for (int a = 0; a < Dim; ++a) grains.force[a][begin + k] = j.part[0][a] - i.part[0][a];
        if constexpr (kRotates)
          for (int a = 0; a < kRotations<Dim>; ++a)
            torque[a][k] = i.part[kParts - 1][kMomentI + a] + j.part[kParts - 1][kMomentJ + a];
      }
    }
  }
};

}  // namespace floc
