#pragma once

#include <fmt/format.h>

#include <string>

#include "floc/packing/packing.h"

namespace floc {

/// Returns the number by which tables refer to a body (a grain or a wall): the identifier of a grain, or the index of a
/// wall among all bodies.
template <int Dim>
std::int64_t body_number(const Packing<Dim>& packing, int body) {
  return packing.is_wall(body) ? body : packing.grains.name(body);
}

/// Returns the name of a wall in messages and lists of contacts: "x-" for the lower wall of the x axis, "x+" for the
/// upper wall.
template <int Dim>
std::string wall_name(const Wall<Dim>& wall) {
  return std::string(1, "xyz"[wall.axis]) + (wall.side < 0 ? "-" : "+");
}

/// Returns the names of all walls, separated by blanks; open ends are left out.
template <int Dim>
std::string wall_names(const std::vector<Wall<Dim>>& walls) {
  std::string names;
  for (const Wall<Dim>& wall : walls)
    if (!wall.open) names += (names.empty() ? "" : " ") + wall_name(wall);
  return names;
}

/// Returns the name of a body in messages and lists of contacts: the identifier of a grain or the name of a wall.
template <int Dim>
std::string body_name(const Packing<Dim>& packing, int body) {
  return packing.is_wall(body) ? wall_name(packing.wall(body)) : std::to_string(packing.grains.name(body));
}

/// Returns the names of the two bodies of a contact, for messages.
template <int Dim>
std::string pair_name(const Packing<Dim>& packing, const Contact<Dim>& c) {
  const Grains<Dim>& g = packing.grains;
  if (packing.is_wall(c.j)) return fmt::format("grain {} and wall {}", g.name(c.i), c.j - g.size());
  return fmt::format("grains {}-{}", g.name(c.i), g.name(c.j));
}

}  // namespace floc
