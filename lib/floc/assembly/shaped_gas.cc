#include "floc/assembly/shaped_gas.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "floc/assembly/draw_shapes.h"
#include "floc/assembly/random_streams.h"
#include "floc/base/error.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

template <int Dim>
constexpr double kDensestGas = Dim == 2 ? kDensestGasOfDisks : kDensestGasOfSpheres;

/// Returns a uniformly distributed random orientation.
template <int Dim>
Orientation<Dim> random_orientation(RandomStream& random) {
  if constexpr (Dim == 2) {
    return random.uniform(-std::numbers::pi, std::numbers::pi);
  } else {
    // Four normally distributed numbers form a vector of random direction in four dimensions. Unit vectors in four
    // dimensions (quaternions) represent rotations.
    Vec<4> q;
    do {
      for (int a = 0; a < 4; ++a) q[a] = random.normal();
    } while (q.isZero(0.0));
    q.normalize();
    return {q[0], q[1], q[2], q[3]};
  }
}

/// Returns the indices of n grains in random order.
std::vector<int> random_order(int n, RandomStream& random) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
  return order;
}

}  // namespace

template <int Dim>
Grains<Dim> shaped_grains(const GrainOptions& options, const std::vector<double>& diameter,
                          std::uint64_t seed) {
  assert(options.shape.has_value());
  const int n = static_cast<int>(diameter.size());
  Grains<Dim> grains = Grains<Dim>::with_size(n);
  auto shapes = std::make_shared<std::vector<Shape<Dim>>>(draw_shapes<Dim>(*options.shape, seed).shapes);
  RandomStream random(seed, kShapeStream);
  const std::vector<int> order = random_order(n, random);
  const int n_shapes = static_cast<int>(shapes->size());
  grains.shape.assign(n, 0);
  for (int k = 0; k < n; ++k) grains.shape[order[k]] = k % n_shapes;
  grains.scale.assign(n, 1.0);
  for (int i = 0; i < n; ++i) {
    grains.radius[i] = 0.5 * diameter[i];
    grains.scale[i] = grains.radius[i] / (*shapes)[grains.shape[i]].outer_radius;
    grains.orientation[i] = random_orientation<Dim>(random);
  }
  grains.shapes = std::move(shapes);
  const double density = options.density.value_or(1.0 / Ball<Dim>{0.5}.volume());
  for (int i = 0; i < n; ++i) grains.mass[i] = density * grains.volume(i);
  return grains;
}

template <int Dim>
double share_of_bounding_balls(const Grains<Dim>& grains) {
  double balls = 0.0;
  for (const double radius : grains.radius) balls += Ball<Dim>{radius}.volume();
  return total_volume(grains) / balls;
}

template <int Dim>
double densest_gas(const Grains<Dim>& grains) {
  return kDensestGas<Dim> * share_of_bounding_balls(grains);
}

namespace {

/// Makes a gas of grains with shapes. The argument place_balls() is a function that places the circumscribed circles or
/// spheres (balls) of the grains. Its arguments are options with the diameters of the balls, and the solid fraction of
/// the balls.
/// @param key  key of the solid fraction in a scene, for messages
template <int Dim>
Packing<Dim> shaped_gas(const GrainOptions& options, double solid_fraction, const char* key, std::uint64_t seed,
                        RandomStream& random, const auto& place_balls) {
  // The diameters are drawn here; place_balls() gets them as a list and does not draw diameters again.
  GrainOptions balls = options;
  balls.diameter.values = draw_diameters(options, random);
  balls.diameter.kind = DiameterDistribution::Kind::list;
  Grains<Dim> grains = shaped_grains<Dim>(options, balls.diameter.values, seed);
  if (solid_fraction > densest_gas(grains))
    throw InputError(
        key,
        fmt::format("{0:g}: expected at most {2:.4g}; at a higher solid fraction, the circumscribed {1} of "
                    "the grains cannot be placed without overlap",
                    solid_fraction, Dim == 2 ? "circles" : "spheres", densest_gas(grains)));
  Packing<Dim> gas = place_balls(balls, solid_fraction / share_of_bounding_balls(grains));
  grains.position = std::move(gas.grains.position);
  gas.grains = std::move(grains);
  return gas;
}

}  // namespace

template <int Dim>
Packing<Dim> make_shaped_gas(const GrainOptions& options, const Law& law, double solid_fraction,
                             std::uint64_t seed, RandomStream& random, GasKind kind) {
  return shaped_gas<Dim>(options, solid_fraction, "cell.solid_fraction", seed, random,
                         [&](const GrainOptions& balls, double fraction) {
                           return make_gas<Dim>(balls, law, fraction, random, kind);
                         });
}

template <int Dim>
Packing<Dim> make_boxed_shaped_gas(const GrainOptions& options, const Law& law, const BoxOptions& box,
                                   double solid_fraction, std::uint64_t seed, RandomStream& random,
                                   GasKind kind) {
  Packing<Dim> gas = shaped_gas<Dim>(options, solid_fraction, "assembly.solid_fraction", seed, random,
                                     [&](const GrainOptions& balls, double fraction) {
                                       return make_boxed_gas<Dim>(balls, law, box, fraction, random, kind);
                                     });
  send_off(gas, box.kinetic_pressure, random);
  // The scene gives the mass of a wall as a multiple of the mass of the largest grain; make_boxed_gas() has used the
  // mass of the largest ball instead.
  for (Wall<Dim>& wall : gas.walls)
    if (std::isfinite(wall.mass)) wall.mass = box.mass * largest_mass(gas.grains);
  return gas;
}

template Grains<2> shaped_grains(const GrainOptions&, const std::vector<double>&, std::uint64_t);
template Grains<3> shaped_grains(const GrainOptions&, const std::vector<double>&, std::uint64_t);
template double share_of_bounding_balls(const Grains<2>&);
template double share_of_bounding_balls(const Grains<3>&);
template double densest_gas(const Grains<2>&);
template double densest_gas(const Grains<3>&);
template Packing<2> make_shaped_gas(const GrainOptions&, const Law&, double, std::uint64_t, RandomStream&,
                                    GasKind);
template Packing<3> make_shaped_gas(const GrainOptions&, const Law&, double, std::uint64_t, RandomStream&,
                                    GasKind);
template Packing<2> make_boxed_shaped_gas(const GrainOptions&, const Law&, const BoxOptions&, double,
                                          std::uint64_t, RandomStream&, GasKind);
template Packing<3> make_boxed_shaped_gas(const GrainOptions&, const Law&, const BoxOptions&, double,
                                          std::uint64_t, RandomStream&, GasKind);

}  // namespace floc
