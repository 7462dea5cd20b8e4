#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "floc/elasticity/stability.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/relaxation/blocking_criterion.h"
#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/relaxation_progress.h"
#include "floc/relaxation/static_solver.h"

namespace floc {

/// Reason why a relaxation ended whose motion diverged.
inline constexpr const char* kMotionDiverged =
    "the motion diverged because the time step (run.time_step, or time_step of this part of the run) is too "
    "large";

/// Brings a periodic packing to equilibrium under a stress or a length imposed on each axis of its cell.
/// RelaxationOptions::finish selects among these methods:
/// 1. Newton steps alone, if the packing does not rearrange under the load.
/// 2. Otherwise time integration of the motion (dynamics) until the motion has stopped; then power control, which sets
/// all velocities to zero whenever the kinetic energy falls, and Newton steps.
///
/// The relaxer advances in chunks of a fixed number of time steps. If a run is stopped between two chunks and continued
/// later, the results are identical.
template <int Dim>
class Relaxer final : public Equilibrator<Dim> {
 public:
  Relaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
          RelaxationProgress progress = {});
  /// Makes the relaxer of a packing under a stress imposed on each axis.
  /// @param target_stress  stress on each axis, compression positive (force/length^(Dim-1))
  Relaxer(const RelaxationOptions& options, Packing<Dim> packing, const Vec<Dim>& target_stress,
          RelaxationProgress progress = {})
      : Relaxer(options, std::move(packing), LoadTarget<Dim>::normal_stress(target_stress),
                std::move(progress)) {}

  /// Advances the relaxation by one chunk of time steps. If the motion diverges, the packing is reset to its state at
  /// the beginning of the chunk, with unloaded springs.
  RelaxationStatus advance() override;
  /// Whether motion has stopped, so that the relaxation is in its final phase (power control and Newton steps).
  bool has_stopped() const { return progress_.phase == RelaxationProgress::finishing; }
  void set_observer(MotionObserver<Dim> observer) override { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const override { return packing_; }
  Packing<Dim> release_packing() override { return std::move(packing_); }
  const Mat<Dim>& stress() const override { return stress_; }
  const Vec<Dim>& target_stress() const override { return target_; }
  RelaxationReport report() const override;
  std::string progress() const override { return as_text(progress_); }

 private:
  StrainRamp<Dim> strain_ramp() const;
  void begin_strain_ramp();
  void begin_response();
  bool carries_no_stress() const;
  double mean_carried_stress() const;
  std::string overfilled_cell_error() const;
  bool responded_to_load();
  bool density_is_steady();
  bool carried_stress_is_steady(std::size_t window);
  double stress_scale() const;
  bool contacts_are_steady();
  bool vibrates(double energy) const;
  bool only_mechanisms_move(bool steady_density);
  std::size_t chunks_in(double time_units) const;
  RelaxationStatus check_motion();
  RelaxationStatus check_finish();
  bool newton_is_cheaper() const;
  bool may_repeat_refinement() const;
  bool refine_by_newton();
  StaticSolution<Dim> solve_from(const Packing<Dim>& start, const StrainRamp<Dim>& ramp,
                                 const StaticSolverOptions& options) const;
  bool solve_without_motion();
  bool accept_if_equilibrium(StaticSolution<Dim> solution, const char* ending, bool go_on);
  bool liquid_rests(const Packing<Dim>& equilibrium, bool go_on);
  Unmet unsteadiness(bool responded) const;
  bool is_stable(const Packing<Dim>& packing, Stability& found);
  void measure();

  RelaxationOptions options_;
  Packing<Dim> packing_;
  LoadTarget<Dim> load_;
  /// stress on each axis: the imposed stress or, for an imposed length, the stress in the packing
  Vec<Dim> target_;
  RelaxationProgress progress_;
  Mat<Dim> stress_;  ///< static stress of the packing (force/length^(Dim-1))
  Residuals residuals_;
  Stability stability_;           ///< stability of the equilibrium that was found
  int n_bridges_unsettled_ = -1;  ///< value of RelaxationReport::n_bridges_unsettled
  /// First criterion of equilibrium (other than the residuals) that was not met at the end of the last chunk of time
  /// steps.
  Unmet unmet_;
  std::string ending_;
  double time_step_;
  /// Time unit sqrt(a m/F1) (time), with a the largest diameter, m the largest mass and F1 the larger of the pull-off
  /// force F0 and P a^(D-1), where P is the pressure and D the dimension.
  double time_unit_;
  MotionObserver<Dim> observer_;
};

/// Returns the time unit of a packing under a stress (time): sqrt(a m/F1), with a the largest diameter, m the mass of
/// the largest grain and F1 the force scale (force_scale()). With adhesion at low pressure, F1 is the pull-off force
/// F0, and the time unit is T0 = sqrt(a m/F0).
template <int Dim>
double inertial_time(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Returns the largest strain rate |L'/L| that the options allow for a side L of the cell under this stress (1/time).
/// If the options set no cap, the result is infinite for packings with adhesion, and 1e-3 times sqrt(P a^(D-2)/m) for
/// packings without adhesion. Here P is the mean stress, a the largest diameter, m the largest mass and D the
/// dimension.
template <int Dim>
double strain_rate_cap(const RelaxationOptions& options, const Packing<Dim>& packing,
                       const Vec<Dim>& target_stress);

}  // namespace floc
