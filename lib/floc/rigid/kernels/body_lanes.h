#pragma once

#include <cstdint>

#include "floc/base/pack.h"
#include "floc/base/vec.h"
#include "floc/rigid/kernels/contact_groups.h"

namespace floc {

/// Returns the numbers of the contacts `lane` to `lane + width - 1` of a group as a vector of n packs.
template <class Isa, int n>
[[gnu::always_inline]] inline Vec<n, Pack<Isa>> load(const Lanes (&numbers)[n], int lane) {
  Vec<n, Pack<Isa>> out;
  for (int k = 0; k < n; ++k) out[k] = Pack<Isa>::load(numbers[k] + lane);
  return out;
}
template <class Isa, int n>
[[gnu::always_inline]] inline void store(const Vec<n, Pack<Isa>>& from, Lanes (&numbers)[n], int lane) {
  for (int k = 0; k < n; ++k) from[k].store(numbers[k] + lane);
}

/// The bodies on one side of several contacts.
template <class Isa, int Dim>
struct BodyLanes {
  using P = Pack<Isa>;
  using Row = BodyRow<Dim>;

  P column[Row::kSize];  ///< components of the rows of the bodies

  /// Reads the rows of the bodies with the given indices, one for each lane.
  [[gnu::always_inline]] BodyLanes(const double* bodies, const int* index) {
    if constexpr (P::kWidth == 8) {
      for (int first = 0; first < Row::kSize; first += 8)
        Records<Isa>::transpose([&](int l) { return P::load(bodies + index[l] * Row::kSize + first).v; },
                                [&](int k, const P& numbers) { column[first + k] = numbers; });
    } else {
      for (int k = 0; k < Row::kSize; ++k)
        for (int l = 0; l < P::kWidth; ++l) column[k].v[l] = bodies[index[l] * Row::kSize + k];
    }
  }

  /// Writes velocities and spins back to the rows of the bodies that move.
  [[gnu::always_inline]] void write_motion(double* bodies, const int* index, const std::uint8_t* moves) const {
    if constexpr (P::kWidth == 8) {
      Records<Isa>::transpose([&](int k) { return column[k].v; },
                              [&](int l, const P& row) {
                                if (moves[l]) row.store(bodies + index[l] * Row::kSize);
                              });
    } else {
      for (int l = 0; l < P::kWidth; ++l)
        if (moves[l])
          for (int k = 0; k < kDofs<Dim>; ++k) bodies[index[l] * Row::kSize + k] = column[k].v[l];
    }
  }

  Vec<Dim, P> velocity() const { return vector<Dim>(Row::kVelocity); }
  RotationVector<Dim, P> spin() const { return vector<kRotations<Dim>>(Row::kSpin); }

  /// Adds an impulse (momentum) to the motion.
  [[gnu::always_inline]] void push(const Vec<Dim, P>& impulse) {
    for (int a = 0; a < Dim; ++a) column[Row::kVelocity + a] += column[Row::kInverseMass + a] * impulse[a];
  }
  /// Adds an impulse of a moment (angular momentum) to the motion.
  [[gnu::always_inline]] void turn(const RotationVector<Dim, P>& moment) {
    const P* const inertia = column + Row::kInverseInertia;
    P* const spin = column + Row::kSpin;
    if constexpr (Dim == 2) {
      spin[0] += inertia[0] * moment[0];
    } else {
      spin[0] += inertia[0] * moment[0] + inertia[5] * moment[1] + inertia[4] * moment[2];
      spin[1] += inertia[5] * moment[0] + inertia[1] * moment[1] + inertia[3] * moment[2];
      spin[2] += inertia[4] * moment[0] + inertia[3] * moment[1] + inertia[2] * moment[2];
    }
  }
  /// Adds an impulse of a moment to the motion of bodies whose moment of inertia is equal about all axes.
  [[gnu::always_inline]] void turn_round(const RotationVector<Dim, P>& moment) {
    for (int a = 0; a < kRotations<Dim>; ++a)
      column[Row::kSpin + a] += column[Row::kInverseInertia] * moment[a];
  }

 private:
  template <int n>
  [[gnu::always_inline]] Vec<n, P> vector(int first) const {
    Vec<n, P> out;
    for (int k = 0; k < n; ++k) out[k] = column[first + k];
    return out;
  }
};

/// Adds the velocities that the stretch of the cell causes between the bodies of the contacts. If the rate of stretch is
/// imposed, they are part of the bias, and nothing is added.
template <class Isa, class Group, int Dim = Group::kDim>
[[gnu::always_inline]] inline void add_stretch(const Group& group, int lane, const Vec<Dim, Pack<Isa>>& stretch,
                                               Vec<Dim, Pack<Isa>>& velocity) {
  if constexpr (Group::kCell) {
    const Vec<Dim, Pack<Isa>> branch = load<Isa>(group.branch, lane);
    for (int a = 0; a < Dim; ++a) velocity[a] += stretch[a] * branch[a];
  }
}

}  // namespace floc
