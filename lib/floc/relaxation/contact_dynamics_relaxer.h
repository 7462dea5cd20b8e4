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

/// Progress of the relaxation of rigid grains. The rest of the relaxation is determined by the progress and the
/// packing.
struct ContactDynamicsProgress {
  enum Phase {
    moving,     ///< the grains move under the load
    resting,    ///< all velocities are set to zero before each step
    straining,  ///< the cell is strained at an imposed rate
  };
  int phase = moving;
  std::int64_t n_steps = 0;   ///< number of time steps so far
  std::int64_t n_sweeps = 0;  ///< number of sweeps over all contacts so far
  /// number of time steps whose sweeps ended before the impulses were within tolerance
  std::int64_t n_unfinished = 0;
  double time = 0.0;             ///< simulated time so far (time)
  double time_step = 0.0;        ///< next time step (time); 0 before the first step
  double last_step = 0.0;        ///< last time step (time); 0 before the first step
  double deepest_overlap = 0.0;  ///< deepest overlap so far, divided by the diameter of the smaller grain
  /// number of successive calm time steps up to the present (kCalmSteps); negative if more calm steps than usual are
  /// required
  int calm_steps = 0;
  int resting_steps = 0;  ///< number of time steps of the phase `resting`
  int next_trial = 0;     ///< value of resting_steps before which balanced forces are not sought again
  int n_rests = 0;        ///< number of times that elastic grains have begun the phase `resting`
  /// smallest residual of elastic grains in the phase `resting`, in units of the force scale; 0 before the first test
  double least_residual = 0.0;
  int least_at = 0;  ///< number of steps of the phase `resting` after which least_residual was found
  /// largest residual of elastic grains before the last trial of balance_springs() in the phase `resting`; 0 before the
  /// first trial
  double tried_residual = 0.0;
  double rest_length = 0.0;  ///< longest time step of the phase `resting`, in units of T
  /// Sides of the cell before the strain (length).
  std::vector<double> side_before;
  double offset_before = 0.0;
  std::string obstacle;  ///< reason why the last search found no balanced forces; empty before the first search
};

/// Brings a packing of rigid grains, or of elastic grains with corners, to equilibrium under its weight and under
/// stresses imposed on the axes of its cell or on its walls. There are three phases:
/// 1. The grains move under the load (contact_dynamics.h) until 40 successive steps have been calm. In a calm step, the
/// root mean square velocity is below 6e-3 d/T, and the strain rate of the cell or box is below 3 % of its cap. Here d
/// is the largest diameter and T = sqrt(m/(P d^(Dim-2))) the time unit.
/// 2. All velocities are set to zero before each step, until the net forces are small. The contacts of frictionless
/// polygons are solved all at once in each step (rigid/implicit_step.h). So are the contacts of other packings if
/// sweeps have not brought the grains to rest. Frictionless polyhedra make no steps in this phase: they are moved to a
/// minimum of the volume (rigid/least_volume.h).
/// 3. Without motion of the grains, forces are sought that satisfy Coulomb's conditions and balance all grains and the
/// imposed stress (rigid/static_forces.h). If there are no such forces, some grain still moves: phase 1 begins anew or, if
/// the contacts are solved all at once, phase 2 continues. Phase 1 also begins anew if the equilibrium is unstable.
///
/// Sides of the cell with an imposed length do not move during these phases. The stress on these sides results from the
/// forces.
///
/// Elastic grains with corners go through the first two phases in the same way, with the springs of their contacts
/// (rigid/elastic_contacts.h). In phase 2 all contacts of a step are solved at once. Near the balance, Newton iterations
/// with the whole tangent matrix are tried (balance_springs()). The relaxation ends when the forces of the contact law
/// balance all grains and the stress.
///
/// If the load changes a length or shears the cell, the relaxation begins by straining the cell. Rigid grains are
/// strained at a constant rate (ContactDynamicsOptions::inertial_number). The relaxation ends when their packing
/// reaches the imposed strain, and the packing is recorded in motion. The recorded forces are those of the time step
/// that begins in this state (MotionRecord). Elastic grains are strained at the largest rate that the cap of the cell
/// allows, and then come to rest in the strained cell. After small strains, they come to rest by Newton steps alone.
template <int Dim>
class ContactDynamicsRelaxer final : public Equilibrator<Dim> {
 public:
  /// @throws InputError if the load imposes no stress on any axis, or a stress that is not positive
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
  /// number of time steps in one call of advance()
  static constexpr int kSteps = 20;

  bool solves_at_once() const;
  bool is_elastic() const { return !packing_.law.is_rigid(); }
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
  bool is_gas() const;
  bool is_calm(const Packing<Dim>& packing, double factor) const;
  bool motion_has_ended() const;
  void make_steps(int n_steps);
  bool forces_are_nearly_balanced() const;
  double near_balance() const;
  double largest_gap(bool is_exact) const;
  bool find_balanced_forces();
  bool find_forces_at_minimum(bool is_near);
  bool stays_in_place(const Packing<Dim>& rested) const;
  void set_balanced_forces(Packing<Dim>& packing) const;
  void start_resting();
  RelaxationStatus rest();
  RelaxationStatus rest_in_steps();
  RelaxationStatus rest_at_least_volume();
  RelaxationStatus rest_on_springs();
  bool springs_balance();
  bool newton_iterations_balance(const Packing<Dim>& rested, double residual);
  void accept(Packing<Dim> balanced);
  void start_moving(int more_calm_steps = 0);
  void measure();

  RelaxationOptions options_;
  Packing<Dim> packing_;
  LoadTarget<Dim> load_;
  /// Stress on each axis from which the scales of time and force follow: the imposed stress or, on axes with an imposed
  /// length, the mean of the imposed stresses (force/length^(Dim-1)).
  Vec<Dim> imposed_;
  /// stress on each axis: the imposed stress or, for an imposed length, the stress in the packing
  /// (force/length^(Dim-1))
  Vec<Dim> target_;
  ContactDynamicsProgress progress_;
  Mat<Dim> stress_;  ///< static stress of the packing (force/length^(Dim-1))
  Residuals residuals_;
  Stability stability_;
  std::string ending_;
  std::optional<MotionRecord> motion_;
  /// time unit T = sqrt(m/(P d^(Dim-2))), with the mass m and the diameter d of the largest grain and the pressure P
  /// (time)
  double time_unit_;
  double strain_rate_ = 0.0;  ///< rate at which the cell is strained if the load imposes a strain (1/time)
  /// whether the load strains a packing of elastic grains so little that most contacts persist
  bool strains_springs_ = false;
  MotionObserver<Dim> observer_;
};

}  // namespace floc
