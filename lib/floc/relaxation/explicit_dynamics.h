#pragma once

#include <optional>

#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/force_sweep.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
#include "floc/relaxation/liquid_bridges.h"
#include "floc/relaxation/neighbor_lists.h"
#include "floc/relaxation/thread_team.h"

namespace floc {

/// Velocity Verlet steps of a packing (Dynamics). A step kicks and drifts the boundary (CellMotion) and the grains,
/// finds the pairs anew where bodies have moved too far (NeighborLists), computes the forces and kicks the grains again
/// (ForceSweep), and ends with the second kick of the boundary. The code that visits every grain or pair is in
/// kernels/, compiled for each kernel law and instruction set.
template <int Dim>
class ExplicitDynamics final : public Dynamics<Dim> {
 public:
  /// @param packing  its contacts are moved into this object
  ExplicitDynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                   const DynamicsSettings& settings);

  void advance(int n_steps, Motion motion) override;
  bool finite() const override;
  Packing<Dim> packing() const override;
  Packing<Dim> release_packing() override;
  double skin() const override;

 private:
  /// Does one thread's part of a time step.
  /// @param from, to  stage of the rotation of the grains before and after the step
  void step(int thread, Barrier& barrier, Motion motion, Rotation from, Rotation to);
  void begin_step();
  void end_step(Motion motion);
  void stop_if_slowing();
  /// Measures the motion of the grains of a thread since the lists were built.
  void measure_motion(int thread);
  void refresh_forces();

  void renew_stale_lists();
  /// @param further  contacts of each interaction beside the first contact of their pair
  void build_lists(const PairLists<Dim>& further);
  void share_liquid();
  /// Gap across which grains interact (length).
  double range() const { return interactions_.between_grains().range(); }

  Law law_, wall_law_;
  double dt_;
  GrainArrays<Dim> grains_;
  CellMotion<Dim> cell_;
  Interactions<Dim> interactions_;
  NeighborLists<Dim> lists_;
  std::optional<LiquidBridges<Dim>> liquid_;  ///< present where the law has liquid
  ForceSweep<Dim> sweep_;
  GrainStep<Dim> step_{};
  double twice_kinetic_ = 0.0;  ///< energy of grains and boundary after the last step under power control
};

}  // namespace floc
