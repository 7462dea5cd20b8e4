#pragma once

#include <memory>

#include "floc/packing/packing.h"
#include "floc/relaxation/boundary_control.h"
#include "floc/relaxation/instruction_set.h"

namespace floc {

/// Time steps of one chunk; a run may be stopped between two chunks. Packing and lists are rebuilt there, which
/// costs about 20 steps.
inline constexpr int kStepsPerChunk = 500;

/// Numerical settings of a chunk of dynamics.
struct DynamicsSettings {
  double time_step;  ///< (time)
  double skin;       ///< first guess of the Verlet skin (length); adapted to the motion
  int threads = 1;
  InstructionSet instructions = widest_instruction_set();
  /// Whether liquid bridges keep their volumes. Otherwise the liquid is shared out anew at the beginning and
  /// with every list of neighbours, whose skin is then a fixed share of the reach of the bridges.
  bool holds_liquid = false;
};

/// Treatment of the kinetic energy in motion.
enum class Motion {
  free,  ///< the equations of motion alone
  /// All velocities are set to zero whenever the kinetic energy falls (for the finish, after motion has
  /// stopped).
  power_control,
};

/// Explicit time integration of a packing under its law: half kick, drift, forces, half kick (velocity Verlet),
/// with the lattice vectors as degrees of freedom and peculiar velocities. Second order. Dashpots act on the
/// velocity at the middle of the step, with a coefficient corrected for that lag: this is stable up to twice
/// the step that a predicted velocity allows, without an error in the restitution.
/// Results depend only on the initial packing and the number of steps. They are identical, bit for bit, for any
/// neighbour lists, skin, number of threads and vector instructions, since every grain sums its forces in the
/// order of its neighbours.
template <int Dim>
class Dynamics {
 public:
  virtual ~Dynamics() = default;

  virtual void advance(int n_steps, Motion motion) = 0;

  /// Whether all positions are finite and at most 1e8 sides of the cell away. If not, the time step was too
  /// large.
  virtual bool finite() const = 0;

  /// Returns the packing as it is now, with its contact list; grains are in the order of the initial packing.
  /// @pre finite()
  virtual Packing<Dim> packing() const = 0;

  /// Returns the packing as packing() does and frees most of the data of the dynamics, for a packing that is
  /// too large to be held twice. No other step can follow.
  virtual Packing<Dim> release_packing() = 0;

  /// First guess of the skin for the next chunk (length).
  virtual double skin() const = 0;
};

/// Makes the dynamics of a packing. @pre the cell matrix is lower triangular, radii and masses are positive,
/// settings.time_step > 0
template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings);

/// Makes the dynamics of a packing that is too large to be held twice: its contacts are removed from `packing`.
/// The preconditions are those above.
template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings);

/// Time step in the scene's units (time; docs/physics.md, "Time step"): RelaxationOptions::time_step times
/// sqrt(m_min/K_N), shortened where K_T is above K_N or the smallest grains roll faster than they vibrate, and
/// in 3D, where grains have more neighbours. Where stiffness grows with the overlap, K_N is the largest of the
/// stiffness at 1.3 times the deepest overlap, twice the stiffness at the mean force under the pressure, and
/// the stiffness in a collision at twice the largest speed; the step is then valid for one chunk.
/// @param pressure  present or next pressure of the packing (force/length^(Dim-1))
template <int Dim>
double time_step_of(const Packing<Dim>& packing, double time_step_in_contact_times, double pressure = 0.0);

/// Time step that a cell under stress allows (time): RelaxationOptions::time_step times 1/w, where w is the
/// largest frequency at which the cell vibrates against its packing, w^2 = sum of K r_a^2/(M L_a^2) over the
/// contacts of a close packing. It is shorter than time_step_of() only where the cell weighs less than a grain
/// or two, or some tens of grains in 3D.
/// @param cell_mass  M, inertia of a component of the lattice (mass)
template <int Dim>
double cell_time_step_of(const Packing<Dim>& packing, double cell_mass, double time_step_in_contact_times,
                         double pressure);

}  // namespace floc
