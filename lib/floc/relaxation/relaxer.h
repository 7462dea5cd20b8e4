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

/// Takes a packing to equilibrium under stresses or lengths of its axes: by Newton steps where nothing
/// rearranges, else by dynamics until motion has stopped, power control, then Newton steps (see Finish). It
/// goes from state to state in chunks of a fixed number of time steps: a run that is stopped between two of
/// them and continued gives the same bits.
template <int Dim>
class Relaxer final : public Equilibrator<Dim> {
 public:
  Relaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
          RelaxationProgress progress = {});
  /// @param target_stress  stress on each axis, compression positive
  Relaxer(const RelaxationOptions& options, Packing<Dim> packing, const Vec<Dim>& target_stress,
          RelaxationProgress progress = {})
      : Relaxer(options, std::move(packing), LoadTarget<Dim>::normal_stress(target_stress),
                std::move(progress)) {}

  /// One chunk. If the motion diverges, the packing is the one the chunk began with, its springs at rest.
  RelaxationStatus advance() override;
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
  Vec<Dim> target_;  ///< stress imposed; where a length is, the stress carried
  RelaxationProgress progress_;
  Mat<Dim> stress_;  ///< of the packing, like the residuals
  Residuals residuals_;
  Stability stability_;           ///< of an equilibrium
  int n_bridges_unsettled_ = -1;  ///< likewise, of liquid
  Unmet unmet_;                   ///< at the end of the last chunk, residuals apart
  std::string ending_;
  double time_step_;
  double time_unit_;  ///< sqrt(a m/F1): T0 of a cohesive scene below P* = 1
  MotionObserver<Dim> observer_;
};

/// Time unit of a packing under a stress: sqrt(a m/F1), m the largest grain's mass. With F1 = F0 this is T0.
template <int Dim>
double inertial_time(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Largest |L'/L| (1/time) that the options allow under this stress. Without adhesion and without a cap of its
/// own, that of the inertial number 1e-3; infinite where a cohesive scene names no cap.
template <int Dim>
double strain_rate_cap(const RelaxationOptions& options, const Packing<Dim>& packing,
                       const Vec<Dim>& target_stress);

}  // namespace floc
