#pragma once

#include <memory>

#include "floc/base/instruction_set.h"
#include "floc/packing/packing.h"
#include "floc/relaxation/boundary_control.h"

namespace floc {

/// Number of time steps in a chunk. A relaxation advances by one chunk at a time, and a run may be stopped between two
/// chunks. At the end of a chunk, the packing and the neighbour lists are rebuilt, which costs as much time as about 20
/// steps.
inline constexpr int kStepsPerChunk = 500;

/// Numerical settings of the time integration during a chunk of time steps.
struct DynamicsSettings {
  double time_step;  ///< time step (time)
  /// First guess of the skin, the extra distance up to which pairs are put on the Verlet lists (length). The skin is
  /// later adapted to the motion.
  double skin;
  int threads = 1;
  InstructionSet instructions = widest_instruction_set();
  /// Whether liquid bridges keep their volumes. If not, the liquid is shared out among the pairs of grains at the
  /// beginning and whenever new neighbour lists are built. In this case, the skin of the lists is a fixed share of the
  /// largest gap that a bridge spans.
  bool holds_liquid = false;
};

/// Treatment of the velocities of a packing in motion.
enum class Motion {
  free,  ///< the packing follows its equations of motion
  /// Power control: all velocities are set to zero whenever the kinetic energy falls. Power control is used in the
  /// final phase of a relaxation, when the grains hardly move.
  power_control,
};

/// Explicit time integration of a packing under its contact law, in the order half kick, drift, forces, half kick
/// (velocity Verlet). The lattice vectors are degrees of freedom, and velocities are peculiar velocities (relative to
/// the affine motion of the lattice). The scheme is of second order. Dashpot forces are computed from the velocities of
/// half a step earlier. The damping coefficients are corrected for this lag, so that the restitution has no error. (If
/// dashpot forces were computed from predicted present velocities, the longest stable time step would be half as long.)
/// The forces on every grain are summed in the order of its neighbours. Results are therefore bitwise identical for any
/// neighbour lists, skin, number of threads and vector instructions: they depend only on the initial packing and the
/// number of steps.
template <int Dim>
class Dynamics {
 public:
  virtual ~Dynamics() = default;

  virtual void advance(int n_steps, Motion motion) = 0;

  /// Whether all positions are finite and at most 1e8 sides of the cell away from the origin. If this is false, the
  /// time step was too large.
  virtual bool finite() const = 0;

  /// Returns the packing in its present state, with its contacts. The grains are in the order of the initial packing.
  /// @pre finite()
  virtual Packing<Dim> packing() const = 0;

  /// Returns the packing like packing(), but frees most of the data of the dynamics, so that a very large packing is
  /// not stored twice. No time step can be made afterwards.
  virtual Packing<Dim> release_packing() = 0;

  /// Returns a first guess of the skin of the neighbour lists for the next chunk of time steps (length).
  virtual double skin() const = 0;
};

/// Makes the object that integrates the motion of a packing in time.
/// @pre the cell matrix is lower triangular, radii and masses are positive, settings.time_step > 0
template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings);

/// Makes the object that integrates the motion of a packing in time, for a packing that is too large to be stored
/// twice: its contacts are removed from `packing`.
/// @pre the cell matrix is lower triangular, radii and masses are positive, settings.time_step > 0
template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings);

/// Returns the time step of a packing in the units of the scene (time; docs/physics.md, "Time step"):
/// RelaxationOptions::time_step times sqrt(m_min/K_N), with m_min the smallest mass and K_N the normal stiffness. The
/// time step is shorter if the tangential stiffness is above K_N, if the smallest grains roll faster than they vibrate,
/// and in 3D, where grains have more neighbours. If the normal stiffness grows with the overlap, K_N is the largest of
/// three values: the stiffness at 1.3 times the deepest overlap; twice the stiffness at the mean force under the
/// pressure; and the largest stiffness in a collision at twice the largest speed. The time step is then valid for one
/// chunk of time steps.
/// @param time_step_in_contact_times  value of RelaxationOptions::time_step
/// @param pressure  present or next pressure of the packing (force/length^(Dim-1))
template <int Dim>
double time_step_of(const Packing<Dim>& packing, double time_step_in_contact_times, double pressure = 0.0);

/// Returns the longest time step for a cell that follows a stress (time): RelaxationOptions::time_step divided by the
/// largest frequency w at which the cell vibrates against the grains in it. For an axis a, w^2 is the sum of K r_a^2/(M
/// L_a^2) over the contacts of a close packing, with the contact stiffness K, the component r_a of the branch vector,
/// the cell mass M and the side L_a of the cell. This time step is shorter than time_step_of() only if the cell mass is
/// small: below the mass of one or two grains in 2D, or of some tens of grains in 3D.
/// @param cell_mass  M, inertia of a component of the lattice (mass)
template <int Dim>
double cell_time_step_of(const Packing<Dim>& packing, double cell_mass, double time_step_in_contact_times,
                         double pressure);

}  // namespace floc
