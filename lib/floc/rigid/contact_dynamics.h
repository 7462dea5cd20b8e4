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

/// Load on the boundary of a packing in contact dynamics. On a periodic axis under stress the side of the cell moves;
/// other sides keep their rate of change Cell::velocity. Every wall of finite mass moves under the stress on its axis.
template <int Dim>
struct BoundaryLoad {
  Vec<Dim> stress = Vec<Dim>::Zero();  ///< stress on each axis, compression positive (force/length^(Dim-1))
  /// Whether the side of the cell follows the stress on this axis; not used on axes between walls.
  std::array<bool, Dim> under_stress = {};
  double cell_mass = 1.0;  ///< mass of a side of the cell over the mass of all grains
  /// Rate |L'/L| at which a side of the cell, or the distance of two walls, shrinks in the end without contacts (1/time):
  /// a drag acts on the side or the walls.
  double strain_rate_cap = std::numeric_limits<double>::infinity();
  /// Speed at which two walls approach each other in the end without contacts (length/time); absent: it follows from
  /// strain_rate_cap.
  std::optional<double> wall_speed = {};
};

/// Settings of the time steps of contact dynamics.
struct ContactDynamicsSettings {
  double longest_step;  ///< longest time step (time)
  /// error of the impulses at which the sweeps of a step end, divided by the mean normal impulse
  double sweep_tolerance;
  int max_sweeps;  ///< largest number of sweeps in a step
  double restitution = 0.0;
  /// Rate of approach below which impacts are inelastic (length/time). Without this limit, grains that fall onto other
  /// grains within a step would never come to rest.
  double slow_impact = 0.0;
  int threads = 1;
  /// Whether the contacts of a step are solved all at once (implicit_step.h) and not by sweeps. Overlaps are then
  /// removed in one step, and the velocities of all grains are set to zero when the grains, as a whole, move backwards.
  /// This leads the grains to rest faster than setting their velocities to zero before each step.
  bool at_once = false;
  /// Whether steps in 3D that are solved at once have separating plates (separating_plates.h). Grains must be
  /// without friction and adhesion, and have corners.
  bool plates = false;
};

/// Motion of rigid grains in implicit time steps (contact dynamics; Moreau 1988, Jean 1999). The impulses of all
/// contacts in a step solve Signorini's and Coulomb's conditions for the velocities at the end of the step
/// (gauss_seidel.h). The time step is halved until no grain moves more than 2e-2 of its diameter (5e-3 for grains with
/// corners that carry a force) and no overlap is deeper than 1e-2 of the diameter of the smaller grain.
///
/// The contacts of the packing are all contact points closer than the reach of a step. They carry the forces of the
/// last step (its impulses divided by the time step), which give the initial impulses of the next step.
template <int Dim>
class ContactDynamics {
 public:
  /// @param time_step  time step to begin with (time)
  /// @param last_step  length of the step that gave the forces of the packing (time); 0 if it is not known
  /// @throws InputError if find_pairs() throws it
  ContactDynamics(Packing<Dim> packing, const BoundaryLoad<Dim>& load, const ContactDynamicsSettings& settings,
                  double time_step, double last_step = 0.0);

  /// Makes one time step. If overlaps remain too deep even after the step has been halved several times, the grains are
  /// stopped, and a step that is solved at once removes the overlaps.
  /// @param at_rest  whether all velocities are set to zero before the step
  /// @throws NoResult if the overlaps are too deep after that step, too
  void step(bool at_rest);

  /// Sets the velocity of the cell (length/time). Sides under stress begin the next step with this velocity; all other
  /// sides keep it.
  void set_cell_velocity(const Mat<Dim>& velocity) { packing_.cell.velocity = velocity; }
  /// Shortens the next step to a length (time).
  void shorten_next_step(double longest) { time_step_ = std::min(time_step_, longest); }

  /// Finds the forces of the next step without moving the grains. The contacts then carry these forces, and time_step()
  /// is the length of that step.
  SweepResult find_forces();
  /// Returns the error of the present forces of the contacts as forces of the next step (SweepResult::residual). The
  /// velocities at the end of that step are computed from these forces.
  double error_of_forces() const;

  const Packing<Dim>& packing() const { return packing_; }
  Packing<Dim> release_packing() { return std::move(packing_); }
  const StepCounts& counts() const { return counts_; }
  double time_step() const { return time_step_; }  ///< next time step (time)
  double last_step() const { return last_step_; }  ///< length of the last time step (time)

 private:
  /// Method by which a step is solved.
  struct Method {
    bool at_rest;          ///< whether all velocities are set to zero before the step
    bool at_once;          ///< see ContactDynamicsSettings::at_once
    double removed = 1.0;  ///< share of each overlap that a step solved at once removes
  };
  struct Trial {
    BodyMotion<Dim> motion;
    std::vector<StepContact<Dim>> contacts;
    std::vector<int> source;  ///< for each contact of the step: its index in the contacts of the packing
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
  std::vector<StepContact<Dim>> step_contacts(double dt, double removed, std::vector<int>& source) const;
  std::vector<PairMatrix<Dim>> stiffnesses(const Trial& trial, double dt) const;
  double removal_time(double dt) const;
  bool solve_with_plates(double dt, const Method& method, Trial& trial) const;
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
