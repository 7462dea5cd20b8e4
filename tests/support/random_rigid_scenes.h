#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "floc/base/random.h"
#include "floc/packing/balance.h"
#include "support/rigid_gas.h"

/// Small scenes of rigid grains with random parameters.
namespace floc::test {

/// Returns a random kind of shape in a dimension; absent for disks or spheres.
template <int Dim>
std::optional<ShapeOptions> random_shape(RandomStream& random) {
  ShapeOptions shape;
  shape.count = 5;
  if (random.uniform() < 0.3) shape.rounding = random.uniform(1e-6, 0.3);
  switch (random.below(6)) {
    case 0:
      return std::nullopt;
    case 1:
      shape.kind = BoxShapeOptions{std::vector<double>(Dim, 1.0)};
      std::get<BoxShapeOptions>(shape.kind).sides[0] = random.uniform(1.0, 8.0);
      return shape;
    case 2:
      shape.kind = CapsuleOptions{random.uniform(1.0, 20.0)};
      shape.rounding = 0.0;
      return shape;
    case 3:
      shape.kind = HullOptions{};
      return shape;
    case 4:
      shape.kind = VoronoiOptions{.cells = 30};
      return shape;
    default:
      if (Dim == 2) shape.kind = PolygonOptions{3 + static_cast<int>(random.below(8))};
      if (Dim == 3) shape.kind = CutOptions{};
      return shape;
  }
}

/// Imposes a shear or a new length of one axis on a packing. Expects that the motion ends at the imposed strain in a
/// state that passes the verification, or that the relaxation gives a reason for its failure.
template <int Dim>
void strain_at_random(std::uint64_t seed, const Packing<Dim>& packing, RelaxationOptions options) {
  RandomStream random(seed, 2);
  LoadTarget<Dim> load = LoadTarget<Dim>::normal_stress(Vec<Dim>::Ones());
  const Mat<Dim>& cell = packing.cell.matrix;
  load.side[0] = cell(0, 0);
  const double strain = random.uniform(-0.02, 0.02);
  if (random.uniform() < 0.5)
    load.offset = ImposedOffset{Dim - 1, cell(Dim - 1, 0) + strain * cell(Dim - 1, Dim - 1)};
  else
    load.side[0] *= std::exp(strain);
  options.contact_dynamics.inertial_number = std::pow(10.0, random.uniform(-2.0, -1.0));
  const RigidEnd<Dim> end = relaxed_under<Dim>(load, packing, options, false, 4000);
  for (const Vec<Dim>& x : end.packing.grains.position) EXPECT_TRUE(x.allFinite());
  if (end.status != RelaxationStatus::converged) {
    EXPECT_GT(end.reason.size(), 20U);
    return;
  }
  for (const Criterion& criterion : verify_motion(state_in_motion(end, load)))
    EXPECT_TRUE(criterion.holds) << criterion.name << ": " << criterion.where;
}

template <int Dim>
void relax_random_scene(RandomStream& random, std::uint64_t seed) {
  constexpr std::array kSpans{1.0, 0.5, 0.2, 1.0 / 49.0};
  constexpr std::array kFrictions{0.0, 0.1, 0.5, 2.0};
  RigidGas gas{.count = 2 + static_cast<int>(random.below(39)), .least = kSpans[random.below(kSpans.size())]};
  gas.shape = random_shape<Dim>(random);
  gas.friction = kFrictions[random.below(kFrictions.size())];
  gas.seed = seed;
  RelaxationOptions options = rigid_options();
  if (random.uniform() < 0.3) options.contact_dynamics.restitution = random.uniform();
  if (random.uniform() < 0.2) gas.adhesion = random.uniform(0.0, 1.0);
  SCOPED_TRACE(testing::Message() << Dim << "D, scene " << seed << ": " << gas.count << " grains, shape "
                                  << (gas.shape ? static_cast<int>(gas.shape->kind.index()) : -1) << ", from "
                                  << gas.least << ", friction " << gas.friction << ", restitution "
                                  << options.contact_dynamics.restitution << ", adhesion "
                                  << gas.adhesion.value_or(0.0));
  const RigidEnd<Dim> rest = relaxed(make_rigid_gas<Dim>(gas), options, false, 2000);
  expect_at_rest_or_reason(rest);
  if (rest.status == RelaxationStatus::converged) strain_at_random(seed, rest.packing, options);
}

/// Relaxes n random scenes, half of them in 2D and half in 3D. Each relaxation must end in a state at rest that meets
/// all criteria, or give a reason for the failure.
inline void relax_random_scenes(int n, std::uint64_t first_seed) {
  for (int k = 0; k < n; ++k) {
    const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(k);
    RandomStream random(seed, 2);
    if (k % 2 == 0)
      relax_random_scene<2>(random, seed);
    else
      relax_random_scene<3>(random, seed);
  }
}

}  // namespace floc::test
