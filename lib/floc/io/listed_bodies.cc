#include "floc/io/listed_bodies.h"

#include <fmt/format.h>

#include <utility>

#include "floc/base/error.h"

namespace floc {

void reverse_actions(ListedContact& c) {
  for (std::optional<Eigen::Vector3d>* on_first : {&c.force, &c.shear_force, &c.rolling_moment, &c.normal})
    if (*on_first) **on_first = -**on_first;
  if (c.image) *c.image = -*c.image;
}

void name_wall(const std::map<std::int64_t, WallSide>& walls, ListedContact& c) {
  if (c.wall || walls.empty()) return;
  const auto first = walls.find(c.id1);
  auto second = walls.find(c.id2);
  if (first != walls.end() && second != walls.end())
    throw InputError(
        c.place.text(),
        fmt::format("the bodies {} and {} are both walls, expected a grain and a wall", c.id1, c.id2));
  if (first != walls.end()) {
    std::swap(c.id1, c.id2);
    reverse_actions(c);
    second = first;
  }
  if (second != walls.end()) c.wall = second->second;
}

}  // namespace floc
