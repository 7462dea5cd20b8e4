#pragma once

namespace floc {

/// Record of a packing in motion: the time step of contact dynamics that begins at the recorded packing. The contacts
/// of the packing have the forces of this step. With these forces, the velocities at the end of the step satisfy
/// Signorini's and Coulomb's conditions.
struct MotionRecord {
  double time_step = 0.0;  ///< length of the step (time)
  /// Longest time step of the motion (time). Overlaps are removed over a time that depends on it
  /// (shortest_removal()).
  double longest_step = 0.0;
  double cell_mass = 0.0;  ///< inertia of the sides of the cell divided by the mass of all grains
  double restitution = 0.0;
  double slow_impact = 0.0;      ///< rate of approach below which impacts are inelastic (length/time)
  double sweep_tolerance = 0.0;  ///< largest accepted error of the impulses, divided by the mean normal impulse
  double residual = 0.0;  ///< error of the impulses at the end of the step, divided by the mean normal impulse
  /// Imposed strain rate times sqrt(m/(P a^(Dim-2))), with the mass m and the diameter a of the largest grain and the
  /// mean P of the imposed stresses.
  double inertial_number = 0.0;

  bool operator==(const MotionRecord&) const = default;
};

}  // namespace floc
