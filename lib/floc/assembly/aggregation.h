#pragma once

#include <utility>

#include "floc/packing/packing.h"
#include "floc/relaxation/motion_observer.h"
#include "floc/relaxation/relaxation_options.h"

namespace floc {

/// Returns the number of clusters of a packing. A cluster is a set of grains that are joined by contacts or by
/// attractions across a gap (docs/physics.md, "Assembly and loading"). A grain that interacts with no other grain
/// counts as a cluster.
template <int Dim>
int count_clusters(const Packing<Dim>& packing);

/// Aggregation of a gas of grains: in a fixed cell the moving grains collide and stick together until they form one
/// cluster. An aggregation is the second stage of an assembly of type 2 (docs/physics.md, "Assembly and loading"). Like
/// Relaxer, this class advances in chunks of time steps. If the options ask for soft springs, the springs are soft
/// within each chunk. Between two chunks the packing has its own contact law. Overlaps and elongations stay as the soft
/// springs left them.
template <int Dim>
class Aggregation {
 public:
  /// @param skin  first guess for the skin of the neighbour lists (Verlet lists; length); 0 if there is no guess
  Aggregation(const RelaxationOptions& options, Packing<Dim> packing, double skin);

  /// Advances by one chunk of time steps. If the clusters only drift before the chunk, the time until two clusters meet
  /// is skipped (see ClusterFlight).
  /// @return true when all grains form one cluster
  bool advance();
  /// Sets the observer, a function that is called while the packing moves.
  void set_observer(MotionObserver<Dim> observer) { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const& { return packing_; }
  Packing<Dim> packing() && { return std::move(packing_); }
  int n_clusters() const { return n_clusters_; }
  double skin() const { return skin_; }
  /// Returns the time simulated in the last call of advance() (time): the skipped time plus the duration of the chunk.
  double chunk_time() const;

 private:
  double fly();

  RelaxationOptions options_;
  Packing<Dim> packing_;
  double time_step_ = 0.0;    ///< time step in the last chunk of time steps (time)
  double flight_time_ = 0.0;  ///< time skipped before the last chunk, while the clusters drifted (time)
  double skin_;
  int n_clusters_;
  MotionObserver<Dim> observer_;
};

}  // namespace floc
