#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Free flight of clusters. A cluster is a set of grains that touch or attract each other. Until two clusters meet, no
/// force acts between them. If the grains of each cluster no longer move relative to each other, each cluster moves as
/// a rigid body (in 3D it tumbles), and the time until the next meeting of two clusters can be skipped.
template <int Dim>
class ClusterFlight {
 public:
  /// Finds the clusters of a packing (see count_clusters()) and the rigid motion of each cluster. The momentum of a
  /// cluster gives its velocity, and the angular momentum gives its spin. A cluster that touches its own periodic image
  /// gets no spin.
  explicit ClusterFlight(const Packing<Dim>& packing);

  /// Returns the kinetic energy of the motion inside the clusters, divided by the number of grains (energy). The motion
  /// inside a cluster is the motion of its grains relative to the rigid motion of the cluster.
  double inner_energy() const { return inner_energy_; }

  /// Moves all clusters as rigid bodies until the surfaces of two clusters are within the distance `nearest` of each
  /// other, or until the time `longest` has passed. The cell does not move; grains may be outside the cell afterwards.
  /// @param nearest  distance between two surfaces at which the flight ends (length)
  /// @param longest  longest duration of the flight (time)
  /// @return duration of the flight (time)
  double fly(Packing<Dim>& packing, double nearest, double longest) const;

 private:
  struct Cluster {
    Vec<Dim> centre = Vec<Dim>::Zero();  ///< centre of mass of the cluster (length)
    Vec<Dim> velocity = Vec<Dim>::Zero();
    double mass = 0.0;
    RotationVector<Dim> spin = RotationVector<Dim>::Zero();
    /// moment of inertia about the centre of mass
    Mat<kRotations<Dim>> inertia = Mat<kRotations<Dim>>::Zero();
    /// Upper bound on the spin of the cluster at any time of its flight (in 3D the spin changes).
    double fastest_spin = 0.0;
    double reach = 0.0;  ///< largest distance from the centre of mass to the centre of a grain (length)
    bool winds = false;  ///< whether contacts connect the cluster to its own periodic image
  };

  void unwrap(const Packing<Dim>& packing);
  void find_motions(const Packing<Dim>& packing);
  double time_to_meet(const Packing<Dim>& packing, double nearest) const;

  std::vector<int> cluster_of_;  ///< for each grain, the index of its cluster
  /// Position of the chosen periodic image of each grain (length). With these positions, the grains of each cluster
  /// form one connected body, and some grains may be outside the cell.
  std::vector<Vec<Dim>> place_;
  std::vector<Cluster> clusters_;
  double inner_energy_ = 0.0;
};

}  // namespace floc
