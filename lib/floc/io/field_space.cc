#include "floc/io/field_space.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "floc/base/error.h"

namespace floc {

namespace {

/// Sets the masses of the walls from the field array wall_masses, which has one number per wall: 0 for a wall that
/// forces do not move.
/// @param walls  content of the array walls: axis, side and position of each wall
void set_masses(const FieldArrays& arrays, const std::vector<double>& walls, ListedSpace& space) {
  const std::vector<double> masses = arrays.read("wall_masses");
  const bool is_valid = std::all_of(masses.begin(), masses.end(), [](double mass) { return mass >= 0.0; });
  if (3 * masses.size() != walls.size() || !is_valid)
    throw InputError(arrays.place("wall_masses"),
                     fmt::format("the masses are {}, expected a number >= 0 for each of {} walls",
                                 fmt::join(masses, " "), walls.size() / 3));
  for (std::size_t k = 0; k < masses.size(); ++k) {
    ListedEnds& ends = ends_along(static_cast<int>(walls[3 * k]), space);
    if (masses[k] > 0.0) (walls[3 * k + 1] < 0.0 ? ends.low_mass : ends.high_mass) = masses[k];
  }
}

}  // namespace

ListedSpace space_of_fields(const FieldArrays& arrays) {
  ListedSpace space;
  space.place = arrays.place("cell");
  if (!arrays.has("cell")) return space;
  const std::vector<double> numbers = arrays.read("cell");
  if (numbers.size() != 9)
    throw InputError(space.place, fmt::format("the array has {} numbers, expected 9", numbers.size()));
  for (int a = 0; a < 3; ++a) space.cell.emplace_back(&numbers[3 * a], &numbers[3 * a] + 3);
  if (arrays.has("dimension")) {
    const std::vector<double> dimension = arrays.read("dimension");
    if (dimension != std::vector<double>{2.0} && dimension != std::vector<double>{3.0})
      throw InputError(arrays.place("dimension"),
                       fmt::format("the dimension is {}, expected 2 or 3", fmt::join(dimension, " ")));
    space.dimension = static_cast<int>(dimension[0]);
    space.periodic = {true, true, true};
  }
  if (arrays.has("walls")) {
    const std::vector<double> walls = arrays.read("walls");  // axis, side and position of each wall
    space.exact_walls = true;
    for (std::size_t k = 0; k + 2 < walls.size(); k += 3) {
      const bool known = walls[k] == 0.0 || walls[k] == 1.0 || walls[k] == 2.0;
      if (!known || (walls[k + 1] != -1.0 && walls[k + 1] != 1.0))
        throw InputError(
            arrays.place("walls"),
            fmt::format("wall {} has the axis {} and the side {}, expected an axis from 0 to 2 and the "
                        "side -1 or 1",
                        k / 3, walls[k], walls[k + 1]));
      add_wall({static_cast<int>(walls[k]), walls[k + 1] < 0.0 ? -1 : 1}, walls[k + 2], space);
    }
    if (arrays.has("wall_masses")) set_masses(arrays, walls, space);
  }
  if (arrays.has("periodic")) {
    const std::vector<double> periodic = arrays.read("periodic");
    if (periodic.size() != 3)
      throw InputError(arrays.place("periodic"),
                       fmt::format("the array has {} numbers, expected 3", periodic.size()));
    space.periodic.clear();
    for (const double along : periodic) space.periodic.push_back(along != 0.0);
    space.boundary = fmt::format("the field array periodic is {}", fmt::join(periodic, " "));
  }
  if (arrays.has("gravity")) {
    const std::vector<double> gravity = arrays.read("gravity");
    if (gravity.size() != 3)
      throw InputError(arrays.place("gravity"),
                       fmt::format("the array has {} numbers, expected 3", gravity.size()));
    space.gravity = Eigen::Vector3d(gravity[0], gravity[1], gravity[2]);
  }
  return space;
}

}  // namespace floc
