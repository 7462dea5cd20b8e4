#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/packing/step_counts.h"
#include "floc/rigid/contact_points.h"
#include "floc/rigid/gap_curvature.h"
#include "floc/rigid/gauss_seidel.h"

namespace floc {

/// Load on the boundary of a packing in contact dynamics. On a periodic axis under stress, the side of the cell moves
/// under the stress; every other side changes at the constant rate in Cell::velocity. Every wall of finite mass moves
/// under the stress on its axis.
template <int Dim>
struct BoundaryLoad {
  Vec<Dim> stress = Vec<Dim>::Zero();  ///< stress on each axis, compression positive (force/length^(Dim-1))
  /// For each axis, whether the side of the cell moves under the stress; not used for axes with walls.
  std::array<bool, Dim> under_stress = {};
  double cell_mass = 1.0;  ///< mass of a side of the cell divided by the mass of all grains
  /// Terminal strain rate |(dL/dt)/L|, where L is the length of a side of the cell or the distance of two walls
  /// (1/time). A drag acts on the side or on the walls, so that without contacts L finally shrinks at this rate.
  double strain_rate_cap = std::numeric_limits<double>::infinity();
  /// Terminal speed at which two walls finally approach each other without contacts (length/time). If no value is
  /// given, the speed is strain_rate_cap times the distance of the walls.
  std::optional<double> wall_speed = {};
};

/// Packings with more grains than this number count as large: they move in longer steps, and come to rest in shorter
/// ones.
inline constexpr int kManyGrains = 1000;

/// Settings of the time steps of contact dynamics.
struct ContactDynamicsSettings {
  double longest_step;  ///< longest time step (time)
  /// tolerance of the impulses, divided by the mean normal impulse: the sweeps of a step end when the error is smaller
  double sweep_tolerance;
  int max_sweeps;  ///< largest number of sweeps in a step
  double restitution = 0.0;
  /// Impacts with a rate of approach below this limit are inelastic (length/time). In each step, gravity moves grains
  /// towards the grains below them. Without the limit, these impacts would be elastic, and the grains would never come
  /// to rest.
  double slow_impact = 0.0;
  int threads = 1;
  /// Whether the contacts of a step are solved all at once (implicit_step.h) and not by sweeps. If so, overlaps are
  /// removed in one step, and the velocities of all grains are set to zero whenever the grains, as a whole, reverse
  /// their motion. The grains then come to rest faster than if their velocities were set to zero before each step.
  bool at_once = false;
};

/// Returns the shortest time in which an overlap is removed (time). In a shorter time the grains would get high
/// velocities, which would shorten the next steps.
double shortest_removal(const ContactDynamicsSettings& settings);

/// Motion of grains in implicit time steps (contact dynamics; Moreau 1988, Jean 1999). In each step, the impulses of
/// all contacts are such that the velocities at the end of the step satisfy Signorini's and Coulomb's conditions
/// (gauss_seidel.h). If the contacts are elastic, the impulses satisfy their contact law for the overlaps at the end
/// of the step (elastic_contacts.h). The time step is halved until no grain moves by more than 2e-2 of its diameter
/// (5e-3 for grains with corners on which a contact force acts) and no overlap is deeper than 1e-2 of the diameter of
/// the smaller grain (0.1 if the contacts are elastic).
///
/// The contacts of the packing are all contact points whose gap could close within one step. The forces of the contacts
/// are the impulses of the last step, divided by the time step. The initial impulses of the next step are computed from
/// these forces.
template <int Dim>
class ContactDynamics {
 public:
  /// @param time_step  length of the first time step (time)
  /// @param last_step  length of the step that gave the forces of the packing (time); 0 if it is not known
  /// @throws InputError if find_pairs() throws it
  ContactDynamics(Packing<Dim> packing, const BoundaryLoad<Dim>& load, const ContactDynamicsSettings& settings,
                  double time_step, double last_step = 0.0);

  /// Makes one time step. If overlaps are too deep even after the step has been halved several times, the grains are
  /// stopped, and a step that is solved at once (ContactDynamicsSettings::at_once) removes the overlaps.
  /// @param at_rest  whether all velocities are set to zero before the step
  /// @throws NoResult if overlaps are too deep even after this last step
  void step(bool at_rest);

  /// Sets the velocity of the cell (length/time). For sides under stress, `velocity` is the velocity at the start of
  /// the next step; all other sides keep `velocity` in later steps.
  void set_cell_velocity(const Mat<Dim>& velocity) { packing_.cell.velocity = velocity; }
  /// Limits the length of the next step to at most `longest` (time).
  void shorten_next_step(double longest) { time_step_ = std::min(time_step_, longest); }

  /// Finds the forces of the next step without moving the grains. Afterwards the contacts of the packing have these
  /// forces, and time_step() is the length of the step.
  SweepResult find_forces();
  /// Returns the error of the present contact forces (SweepResult::residual), as if they were the forces of the next
  /// step. The error is computed from the velocities that these forces would cause at the end of the next step.
  double error_of_forces() const;

  const Packing<Dim>& packing() const { return packing_; }
  Packing<Dim> release_packing() { return std::move(packing_); }
  const StepCounts& counts() const { return counts_; }
  double time_step() const { return time_step_; }  ///< length of the next time step (time)
  double last_step() const { return last_step_; }  ///< length of the last time step (time)

 private:
  /// Method by which a step is solved.
  struct Method {
    bool at_rest;          ///< whether all velocities are set to zero before the step
    bool at_once;          ///< whether the contacts are solved all at once (ContactDynamicsSettings::at_once)
    double removed = 1.0;  ///< share of each overlap that is removed if the step is solved at once
  };
  struct Trial {
    BodyMotion<Dim> motion;
    std::vector<StepContact<Dim>> contacts;
    std::vector<int> source;  ///< for each contact of the step, its index in Packing::contacts
    SweepResult sweeps;
  };

  double reach() const;
  void find_contacts(Packing<Dim>& packing);
  BodyMotion<Dim> free_motion(double dt, bool at_rest) const;
  double terminal_speed(const Wall<Dim>& wall) const;
  void add_walls(double dt, bool at_rest, BodyMotion<Dim>& bodies) const;
  void add_cell(double dt, bool at_rest, BodyMotion<Dim>& bodies) const;
  Mat<Dim> cell_rate() const;
  double gap_rate(const Contact<Dim>& contact) const;
  double restitution(const Contact<Dim>& contact) const;
  std::vector<StepContact<Dim>> step_contacts(double dt, double removed, std::vector<int>& source,
                                              bool recorded = false) const;
  std::vector<PairMatrix<Dim>> stiffnesses(const Trial& trial, double dt) const;
  double removal_time(double dt) const;
  bool has_slow_cell() const;
  Trial solve(double dt, const Method& method) const;
  double largest_share_moved(const Trial& trial, double dt, const Method& method) const;
  Packing<Dim> moved(const Trial& trial, double dt) const;
  void set_forces(const Trial& trial, double dt, Packing<Dim>& packing) const;
  double deepest_overlap(const Packing<Dim>& packing, const Contact<Dim>*& where) const;

  Packing<Dim> packing_;
  BoundaryLoad<Dim> load_;
  ContactDynamicsSettings settings_;
  double time_step_, last_step_;
  double grain_mass_;  ///< mass of all grains
  ContactPoints<Dim> points_;
  StepCounts counts_;
};

}  // namespace floc
