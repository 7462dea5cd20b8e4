#include "floc/assembly/aggregation.h"

#include <algorithm>

#include "floc/assembly/cluster_flight.h"
#include "floc/base/disjoint_sets.h"
#include "floc/packing/grain_sizes.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/relaxer.h"
#include "floc/relaxation/softening.h"

namespace floc {
namespace {

/// Smallest allowed number of time steps that the fastest grain takes to cross the range of the adhesion. With fewer
/// steps, the grain could pass another grain without being attracted.
constexpr double kStepsAcrossTail = 3.0;
/// The free flight of clusters ends when the surfaces of two clusters are as close as the range of the contact law plus
/// this length (in largest diameters). After the flight, time steps move the clusters again.
constexpr double kFlightClearance = 1e-3;

/// Returns the time step of the options (time). If the fastest grain would cross the range of the adhesion in too few
/// of these steps, a shorter time step is returned.
template <int Dim>
double step_across_tail(const RelaxationOptions& options, const Packing<Dim>& packing) {
  const double step = time_step_of(packing, options.time_step);
  double fastest = 0.0;
  for (const Vec<Dim>& v : packing.grains.velocity) fastest = std::max(fastest, v.norm());
  const double range = packing.law.range();
  return kStepsAcrossTail * fastest * step > range && range > 0.0 ? range / (kStepsAcrossTail * fastest) : step;
}

}  // namespace

template <int Dim>
int count_clusters(const Packing<Dim>& packing) {
  DisjointSets sets(packing.grains.size());
  for (const Contact<Dim>& c : packing.contacts) sets.join(c.i, c.j);
  return sets.n_sets();
}

template <int Dim>
Aggregation<Dim>::Aggregation(const RelaxationOptions& options, Packing<Dim> packing, double skin)
    : options_(options), packing_(std::move(packing)), skin_(skin), n_clusters_(count_clusters(packing_)) {
  const double a = largest_diameter(packing_.grains);
  if (options.skin) skin_ = *options.skin * a;
  if (skin_ == 0.0) skin_ = 0.1 * a;
}

template <int Dim>
bool Aggregation<Dim>::advance() {
  flight_time_ = fly();
  const Law law = packing_.law;
  soften_in_place(packing_, law, 1.0, options_.softening);
  time_step_ = step_across_tail(options_, packing_);
  const auto dynamics =
      make_dynamics(packing_, BoundaryControl<Dim>::fixed(), {time_step_, skin_, options_.threads});
  advance_observed(*dynamics, kStepsPerChunk, Motion::free, observer_, flight_time_, time_step_);
  packing_ = {};
  packing_ = dynamics->release_packing();
  soften_in_place(packing_, law, options_.softening, 1.0);
  if (!options_.skin) skin_ = dynamics->skin();
  n_clusters_ = count_clusters(packing_);
  return n_clusters_ == 1;
}

/// Moves the clusters as rigid bodies until two of them are about to meet. This replaces time steps in which the
/// clusters would only drift (often most time steps of an aggregation).
/// @return skipped time; 0 if the grains of a cluster still move relative to each other
template <int Dim>
double Aggregation<Dim>::fly() {
  if (n_clusters_ == 1) return 0.0;
  const ClusterFlight<Dim> flight(packing_);
  const Vec<Dim> no_load = Vec<Dim>::Zero();
  const ForceScale scale = force_scale(packing_, no_load);
  const double still = kMechanismEnergy * options_.tolerance.energy * scale.force * scale.length;
  if (flight.inner_energy() >= still) return 0.0;
  return flight.fly(packing_, packing_.law.range() + kFlightClearance * scale.length,
                    options_.max_time * inertial_time(packing_, no_load));
}

template <int Dim>
double Aggregation<Dim>::chunk_time() const {
  return flight_time_ + kStepsPerChunk * time_step_;
}

template int count_clusters(const Packing<2>&);
template int count_clusters(const Packing<3>&);
template class Aggregation<2>;
template class Aggregation<3>;

}  // namespace floc
