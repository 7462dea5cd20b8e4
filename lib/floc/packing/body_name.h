#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "floc/packing/packing.h"

namespace floc {

/// Numbers by which tables refer to bodies (grains and walls). The number of a grain is its identifier. The walls are
/// numbered from the number of grains on or, if a grain has an identifier that is as large, from the number after the
/// largest identifier on.
template <int Dim>
class BodyNumbers {
 public:
  explicit BodyNumbers(const Packing<Dim>& packing) : packing_(packing), first_wall_(packing.grains.size()) {
    for (const std::int64_t id : packing.grains.id) first_wall_ = std::max(first_wall_, id + 1);
  }
  std::int64_t of(int body) const {
    return packing_.is_wall(body) ? first_wall_ + body - packing_.grains.size() : packing_.grains.name(body);
  }

 private:
  const Packing<Dim>& packing_;
  std::int64_t first_wall_;
};

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
