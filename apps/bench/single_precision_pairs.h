#pragma once

#include <cstddef>
#include <utility>

#include "floc/base/pack.h"
#include "floc/contact/contact_law.h"
#include "floc/contact/history_layout.h"
#include "floc/geometry/frame_turn.h"
#include "floc/relaxation/kernels/kernel_law.h"
#include "floc/relaxation/kernels/step_kernels.h"

/// Force loop in single precision, which only single_precision_bench.cc uses. Separations and overlaps are computed in
/// double precision, and all other quantities in single precision.
namespace floc {

template <int N>
struct FloatsOf;
template <>
struct FloatsOf<8> {
  typedef float Type __attribute__((vector_size(32)));
  typedef int Bits __attribute__((vector_size(32)));
};
template <>
struct FloatsOf<16> {
  typedef float Type __attribute__((vector_size(64)));
  typedef int Bits __attribute__((vector_size(64)));
};

/// A register of floats, twice as many as Pack<Isa> has doubles, with the operations that contact laws need.
template <class Isa>
struct FloatPack {
  static constexpr int kWidth = 2 * Isa::kWidth;
  using Vector = typename FloatsOf<kWidth>::Type;
  using Bits = typename FloatsOf<kWidth>::Bits;
  struct Mask {
    Bits bits;
  };

  Vector v;

  FloatPack() = default;
  FloatPack(double value) : v(static_cast<float>(value) - Vector{}) {}  // NOLINT(google-explicit-constructor)
  explicit FloatPack(const Vector& vector) : v(vector) {}
  /// Rounds two packs of doubles to floats: `low` becomes the lower half of the register, and `high` the upper half.
  FloatPack(const Pack<Isa>& low, const Pack<Isa>& high) {
    if constexpr (Isa::kWidth == 8) {
      const __m256 halves[] = {_mm512_cvtpd_ps(low.v), _mm512_cvtpd_ps(high.v)};
      __builtin_memcpy(&v, halves, sizeof(Vector));
    } else {
      const __m128 halves[] = {_mm256_cvtpd_ps(low.v), _mm256_cvtpd_ps(high.v)};
      __builtin_memcpy(&v, halves, sizeof(Vector));
    }
  }
  static FloatPack load(const float* from) {
    FloatPack p;
    __builtin_memcpy(&p.v, from, sizeof(Vector));
    return p;
  }
  void store(float* to) const { __builtin_memcpy(to, &v, sizeof(Vector)); }

  FloatPack& operator+=(const FloatPack& b) { return v += b.v, *this; }
  FloatPack& operator-=(const FloatPack& b) { return v -= b.v, *this; }
  FloatPack& operator*=(const FloatPack& b) { return v *= b.v, *this; }
  FloatPack operator-() const { return FloatPack(Vector(-v)); }
  friend FloatPack operator+(const FloatPack& a, const FloatPack& b) { return FloatPack(Vector(a.v + b.v)); }
  friend FloatPack operator-(const FloatPack& a, const FloatPack& b) { return FloatPack(Vector(a.v - b.v)); }
  friend FloatPack operator*(const FloatPack& a, const FloatPack& b) { return FloatPack(Vector(a.v * b.v)); }
  friend FloatPack operator/(const FloatPack& a, const FloatPack& b) { return FloatPack(Vector(a.v / b.v)); }
  friend Mask operator<(const FloatPack& a, const FloatPack& b) { return {Bits(a.v < b.v)}; }
  friend Mask operator==(const FloatPack& a, const FloatPack& b) { return {Bits(a.v == b.v)}; }
  friend FloatPack blend(const Mask& when, const FloatPack& a, const FloatPack& b) {
    return FloatPack(Vector(when.bits ? a.v : b.v));
  }
  friend FloatPack sqrt(const FloatPack& a) {
    FloatPack root;
    for (int l = 0; l < kWidth; ++l) root.v[l] = __builtin_sqrtf(a.v[l]);
    return root;
  }

  /// Returns a pack whose lane l contains base[place[l]].
  [[gnu::always_inline]] static FloatPack gather(const float* base, const int* place) {
    FloatPack out;
    __m128 four[kWidth / 4];
    for (int k = 0; k < kWidth / 4; ++k) {
      const int* const at = place + 4 * k;
      __m128 lanes = _mm_load_ss(base + at[0]);
      lanes = _mm_insert_ps(lanes, _mm_load_ss(base + at[1]), 0x10);
      lanes = _mm_insert_ps(lanes, _mm_load_ss(base + at[2]), 0x20);
      four[k] = _mm_insert_ps(lanes, _mm_load_ss(base + at[3]), 0x30);
    }
    __builtin_memcpy(&out.v, four, sizeof(Vector));
    return out;
  }
  /// Returns gather(base, place), with a single load for every eight lanes. @pre see Records::gather_window()
  [[gnu::always_inline]] static FloatPack gather_window(const float* base, const int* place) {
    FloatPack out;
    __m256 eight[kWidth / 8];
    for (int k = 0; k < kWidth / 8; ++k) {
      const int* const at = place + 8 * k;
      const __m256i from =
          _mm256_sub_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(at)), _mm256_set1_epi32(at[0]));
      eight[k] = _mm256_permutevar8x32_ps(_mm256_loadu_ps(base + at[0]), from);
    }
    __builtin_memcpy(&out.v, eight, sizeof(Vector));
    return out;
  }
  /// Sets to[stride * l + k] to lane l of a[k], for k from 0 to 3 and for each lane l.
  [[gnu::always_inline]] static void store_four(float* to, std::ptrdiff_t stride, const FloatPack* a) {
    __m128 quarter[4][kWidth / 4];
    for (int k = 0; k < 4; ++k) __builtin_memcpy(quarter[k], &a[k].v, sizeof(Vector));
    for (int q = 0; q < kWidth / 4; ++q) {
      __m128 r0 = quarter[0][q], r1 = quarter[1][q], r2 = quarter[2][q], r3 = quarter[3][q];
      _MM_TRANSPOSE4_PS(r0, r1, r2, r3);
      float* const at = to + stride * 4 * q;
      _mm_storeu_ps(at, r0);
      _mm_storeu_ps(at + stride, r1);
      _mm_storeu_ps(at + 2 * stride, r2);
      _mm_storeu_ps(at + 3 * stride, r3);
    }
  }
};

}  // namespace floc

namespace Eigen {
template <class Isa>
struct NumTraits<floc::FloatPack<Isa>> : GenericNumTraits<floc::FloatPack<Isa>> {
  enum {
    RequireInitialization = 0,
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
}  // namespace Eigen

namespace floc {

/// Pairs and grains for the loop in single precision: the data of PairView and GrainView, mostly as floats.
template <int Dim>
struct SinglePairs {
  const int *i, *j;
  const float *image[Dim], *v[Dim], *spin[kRotations<Dim>];
  const double* x[Dim];
  int own_numbers;
  const double* radii;
  const float *radii_float, *share_i, *damping, *reduced_radius, *reduced_mass;
  float *viscous, *history[HistoryLayout<Dim>::kSize], *row;
};

/// Function that computes the pairs from `first` to `last` - 1.
/// @param law  address of the contact law; its type is the kernel law for which the function is compiled
template <int Dim>
using SingleLoop = void (*)(const void* law, const SinglePairs<Dim>&, int first, int last,
                            const PairCell<Dim>&);

/// The force loop of PairKernel in single precision, for cells with a rectangular lattice.
template <class Isa, int Dim, class Law>
struct SinglePrecisionKernel {
  using D = Pack<Isa>;
  using F = FloatPack<Isa>;
  using V = Vec<Dim, F>;
  static constexpr bool kTurns = Dim == 3;
  static constexpr int kHistorySize = Law::template kHistorySize<Dim>;
  static constexpr int kRowSize = Dim == 2 ? 4 : 8;
  struct NoTurn {};

  struct Kinematics {
    V n;
    F arm_i, arm_j;
    ContactMotion<Dim, F> motion;
    [[no_unique_address]] std::conditional_t<kTurns, FrameTurn<F>, NoTurn> turn;
  };

  [[gnu::flatten]] static void compute(const void* any_law, const SinglePairs<Dim>& given, int first, int last,
                                       const PairCell<Dim>& cell_given) {
    const Law law = *static_cast<const Law*>(any_law);
    const SinglePairs<Dim> pairs = given;
    const PairCell<Dim> cell = cell_given;
    Kinematics now = kinematics(pairs, first, cell);
    for (int p = first; p < last; p += F::kWidth) {
      const Kinematics next = kinematics(pairs, p + F::kWidth < last ? p + F::kWidth : p, cell);
      respond(law, now, pairs, p);
      now = next;
    }
  }

  static F number(const float* numbers, const SinglePairs<Dim>& pairs, int p) {
    return F::load(numbers + (p & pairs.own_numbers));
  }

  /// Sets `r` to the separations of the pairs. Sets `beyond` to the squared length of each separation minus the squared
  /// sum of the two radii. Both are computed in double precision and then rounded.
  static void separate(const SinglePairs<Dim>& pairs, int p, const PairCell<Dim>& cell, V& r, F& beyond) {
    D half[2][Dim], excess[2];
    for (int h = 0; h < 2; ++h) {
      const int q = p + h * D::kWidth;
      D squared(0.0);
      for (int a = 0; a < Dim; ++a) {
        const D xi = Records<Isa>::gather_window(pairs.x[a], pairs.i + q);
        const D xj = Records<Isa>::gather(pairs.x[a], pairs.j + q);
        half[h][a] = (xj - xi) + D::load(pairs.image[a] + q) * D(cell.lattice[a][a]);
        squared += half[h][a] * half[h][a];
      }
      const D radii = D::load(pairs.radii + (q & pairs.own_numbers));
      excess[h] = squared - radii * radii;
    }
    for (int a = 0; a < Dim; ++a) r[a] = F(half[0][a], half[1][a]);
    beyond = F(excess[0], excess[1]);
  }

  static Kinematics kinematics(const SinglePairs<Dim>& pairs, int p, const PairCell<Dim>& cell) {
    V r, centres;
    F beyond;
    separate(pairs, p, cell, r, beyond);
    for (int a = 0; a < Dim; ++a)
      centres[a] = (F::gather(pairs.v[a], pairs.j + p) - F::gather_window(pairs.v[a], pairs.i + p)) +
                   F(cell.strain_rate[a][a]) * r[a];
    RotationVector<Dim, F> spin_i, spin_j;
    for (int a = 0; a < kRotations<Dim>; ++a) {
      spin_i[a] = F::gather_window(pairs.spin[a], pairs.i + p);
      spin_j[a] = F::gather(pairs.spin[a], pairs.j + p);
    }
    const F distance = sqrt(r.squaredNorm());
    const F inverse = F(1.0) / distance;
    Kinematics k;
    k.n = r * inverse;
    const F gap = beyond / (distance + number(pairs.radii_float, pairs, p));
    k.motion = {gap, k.n.dot(centres), F(0.0), Shear<Dim, F>::Zero(), RotationVector<Dim, F>::Zero()};
    if constexpr (Law::kNeedsReducedRadius)
      k.motion.pair.reduced_radius = number(pairs.reduced_radius, pairs, p);
    if constexpr (Law::kNeedsReducedMass) k.motion.pair.reduced_mass = number(pairs.reduced_mass, pairs, p);
    const F share_i = number(pairs.share_i, pairs, p);
    k.arm_i = share_i * distance;
    k.arm_j = distance - k.arm_i;
    const F time(cell.slip_time);
    if constexpr (kTurns) {
      const F per_length = time * inverse, along = per_length * k.motion.gap_rate;
      k.turn = {k.n, along, V(per_length * centres - along * k.n), RotationVector<Dim, F>(spin_i + spin_j),
                time};
      const F middle = distance * (time - F(0.5 * cell.slip_time) * along), arm_i = share_i * middle;
      k.motion.slip = k.turn.slip(distance, RotationVector<Dim, F>(arm_i * spin_i + (middle - arm_i) * spin_j));
    } else {
      const RotationVector<Dim, F> surfaces = k.arm_i * spin_i + k.arm_j * spin_j;
      k.motion.slip = time * to_shear<F>(k.n, V(centres - cross<F>(surfaces, k.n)));
    }
    return k;
  }

  static void respond(const Law& law, const Kinematics& k, const SinglePairs<Dim>& pairs, int p) {
    ContactMotion<Dim, F> motion = k.motion;
    motion.damping = number(pairs.damping, pairs, p);
    PackedHistory<kHistorySize, F> history;
    for (int h = 0; h < kHistorySize; ++h)
      history.value[h] = F::load(pairs.history[history_place<Law, Dim>(h)] + p);
    if constexpr (kTurns)
      for (int h = 0; h < kHistorySize; ++h)
        if (begins_tangent<Law, Dim>(h)) {
          const V turned = k.turn(V(history.value[h], history.value[h + 1], history.value[h + 2]));
          for (int a = 0; a < 3; ++a) history.value[h + a] = turned[a];
        }
    const ContactForces<Dim, F> f = law.respond(motion, history, {});
    for (int h = 0; h < kHistorySize; ++h)
      history.value[h].store(pairs.history[history_place<Law, Dim>(h)] + p);
    const F before = F::load(pairs.viscous + p);
    f.viscous.store(pairs.viscous + p);
    const F both = F(kDashpotShare) * f.viscous + F(1.0 - kDashpotShare) * before;
    const F dashpot = blend(f.viscous * before == F(0.0), f.viscous, both);
    const V shear = from_shear<F>(k.n, f.shear);
    const V on_j = (f.normal.force() + dashpot) * k.n - shear;
    const RotationVector<Dim, F> unit_moment = moment<F>(k.n, shear);
    F row[kRowSize];
    for (int a = 0; a < Dim; ++a) row[a] = on_j[a];
    if constexpr (Dim == 2) {
      row[2] = k.arm_i * unit_moment[0];
      row[3] = k.arm_j * unit_moment[0];
    } else {
      row[3] = k.arm_i;
      for (int a = 0; a < 3; ++a) row[4 + a] = unit_moment[a];
      row[7] = k.arm_j;
    }
    for (int q = 0; q < kRowSize; q += 4)
      F::store_four(pairs.row + static_cast<std::ptrdiff_t>(kRowSize) * p + q, kRowSize, row + q);
  }
};

/// Contact laws for which the loop is compiled: cohesive disks with friction, and elastic spheres.
using DisksOfTrial = KernelLawOf<
    ContactLaw<LinearRepulsion, TailAdhesion, ViscousDamping, CoulombFriction, NoRolling, NoTwisting>, 2>;
using SpheresOfTrial =
    KernelLawOf<ContactLaw<HertzRepulsion, NoAdhesion, CriticalDamping, MindlinFriction, NoRolling, NoTwisting>,
                3>;

SingleLoop<2> single_disks_avx2();
SingleLoop<2> single_disks_avx512();
SingleLoop<3> single_spheres_avx2();
SingleLoop<3> single_spheres_avx512();

}  // namespace floc
