#pragma once

#include <optional>

#include "floc/base/thread_team.h"
#include "floc/relaxation/cell_motion.h"
#include "floc/relaxation/dynamics.h"
#include "floc/relaxation/force_sweep.h"
#include "floc/relaxation/grain_arrays.h"
#include "floc/relaxation/interactions.h"
#include "floc/relaxation/liquid_bridges.h"
#include "floc/relaxation/neighbor_lists.h"

namespace floc {

/// Time integration of a packing by velocity Verlet steps (class Dynamics). A step has four parts. The boundary
/// (CellMotion) and the grains are kicked (accelerated over half a step) and moved. New lists of pairs are built if
/// bodies have moved too far (NeighborLists). The forces are computed, and the grains are kicked again (ForceSweep).
/// The boundary is kicked again. The loops over grains and pairs are in the folder kernels/ and are compiled for each
/// contact law and instruction set.
template <int Dim>
class ExplicitDynamics final : public Dynamics<Dim> {
 public:
  /// @param packing  initial packing, whose contacts are moved into this object
  ExplicitDynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                   const DynamicsSettings& settings);

  void advance(int n_steps, Motion motion) override;
  bool finite() const override;
  Packing<Dim> packing() const override;
  Packing<Dim> release_packing() override;
  double skin() const override;

 private:
  /// Makes the part of a time step that is assigned to one thread.
  /// @param from, to  stages of the time integration (enum Rotation) that the rotation of the grains has reached before
  /// and after the step
  void step(int thread, Barrier& barrier, Motion motion, Rotation from, Rotation to);
  void begin_step();
  void end_step(Motion motion);
  void stop_if_slowing();
  /// Changes the velocities of the grains of one thread by gravity during half a time step.
  void fall(int thread);
  bool has_gravity() const { return !gravity_.isZero(0.0); }
  double twice_kinetic_energy_of_grains() const;
  /// Measures how far the grains of one thread have moved since the neighbour lists were built.
  void measure_motion(int thread);
  void refresh_forces();

  void renew_stale_lists();
  /// Builds new lists of pairs.
  /// @param further  for each interaction, the second and later contacts of all bodies with several contacts between
  /// them
  void build_lists(const PairLists<Dim>& further);
  void share_liquid();
  /// Returns the largest gap across which grains interact (length).
  double range() const { return interactions_.between_grains().range(); }

  Law law_, wall_law_;
  Vec<Dim> gravity_;  ///< acceleration due to gravity (length/time^2)
  double dt_;
  GrainArrays<Dim> grains_;
  CellMotion<Dim> cell_;
  Interactions<Dim> interactions_;
  NeighborLists<Dim> lists_;
  std::optional<LiquidBridges<Dim>> liquid_;  ///< liquid bridges; set if the contact law has liquid
  ForceSweep<Dim> sweep_;
  GrainStep<Dim> step_{};
  /// Twice the kinetic energy of grains and boundary after the last step under power control (energy).
  double twice_kinetic_ = 0.0;
};

}  // namespace floc
