#include "floc/io/state_walls.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "floc/base/error.h"
#include "floc/io/law_attributes.h"
#include "floc/io/state_layout.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

const std::string kWallLaw = "wall_law";

constexpr Field kWallMass = {"walls/mass", Quantity::mass, "mass of the wall; 0: its velocity is prescribed"};
constexpr Field kWallOpen = {"walls/open", Quantity::flag,
                             "1: there is no wall, and the packing ends in free space; absent: 0"};
constexpr Field kWallForce = {"walls/force", Quantity::force,
                              "static normal force of the grains on the wall, positive outwards"};

/// Checks the walls of a state.
/// @throws InputError unless the axes of the walls are in ascending order, each axis with walls has a lower and an
/// upper wall in this order, and the distance between the two is the side of the cell along the axis
template <int Dim>
void check_walls(const Hdf5Reader& file, const Packing<Dim>& packing) {
  const std::vector<Wall<Dim>>& walls = packing.walls;
  int next_axis = 0;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const auto refuse = [&](const char* path, const std::string& what) {
      throw InputError(file.place(path), fmt::format("entry {} is {}", w, what));
    };
    // Walls with an even index are lower walls. The next wall is the upper wall of the same axis.
    const bool lower = w % 2 == 0;
    if (walls[w].axis < next_axis || walls[w].axis >= Dim || (!lower && walls[w].axis != walls[w - 1].axis))
      refuse("walls/axis",
             fmt::format("{}, expected two walls for an axis from 0 to {}, with the axes in ascending order",
                         walls[w].axis, Dim - 1));
    if (walls[w].side != (lower ? -1 : 1))
      refuse("walls/side", fmt::format("{}, expected -1 and 1 for the two walls of an axis", walls[w].side));
    if (walls[w].mass < 0.0) refuse("walls/mass", fmt::format("{}, expected 0 or more", walls[w].mass));
    if (lower) continue;
    next_axis = walls[w].axis + 1;
    // The distance between the two walls of an axis must be the side of the cell along this axis, within rounding.
    const double distance = walls[w].position - walls[w - 1].position;
    const double side = packing.cell.matrix(walls[w].axis, walls[w].axis);
    if (!packing.cell.rectangular() || !(distance > 0.0) || !(std::abs(distance / side - 1.0) < 1e-9))
      refuse("walls/position",
             fmt::format(
                 "{:.6g} above the opposite wall, expected a distance equal to the side of a rectangular cell, "
                 "{:.6g}",
                 distance, side));
  }
  if (walls.size() % 2 != 0)
    throw InputError(file.place("walls/axis"),
                     fmt::format("the file has {} walls, expected two for each axis", walls.size()));
}

}  // namespace

template <int Dim>
void write_walls(Hdf5Writer& file, WritingArchive& archive, const State<Dim>& s) {
  const std::vector<Wall<Dim>>& walls = s.packing.walls;
  if (walls.empty()) return;
  describe_walls<Dim>(archive, walls);
  std::vector<double> mass;
  for (const Wall<Dim>& wall : walls) mass.push_back(follows_forces(wall) ? wall.mass : 0.0);
  archive.put(kWallMass, {mass.size()}, mass);
  archive.put(kWallForce, {mass.size()}, wall_forces(s.packing));
  if (is_open(walls)) {
    std::vector<std::uint8_t> open;
    for (const Wall<Dim>& wall : walls) open.push_back(wall.open);
    archive.put(kWallOpen, {open.size()}, open);
  }
  write_law(file, s.packing.wall_law, kWallLaw);
}

template <int Dim>
void read_walls(const Hdf5Reader& file, ReadingArchive& archive, State<Dim>& s) {
  if (!file.has("walls/axis")) return;
  Packing<Dim>& packing = s.packing;
  const std::uint64_t n = file.n_rows("walls/axis");
  if (n > 2 * Dim)
    throw InputError(file.place("walls/axis"),
                     fmt::format("the file has {} walls, expected at most {}", n, 2 * Dim));
  packing.walls.assign(n, Wall<Dim>{});
  describe_walls<Dim>(archive, packing.walls);
  const auto mass = archive.take<double>(kWallMass, {n});
  for (std::size_t w = 0; w < n; ++w) packing.walls[w].mass = mass[w];
  if (file.has(kWallOpen.path)) {
    const auto open = archive.take<std::uint8_t>(kWallOpen, {n});
    for (std::size_t w = 0; w < n; ++w) packing.walls[w].open = open[w] != 0;
  }
  s.wall_force = archive.take<double>(kWallForce, {n});
  check_walls(file, packing);
  for (Wall<Dim>& wall : packing.walls)
    if (wall.mass == 0.0) wall.mass = std::numeric_limits<double>::infinity();
  packing.wall_law = read_law(file, Dim, kWallLaw);
}

#define FLOC_INSTANTIATE(Dim)                                                 \
  template void write_walls(Hdf5Writer&, WritingArchive&, const State<Dim>&); \
  template void read_walls(const Hdf5Reader&, ReadingArchive&, State<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
