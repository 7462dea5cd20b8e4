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
  /// Liquid bridges keep their volumes; otherwise liquid is shared out anew at the beginning and with every
  /// list of neighbours, whose skin is then a fixed part of the reach of the bridges.
  bool holds_liquid = false;
};

/// What happens to the kinetic energy.
enum class Motion {
  free,  ///< the equations of motion alone
  /// All velocities are zeroed whenever the kinetic energy falls (a finish, after motion has stopped).
  power_control,
};

/// Explicit time integration of a packing under its law: half kick, drift, forces, half kick (velocity Verlet),
/// with the lattice vectors as degrees of freedom and peculiar velocities. Second order. Dashpots act on the
/// velocity at the middle of the step, with a coefficient corrected for that lag: this is stable to twice the
/// step that a predicted velocity allows, and the restitution is right all the same.
///
/// Results depend only on the packing it was made from and on the number of steps: neighbour lists, their skin,
/// the number of threads and the vector instructions leave no trace in the bits, since every grain sums its
/// forces in the order of its neighbours.
template <int Dim>
class Dynamics {
 public:
  virtual ~Dynamics() = default;

  virtual void advance(int n_steps, Motion motion) = 0;

  /// False when positions are no longer finite, or millions of cells away: the time step was too large.
  virtual bool finite() const = 0;

  /// The packing as it is now, with its contact list; grains in the order of the packing this was made from.
  /// @pre finite()
  virtual Packing<Dim> packing() const = 0;

  /// The same, for a packing that is too large to be held twice: no other step can follow.
  virtual Packing<Dim> release_packing() = 0;

  /// A good first guess of the skin for the next chunk (length).
  virtual double skin() const = 0;
};

/// @pre the cell matrix is lower triangular, radii and masses are positive, settings.time_step > 0.
template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(const Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings);

/// The same, for a packing that is too large to be held twice: its contacts go over, and are gone from it.
template <int Dim>
std::unique_ptr<Dynamics<Dim>> make_dynamics(Packing<Dim>& packing, const BoundaryControl<Dim>& control,
                                             const DynamicsSettings& settings);

/// Time step of RelaxationOptions::time_step in the scene's units: in sqrt(m_min/K_N), shortened where K_T is
/// above K_N or the smallest grains roll faster than they vibrate, and in 3D, where grains have more
/// neighbours. Where stiffness grows with the overlap, K_N is that of the deepest contact there is, twice that
/// at the mean force under the pressure, or that of the fastest collision, whichever is stiffest: good for one
/// chunk.
/// @param pressure  that the packing is under or will be (force/length^(Dim-1))
template <int Dim>
double time_step_of(const Packing<Dim>& packing, double time_step_in_contact_times, double pressure = 0.0);

/// Time step of RelaxationOptions::time_step in 1/w, w being the largest frequency at which a cell under stress
/// vibrates against its packing: w^2 = sum of K r_a^2/(M L_a^2) over the contacts of a close packing. It is
/// shorter than time_step_of only where the cell weighs less than a grain or two, or some tens in 3D.
/// @param cell_mass  M, inertia of a component of the lattice (mass)
template <int Dim>
double cell_time_step_of(const Packing<Dim>& packing, double cell_mass, double time_step_in_contact_times,
                         double pressure);

}  // namespace floc
