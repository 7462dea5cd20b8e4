#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Free flight of clusters of grains that do not interact, as rigid bodies (tumbling in 3D). Clusters have no
/// effect on each other until they meet. Once the motion inside each cluster has died out, the time until the
/// next meeting can be skipped.
template <int Dim>
class ClusterFlight {
 public:
  /// Finds the clusters of a packing (count_clusters()) and the rigid motion of each cluster. The motion
  /// follows from the momentum of the cluster and, unless the cluster winds around the periodic cell, from its
  /// angular momentum.
  explicit ClusterFlight(const Packing<Dim>& packing);

  /// Returns the kinetic energy of the motions inside clusters, averaged over all grains (energy).
  double inner_energy() const { return inner_energy_; }

  /// Moves the clusters until the surfaces of two clusters are within a distance `nearest` of each other
  /// (length), or the time `longest` has passed. Positions are not wrapped into the cell, which does not move.
  /// @return duration of the flight
  double fly(Packing<Dim>& packing, double nearest, double longest) const;

 private:
  struct Cluster {
    Vec<Dim> centre = Vec<Dim>::Zero();  ///< centre of mass
    Vec<Dim> velocity = Vec<Dim>::Zero();
    double mass = 0.0;
    RotationVector<Dim> spin = RotationVector<Dim>::Zero();
    Mat<kRotations<Dim>> inertia = Mat<kRotations<Dim>>::Zero();  ///< moment of inertia about `centre`
    /// Upper bound of the magnitude of the spin in free flight.
    double fastest_spin = 0.0;
    double reach = 0.0;  ///< largest distance of the centre of a grain from `centre`
    bool winds = false;  ///< whether the cluster is connected to itself across the periodic cell
  };

  void unwrap(const Packing<Dim>& packing);
  void find_motions(const Packing<Dim>& packing);
  double time_to_meet(const Packing<Dim>& packing, double nearest) const;

  std::vector<int> cluster_of_;  ///< index of the cluster of each grain
  /// Position of the centre of each grain in its connected cluster, not wrapped into the cell (length).
  std::vector<Vec<Dim>> place_;
  std::vector<Cluster> clusters_;
  double inner_energy_ = 0.0;
};

}  // namespace floc
