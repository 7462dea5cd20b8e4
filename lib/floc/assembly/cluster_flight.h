#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Clusters that do not interact have no effect on each other until they meet. Once nothing moves inside them,
/// the time until then can be skipped: each flies on as a rigid body, tumbling in 3D.
template <int Dim>
class ClusterFlight {
 public:
  /// Finds the clusters of a packing (count_clusters()) and how each moves: with its momentum and, unless it
  /// winds around the periodic cell, its angular momentum.
  explicit ClusterFlight(const Packing<Dim>& packing);

  /// Mean kinetic energy per grain of the motions inside clusters (energy).
  double inner_energy() const { return inner_energy_; }

  /// Lets the clusters fly until surfaces of two of them are within `nearest` of each other (length), or
  /// `longest` has passed (time). Positions are left where they arrive, inside the cell or not. The cell does
  /// not move.
  /// @return time flown
  double fly(Packing<Dim>& packing, double nearest, double longest) const;

 private:
  struct Cluster {
    Vec<Dim> centre = Vec<Dim>::Zero();  ///< of mass
    Vec<Dim> velocity = Vec<Dim>::Zero();
    double mass = 0.0;
    RotationVector<Dim> spin = RotationVector<Dim>::Zero();
    Mat<kRotations<Dim>> inertia = Mat<kRotations<Dim>>::Zero();  ///< about the centre
    double fastest_spin = 0.0;                                    ///< that it ever has in free flight
    double reach = 0.0;                                           ///< distance of its farthest grain's centre
    bool winds = false;                                           ///< around the cell
  };

  void unwrap(const Packing<Dim>& packing);
  void find_motions(const Packing<Dim>& packing);
  double time_to_meet(const Packing<Dim>& packing, double nearest) const;

  std::vector<int> cluster_of_;  ///< of each grain
  std::vector<Vec<Dim>> place_;  ///< of each grain among those of its cluster, unwrapped from the cell
  std::vector<Cluster> clusters_;
  double inner_energy_ = 0.0;
};

}  // namespace floc
