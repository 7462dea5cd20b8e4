#pragma once

#include <utility>

#include "floc/packing/packing.h"
#include "floc/relaxation/motion_observer.h"
#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Number of clusters of grains joined by contacts or by distant attractions (docs/physics.md, "Assembly and
/// loading"): connected components of the interactions. A grain without interactions counts as a cluster.
template <int Dim>
int count_clusters(const Packing<Dim>& packing);

/// Aggregation, the second stage of the type 2 assembly: agitated grains in a fixed cell collide and stick
/// until they form one cluster. It advances in chunks of time steps, like Relaxer.
template <int Dim>
class Aggregation {
 public:
  /// @param skin  first guess of the Verlet skin (length), 0 for none
  Aggregation(const RelaxationOptions& options, Packing<Dim> packing, double skin);

  /// Advances by one chunk, after a flight (ClusterFlight) where clusters only drift.
  /// @return true when all grains form one cluster
  bool advance();
  /// Sets the observer of the packing as it moves.
  void set_observer(MotionObserver<Dim> observer) { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const& { return packing_; }
  Packing<Dim> packing() && { return std::move(packing_); }
  int n_clusters() const { return n_clusters_; }
  double skin() const { return skin_; }
  /// Simulated time of the last chunk, flight included (time).
  double chunk_time() const;

 private:
  double fly();

  RelaxationOptions options_;
  Packing<Dim> packing_;
  double time_step_ = 0.0;    ///< time step of the last chunk
  double flight_time_ = 0.0;  ///< time flown before the last chunk
  double skin_;
  int n_clusters_;
  MotionObserver<Dim> observer_;
};

}  // namespace floc
