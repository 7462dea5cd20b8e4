#include "floc/io/settle_space.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "floc/base/error.h"
#include "floc/io/wall_planes.h"

namespace floc {
namespace {

/// Largest overlap of a sphere with its own periodic image along z, divided by the diameter of the sphere. Grains with
/// a larger overlap are taken as disks, for which the height of the cell has no meaning.
constexpr double kDeepestOverlap = 0.1;

/// Largest accepted difference in z between disks, divided by the smallest diameter. This difference is not zero
/// because files may have few digits.
constexpr double kOnePlane = 1e-6;

struct Guess {
  int dimension = 2;
  std::string words;
  bool doubtful = false;
};

/// Whether one of the first two lattice vectors has a component along z, or the third lattice vector has a component
/// along x or y.
bool tilts_along_z(const std::vector<std::vector<double>>& cell) {
  return cell[0][2] != 0.0 || cell[1][2] != 0.0 || cell[2][0] != 0.0 || cell[2][1] != 0.0;
}

/// For grains that all have the same z, guesses whether they are disks or spheres.
/// @param height  distance of a grain from its periodic image along z; a sphere with a diameter above `height` overlaps
/// its image
/// @param mid_plane  whether the grains lie halfway between the lower and the upper face of the cell across z
Guess guess_of_layer(const std::vector<ListedGrain>& grains, double height, bool mid_plane) {
  std::size_t n_touching = 0;
  double largest = 0.0;
  for (const ListedGrain& g : grains) {
    n_touching += 2.0 * g.radius > height;
    largest = std::max(largest, 2.0 * g.radius);
  }
  // If the packing is not periodic along z, the height is infinite, so no sphere touches an image of itself.
  if (n_touching == 0)
    return {
        2,
        "every z is the same, so the grains are taken as disks in 2D; give --dimension 3 to make them spheres",
        false};
  // In a packing of spheres that is one sphere high, every sphere slightly overlaps its own image along z. For disks
  // the height of the cell is arbitrary, so such a height would be a coincidence. Grains in the middle plane are taken
  // as disks even then, because LAMMPS requires this plane in two dimensions.
  if (n_touching == grains.size() && largest - height <= kDeepestOverlap * largest && !mid_plane)
    return {
        3,
        fmt::format("every z is the same, but the cell is {:.6g} high, less than the diameter of each grain, "
                    "so the grains are taken as spheres that touch their own images along z; give --dimension "
                    "2 to make them disks",
                    height),
        false};
  return {2,
          fmt::format("every z is the same, so the grains are taken as disks in 2D; if they were spheres, {} "
                      "of the {} grains would touch their own images along z, because the cell is {:.6g} high; "
                      "choose with --dimension 2 "
                      "or 3",
                      n_touching, grains.size(), height),
          true};
}

Guess guess_dimension(const ListedSpace& space, const std::vector<ListedGrain>& grains) {
  const auto same_height = [&](const ListedGrain& g) { return g.position[2] == grains.front().position[2]; };
  if (!std::all_of(grains.begin(), grains.end(), same_height)) return {3, "", false};
  const double none = std::numeric_limits<double>::infinity();
  if (space.cell.empty()) return guess_of_layer(grains, none, space.mid_plane);
  if (tilts_along_z(space.cell))
    return {3,
            "every z is the same, but the lattice vectors are tilted along z, so the grains are taken as "
            "spheres; give --dimension 2 to make them disks",
            false};
  const bool periodic = space.periodic.size() < 3 || space.periodic[2];
  return guess_of_layer(grains, periodic ? std::abs(space.cell[2][2]) : none, space.mid_plane);
}

int dimension_of(const ImportOptions& options, ListedPacking& listed) {
  // Options of the user take precedence over the file, and the file takes precedence over a guess.
  if (options.dimension) return *options.dimension;
  if (!options.cell.empty()) return static_cast<int>(options.cell.size());
  if (listed.space.dimension) return *listed.space.dimension;
  Guess guess = guess_dimension(listed.space, listed.grains);
  if (!guess.words.empty())
    (guess.doubtful ? listed.inconsistencies : listed.remarks).push_back(std::move(guess.words));
  return guess.dimension;
}

/// Sets the lattice vectors of `listed` from the option `--cell` or, without this option, from the file. If neither
/// gives a cell, the list of vectors is empty.
void set_cell(const ImportOptions& options, int dimension, ListedPacking& listed) {
  const ListedSpace& space = listed.space;
  listed.cell_place = options.cell.empty() ? space.place : "--cell";
  listed.cell = options.cell;
  if (!options.cell.empty()) return;
  for (int a = 0; a < dimension && !space.cell.empty(); ++a) {
    const std::vector<double>& vector = space.cell[a];
    if (dimension == 2 && vector[2] != 0.0)
      throw InputError(space.place, fmt::format("lattice vector {} has the z component {:.6g}, expected 0 in "
                                                "two dimensions; give --dimension 3 to make the grains spheres",
                                                a + 1, vector[2]));
    if (space.positive_sides && !(vector[a] > 0.0))
      throw InputError(
          space.place,
          fmt::format("the cell is degenerate: its side along {} is {:.6g}, expected a positive length",
                      "xyz"[a], vector[a]));
    listed.cell.emplace_back(vector.begin(), vector.begin() + dimension);
  }
}

const ListedEnds* find_ends(const std::vector<ListedEnds>& all, int axis) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const ListedEnds& e) { return e.axis == axis; });
  return found == all.end() ? nullptr : &*found;
}

/// Returns the number of grains that extend beyond a face of the box across an axis.
std::size_t n_beyond_faces(const ListedPacking& listed, int axis) {
  const double low = listed.space.origin[axis], high = low + listed.space.cell[axis][axis];
  return std::count_if(listed.grains.begin(), listed.grains.end(), [&](const ListedGrain& g) {
    return g.position[axis] - reach_along(listed, g, axis, -1) < low ||
           g.position[axis] + reach_along(listed, g, axis, 1) > high;
  });
}

/// For axes whose ends are not set yet, adds the ends in the file.
void add_stated_ends(int dimension, ListedPacking& listed) {
  const ListedSpace& space = listed.space;
  std::string open;
  std::size_t n_beyond = 0;
  for (int a = 0; a < dimension; ++a) {
    // The option --walls takes precedence over the file.
    if (find_ends(listed.ends, a)) continue;
    if (const ListedEnds* ends = find_ends(space.ends, a)) {
      listed.ends.push_back(*ends);
    } else if (static_cast<std::size_t>(a) < space.periodic.size() && !space.periodic[a]) {
      listed.ends.push_back({a, {}, {}});
      open += fmt::format("{}{}", open.empty() ? "" : ",", "xyz"[a]);
      // Grains at a wall slightly overlap it. Therefore grains beyond a face may mean that this face has a wall, which
      // the file does not describe.
      if (!space.cell.empty()) n_beyond += n_beyond_faces(listed, a);
    }
  }
  if (!open.empty())
    listed.remarks.push_back(fmt::format(
        "the packing is not periodic along {} ({}), and no walls are given: it ends in free space there", open,
        space.boundary));
  if (n_beyond > 0)
    listed.inconsistencies.push_back(
        fmt::format("{} grains extend beyond faces of the box, which are taken as open: give --walls {} to put "
                    "walls at these faces",
                    n_beyond, open));
  // Without a cell this remark is not needed: assemble() then refuses the packing.
  if (space.periodic.empty() && listed.ends.empty() && !space.cell.empty())
    listed.remarks.emplace_back(
        "the packing is taken as periodic in every direction, because the file does not say whether it is; "
        "give --walls for a packing with walls");
}

/// For axes whose ends are not set yet, sets the ends to the walls in a file of another program. Also sets gravity from
/// this file, unless the user gives gravity.
void add_walls_of_file(const std::string& file, const ImportOptions& options, int dimension,
                       ListedPacking& listed) {
  const ListedWalls walls = read_wall_file(file);
  listed.inconsistencies.insert(listed.inconsistencies.end(), walls.doubts.begin(), walls.doubts.end());
  std::string places;
  for (const ListedEnds& ends : ends_of_planes(walls.planes, listed.grains, dimension)) {
    if (find_ends(listed.ends, ends.axis)) continue;
    listed.ends.push_back(ends);
    for (const int side : {-1, 1})
      if (const std::optional<double>& at = side < 0 ? ends.low : ends.high)
        places += fmt::format("{}{} at {}", places.empty() ? "" : ", ", WallSide{ends.axis, side}.name(), *at);
  }
  if (!places.empty()) listed.remarks.push_back(fmt::format("the walls of {} are {}", file, places));
  if (!walls.gravity || !options.gravity.empty()) return;
  listed.space.gravity = *walls.gravity;
  listed.remarks.push_back(
      fmt::format("the gravity of {} is {}; --gravity gives another", file, fmt::join(*walls.gravity, ",")));
}

/// Checks that the option `--walls` gives no walls across z if the grains are taken as disks only because their z are
/// equal.
/// @throws InputError naming the option that makes the grains spheres
void require_axes_of_guess(const std::string& axes, const ImportOptions& options, int dimension,
                           const ListedPacking& listed) {
  const bool is_guess = !options.dimension && options.cell.empty() && !listed.space.dimension;
  // Only names of axes contain letters.
  const bool across_z = axes.find('z') != std::string::npos;
  if (dimension == 2 && is_guess && across_z)
    throw InputError(
        "--walls", fmt::format("\"{}\" gives walls across z, but every grain has the same z, so the grains are "
                               "taken as disks in 2D: give --dimension 3 to make them spheres",
                               axes));
}

/// Sets the mass of a wall, which forces then move.
/// @throws InputError if the packing has no such wall
void set_mass(const WallSide& wall, double mass, ListedPacking& listed) {
  for (ListedEnds& ends : listed.ends)
    if (ends.axis == wall.axis && (wall.side < 0 ? ends.low : ends.high)) {
      (wall.side < 0 ? ends.low_mass : ends.high_mass) = mass;
      return;
    }
  throw InputError(
      "--wall-masses",
      fmt::format("a mass is given for the wall {}, but the packing has no such wall: give --walls",
                  wall.name()));
}

/// Sets the ends of the axes that are not periodic. They are taken from the options or, if the options do not contain
/// them, from the file.
void set_ends(const ImportOptions& options, int dimension, ListedPacking& listed) {
  ListedSpace box = listed.space;
  if (!options.cell.empty()) {
    box.cell = options.cell;
    box.origin.setZero();
  }
  const WallOption walls = split_walls(options.walls);
  require_axes_of_guess(walls.axes, options, dimension, listed);
  listed.ends = parse_walls(walls.axes, box, dimension);
  for (const std::string& file : walls.files) add_walls_of_file(file, options, dimension, listed);
  if (options.cell.empty()) add_stated_ends(dimension, listed);
  for (const auto& [wall, mass] : options.wall_masses) set_mass(wall, mass, listed);
  std::sort(listed.ends.begin(), listed.ends.end(),
            [](const ListedEnds& a, const ListedEnds& b) { return a.axis < b.axis; });
}

/// Returns the lowest and the highest coordinate, along an axis, of the points of all grains.
std::pair<double, double> extent(const ListedPacking& listed, int axis) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ListedGrain& g : listed.grains) {
    low = std::min(low, g.position[axis] - reach_along(listed, g, axis, -1));
    high = std::max(high, g.position[axis] + reach_along(listed, g, axis, 1));
  }
  return {low, high};
}

/// For each axis that is not periodic, makes the side of the cell equal to the distance between the two ends of the
/// axis.
void fit_cell_to_ends(int dimension, ListedPacking& listed) {
  if (listed.ends.empty()) return;
  if (listed.cell.empty() && static_cast<int>(listed.ends.size()) == dimension)
    listed.cell.assign(dimension, std::vector<double>(dimension, 0.0));
  if (listed.cell.empty()) return;  // assemble() reports the missing cell
  for (const ListedEnds& ends : listed.ends) {
    const auto [lowest, highest] = extent(listed, ends.axis);
    const double side = ends.high.value_or(highest) - ends.low.value_or(lowest);
    if (!(side > 0.0))
      throw InputError(listed.place, fmt::format("all grains lie beyond the wall across {}", "xyz"[ends.axis]));
    listed.cell[ends.axis][ends.axis] = side;
  }
  for (int a = 0; a < dimension; ++a)
    for (int b = 0; b < dimension; ++b)
      if (a != b && static_cast<int>(listed.cell[a].size()) == dimension && listed.cell[a][b] != 0.0)
        throw InputError(
            listed.cell_place,
            fmt::format("lattice vector {} has the component {:.6g} along {}: expected a rectangular "
                        "cell for a packing that is not periodic along every axis",
                        a + 1, listed.cell[a][b], "xyz"[b]));
}

/// Checks that no wall cuts off more than a tenth of the radius of a grain.
void require_grains_between_walls(const ListedPacking& listed) {
  constexpr double kDeepest = 0.1;
  if (listed.space.exact_walls) return;
  for (const ListedEnds& ends : listed.ends)
    for (const int side : {-1, 1}) {
      const std::optional<double>& at = side < 0 ? ends.low : ends.high;
      if (!at) continue;
      for (const ListedGrain& g : listed.grains) {
        const double overlap = reach_along(listed, g, ends.axis, side) - side * (*at - g.position[ends.axis]);
        if (overlap > kDeepest * g.radius)
          throw InputError(
              g.place.text(),
              fmt::format(
                  "the wall {} at {} = {:.6g} cuts the grain with {} = {:.6g} and radius {:.6g} by {:.6g}: "
                  "expected at most a tenth of the radius",
                  WallSide{ends.axis, side}.name(), "xyz"[ends.axis], *at, "xyz"[ends.axis],
                  g.position[ends.axis], g.radius, overlap));
      }
    }
}

/// Sets gravity. If there is gravity, checks that at least one axis is not periodic.
void set_gravity(const ImportOptions& options, int dimension, ListedPacking& listed) {
  listed.gravity = options.gravity.empty() ? listed.space.gravity : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const std::string place = options.gravity.empty() ? listed.space.place : "--gravity";
  if (!options.gravity.empty() && static_cast<int>(options.gravity.size()) != dimension)
    throw InputError(place, fmt::format("gravity has {} components, expected {} in {}D", options.gravity.size(),
                                        dimension, dimension));
  for (std::size_t a = 0; a < options.gravity.size(); ++a)
    listed.gravity[static_cast<Eigen::Index>(a)] = options.gravity[a];
  if (dimension == 2) listed.gravity[2] = 0.0;
  if (!listed.gravity.isZero(0.0) && listed.ends.empty())
    throw InputError(
        place, fmt::format("gravity is ({}), but the packing is periodic along every axis, so no "
                           "wall supports the grains: expected a wall (--walls), or no gravity (--gravity {})",
                           fmt::join(listed.gravity.begin(), listed.gravity.begin() + dimension, ", "),
                           dimension == 2 ? "0,0" : "0,0,0"));
}

}  // namespace

int settle_space(const ImportOptions& options, ListedPacking& listed) {
  if (listed.grains.empty()) throw InputError(listed.place, "the file has no grains");
  const int dimension = dimension_of(options, listed);
  set_cell(options, dimension, listed);
  set_ends(options, dimension, listed);
  fit_cell_to_ends(dimension, listed);
  require_grains_between_walls(listed);
  set_gravity(options, dimension, listed);
  return dimension;
}

void require_one_plane(const ListedPacking& listed) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ListedGrain& g : listed.grains) smallest = std::min(smallest, 2.0 * g.radius);
  const double z = listed.grains.front().position[2];
  for (const ListedGrain& g : listed.grains)
    if (std::abs(g.position[2] - z) > kOnePlane * smallest)
      throw InputError(g.place.text(),
                       fmt::format("z = {:.6g}, but z = {:.6g} at {}: expected the same z for all disks of a "
                                   "two-dimensional packing (to make the grains spheres, give three vectors "
                                   "with --cell, or --dimension 3)",
                                   g.position[2], z, listed.grains.front().place.text()));
}

}  // namespace floc
