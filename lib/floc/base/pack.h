#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "floc/base/instruction_set.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace floc {

/// Tags of the instruction sets. Each tag is a template argument of all code that is compiled for its instruction set,
/// so that translation units with different compiler flags share no symbol. (Otherwise a processor might run code with
/// instructions that it lacks.)
struct Portable {
  static constexpr int kWidth = 2;
};
struct Avx2 {
  static constexpr int kWidth = 4;
};
struct Avx512 {
  static constexpr int kWidth = 8;
};

/// Vector types of the compiler: `Type` is a vector of N doubles, `Bits` a vector of N 64-bit integers, the result of
/// comparing two vectors of type `Type`.
template <int N>
struct VectorOf;
template <>
struct VectorOf<2> {
  typedef double Type __attribute__((vector_size(16)));
  typedef long long Bits __attribute__((vector_size(16)));
};
template <>
struct VectorOf<4> {
  typedef double Type __attribute__((vector_size(32)));
  typedef long long Bits __attribute__((vector_size(32)));
};
template <>
struct VectorOf<8> {
  typedef double Type __attribute__((vector_size(64)));
  typedef long long Bits __attribute__((vector_size(64)));
};

/// Converts a vector of 32-bit numbers (float or int) to 64 bits, lane by lane.
template <class Isa, class Numbers>
auto widened(const Numbers& numbers) {
  using Vector = VectorOf<Isa::kWidth>;
  constexpr bool kFloats = std::is_floating_point_v<std::remove_cvref_t<decltype(numbers[0])>>;
  using Wide = std::conditional_t<kFloats, typename Vector::Type, typename Vector::Bits>;
#if defined(__x86_64__)
  // GCC converts the vector in two halves unless these intrinsics are used.
  if constexpr (Isa::kWidth == 8 && kFloats)
    return Wide(_mm512_cvtps_pd(__m256(numbers)));
  else if constexpr (Isa::kWidth == 8)
    return Wide(_mm512_cvtepi32_epi64(__m256i(numbers)));
  else
#endif
    return __builtin_convertvector(numbers, Wide);
}

/// Number type of kernels (compiled loops over grains, pairs or contacts): as many doubles as a
/// register of the instruction set holds. Operations and comparisons act lane by lane.
template <class Isa>
struct Pack {
  static constexpr int kWidth = Isa::kWidth;
  using Vector = typename VectorOf<Isa::kWidth>::Type;
  using Bits = typename VectorOf<Isa::kWidth>::Bits;

  struct Mask {
    Bits bits;

    friend Mask operator&(const Mask& a, const Mask& b) { return {Bits(a.bits & b.bits)}; }
    friend Mask operator|(const Mask& a, const Mask& b) { return {Bits(a.bits | b.bits)}; }
    friend Mask operator!(const Mask& a) { return {Bits(~a.bits)}; }
    /// Returns whether the mask is set in any lane.
    friend bool any(const Mask& a) {
      long long bits = 0;
      for (int l = 0; l < kWidth; ++l) bits |= a.bits[l];
      return bits != 0;
    }
  };

  Vector v;

  Pack() = default;
  /// Sets every lane to `value`. The conversion is implicit, because contact laws combine packs with parameters, which
  /// are doubles.
  Pack(double value) : v(value - Vector{}) {}  // NOLINT(google-explicit-constructor)
  explicit Pack(const Vector& vector) : v(vector) {}

  static Pack load(const double* from) {
    Pack p;
    __builtin_memcpy(&p.v, from, sizeof(Vector));
    return p;
  }
  static Pack load(const float* from) {
    typedef float Floats __attribute__((vector_size(sizeof(float) * kWidth)));
    Floats numbers;
    __builtin_memcpy(&numbers, from, sizeof(Floats));
    return Pack(widened<Isa>(numbers));
  }
  void store(double* to) const { __builtin_memcpy(to, &v, sizeof(Vector)); }

  Pack& operator+=(const Pack& b) { return v += b.v, *this; }
  Pack& operator-=(const Pack& b) { return v -= b.v, *this; }
  Pack& operator*=(const Pack& b) { return v *= b.v, *this; }
  Pack operator-() const { return Pack(Vector(-v)); }
  friend Pack operator+(const Pack& a, const Pack& b) { return Pack(Vector(a.v + b.v)); }
  friend Pack operator-(const Pack& a, const Pack& b) { return Pack(Vector(a.v - b.v)); }
  friend Pack operator*(const Pack& a, const Pack& b) { return Pack(Vector(a.v * b.v)); }
  friend Pack operator/(const Pack& a, const Pack& b) { return Pack(Vector(a.v / b.v)); }
  friend Mask operator<(const Pack& a, const Pack& b) { return {Bits(a.v < b.v)}; }
  friend Mask operator<=(const Pack& a, const Pack& b) { return {Bits(a.v <= b.v)}; }
  friend Mask operator==(const Pack& a, const Pack& b) { return {Bits(a.v == b.v)}; }
  friend Pack blend(const Mask& when, const Pack& a, const Pack& b) {
    return Pack(Vector(when.bits ? a.v : b.v));
  }
  friend Pack sqrt(const Pack& a) {
    Pack root;
    for (int l = 0; l < kWidth; ++l) root.v[l] = __builtin_sqrt(a.v[l]);
    return root;
  }
  /// Returns p 2^n. The parameter `shifted` is the number n + 1.5 * 2^52 (see lanes::exp_of_negative()).
  friend Pack times_power_of_two(const Pack& p, const Pack& shifted) {
    return Pack(Vector((Bits)p.v + ((Bits)shifted.v << 52)));
  }
};

/// Functions that read numbers from scattered places of an array, and functions that write records (the consecutive
/// doubles of one pair). All these functions are always inlined, so that the registers that GCC chooses do not depend
/// on the number of compiled contact laws. Inlining makes time steps of spheres 3 to 6 % faster.
template <class Isa>
struct Records {
  using P = Pack<Isa>;

  /// Returns base[place[l]] in lane l of a pack.
  [[gnu::always_inline]] static P gather(const double* base, const int* place) {
    P out;
#if defined(__x86_64__)
    // The lanes are loaded one by one and merged by broadcasts with masks. With single loads joined by shuffles, whole
    // time steps were shorter by a fifth than with the gather instruction (Xeon of 2023). With broadcasts they were
    // shorter by another 4 % (EPYC of 2023).
    if constexpr (P::kWidth == 8) {
      const auto four = [&](int l) {
        __m256d lanes = _mm256_castpd128_pd256(_mm_load_sd(base + place[l]));
        lanes = _mm256_mask_broadcastsd_pd(lanes, 1 << 1, _mm_load_sd(base + place[l + 1]));
        lanes = _mm256_mask_broadcastsd_pd(lanes, 1 << 2, _mm_load_sd(base + place[l + 2]));
        return _mm256_mask_broadcastsd_pd(lanes, 1 << 3, _mm_load_sd(base + place[l + 3]));
      };
      out.v = _mm512_insertf64x4(_mm512_castpd256_pd512(four(0)), four(4), 1);
      return out;
    }
#endif
    for (int l = 0; l < P::kWidth; ++l) out.v[l] = base[place[l]];
    return out;
  }

  /// Returns base[place[l]] in lane l of a pack, like gather(), but with one load and one shuffle instead of one load
  /// per lane.
  /// @pre the places ascend, and the last place exceeds the first by less than kWindow
  [[gnu::always_inline]] static P gather_window(const double* base, const int* place) {
#if !defined(__clang__)  // Clang has no shuffle whose indices are known only at run time.
    if constexpr (P::kWidth == kWindow) {
      typedef int Ints __attribute__((vector_size(4 * P::kWidth)));
      Ints places;
      __builtin_memcpy(&places, place, sizeof(Ints));
      return P(__builtin_shuffle(P::load(base + place[0]).v, widened<Isa>(places - place[0])));
    }
#endif
    return gather(base, place);
  }

  /// Writes the records of all lanes one after another: the numbers row[0][l], row[1][l], ... of lane l are written to
  /// base[size * l] and the following places.
  template <std::size_t size>
  [[gnu::always_inline]] static void store_rows(double* base, const P (&row)[size]) {
    static_assert(size % 2 == 0);
    constexpr int kEights = P::kWidth == 8 ? static_cast<int>(size) / 8 : 0;
    for (int k = 0; k < kEights; ++k) store_eight(base + 8 * k, size, row + 8 * k);
    for (std::size_t k = 8 * kEights; k < size; k += 2) store_two(base + k, size, row[k], row[k + 1]);
  }

  /// Calls take(l, column) for each column l of the matrix whose rows are a(0) to a(7), with 8 numbers each.
  /// Neighbouring numbers are moved in pairs, since moving two numbers takes as long as moving one number.
  template <class Rows, class Take>
  [[gnu::always_inline]] static void transpose([[maybe_unused]] Rows a, [[maybe_unused]] Take take) {
    if constexpr (P::kWidth == 8) {
      const auto even = [](const Vector& p, const Vector& q) -> Vector {
        return __builtin_shufflevector(p, q, 0, 1, 4, 5, 8, 9, 12, 13);
      };
      const auto odd = [](const Vector& p, const Vector& q) -> Vector {
        return __builtin_shufflevector(p, q, 2, 3, 6, 7, 10, 11, 14, 15);
      };
      const auto half = [&](int first, const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
        const Vector even_pq = even(p, q), odd_pq = odd(p, q), even_rs = even(r, s), odd_rs = odd(r, s);
        take(first, P(even(even_pq, even_rs)));
        take(first + 2, P(even(odd_pq, odd_rs)));
        take(first + 4, P(odd(even_pq, even_rs)));
        take(first + 6, P(odd(odd_pq, odd_rs)));
      };
      half(0, low_halves(a(0), a(1)), low_halves(a(2), a(3)), low_halves(a(4), a(5)), low_halves(a(6), a(7)));
      half(1, high_halves(a(0), a(1)), high_halves(a(2), a(3)), high_halves(a(4), a(5)),
           high_halves(a(6), a(7)));
    }
  }

 private:
  using Vector = typename P::Vector;
  using Two = VectorOf<2>::Type;

  [[gnu::always_inline]] static Vector low_halves(const Vector& a, const Vector& b) {
    if constexpr (P::kWidth == 2) {
      return __builtin_shufflevector(a, b, 0, 2);
    } else if constexpr (P::kWidth == 4) {
      return __builtin_shufflevector(a, b, 0, 4, 2, 6);
    } else {
      return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    }
  }
  [[gnu::always_inline]] static Vector high_halves(const Vector& a, const Vector& b) {
    if constexpr (P::kWidth == 2) {
      return __builtin_shufflevector(a, b, 1, 3);
    } else if constexpr (P::kWidth == 4) {
      return __builtin_shufflevector(a, b, 1, 5, 3, 7);
    } else {
      return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    }
  }

  /// Sets base[stride * l + k] = a[k][l] for 8 values of k and 8 values of l.
  [[gnu::always_inline]] static void store_eight(double* base, std::ptrdiff_t stride, const P* a) {
    transpose([&](int k) -> const Vector& { return a[k].v; },
              [&](int l, const P& row) { row.store(base + stride * l); });
  }

  /// Sets base[stride * l] = a[l] and base[stride * l + 1] = b[l] for each lane l.
  [[gnu::always_inline]] static void store_two(double* base, std::ptrdiff_t stride, const P& a, const P& b) {
    const Vector even = low_halves(a.v, b.v);
    const Vector odd = high_halves(a.v, b.v);
    store_chunks(base, 2 * stride, even, std::make_integer_sequence<int, P::kWidth / 2>());
    store_chunks(base + stride, 2 * stride, odd, std::make_integer_sequence<int, P::kWidth / 2>());
  }

  template <int... chunk>
  [[gnu::always_inline]] static void store_chunks(double* base, std::ptrdiff_t stride, const Vector& v,
                                                  std::integer_sequence<int, chunk...>) {
    (store_chunk<chunk>(base + stride * chunk, v), ...);
  }
  template <int chunk>
  [[gnu::always_inline]] static void store_chunk(double* to, const Vector& v) {
    Two t;
    if constexpr (P::kWidth == 2) t = v;
#if defined(__x86_64__)
    if constexpr (P::kWidth == 4) t = _mm256_extractf128_pd(v, chunk);
    if constexpr (P::kWidth == 8) t = _mm512_extractf64x2_pd(v, chunk);
#endif
    __builtin_memcpy(to, &t, sizeof(Two));
  }
};

}  // namespace floc

namespace Eigen {
template <class Isa>
struct NumTraits<floc::Pack<Isa>> : GenericNumTraits<floc::Pack<Isa>> {
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
