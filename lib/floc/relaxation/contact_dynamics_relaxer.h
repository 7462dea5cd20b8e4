#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floc/relaxation/blocking_criterion.h"
#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/imposed_strain.h"
#include "floc/rigid/contact_dynamics.h"

namespace floc {

/// Progress of the relaxation of rigid grains. Together with the packing it determines how the relaxation continues.
struct ContactDynamicsProgress {
  enum Phase {
    moving,     ///< the grains move under the load
    resting,    ///< all velocities are set to zero before each step
    straining,  ///< the cell is strained at an imposed rate
  };
  int phase = moving;
  std::int64_t n_steps = 0;   ///< number of time steps so far
  std::int64_t n_sweeps = 0;  ///< number of sweeps over all contacts so far
  std::int64_t n_unfinished =
      0;                   ///< number of time steps that ended before their impulses were within tolerance
  double time = 0.0;       ///< simulated time so far (time)
  double time_step = 0.0;  ///< next time step (time); 0 before the first step
  double last_step = 0.0;  ///< last time step (time); 0 before the first step
  double deepest_overlap = 0.0;  ///< deepest overlap so far, over the diameter of the smaller grain
  int calm_steps = 0;            ///< number of time steps since the packing last moved or was out of balance
  int resting_steps = 0;         ///< number of time steps of the phase `resting`
  int next_trial = 0;  ///< number of steps of the phase `resting` at which balanced forces are sought next
  double rest_length = 0.0;  ///< longest time step of the phase `resting` (T)
  int rest_sweeps = 0;       ///< largest number of sweeps in a time step of the phase `resting`
  /// Sides of the cell, and offset of the lattice vector that a shear tilts, before the strain (length).
  std::vector<double> side_before;
  double offset_before = 0.0;
  std::string obstacle;  ///< reason why no balanced forces were found last; empty before the first trial
};

/// Brings a packing of rigid grains to equilibrium under a stress on each axis of its cell or on its walls, and under its
/// weight, in three phases:
/// 1. The grains move under the load (contact_dynamics.h) until, for 40 steps, the root mean square velocity is below
/// 6e-3 d/T and the strain rates of the cell and of the box below 3 % of their cap, with the largest diameter d and the time unit T =
/// sqrt(m/(P d^(Dim-2))).
/// 2. All velocities are set to zero before each step, until the net forces are small. Steps of frictionless grains with
/// corners, and of all grains that sweeps have not brought to rest, are solved at once (rigid/implicit_step.h).
/// 3. With the grains held, forces are sought that balance all grains and the stress and satisfy Coulomb's conditions
/// (rigid/static_forces.h). If there are none, some grain still moves, and phase 2 goes on.
/// Sides of the cell with an imposed length that do not change are held, and the stress on them follows.
///
/// If the load changes a length or shears the cell, the relaxation is a motion instead: the cell is strained at a constant
/// rate (ContactDynamicsOptions::inertial_number), and the packing at the imposed strain is recorded as it moves, with the
/// forces of the time step that begins there (MotionRecord).
template <int Dim>
class ContactDynamicsRelaxer final : public Equilibrator<Dim> {
 public:
  /// @throws InputError if the load imposes no positive stress on any axis
  ContactDynamicsRelaxer(const RelaxationOptions& options, Packing<Dim> packing, const LoadTarget<Dim>& load,
                         const std::string& progress = "");

  RelaxationStatus advance() override;
  void set_observer(MotionObserver<Dim> observer) override { observer_ = std::move(observer); }

  const Packing<Dim>& packing() const override { return packing_; }
  Packing<Dim> release_packing() override { return std::move(packing_); }
  const Mat<Dim>& stress() const override { return stress_; }
  const Vec<Dim>& target_stress() const override { return target_; }
  RelaxationReport report() const override;
  std::string progress() const override;

 private:
  bool solves_at_once() const;
  bool has_plates() const;
  void begin_strain();
  ImposedStrain<Dim> imposed_strain() const;
  bool impose_strain(ContactDynamics<Dim>& motion) const;
  RelaxationStatus strain();
  void record_motion();
  std::string closed_cell() const;
  ContactDynamicsSettings settings() const;
  BoundaryLoad<Dim> boundary_load() const;
  double gap_tolerance() const;
  double boundary_rate(const Packing<Dim>& packing) const;
  double rate_cap(const Packing<Dim>& packing) const;
  bool is_calm(const Packing<Dim>& packing) const;
  void make_steps(int n_steps);
  bool forces_are_nearly_balanced() const;
  double near_balance() const;
  double largest_gap() const;
  bool find_balanced_forces();
  bool stays_in_place(const Packing<Dim>& rested) const;
  void set_balanced_forces(Packing<Dim>& packing) const;
  RelaxationStatus rest();
  void measure();

  RelaxationOptions options_;
  Packing<Dim> packing_;
  LoadTarget<Dim> load_;
  /// Stress imposed on each axis, and the mean of these on axes with an imposed length (force/length^(Dim-1)).
  Vec<Dim> imposed_;
  Vec<Dim> target_;  ///< stress on each axis, imposed or carried (force/length^(Dim-1))
  ContactDynamicsProgress progress_;
  Mat<Dim> stress_;  ///< static stress of the packing (force/length^(Dim-1))
  Residuals residuals_;
  std::string ending_;
  std::optional<MotionRecord> motion_;
  double time_unit_;  ///< T = sqrt(m/(P d^(Dim-2))) (time)
  MotionObserver<Dim> observer_;
};

}  // namespace floc
