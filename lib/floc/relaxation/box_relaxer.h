#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/neighbors/spread_liquid.h"
#include "floc/relaxation/blocking_criterion.h"
#include "floc/relaxation/equilibrator.h"

namespace floc {

/// The progress of a compaction, apart from the packing itself: all that decides how it goes on.
struct CompactionProgress {
  enum Phase { moving, finishing };
  int phase = moving;
  std::int64_t n_steps = 0;        ///< time steps of this relaxation so far
  double time = 0.0;               ///< simulated time of this relaxation so far
  double skin = 0.0;               ///< of the Verlet list; 0 before the first chunk
  std::vector<double> start_side;  ///< of the box, when the relaxation began
  std::vector<double> void_ratio;  ///< at the end of each recent chunk, the oldest first
  /// For each axis: sign of pressure - target while its walls move at their given speed; 0 once they bear it.
  std::vector<double> closing_sign;
  bool armed = false;            ///< every wall has borne half of its pressure
  double finishing_since = 0.0;  ///< void ratio when finishing began
  double finishing_time = 0.0;   ///< time when finishing began
};

/// Takes a packing between walls to equilibrium under their pressure: dynamics until the end that the options
/// ask for, then, where the structure that carries the load has no mechanism, power control. A scene that says
/// when to stop, by a time or by the ratio of energies, gets the state that there is then, "stopped", with the
/// number of its mechanisms; any other is given up at RelaxationOptions::max_time. Walls of infinite mass and
/// periodic axes stay as they are.
template <int Dim>
class BoxRelaxer final : public Equilibrator<Dim> {
 public:
  /// @pre the packing has walls and its lattice is rectangular
  /// @throws InputError if a length is imposed on an axis: fixed walls and periodic axes keep their own
  BoxRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
             const std::string& progress = "");
  /// @param target_stress  pressure on the walls of each axis
  BoxRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const Vec<Dim>& target_stress,
             const std::string& progress = "")
      : BoxRelaxer(options, std::move(packing), LoadTarget<Dim>::normal_stress(target_stress), progress) {}

  /// One chunk. A packing that has ceased to be one (walls that ran away, a box that closed) is given
  /// up.
  RelaxationStatus advance() override;
  void set_observer(MotionObserver<Dim> observer) override { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const override { return packing_; }
  Packing<Dim> release_packing() override { return std::move(packing_); }
  const Mat<Dim>& stress() const override { return stress_; }
  const Vec<Dim>& target_stress() const override { return target_; }
  RelaxationReport report() const override;
  std::string progress() const override;

 private:
  bool under_pressure(int axis) const;
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
  Mat<Dim> stress_;  ///< of the packing, like what follows
  Residuals residuals_;
  double energy_ratio_ = 0.0;
  Stability stability_;  ///< of a packing within its tolerances
  Unmet unmet_;          ///< residuals apart
  int n_mechanisms_ = -1, n_bridges_unsettled_ = -1;
  std::string ending_, words_;
  double time_step_;
  double time_unit_;  ///< T
  MotionObserver<Dim> observer_;
};

/// T = sqrt(m/(P a^(Dim-2))) of the largest grain; without pressure inertial_time().
template <int Dim>
double compaction_time(const Packing<Dim>& packing, double pressure);

}  // namespace floc
