#include "floc/scene/rigid_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floc/assembly/random_streams.h"
#include "floc/assembly/shaped_gas.h"
#include "floc/scene/read_shape.h"
#include "floc/scene/scene_scales.h"

namespace floc {
namespace {

/// Returns the grains, with shapes but without positions, that a run of the scene makes.
template <int Dim>
Grains<Dim> unplaced_grains(const Scene& scene) {
  RandomStream random(scene.seed, kAssemblyStream);
  return shaped_grains<Dim>(scene.grains, draw_diameters(scene.grains, random), scene.seed);
}

/// Returns the ratio of the largest to the smallest extent of a shape along its principal axes.
template <int Dim>
double aspect_of(const Shape<Dim>& shape) {
  if (shape.is_round()) return 1.0;
  Vec<Dim> low = shape.vertices.front(), high = low;
  for (const Vec<Dim>& vertex : shape.vertices) low = low.cwiseMin(vertex), high = high.cwiseMax(vertex);
  const Vec<Dim> extent = high - low + Vec<Dim>::Constant(2.0 * shape.rounding);
  return extent.maxCoeff() / extent.minCoeff();
}

template <int Dim>
void add_shape_groups_of(const Scene& scene, std::vector<DerivedGroup>& groups) {
  const Grains<Dim> grains = unplaced_grains<Dim>(scene);
  double aspect = 0.0;
  for (const int s : grains.shape) aspect += aspect_of((*grains.shapes)[s]) / grains.size();
  groups.push_back(
      {"n_shapes", static_cast<double>(grains.shapes->size()),
       fmt::format("number of different shapes of kind \"{}\"", shape_kind_name(*scene.grains.shape))});
  groups.push_back({"V/V_ball", share_of_bounding_balls(grains),
                    fmt::format("volume of the grains divided by the volume of their circumscribed {}",
                                Dim == 2 ? "circles" : "spheres")});
  groups.push_back(
      {"aspect", aspect,
       "ratio of the largest to the smallest extent along the principal axes, averaged over the grains"});
}

template <int Dim>
double largest_mass_of(const Scene& scene) {
  const Grains<Dim> grains = unplaced_grains<Dim>(scene);
  return *std::max_element(grains.mass.begin(), grains.mass.end());
}

/// Returns the processor time per grain (s) of one time step of rigid polyhedra, averaged over the assembly. Large
/// packings need more sweeps. Without friction, most of the time is spent in the search for the minimum of the volume.
double cost_of_polyhedra(const Scene& scene) {
  const double size = scene.grains.count / 200.0;
  return scene.law.friction_coefficient() > 0.0 ? 1e-4 * std::cbrt(size) : 4e-4 * std::pow(size, 0.4);
}

/// Processor time per grain (s) of one time step under pressures, and of one step with an imposed strain, whose sweeps
/// have to move the whole packing.
struct SecondsPerStep {
  double pressed, sheared;
};

/// Returns the processor times of time steps, measured on packings of 200 to 10 000 disks, 200 pentagons, 2000 spheres
/// and 200 to 5000 polyhedra.
SecondsPerStep seconds_per_step(const Scene& scene) {
  // Small round grains may move only a short distance in a time step. The time steps are therefore shorter if the
  // smallest diameter is smaller.
  const double span =
      scene.grains.shape ? 1.0 : std::pow(scene.grains.largest() / scene.grains.smallest(), 2.0 / 3.0);
  if (scene.dimension == 3) {
    const double seconds = scene.grains.shape ? cost_of_polyhedra(scene) : 6e-5 * span;
    return {seconds, seconds};
  }
  // Sweeps transmit the forces through the packing, and large packings need more sweeps.
  const double size = span * std::sqrt(scene.grains.count / 1000.0);
  if (scene.grains.shape) return {2.7e-5 * size, 5.4e-5 * size};
  return {2.7e-6 * size, 1.3e-5 * size};
}

}  // namespace

void add_shape_groups(const Scene& scene, std::vector<DerivedGroup>& groups) {
  if (scene.dimension == 2)
    add_shape_groups_of<2>(scene, groups);
  else
    add_shape_groups_of<3>(scene, groups);
}

double time_unit_of_rigid_grains(const Scene& scene) {
  const double a = scene.grains.largest();
  const double m = !scene.grains.shape    ? mass_of(scene, a)
                   : scene.dimension == 2 ? largest_mass_of<2>(scene)
                                          : largest_mass_of<3>(scene);
  return std::sqrt(m / (scene.assembly.pressure * std::pow(a, scene.dimension - 2)));
}

double cost_of_rigid_grains(const Scene& scene, int n_loaded) {
  // Number of time steps of the assembly and of each later equilibrium, with the default time step.
  constexpr double kAssembling = 1200.0, kLoading = 300.0;
  double straining = 0.0;
  for (const LoadStage& stage : scene.load) {
    const ContactDynamicsOptions& o = stage.cell.applied_to(scene.relaxation).contact_dynamics;
    const double steps = stage.largest_strain() / (o.inertial_number * ContactDynamicsOptions{}.time_step);
    if (steps <= 0.0) continue;
    straining += steps;
    n_loaded -= stage.steps.value_or(1);
  }
  const double first = scene.starts_from_state() ? kLoading : kAssembling;
  const double shorter = ContactDynamicsOptions{}.time_step / scene.relaxation.contact_dynamics.time_step;
  const auto [pressed, sheared] = seconds_per_step(scene);
  return scene.grains.count * (pressed * (first + kLoading * n_loaded) + sheared * straining) * shorter;
}

}  // namespace floc
