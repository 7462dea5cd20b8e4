#pragma once

#include <utility>

#include "floc/packing/packing.h"
#include "floc/relaxation/motion_observer.h"
#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Returns the number of clusters of a packing: sets of grains joined by contacts or by attractions across a
/// gap (docs/physics.md, "Assembly and loading"). A grain without interactions counts as a cluster.
template <int Dim>
int count_clusters(const Packing<Dim>& packing);

/// Aggregation, the second stage of the assembly of type 2: moving grains in a fixed cell collide and stick
/// together until they form one cluster. Like Relaxer, it advances in chunks of time steps.
template <int Dim>
class Aggregation {
 public:
  /// @param skin  first guess of the skin of the Verlet lists of neighbours (length); 0 if there is no guess
  Aggregation(const RelaxationOptions& options, Packing<Dim> packing, double skin);

  /// Advances by one chunk of time steps. Before it, time in which clusters only drift is skipped
  /// (ClusterFlight).
  /// @return true when all grains form one cluster
  bool advance();
  /// Sets the observer that follows the motion of the packing.
  void set_observer(MotionObserver<Dim> observer) { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const& { return packing_; }
  Packing<Dim> packing() && { return std::move(packing_); }
  int n_clusters() const { return n_clusters_; }
  double skin() const { return skin_; }
  /// Returns the simulated time of the last chunk, including the flight of clusters before it (time).
  double chunk_time() const;

 private:
  double fly();

  RelaxationOptions options_;
  Packing<Dim> packing_;
  double time_step_ = 0.0;    ///< time step of the last chunk
  double flight_time_ = 0.0;  ///< duration of the flight of clusters before the last chunk
  double skin_;
  int n_clusters_;
  MotionObserver<Dim> observer_;
};

}  // namespace floc
