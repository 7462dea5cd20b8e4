#pragma once

namespace floc {

/// Placeholder for the model of an empty slot of a contact law, for example of a law without friction. Each
/// slot has a different tag, because two empty members of the same type cannot share an address and would take
/// memory.
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
