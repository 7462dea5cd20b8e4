#pragma once

namespace floc {

/// Type of the placeholder for a model in an empty slot of a contact law, for example in the friction slot of a law
/// without friction. Each slot uses a different tag. With equal tags, two empty members would have the same type and
/// could not share an address, so the second member would take memory.
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
