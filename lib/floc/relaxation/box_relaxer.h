#pragma once

#include <string>
#include <utility>
#include <vector>

#include "floc/neighbors/spread_liquid.h"
#include "floc/relaxation/blocking_criterion.h"
#include "floc/relaxation/equilibrator.h"

namespace floc {

/// Progress of a compaction. Together with the packing it determines how the compaction continues.
struct CompactionProgress {
  enum Phase { moving, finishing };
  int phase = moving;
  std::int64_t n_steps = 0;        ///< time steps of this relaxation so far
  double time = 0.0;               ///< simulated time of this relaxation so far
  double skin = 0.0;               ///< skin of the Verlet list (length); 0 before the first chunk
  std::vector<double> start_side;  ///< sides of the box when the relaxation began (length)
  std::vector<double> void_ratio;  ///< void ratio at the end of each recent chunk, the oldest first
  /// For each axis: sign of pressure - target while its walls move at their given speed; 0 once they bear it.
  std::vector<double> closing_sign;
  bool armed = false;            ///< every wall has borne half of its pressure
  double finishing_since = 0.0;  ///< void ratio when finishing began
  double finishing_time = 0.0;   ///< time when finishing began
};

/// Relaxer of a packing between walls under pressure. The packing moves freely until the criterion of the
/// options (CompactionEnd) is met and the structure that carries the load has no mechanism; power control then
/// takes it to equilibrium. If the options end the compaction at a given time or ratio of energies, the state
/// at that point is recorded as "stopped", with the number of its mechanisms. Otherwise the relaxation is given
/// up at RelaxationOptions::max_time. Walls of infinite mass and periodic axes do not move.
template <int Dim>
class BoxRelaxer final : public Equilibrator<Dim> {
 public:
  /// @pre the packing has walls and its lattice is rectangular
  /// @throws InputError if a length is imposed on an axis
  BoxRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
             const std::string& progress = "");
  /// @param target_stress  pressure on the walls of each axis
  BoxRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const Vec<Dim>& target_stress,
             const std::string& progress = "")
      : BoxRelaxer(options, std::move(packing), LoadTarget<Dim>::normal_stress(target_stress), progress) {}

  /// Advances by one chunk. The relaxation is given up if a wall loses contact with the packing, a grain passes
  /// a wall or the box closes.
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
  Mat<Dim> stress_;  ///< static stress of the packing
  Residuals residuals_;
  double energy_ratio_ = 0.0;
  Stability stability_;  ///< determined once the residuals are within tolerance
  Unmet unmet_;          ///< first unmet criterion besides the residuals
  int n_mechanisms_ = -1, n_bridges_unsettled_ = -1;
  std::string ending_, words_;
  double time_step_;
  double time_unit_;  ///< T
  MotionObserver<Dim> observer_;
};

/// Time unit of a compaction, T = sqrt(m/(P a^(Dim-2))) with m and a of the largest grain (time);
/// inertial_time() where the pressure is zero.
template <int Dim>
double compaction_time(const Packing<Dim>& packing, double pressure);

}  // namespace floc
