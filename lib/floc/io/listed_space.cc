#include "floc/io/listed_space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/error.h"

namespace floc {
namespace {

/// Largest overlap of a sphere with its own periodic image along z, relative to its diameter. Grains that would overlap
/// by more are taken as disks, for which the height of the cell has no meaning.
constexpr double kDeepestOverlap = 0.1;

/// Largest accepted difference in z between disks, relative to the smallest diameter. It allows for files with few
/// digits.
constexpr double kOnePlane = 1e-6;

struct Guess {
  int dimension = 2;
  std::string words;
  bool doubtful = false;
};

/// Whether one of the first two lattice vectors has a component along z, or the third a component along x or y.
bool tilts_along_z(const std::vector<std::vector<double>>& cell) {
  return cell[0][2] != 0.0 || cell[1][2] != 0.0 || cell[2][0] != 0.0 || cell[2][1] != 0.0;
}

/// Guesses whether grains that all have the same z are disks or spheres.
/// @param height  distance of a grain from its periodic image along z; a sphere with a larger diameter touches its
/// image
/// @param mid_plane  whether the grains lie in the middle of the cell along its third side
Guess guess_of_layer(const std::vector<ListedGrain>& grains, double height, bool mid_plane) {
  std::size_t n_touching = 0;
  double largest = 0.0;
  for (const ListedGrain& g : grains) {
    n_touching += 2.0 * g.radius > height;
    largest = std::max(largest, 2.0 * g.radius);
  }
  if (n_touching == 0)
    return {2, "every z is the same, so the grains are taken as disks in 2D; --dimension 3 makes them spheres",
            false};
  if (n_touching == grains.size() && largest - height <= kDeepestOverlap * largest && !mid_plane)
    return {
        3,
        fmt::format("every z is the same, but the cell is {:.6g} high, less than the diameter of each grain, "
                    "so the grains are taken as spheres that touch their own images along z; --dimension 2 "
                    "makes them disks",
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
    return {
        3,
        "every z is the same, but the lattice vectors are tilted along z, so the grains are taken as spheres; "
        "--dimension 2 makes them disks",
        false};
  const bool periodic = space.periodic.size() < 3 || space.periodic[2];
  return guess_of_layer(grains, periodic ? std::abs(space.cell[2][2]) : none, space.mid_plane);
}

void require_periodic(const ListedSpace& space, int dimension, std::vector<std::string>& remarks) {
  for (std::size_t a = 0; a < std::min<std::size_t>(dimension, space.periodic.size()); ++a)
    if (!space.periodic[a])
      throw InputError(
          space.place,
          fmt::format(
              "the box is not periodic ({}), and packings between walls cannot be read; --cell puts grains "
              "that touch no wall into a periodic cell",
              space.boundary));
  if (space.periodic.empty() && !space.cell.empty())
    remarks.emplace_back(
        "the packing is taken as periodic in every direction, because the file does not say whether it is");
}

}  // namespace

int settle_space(const ListedSpace& space, const ImportOptions& options, ListedPacking& listed) {
  if (listed.grains.empty()) throw InputError(listed.place, "the file has no grains");
  int dimension = 0;
  // Options of the user take precedence over the file, and the file takes precedence over a guess.
  if (options.dimension || !options.cell.empty() || space.dimension) {
    const int of_cell = static_cast<int>(options.cell.size());
    dimension = options.dimension ? *options.dimension : of_cell > 0 ? of_cell : *space.dimension;
  } else {
    Guess guess = guess_dimension(space, listed.grains);
    dimension = guess.dimension;
    if (!guess.words.empty())
      (guess.doubtful ? listed.inconsistencies : listed.remarks).push_back(std::move(guess.words));
  }
  // A cell given by the user is periodic by definition, so the boundary of the file is not checked.
  if (!options.cell.empty()) {
    listed.cell_place = "--cell";
    listed.cell = options.cell;
    return dimension;
  }
  require_periodic(space, dimension, listed.remarks);
  listed.cell_place = space.place;
  listed.cell.clear();
  for (int a = 0; a < dimension && !space.cell.empty(); ++a) {
    const std::vector<double>& vector = space.cell[a];
    if (dimension == 2 && vector[2] != 0.0)
      throw InputError(space.place,
                       fmt::format("lattice vector {} has the z component {:.6g}, expected 0 in two "
                                   "dimensions; --dimension 3 makes the grains spheres",
                                   a + 1, vector[2]));
    listed.cell.emplace_back(vector.begin(), vector.begin() + dimension);
  }
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
                                   "two-dimensional packing (three vectors of --cell, or --dimension 3, make "
                                   "the grains spheres)",
                                   g.position[2], z, listed.grains.front().place.text()));
}

}  // namespace floc
