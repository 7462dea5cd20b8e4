#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace floc {

/// Progress of the relaxation of a periodic packing. The rest of the relaxation is determined by the progress and the
/// packing.
struct RelaxationProgress {
  enum Phase { moving, finishing };
  int phase = moving;
  std::int64_t n_steps = 0;  ///< number of time steps of this relaxation so far
  double time = 0.0;         ///< simulated time of this relaxation so far (time)
  /// Skin of the Verlet lists, that is, extra distance up to which pairs are listed (length); 0 before the first chunk
  /// of time steps.
  double skin = 0.0;
  /// Solid fraction at the end of each recent chunk of time steps, the oldest first.
  std::vector<double> solid_fraction;
  /// For each axis: sign of the difference (stress - target stress) at the start of the relaxation; 0 once this sign
  /// has changed.
  std::vector<double> imbalance_sign;
  /// Length of each axis of the cell before the strain ramp, in which the axes change smoothly to their imposed lengths
  /// (length); empty if no axis has an imposed length.
  std::vector<double> side_before;
  /// Offset of the sheared lattice vector (its component along the first axis) before the strain ramp (length).
  double offset_before = 0.0;
  double ramp_duration = 0.0;  ///< duration of the strain ramp, the change to the imposed lengths (time)
  /// Mean stress on the axes with an imposed length at the end of each recent chunk of time steps
  /// (force/length^(Dim-1)).
  std::vector<double> carried_stress;
  double finishing_since_stress = 0.0;
  std::uint64_t contact_set = 0;  ///< fingerprint (hash) of the set of pairs of grains that touch
  int unchanged_chunks = 0;       ///< number of chunks of time steps since contact_set last changed
  int steady_chunks = 0;          ///< number of chunks of time steps since the density was last found unsteady
  double steady_since_phi = 0.0;  ///< solid fraction when the density was last found unsteady
  /// Solid fraction at the beginning of the final phase of the relaxation (power control and Newton steps).
  double finishing_since_phi = 0.0;
  int finishing_chunks = 0;
  int liquid_trials = 0;  ///< number of equilibria that were rejected because liquid would still move
  /// Number of chunks of time steps in the final phase of the relaxation after which Newton refinement is tried again.
  int next_refinement = 0;
  /// 1 if the last attempt at Newton refinement failed although the residuals were within tolerance, otherwise 0.
  int refused_within = 0;
  /// Force residual at the end of each recent chunk of time steps. The decay rate of the residual is computed from
  /// these values.
  std::vector<double> force_residual;
};

/// Returns the progress of a relaxation as text: JSON, whose numbers can be read back without loss.
std::string as_text(const RelaxationProgress& progress);
/// Reads the progress of a relaxation from a text that as_text() made.
/// @throws InputError if the text does not contain the progress of a relaxation
RelaxationProgress relaxation_progress(const std::string& text);

}  // namespace floc
