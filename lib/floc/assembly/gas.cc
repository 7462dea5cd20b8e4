#include "floc/assembly/gas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/assembly/hard_grains.h"
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

/// Monte Carlo moves of hard grains whose diameters grow to their final size.
template <int Dim>
class MovingGrains {
 public:
  /// @param scale  initial factor by which all diameters are multiplied, at which no grains overlap
  MovingGrains(HardGrains<Dim>& grains, const std::vector<double>& diameter, double scale)
      : grains_(grains), diameter_(diameter), scale_(scale), may_overlap_(diameter.size(), false) {}

  double scale() const { return scale_; }

  void grow_to(double scale) {
    scale_ = scale;
    std::fill(may_overlap_.begin(), may_overlap_.end(), true);
  }

  /// Performs one sweep of as many trial moves as there are grains. Each move displaces a random grain by at most
  /// `reach` along each axis.
  void sweep(double reach, RandomStream& random) {
    const int n = static_cast<int>(diameter_.size());
    for (int trial = 0; trial < n; ++trial) {
      const int i = static_cast<int>(random.below(n));
      Vec<Dim> x = grains_.position()[i];
      if (displace(i, x, reach, random)) try_move(i, x);
    }
  }

  bool all_free() {
    for (int i = 0; i < static_cast<int>(diameter_.size()); ++i)
      if (!is_free(i)) return false;
    return true;
  }

 private:
  /// Moves the point x by a random displacement of at most `reach` along each axis.
  /// @return false if grain i, with its centre at x, overlaps a wall
  bool displace(int i, Vec<Dim>& x, double reach, RandomStream& random) const {
    const Room<Dim>& room = grains_.room();
    bool inside = true;
    for (int a = 0; a < Dim; ++a) {
      x[a] += random.uniform(-reach, reach);
      if (room.walled[a]) {
        const double kept = 0.5 * diameter_[i];
        inside = inside && x[a] >= kept && x[a] <= room.side[a] - kept;
        continue;
      }
      x[a] = wrapped(x[a], room.side[a]);
    }
    return inside;
  }

  /// Moves grain i to x if it overlaps no grain there. A grain that overlaps another one after all grains have grown may
  /// also move to a position with a smaller overlap.
  void try_move(int i, const Vec<Dim>& x) {
    if (grains_.free_at(i, x, scale_)) {
      grains_.move(i, x);
      may_overlap_[i] = false;
    } else if (!is_free(i) &&
               grains_.clearance(i, x, scale_) > grains_.clearance(i, grains_.position()[i], scale_)) {
      grains_.move(i, x);
      // Grains that were free may overlap grain i now. More grains than these are marked, so that rounding errors do not
      // matter.
      grains_.visit_near(i, x, [&](int j, const Vec<Dim>& r) {
        may_overlap_[j] = may_overlap_[j] || r.norm() < scale_ * (diameter_[i] + diameter_[j]);
        return true;
      });
    }
  }

  /// Returns true if grain i overlaps no other grain.
  bool is_free(int i) {
    if (may_overlap_[i]) may_overlap_[i] = !grains_.free_at(i, grains_.position()[i], scale_);
    return !may_overlap_[i];
  }

  HardGrains<Dim>& grains_;
  const std::vector<double>& diameter_;
  double scale_;
  std::vector<bool> may_overlap_;  ///< false for a grain that is known to overlap no other grain
};

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
  MovingGrains<Dim> moving(hard, diameter, scale);
  for (int sweep = 0, at_size = 0; at_size < kShuffleSweeps; ++sweep) {
    if (sweep > kMaxSweeps)
      throw InputError("assembly",
                       fmt::format("solid_fraction is too large: the grains grow from smaller sizes, and "
                                   "overlaps remain when their diameters are {:.3f} of the "
                                   "final diameters; expected a smaller solid_fraction",
                                   moving.scale()));
    moving.sweep((sweep % 2 ? 0.5 : 0.1) * mean_diameter, random);
    const bool grown = moving.all_free();
    at_size += grown && moving.scale() == 1.0;
    if (grown && moving.scale() < 1.0) moving.grow_to(std::min(1.0, kGrowth * moving.scale()));
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
