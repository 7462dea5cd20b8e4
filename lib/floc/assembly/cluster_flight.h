#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Flight of clusters that do not interact, as rigid bodies (tumbling in 3D). Clusters have no effect on each
/// other until they meet. Once the motion inside each cluster has died out, the time until the next meeting can
/// be skipped.
template <int Dim>
class ClusterFlight {
 public:
  /// Finds the clusters of a packing (count_clusters()) and the motion of each: it follows from the momentum of
  /// the cluster and, unless it winds around the periodic cell, its angular momentum.
  explicit ClusterFlight(const Packing<Dim>& packing);

  /// Mean kinetic energy per grain of the motions inside clusters (energy).
  double inner_energy() const { return inner_energy_; }

  /// Moves the clusters until the surfaces of two of them are within `nearest` of each other (length), or
  /// `longest` has passed (time). Positions are not wrapped into the cell, which does not move.
  /// @return time flown
  double fly(Packing<Dim>& packing, double nearest, double longest) const;

 private:
  struct Cluster {
    Vec<Dim> centre = Vec<Dim>::Zero();  ///< centre of mass
    Vec<Dim> velocity = Vec<Dim>::Zero();
    double mass = 0.0;
    RotationVector<Dim> spin = RotationVector<Dim>::Zero();
    Mat<kRotations<Dim>> inertia = Mat<kRotations<Dim>>::Zero();  ///< about the centre
    double fastest_spin = 0.0;                                    ///< upper bound of the spin in free flight
    double reach = 0.0;  ///< largest distance of a grain's centre from `centre`
    bool winds = false;  ///< whether the cluster winds around the cell
  };

  void unwrap(const Packing<Dim>& packing);
  void find_motions(const Packing<Dim>& packing);
  double time_to_meet(const Packing<Dim>& packing, double nearest) const;

  std::vector<int> cluster_of_;  ///< cluster of each grain
  std::vector<Vec<Dim>> place_;  ///< centre of each grain in its cluster, unwrapped from the cell (length)
  std::vector<Cluster> clusters_;
  double inner_energy_ = 0.0;
};

}  // namespace floc
