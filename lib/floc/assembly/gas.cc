#include "floc/assembly/gas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "floc/base/error.h"
#include "floc/neighbors/pairs.h"

namespace floc {
namespace {

/// Solid fraction that placing one by one reaches without long searches.
template <int Dim>
constexpr double kRandomPlacingLimit = Dim == 2 ? 0.4 : 0.3;
constexpr int kShuffleSweeps = 200;  ///< moves a grain: several mean free paths, the placing is forgotten
constexpr int kMaxSweeps = 20000;    ///< beyond this growing has failed
constexpr double kGrowth = 1.01;     ///< of all diameters, whenever no grains overlap

template <int Dim>
double solid_volume(const std::vector<double>& diameter) {
  double sum = 0.0;
  for (const double d : diameter)
    sum += Dim == 2 ? std::numbers::pi / 4.0 * d * d : std::numbers::pi / 6.0 * d * d * d;
  return sum;
}

/// Where grains are placed: periodic along some axes, between walls along the others.
template <int Dim>
struct Room {
  Vec<Dim> side;
  std::array<bool, Dim> walled = {};
};

/// Hard grains in a rectangular room, on a grid of bins no finer than the largest grain.
template <int Dim>
class HardGrains {
 public:
  HardGrains(const Room<Dim>& room, const std::vector<double>& diameter) : room_(room), diameter_(diameter) {
    const double largest = *std::max_element(diameter.begin(), diameter.end());
    std::size_t n_bins = 1;
    for (int a = 0; a < Dim; ++a) {
      bins_[a] = std::max(1, static_cast<int>(room.side[a] / largest));
      n_bins *= static_cast<std::size_t>(bins_[a]);
    }
    members_.resize(n_bins);
    position_.resize(diameter.size());
  }

  const Room<Dim>& room() const { return room_; }

  /// True if grain i at x, with all diameters times `scale`, keeps clear of every placed grain but itself.
  bool free_at(int i, const Vec<Dim>& x, double scale) const { return clearance(i, x, scale) >= 1.0; }

  /// Smallest ratio of distance to contact distance (diameters times `scale`) around grain i at x, at most 2.
  double clearance(int i, const Vec<Dim>& x, double scale) const {
    double least = 2.0;
    Vec<Dim, int> centre = bin_of(x), offset = Vec<Dim, int>::Constant(-1);
    while (true) {
      for (const int j : members_[flat(centre + offset)]) {
        if (j == i) continue;
        Vec<Dim> r = position_[j] - x;
        for (int a = 0; a < Dim; ++a)
          if (!room_.walled[a]) r[a] -= room_.side[a] * std::round(r[a] / room_.side[a]);
        least = std::min(least, r.norm() / (0.5 * scale * (diameter_[i] + diameter_[j])));
      }
      int a = 0;
      while (a < Dim && ++offset[a] > 1) offset[a] = -1, ++a;
      if (a == Dim) return least;
    }
  }

  void place(int i, const Vec<Dim>& x) {
    position_[i] = x;
    members_[flat(bin_of(x))].push_back(i);
  }

  void move(int i, const Vec<Dim>& x) {
    auto& old = members_[flat(bin_of(position_[i]))];
    old.erase(std::find(old.begin(), old.end(), i));
    place(i, x);
  }

  const std::vector<Vec<Dim>>& position() const { return position_; }

 private:
  Vec<Dim, int> bin_of(const Vec<Dim>& x) const {
    Vec<Dim, int> bin;
    for (int a = 0; a < Dim; ++a)
      bin[a] = std::min(bins_[a] - 1, static_cast<int>(x[a] / room_.side[a] * bins_[a]));
    return bin;
  }
  std::size_t flat(const Vec<Dim, int>& bin) const {
    std::size_t index = 0;
    for (int a = 0; a < Dim; ++a)
      index =
          index * static_cast<std::size_t>(bins_[a]) + static_cast<std::size_t>((bin[a] + bins_[a]) % bins_[a]);
    return index;
  }

  Room<Dim> room_;
  std::vector<double> diameter_;
  Vec<Dim, int> bins_;
  std::vector<std::vector<int>> members_;
  std::vector<Vec<Dim>> position_;
};

/// A place for a grain, which keeps its radius from walls.
template <int Dim>
Vec<Dim> random_point(const Room<Dim>& room, double diameter, RandomStream& random) {
  Vec<Dim> x;
  for (int a = 0; a < Dim; ++a) {
    const double kept = room.walled[a] ? 0.5 * diameter : 0.0;
    x[a] = random.uniform(kept, room.side[a] - kept);
  }
  return x;
}

/// Places the grains one by one, the largest first, with diameters times `scale`.
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
      if (++tries > kMaxTries) throw InputError("assembly", "solid_fraction: no room left to place the grains");
      x = random_point(grains.room(), diameter[i], random);
    }
    grains.place(i, x);
  }
}

/// One Monte Carlo sweep: a trial move of every grain.
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
      x[a] -= room.side[a] * std::floor(x[a] / room.side[a]);
      if (x[a] >= room.side[a]) x[a] = 0.0;
    }
    if (!inside) continue;
    const double clearance = grains.clearance(i, x, scale);
    // A grain that still overlaps after growing may move wherever it overlaps less.
    if (clearance >= 1.0 || clearance > grains.clearance(i, grains.position()[i], scale)) grains.move(i, x);
  }
}

/// True if no two grains overlap with diameters times `scale`.
template <int Dim>
bool all_free(const HardGrains<Dim>& grains, int n, double scale) {
  for (int i = 0; i < n; ++i)
    if (!grains.free_at(i, grains.position()[i], scale)) return false;
  return true;
}

}  // namespace

std::vector<double> draw_diameters(const GrainOptions& options, RandomStream& random) {
  const DiameterDistribution& d = options.diameter;
  if (d.kind == DiameterDistribution::Kind::list) return d.values;
  const int n = options.count;
  std::vector<double> diameter(n, d.min);
  // Equally spaced quantiles in random order: the sample has the distribution's moments, and its largest grain
  // is exactly the unit of length that P* and kappa are made of.
  for (int i = 0; i < n; ++i) {
    if (d.kind == DiameterDistribution::Kind::uniform)
      diameter[i] = n == 1 ? d.max : d.min + (d.max - d.min) * i / (n - 1);
    if (d.kind == DiameterDistribution::Kind::bidisperse)
      diameter[i] = i < d.share_of_large * n ? d.max : d.min;
  }
  for (int i = n - 1; i > 0; --i) std::swap(diameter[i], diameter[random.below(i + 1)]);
  return diameter;
}

namespace {

/// Positions of hard grains of these diameters at random in a room.
/// @param solid_fraction  of the room that centres may be in
template <int Dim>
std::vector<Vec<Dim>> place_hard_grains(const Room<Dim>& room, const std::vector<double>& diameter,
                                        double solid_fraction, RandomStream& random) {
  double scale = std::min(1.0, std::pow(kRandomPlacingLimit<Dim> / solid_fraction, 1.0 / Dim));
  HardGrains<Dim> hard(room, diameter);
  place_at_random(hard, diameter, scale, random);

  const double mean_diameter =
      std::pow(solid_volume<Dim>(diameter) / static_cast<double>(diameter.size()), 1.0 / Dim);
  for (int sweep = 0, at_size = 0; at_size < kShuffleSweeps; ++sweep) {
    if (sweep > kMaxSweeps)
      throw InputError(
          "assembly",
          fmt::format("solid_fraction: grains without overlap got stuck at {:.3f} of their size", scale));
    shuffle(hard, diameter, scale, (sweep % 2 ? 0.5 : 0.1) * mean_diameter, random);
    const bool grown = at_size > 0 || all_free(hard, static_cast<int>(diameter.size()), scale);
    at_size += grown && scale == 1.0;
    if (grown) scale = std::min(1.0, kGrowth * scale);
  }
  return hard.position();
}

/// Grains at rest of these diameters, without places.
template <int Dim>
Packing<Dim> grains_of(const GrainOptions& options, const LawParameters& law,
                       const std::vector<double>& diameter) {
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

/// Velocities of one magnitude in random directions, without total momentum.
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

}  // namespace

template <int Dim>
Packing<Dim> make_gas(const GrainOptions& options, const LawParameters& law, double solid_fraction,
                      RandomStream& random) {
  const std::vector<double> diameter = draw_diameters(options, random);
  const double side = std::pow(solid_volume<Dim>(diameter) / solid_fraction, 1.0 / Dim);
  Packing<Dim> gas = grains_of<Dim>(options, law, diameter);
  gas.cell.matrix *= side;
  gas.grains.position =
      place_hard_grains<Dim>({Vec<Dim>::Constant(side), {}}, diameter, solid_fraction, random);
  return gas;
}

template <int Dim>
Packing<Dim> make_boxed_gas(const GrainOptions& options, const LawParameters& law, const BoxOptions& box,
                            double solid_fraction, RandomStream& random) {
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
  gas.grains.position = place_hard_grains(room, diameter, solid / for_centres, random);
  gas.walls = walls_around<Dim>(gas, box, Vec<Dim>::Zero());
  gas.wall_law = wall_law(law, box);
  send_off(gas, box.kinetic_pressure, random);
  return gas;
}

template <int Dim>
void agitate(Packing<Dim>& packing, double rms_speed, RandomStream& random) {
  Grains<Dim>& g = packing.grains;
  const double heaviest = *std::max_element(g.mass.begin(), g.mass.end());
  Vec<Dim> momentum = Vec<Dim>::Zero();
  double mass = 0.0;
  for (int i = 0; i < g.size(); ++i) {
    // Maxwell's distribution: every grain has the same mean energy. Mass over mass, for no unit to enter its
    // root.
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

template Packing<2> make_gas(const GrainOptions&, const LawParameters&, double, RandomStream&);
template Packing<3> make_gas(const GrainOptions&, const LawParameters&, double, RandomStream&);
template Packing<2> make_boxed_gas(const GrainOptions&, const LawParameters&, const BoxOptions&, double,
                                   RandomStream&);
template Packing<3> make_boxed_gas(const GrainOptions&, const LawParameters&, const BoxOptions&, double,
                                   RandomStream&);
template void agitate(Packing<2>&, double, RandomStream&);
template void agitate(Packing<3>&, double, RandomStream&);

}  // namespace floc
