#include "floc/assembly/gas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "floc/base/error.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Largest solid fraction at which grains are placed at random with their final diameters. At higher solid fractions,
/// finding free places would take too long; grains are then placed with smaller diameters and grow afterwards.
template <int Dim>
constexpr double kRandomPlacingLimit = Dim == 2 ? 0.4 : 0.3;
/// Mean number of Monte Carlo moves of a grain after all grains have reached their final diameters. In these moves a
/// grain travels several mean free paths, so the positions at which the grains were placed have no effect on the gas.
constexpr int kShuffleSweeps = 200;
/// largest number of Monte Carlo sweeps until the grains have their final diameters
constexpr int kMaxSweeps = 20000;
constexpr double kGrowth = 1.01;  ///< factor by which all diameters are multiplied whenever no grains overlap
/// Overlapping grains are pushed apart until the distance between their centres is this multiple of the sum of their
/// radii.
constexpr double kParted = 1.001;
/// largest number of passes over all grains in which overlapping grains are pushed apart
constexpr int kMaxPartings = 1000;

template <int Dim>
double solid_volume(const std::vector<double>& diameter) {
  double sum = 0.0;
  for (const double d : diameter)
    sum += Dim == 2 ? std::numbers::pi / 4.0 * d * d : std::numbers::pi / 6.0 * d * d * d;
  return sum;
}

/// Rectangular region in which grains are placed. Along each axis it is either periodic or bounded by walls.
template <int Dim>
struct Room {
  Vec<Dim> side;
  std::array<bool, Dim> walled = {};
};

/// Hard grains in a rectangular region. To find close grains fast, the region is divided into a grid of bins, and each
/// bin lists the grains in it. If the largest diameter is much larger than the smallest, there are several grids, such
/// that the diameters of the grains in one grid differ by less than a factor of two. The bins of a grid are at least as
/// long as the diameter of its largest grain, unless the region is shorter.
template <int Dim>
class HardGrains {
 public:
  HardGrains(const Room<Dim>& room, const std::vector<double>& diameter)
      : room_(room), diameter_(diameter), grid_of_(diameter.size(), 0), position_(diameter.size()) {
    const auto [least, most] = std::minmax_element(diameter.begin(), diameter.end());
    if (*most > kSimilarSizes * *least)
      for (std::size_t i = 0; i < diameter.size(); ++i) grid_of_[i] = std::ilogb(*most / diameter[i]);
    grids_.resize(*std::max_element(grid_of_.begin(), grid_of_.end()) + 1);
    for (std::size_t i = 0; i < diameter.size(); ++i) {
      Grid& grid = grids_[grid_of_[i]];
      grid.largest = std::max(grid.largest, diameter[i]), ++grid.n_grains;
    }
    for (Grid& grid : grids_)
      if (grid.n_grains > 0) divide(grid);
  }

  const Room<Dim>& room() const { return room_; }

  /// Returns true if grain i, with its centre at x and all diameters multiplied by `scale`, overlaps no other placed
  /// grain: clearance(i, x, scale) >= 1.
  bool free_at(int i, const Vec<Dim>& x, double scale) const {
    bool free = true;
    visit_near(i, x, [&](int j, const Vec<Dim>& r) {
      const double touching = 0.5 * scale * (diameter_[i] + diameter_[j]);
      // Most grains are far apart, and the square root for their exact distance is not needed.
      if (r.squaredNorm() < kSurelyApart * touching * touching) free = r.norm() / touching >= 1.0;
      return free;
    });
    return free;
  }

  /// For each other grain j, let q be the distance between the centres of the grains i and j, divided by the sum of
  /// their radii. Returns the smallest q. The centre of i is at x, and all diameters are multiplied by `scale` <= 1. A
  /// result above 1 only means that grain i overlaps no other grain; its value may be inexact.
  double clearance(int i, const Vec<Dim>& x, double scale) const {
    double least = 2.0;
    visit_near(i, x, [&](int j, const Vec<Dim>& r) {
      least = std::min(least, r.norm() / (0.5 * scale * (diameter_[i] + diameter_[j])));
      return true;
    });
    return least;
  }

  /// Calls visit(j, r) for every grain j that grain i, with its centre at x, might touch, and for some grains farther
  /// away. The calls end when `visit` returns false. The vector r leads from x to the centre of grain j.
  template <typename Visit>
  void visit_near(int i, const Vec<Dim>& x, Visit&& visit) const {
    for (const Grid& grid : grids_) {
      if (grid.n_grains == 0) continue;
      const double reach = 0.5 * (diameter_[i] + grid.largest);
      const Vec<Dim, int> centre = bin_of(x, grid);
      Vec<Dim, int> most;
      // Half of the bins of a side in each direction are together all bins of the side. More bins are never visited.
      for (int a = 0; a < Dim; ++a)
        most[a] = std::min(grid.bins[a] / 2, static_cast<int>(std::ceil(reach / room_.side[a] * grid.bins[a])));
      // The order of the offsets along an axis is 0, 1, -1, 2, -2, ..., because a grain that ends the search is most
      // often in one of the nearest bins.
      Vec<Dim, int> offset = Vec<Dim, int>::Zero();
      int a = 0;
      while (a < Dim) {
        for (const int j : grid.members[flat(centre + offset, grid)])
          if (j != i && !visit(j, nearest_image(position_[j] - x))) return;
        for (a = 0; a < Dim; offset[a] = 0, ++a) {
          offset[a] = offset[a] > 0 ? -offset[a] : 1 - offset[a];
          if (offset[a] <= most[a]) break;
        }
      }
    }
  }

  Vec<Dim> nearest_image(Vec<Dim> r) const {
    // Most components are shorter than half of the side of the region; no division is needed for them.
    for (int a = 0; a < Dim; ++a)
      if (!room_.walled[a] && std::abs(r[a]) > kSurelyNearest * room_.side[a])
        r[a] -= room_.side[a] * std::round(r[a] / room_.side[a]);
    return r;
  }

  void place(int i, const Vec<Dim>& x) {
    position_[i] = x;
    bin_at(i, x).push_back(i);
  }

  void move(int i, const Vec<Dim>& x) {
    auto& old = bin_at(i, position_[i]);
    old.erase(std::find(old.begin(), old.end(), i));
    place(i, x);
  }

  const std::vector<Vec<Dim>>& position() const { return position_; }

 private:
  /// kSurelyApart: let q be the squared distance of the centres of two grains, divided by the squared sum of their
  /// radii. If q is at least this number, the grains do not overlap, in spite of rounding errors.
  /// kSurelyNearest: let q be a component of a vector, divided by the side of the region. If |q| is at most this
  /// number, no periodic image of the vector has a shorter component.
  static constexpr double kSurelyApart = 1.0 + 1e-9, kSurelyNearest = 0.499;

  struct Grid {
    double largest = 0.0;  ///< largest diameter of the grains in this grid (length)
    int n_grains = 0;
    Vec<Dim, int> bins;  ///< number of bins along each side of the region
    std::vector<std::vector<int>> members;
  };

  void divide(Grid& grid) const {
    // The number of bins is limited: with many more bins than grains, empty bins would use memory without saving time.
    const double most_bins = 2.0 * std::pow(static_cast<double>(grid.n_grains), 1.0 / Dim) + 1.0;
    std::size_t n_bins = 1;
    for (int a = 0; a < Dim; ++a) {
      grid.bins[a] = static_cast<int>(std::clamp(room_.side[a] / grid.largest, 1.0, most_bins));
      n_bins *= static_cast<std::size_t>(grid.bins[a]);
    }
    grid.members.resize(n_bins);
  }

  Vec<Dim, int> bin_of(const Vec<Dim>& x, const Grid& grid) const {
    Vec<Dim, int> bin;
    for (int a = 0; a < Dim; ++a)
      bin[a] = std::min(grid.bins[a] - 1, static_cast<int>(x[a] / room_.side[a] * grid.bins[a]));
    return bin;
  }
  /// Returns the index of a bin in Grid::members. The numbers in `bin` are periodic: along an axis with n bins, the
  /// bins -1 and n are the bins n - 1 and 0. Numbers from -n to 2 n - 1 are allowed.
  std::size_t flat(const Vec<Dim, int>& bin, const Grid& grid) const {
    std::size_t index = 0;
    for (int a = 0; a < Dim; ++a) {
      const int n = grid.bins[a];
      const int inside = bin[a] < 0 ? bin[a] + n : bin[a] >= n ? bin[a] - n : bin[a];
      index = index * static_cast<std::size_t>(n) + static_cast<std::size_t>(inside);
    }
    return index;
  }
  std::vector<int>& bin_at(int i, const Vec<Dim>& x) {
    Grid& grid = grids_[grid_of_[i]];
    return grid.members[flat(bin_of(x, grid), grid)];
  }

  Room<Dim> room_;
  std::vector<double> diameter_;
  std::vector<int> grid_of_;
  std::vector<Grid> grids_;
  std::vector<Vec<Dim>> position_;
};

/// Returns a random point for the centre of a grain with the given diameter. The distance of the point from walls is at
/// least the radius of the grain.
template <int Dim>
Vec<Dim> random_point(const Room<Dim>& room, double diameter, RandomStream& random) {
  Vec<Dim> x;
  for (int a = 0; a < Dim; ++a) {
    const double kept = room.walled[a] ? 0.5 * diameter : 0.0;
    x[a] = random.uniform(kept, room.side[a] - kept);
  }
  return x;
}

/// Places the grains one by one at random positions without overlap, the largest grains first. All diameters are
/// multiplied by `scale`.
template <int Dim>
void place_at_random(HardGrains<Dim>& grains, const std::vector<double>& diameter, double scale,
                     RandomStream& random) {
  std::vector<int> order(diameter.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) { return diameter[p] > diameter[q]; });
  constexpr int kMaxTries = 100000;
  for (const int i : order) {
    int tries = 0;
    Vec<Dim> x = random_point(grains.room(), diameter[i], random);
    while (!grains.free_at(i, x, scale)) {
      if (++tries > kMaxTries)
        throw InputError("assembly",
                         "solid_fraction is too large: no space is left for the next grain; expected a smaller "
                         "solid_fraction");
      x = random_point(grains.room(), diameter[i], random);
    }
    grains.place(i, x);
  }
}

/// Returns a coordinate x along a periodic axis, shifted into the interval [0, side) by a multiple of the period
/// `side`.
double wrapped(double x, double side) {
  x -= side * std::floor(x / side);
  return x < side ? x : 0.0;
}

/// Performs one Monte Carlo sweep of as many trial moves as there are grains. Each move displaces a random grain by at
/// most `reach` along each axis. All diameters are multiplied by `scale`.
template <int Dim>
void shuffle(HardGrains<Dim>& grains, const std::vector<double>& diameter, double scale, double reach,
             RandomStream& random) {
  const int n = static_cast<int>(diameter.size());
  const Room<Dim>& room = grains.room();
  for (int trial = 0; trial < n; ++trial) {
    const int i = static_cast<int>(random.below(n));
    Vec<Dim> x = grains.position()[i];
    bool inside = true;
    for (int a = 0; a < Dim; ++a) {
      x[a] += random.uniform(-reach, reach);
      if (room.walled[a]) {
        const double kept = 0.5 * diameter[i];
        inside = inside && x[a] >= kept && x[a] <= room.side[a] - kept;
        continue;
      }
      x[a] = wrapped(x[a], room.side[a]);
    }
    if (!inside) continue;
    const Vec<Dim>& now = grains.position()[i];
    // If a grain overlaps another grain after all grains have grown, it may also move to a position with a smaller
    // overlap.
    if (grains.free_at(i, x, scale) ||
        (!grains.free_at(i, now, scale) && grains.clearance(i, x, scale) > grains.clearance(i, now, scale)))
      grains.move(i, x);
  }
}

/// Returns true if no two of the n grains overlap when all diameters are multiplied by `scale`.
template <int Dim>
bool all_free(const HardGrains<Dim>& grains, int n, double scale) {
  for (int i = 0; i < n; ++i)
    if (!grains.free_at(i, grains.position()[i], scale)) return false;
  return true;
}

}  // namespace

std::vector<double> draw_diameters(const GrainOptions& options, RandomStream& random) {
  std::vector<double> diameter = equally_spaced_diameters(options.diameter, options.count);
  if (options.diameter.kind == DiameterDistribution::Kind::list) return diameter;
  for (int i = options.count - 1; i > 0; --i) std::swap(diameter[i], diameter[random.below(i + 1)]);
  return diameter;
}

namespace {

/// Grows the grains to their final diameters during Monte Carlo moves. The moves then continue until the positions at
/// which the grains were placed have no effect.
/// @param scale  initial factor by which all diameters are multiplied
template <int Dim>
void equilibrate(HardGrains<Dim>& hard, const std::vector<double>& diameter, double scale,
                 RandomStream& random) {
  const double mean_diameter =
      std::pow(solid_volume<Dim>(diameter) / static_cast<double>(diameter.size()), 1.0 / Dim);
  for (int sweep = 0, at_size = 0; at_size < kShuffleSweeps; ++sweep) {
    if (sweep > kMaxSweeps)
      throw InputError("assembly",
                       fmt::format("solid_fraction is too large: the grains grow from smaller sizes, and "
                                   "overlaps remain when their diameters are {:.3f} of the "
                                   "final diameters; expected a smaller solid_fraction",
                                   scale));
    shuffle(hard, diameter, scale, (sweep % 2 ? 0.5 : 0.1) * mean_diameter, random);
    const bool grown = at_size > 0 || all_free(hard, static_cast<int>(diameter.size()), scale);
    at_size += grown && scale == 1.0;
    if (grown) scale = std::min(1.0, kGrowth * scale);
  }
}

/// Returns x, moved to an allowed position of a grain with the given diameter. Along periodic axes, x is shifted into
/// the region. Along axes with walls, x is moved until the grain does not overlap a wall.
template <int Dim>
Vec<Dim> kept_inside(const Room<Dim>& room, double diameter, Vec<Dim> x) {
  for (int a = 0; a < Dim; ++a) {
    const double kept = 0.5 * diameter;
    x[a] = room.walled[a] ? std::clamp(x[a], kept, room.side[a] - kept) : wrapped(x[a], room.side[a]);
  }
  return x;
}

/// Pushes overlapping grains apart, pair by pair, until no grains overlap.
/// @throws InputError if grains still overlap after many passes
template <int Dim>
void part(HardGrains<Dim>& hard, const std::vector<double>& diameter) {
  std::vector<int> overlapping;
  const auto keep = [&](int i, const Vec<Dim>& x) { hard.move(i, kept_inside(hard.room(), diameter[i], x)); };
  for (int sweep = 0; sweep < kMaxPartings; ++sweep) {
    bool any = false;
    for (int i = 0; i < static_cast<int>(diameter.size()); ++i) {
      overlapping.clear();
      // The overlapping grains are listed before any of them is moved: a move changes the lists of grains in the bins,
      // and visit_near() iterates over these lists.
      hard.visit_near(i, hard.position()[i], [&](int j, const Vec<Dim>& r) {
        if (2.0 * r.norm() < diameter[i] + diameter[j]) overlapping.push_back(j);
        return true;
      });
      // The final positions depend on the order of the pushes. visit_near() finds the grains in an order that depends
      // on the grid of bins and on earlier moves. The order of the numbers of the grains depends on neither of them.
      std::sort(overlapping.begin(), overlapping.end());
      for (const int j : overlapping) {
        // The distance d = |r| is computed again, because earlier pushes may have moved both grains. If d is less than
        // the wanted distance w, each grain moves by (w - d)/2 along r, away from the other.
        const Vec<Dim> r = hard.nearest_image(hard.position()[j] - hard.position()[i]);
        const double distance = r.norm(), wanted = 0.5 * kParted * (diameter[i] + diameter[j]);
        if (distance >= wanted) continue;
        const Vec<Dim> push = 0.5 * (wanted / distance - 1.0) * r;
        keep(i, hard.position()[i] - push);
        keep(j, hard.position()[j] + push);
      }
      any = any || !overlapping.empty();
    }
    if (!any) return;
  }
  throw InputError(
      "assembly",
      "solid_fraction is too large: grains that were added one by one overlap and could not be pushed apart; "
      "expected a smaller solid_fraction");
}

/// Returns random positions, without overlap, of hard grains with the given diameters in a region.
/// @param solid_fraction  volume of the grains, divided by the volume in which their centres may lie
template <int Dim>
std::vector<Vec<Dim>> place_hard_grains(const Room<Dim>& room, const std::vector<double>& diameter,
                                        GasKind kind, double solid_fraction, RandomStream& random) {
  const double scale = std::min(1.0, std::pow(kRandomPlacingLimit<Dim> / solid_fraction, 1.0 / Dim));
  HardGrains<Dim> hard(room, diameter);
  place_at_random(hard, diameter, scale, random);
  if (kind == GasKind::equilibrated)
    equilibrate(hard, diameter, scale, random);
  else
    part(hard, diameter);
  return hard.position();
}

/// Returns a packing of grains at rest with the given diameters and the masses that follow from them. Positions are not
/// set.
template <int Dim>
Packing<Dim> grains_of(const GrainOptions& options, const Law& law, const std::vector<double>& diameter) {
  Packing<Dim> gas;
  gas.law = law;
  gas.grains = Grains<Dim>::with_size(static_cast<int>(diameter.size()));
  const double unit_sphere = Dim == 2 ? std::numbers::pi / 4.0 : std::numbers::pi / 6.0;
  const double mass_per_cube = options.density ? *options.density * unit_sphere : 1.0;
  for (int i = 0; i < gas.grains.size(); ++i) {
    gas.grains.radius[i] = 0.5 * diameter[i];
    gas.grains.mass[i] = mass_per_cube * std::pow(diameter[i], Dim);
  }
  return gas;
}

}  // namespace

template <int Dim>
void send_off(Packing<Dim>& packing, double kinetic_pressure, RandomStream& random) {
  Grains<Dim>& g = packing.grains;
  Vec<Dim> momentum = Vec<Dim>::Zero();
  double mass = 0.0;
  for (int i = 0; i < g.size(); ++i) {
    do {
      for (int a = 0; a < Dim; ++a) g.velocity[i][a] = random.normal();
    } while (g.velocity[i].isZero(0.0));
    g.velocity[i].normalize();
    momentum += g.mass[i] * g.velocity[i];
    mass += g.mass[i];
  }
  double twice_kinetic = 0.0;
  for (int i = 0; i < g.size(); ++i) {
    g.velocity[i] -= momentum / mass;
    twice_kinetic += g.mass[i] * g.velocity[i].squaredNorm();
  }
  const double factor =
      twice_kinetic > 0.0 ? std::sqrt(kinetic_pressure * packing.cell.volume() / twice_kinetic) : 0.0;
  for (Vec<Dim>& v : g.velocity) v *= factor;
}

template <int Dim>
Packing<Dim> make_gas(const GrainOptions& options, const Law& law, double solid_fraction, RandomStream& random,
                      GasKind kind) {
  const std::vector<double> diameter = draw_diameters(options, random);
  const double side = std::pow(solid_volume<Dim>(diameter) / solid_fraction, 1.0 / Dim);
  Packing<Dim> gas = grains_of<Dim>(options, law, diameter);
  gas.cell.matrix *= side;
  gas.grains.position =
      place_hard_grains<Dim>({Vec<Dim>::Constant(side), {}}, diameter, kind, solid_fraction, random);
  return gas;
}

template <int Dim>
Packing<Dim> make_boxed_gas(const GrainOptions& options, const Law& law, const BoxOptions& box,
                            double solid_fraction, RandomStream& random, GasKind kind) {
  const std::vector<double> diameter = draw_diameters(options, random);
  const double solid = solid_volume<Dim>(diameter);
  Room<Dim> room{box.sides.head<Dim>(), {}};
  if (solid_fraction > 0.0) room.side *= std::pow(solid / (solid_fraction * room.side.prod()), 1.0 / Dim);
  const double largest = *std::max_element(diameter.begin(), diameter.end());
  for (int a = 0; a < Dim; ++a) {
    room.walled[a] = box.boundary[a] != BoxSide::periodic;
    if (!(room.side[a] > largest))
      throw InputError("box.sides", fmt::format("the side along axis {} is {:.4g}: expected more than the "
                                                "largest diameter, {:.4g}",
                                                a + 1, room.side[a], largest));
  }
  Packing<Dim> gas = grains_of<Dim>(options, law, diameter);
  gas.cell.matrix = room.side.asDiagonal();
  double for_centres = 1.0;
  for (int a = 0; a < Dim; ++a) for_centres *= room.side[a] - (room.walled[a] ? largest : 0.0);
  gas.grains.position = place_hard_grains(room, diameter, kind, solid / for_centres, random);
  gas.walls = walls_around<Dim>(gas, box, Vec<Dim>::Zero());
  gas.wall_law = wall_law(law, box);
  gas.gravity = box.gravity.head<Dim>();
  send_off(gas, box.kinetic_pressure, random);
  return gas;
}

template <int Dim>
void agitate(Packing<Dim>& packing, double rms_speed, RandomStream& random) {
  Grains<Dim>& g = packing.grains;
  const double heaviest = largest_mass(g);
  Vec<Dim> momentum = Vec<Dim>::Zero();
  double mass = 0.0;
  for (int i = 0; i < g.size(); ++i) {
    // In Maxwell's distribution, the mean kinetic energy of all grains is equal. Each mass is divided by the largest
    // mass, so the result does not depend on the unit of mass.
    for (int a = 0; a < Dim; ++a) g.velocity[i][a] = random.normal() / std::sqrt(g.mass[i] / heaviest);
    momentum += g.mass[i] * g.velocity[i];
    mass += g.mass[i];
  }
  double squares = 0.0;
  for (Vec<Dim>& v : g.velocity) {
    v -= momentum / mass;
    squares += v.squaredNorm();
  }
  const double factor = squares > 0.0 ? rms_speed / std::sqrt(squares / g.size()) : 0.0;
  for (Vec<Dim>& v : g.velocity) v *= factor;
}

template Packing<2> make_gas(const GrainOptions&, const Law&, double, RandomStream&, GasKind);
template Packing<3> make_gas(const GrainOptions&, const Law&, double, RandomStream&, GasKind);
template Packing<2> make_boxed_gas(const GrainOptions&, const Law&, const BoxOptions&, double, RandomStream&,
                                   GasKind);
template Packing<3> make_boxed_gas(const GrainOptions&, const Law&, const BoxOptions&, double, RandomStream&,
                                   GasKind);
template void send_off(Packing<2>&, double, RandomStream&);
template void send_off(Packing<3>&, double, RandomStream&);
template void agitate(Packing<2>&, double, RandomStream&);
template void agitate(Packing<3>&, double, RandomStream&);

}  // namespace floc
