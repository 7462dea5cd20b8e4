#pragma once

namespace floc {

/// Marks a slot that a law leaves empty. Each slot has a tag of its own: two empty members of the same type
/// could not share an address, and would cost bytes.
template <int Tag>
struct Absent {
  bool operator==(const Absent&) const = default;
};

using NoAdhesion = Absent<1>;
using NoDamping = Absent<2>;
using NoFriction = Absent<3>;
using NoRolling = Absent<4>;
using NoTwisting = Absent<5>;

template <class Model>
inline constexpr bool kIsAbsent = false;
template <int Tag>
inline constexpr bool kIsAbsent<Absent<Tag>> = true;

}  // namespace floc
