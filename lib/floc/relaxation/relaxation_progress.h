#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace floc {

/// The progress of a relaxation, apart from the packing itself: all that decides how it goes on.
struct RelaxationProgress {
  enum Phase { moving, finishing };
  int phase = moving;
  std::int64_t n_steps = 0;            ///< time steps of this relaxation so far
  double time = 0.0;                   ///< simulated time of this relaxation so far
  double skin = 0.0;                   ///< of the Verlet list; 0 before the first chunk
  std::vector<double> solid_fraction;  ///< at the end of each recent chunk, the oldest first
  /// For each axis: sign of stress - target at the start; 0 once it has changed.
  std::vector<double> imbalance_sign;
  std::vector<double> side_before;     ///< of each axis where any is strained (length)
  double offset_before = 0.0;          ///< of the lattice vector that is sheared (length)
  double way_duration = 0.0;           ///< of strained axes to their new length (time)
  std::vector<double> carried_stress;  ///< where an axis is strained: at the end of each recent chunk
  double finishing_since_stress = 0.0;
  std::uint64_t contact_set = 0;     ///< fingerprint of the contact list
  int unchanged_chunks = 0;          ///< chunks since that last changed
  int steady_chunks = 0;             ///< chunks since the density was last unsteady
  double steady_since_phi = 0.0;     ///< solid fraction then
  double finishing_since_phi = 0.0;  ///< solid fraction when finishing began
  int finishing_chunks = 0;
  int liquid_trials = 0;               ///< equilibria given up because their liquid moved
  int next_refinement = 0;             ///< chunk of the finish at which Newton refinement is tried next
  int refused_within = 0;              ///< whether the last attempt at it failed within tolerance
  std::vector<double> force_residual;  ///< at the end of each recent chunk, for the decay rate
};

/// As text (JSON; numbers round-trip), and back. @throws InputError if the text does not hold a progress
std::string as_text(const RelaxationProgress& progress);
RelaxationProgress relaxation_progress(const std::string& text);

}  // namespace floc
