#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/relaxation/motion_observer.h"
#include "floc/relaxation/relaxation_options.h"
#include "floc/relaxation/static_solver.h"

namespace floc {

/// Where a relaxation stands, beside the packing itself: all that decides how it goes on.
struct RelaxationProgress {
  enum Stage { moving, finishing };
  int stage = moving;
  std::int64_t n_steps = 0;            ///< time steps of this relaxation so far
  double time = 0.0;                   ///< simulated time of this relaxation so far
  double skin = 0.0;                   ///< of the Verlet list; 0 before the first stretch
  std::vector<double> solid_fraction;  ///< at the end of each recent stretch, the oldest first
  std::vector<double>
      imbalance_sign;             ///< of each axis: sign of stress - target at the start; 0 once it has changed
  std::uint64_t contact_set = 0;  ///< fingerprint of the contact list
  int unchanged_stretches = 0;    ///< stretches since that last changed
  double finishing_since_phi = 0.0;  ///< solid fraction when finishing began
  int finishing_stretches = 0;
  int next_polish = 0;                 ///< stretch of the finish at which the static polisher is tried next
  std::vector<double> force_residual;  ///< at the end of each recent stretch, for the decay rate
};

enum class RelaxationStatus { running, converged, gave_up };

/// How a relaxation ended or where it stands, in numbers and words.
struct RelaxationReport {
  Residuals residuals;
  int n_negative = -1;      ///< negative eigenvalues of an equilibrium's stiffness matrix; -1 before
  std::string ending;       ///< "polished", "dynamic", "static", "diverged"; empty while it runs
  std::string blocking;     ///< criterion that is worst against its tolerance, with its grain
  double decay_rate = 0.0;  ///< of the force residual (1/time); positive when it falls
};

/// Takes a packing to equilibrium under a diagonal stress: by Newton steps where nothing rearranges, else by dynamics
/// until motion has stopped, power control, then Newton steps (see Finish). State to state in stretches of a fixed number of time steps; between two of them packing and
/// progress are the whole truth, so a run that is stopped there and continued gives the same bits.
template <int Dim>
class Relaxer {
 public:
  Relaxer(const RelaxationOptions& options, Packing<Dim> packing, const Vec<Dim>& target_stress,
          RelaxationProgress progress = {});

  /// One stretch. Where the motion diverges, the packing is the one it began with, its springs at rest.
  RelaxationStatus advance();
  /// Shows the packing to somebody as it moves.
  void observe(MotionObserver<Dim> observer) { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const& { return packing_; }
  Packing<Dim> packing() && { return std::move(packing_); }
  const RelaxationProgress& progress() const { return progress_; }
  RelaxationReport report() const;
  /// Static stress of the packing as it is now.
  const Mat<Dim>& stress() const { return stress_; }

 private:
  bool answered_to_load();
  bool density_still();
  bool contacts_still();
  bool vibrates(double energy) const;
  std::size_t stretches_in(double time_units) const;
  RelaxationStatus judge_motion();
  RelaxationStatus judge_finish();
  bool polish();
  bool solved_at_once();
  bool take_if_equilibrium(StaticSolution<Dim> solution, const char* ending);
  void measure();

  RelaxationOptions options_;
  Packing<Dim> packing_;
  Vec<Dim> target_;
  RelaxationProgress progress_;
  Mat<Dim> stress_;  ///< of the packing, like the residuals
  Residuals residuals_;
  int n_negative_ = -1;  ///< of an equilibrium
  std::string ending_;
  double time_step_;
  double time_unit_;  ///< sqrt(a m/F1): T0 of a cohesive scene below P* = 1
  MotionObserver<Dim> observer_;
};

/// Time unit of a packing under a stress: sqrt(a m/F1), m the largest grain's mass. With F1 = F0 this is T0.
template <int Dim>
double inertial_time(const Packing<Dim>& packing, const Vec<Dim>& target_stress);

/// Largest |L'/L| (1/time) the options allow under this stress. Without adhesion and without a cap of
/// its own, that of the inertial number 1e-3; infinite where a cohesive scene names no cap.
template <int Dim>
double strain_rate_cap(const RelaxationOptions& options, const Packing<Dim>& packing,
                       const Vec<Dim>& target_stress);

}  // namespace floc
