#include "floc/assembly/aggregation.h"

#include <algorithm>

#include "floc/base/disjoint_sets.h"
#include "floc/relaxation/dynamics.h"

namespace floc {
namespace {

/// Steps in which two grains that approach at twice the r.m.s. speed cross the tail, at least (`v dt << D0`).
constexpr double kStepsAcrossTail = 4.0;

}  // namespace

template <int Dim>
int count_clusters(const Packing<Dim>& packing) {
  DisjointSets sets(packing.grains.size());
  for (const Contact<Dim>& c : packing.contacts) sets.join(c.i, c.j);
  return sets.n_sets();
}

template <int Dim>
Aggregation<Dim>::Aggregation(const RelaxationOptions& options, Packing<Dim> packing, double rms_speed,
                              double skin)
    : options_(options),
      packing_(std::move(packing)),
      time_step_(time_step_of(packing_, options.time_step)),
      skin_(skin),
      n_clusters_(count_clusters(packing_)) {
  const double range = packing_.law.range();
  if (range > 0.0 && rms_speed > 0.0)
    time_step_ = std::min(time_step_, range / (kStepsAcrossTail * 2.0 * rms_speed));
  const double a = 2.0 * *std::max_element(packing_.grains.radius.begin(), packing_.grains.radius.end());
  if (options.skin) skin_ = *options.skin * a;
  if (skin_ == 0.0) skin_ = 0.1 * a;
}

template <int Dim>
bool Aggregation<Dim>::advance() {
  CellControl<Dim> control;
  control.fixed = true;
  const auto dynamics = make_dynamics(packing_, control, {time_step_, skin_, options_.threads});
  advance_observed(*dynamics, kStretch, Motion::free, observer_, 0.0, time_step_);
  packing_ = {};
  packing_ = dynamics->packing();
  if (!options_.skin) skin_ = dynamics->skin();
  n_clusters_ = count_clusters(packing_);
  return n_clusters_ == 1;
}

template <int Dim>
double Aggregation<Dim>::stretch_time() const {
  return kStretch * time_step_;
}

template int count_clusters(const Packing<2>&);
template int count_clusters(const Packing<3>&);
template class Aggregation<2>;

}  // namespace floc
