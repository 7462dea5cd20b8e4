#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/neighbors/spread_liquid.h"
#include "floc/relaxation/blocking_criterion.h"
#include "floc/relaxation/equilibrator.h"

namespace floc {

/// Progress of the compaction of a packing between walls. The rest of the compaction is determined by the progress and
/// the packing.
struct CompactionProgress {
  enum Phase { moving, finishing };
  int phase = moving;
  std::int64_t n_steps = 0;  ///< number of time steps of this relaxation so far
  double time = 0.0;         ///< simulated time of this relaxation so far (time)
  /// Skin of the Verlet lists, that is, extra distance up to which pairs are listed (length); 0 before the first chunk
  /// of time steps.
  double skin = 0.0;
  std::vector<double> start_side;  ///< sides of the box when the relaxation began (length)
  /// Void ratio at the end of each recent chunk of time steps, the oldest first.
  std::vector<double> void_ratio;
  /// For each axis: sign of (pressure - imposed pressure) while its walls move at the speed given by the scene; 0 once
  /// the pressure of the grains on the walls has reached the imposed pressure.
  std::vector<double> closing_sign;
  /// Whether at some time the pressure of the grains on each wall was at least half of the imposed pressure, so that
  /// the compaction may end.
  bool armed = false;
  /// Void ratio at the beginning of the final phase of the relaxation (power control).
  double finishing_since = 0.0;
  /// Simulated time at the beginning of the final phase of the relaxation (time).
  double finishing_time = 0.0;
};

/// Relaxer of a packing between walls under pressure. The packing moves freely until the criterion of the options
/// (CompactionEnd) is met and the structure that carries the load has no mechanism (motion without stiffness). Power
/// control (all velocities are set to zero whenever the kinetic energy falls) then brings the packing to equilibrium.
/// The options may accept the state at a given time or at a given ratio of energies. If this state is not an
/// equilibrium, it is recorded with the ending "stopped" and the number of its mechanisms. If the options give no such
/// time, the relaxation is given up at RelaxationOptions::max_time. Walls of infinite mass and periodic axes do not
/// move.
template <int Dim>
class BoxRelaxer final : public Equilibrator<Dim> {
 public:
  /// @pre the packing has walls and its lattice is rectangular
  /// @throws InputError if a length is imposed on an axis
  BoxRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
             const std::string& progress = "");
  /// Makes the relaxer of a packing under a pressure on the walls of each axis.
  /// @param target_stress  pressure on the walls of each axis (force/length^(Dim-1))
  BoxRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const Vec<Dim>& target_stress,
             const std::string& progress = "")
      : BoxRelaxer(options, std::move(packing), LoadTarget<Dim>::normal_stress(target_stress), progress) {}

  /// Advances the relaxation by one chunk of time steps. The relaxation is given up if the motion diverges, a wall
  /// moves far away from the grains, a grain passes a wall or the box closes.
  RelaxationStatus advance() override;
  void set_observer(MotionObserver<Dim> observer) override { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const override { return packing_; }
  Packing<Dim> release_packing() override { return std::move(packing_); }
  const Mat<Dim>& stress() const override { return stress_; }
  const Vec<Dim>& target_stress() const override { return target_; }
  RelaxationReport report() const override;
  std::string progress() const override;

 private:
  BoundaryControl<Dim> control();
  void measure();
  std::string lost() const;
  RelaxationStatus give_up(const char* ending, std::string words);
  bool is_armed();
  bool void_ratio_is_steady();
  bool has_ended();
  RelaxationStatus check_motion();
  RelaxationStatus check_finish();
  RelaxationStatus stop_here();
  bool may_stop() const;
  LiquidChange share_liquid_once_more();

  RelaxationOptions options_;
  Packing<Dim> packing_;
  Vec<Dim> target_;
  CompactionProgress progress_;
  Mat<Dim> stress_;  ///< static stress of the packing (force/length^(Dim-1))
  Residuals residuals_;
  double energy_ratio_ = 0.0;
  Stability stability_;  ///< stability of the packing, determined once the residuals are within tolerance
  Unmet unmet_;  ///< first criterion of equilibrium that is not met, apart from the tolerances of the residuals
  int n_mechanisms_ = -1, n_bridges_unsettled_ = -1;
  std::string ending_, words_;
  double time_step_;
  double time_unit_;  ///< time unit T of the compaction, from compaction_time() (time)
  MotionObserver<Dim> observer_;
};

/// Returns the time unit of a compaction (time), T = sqrt(m/(P a^(Dim-2))), with the mass m and the diameter a of the
/// largest grain and the pressure P. If the pressure is zero, returns inertial_time().
template <int Dim>
double compaction_time(const Packing<Dim>& packing, double pressure);

}  // namespace floc
