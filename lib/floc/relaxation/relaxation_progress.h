#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace floc {

/// Progress of a relaxation. Together with the packing it determines how the relaxation continues.
struct RelaxationProgress {
  enum Phase { moving, finishing };
  int phase = moving;
  std::int64_t n_steps = 0;            ///< time steps of this relaxation so far
  double time = 0.0;                   ///< simulated time of this relaxation so far
  double skin = 0.0;                   ///< skin of the Verlet list (length); 0 before the first chunk
  std::vector<double> solid_fraction;  ///< solid fraction at the end of each recent chunk, the oldest first
  /// For each axis: sign of stress - target at the start; 0 once it has changed.
  std::vector<double> imbalance_sign;
  std::vector<double> side_before;     ///< length of each axis before the ramp, where any is strained (length)
  double offset_before = 0.0;          ///< offset of the sheared lattice vector before the ramp (length)
  double ramp_duration = 0.0;          ///< duration of the strain ramp (time)
  std::vector<double> carried_stress;  ///< stress at the end of each recent chunk, where an axis is strained
  double finishing_since_stress = 0.0;
  std::uint64_t contact_set = 0;     ///< fingerprint of the contact list
  int unchanged_chunks = 0;          ///< chunks since contact_set last changed
  int steady_chunks = 0;             ///< chunks since the density was last unsteady
  double steady_since_phi = 0.0;     ///< solid fraction at that time
  double finishing_since_phi = 0.0;  ///< solid fraction when finishing began
  int finishing_chunks = 0;
  int liquid_trials = 0;    ///< equilibria given up because their liquid moved
  int next_refinement = 0;  ///< chunk of the finish at which Newton refinement is tried next
  int refused_within = 0;   ///< 1 if the last attempt failed while the residuals were within tolerance
  std::vector<double> force_residual;  ///< force residual at the end of each recent chunk, for the decay rate
};

/// Writes a progress as text (JSON; numbers round-trip), and reads it back.
/// @throws InputError if the text does not hold a progress
std::string as_text(const RelaxationProgress& progress);
RelaxationProgress relaxation_progress(const std::string& text);

}  // namespace floc
