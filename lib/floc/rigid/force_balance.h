#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/rigid/cone_program.h"

namespace floc {

/// Options of a balance of static forces.
template <int Dim>
struct ForceBalanceOptions {
  /// friction coefficient; if absent, the coefficient of the contact law is used
  std::optional<double> friction;
  /// stiffnesses K_N and K_T (force/length); if absent, each contact has its own
  std::optional<double> kn, kt;
  /// Stress that the forces have to give, symmetric (force/length^(Dim-1)); if absent, it is the stress of the present
  /// forces.
  std::optional<Mat<Dim>> stress;
  /// Stress on each axis that the forces have to give, compression positive (force/length^(Dim-1)); shear stresses are
  /// then arbitrary. If axis_stress is absent, `stress` is used. At most one of the two may be given.
  std::optional<Vec<Dim>> axis_stress;
  /// Axes along which the length of the cell is fixed; used only with `axis_stress`. The stress on these axes is
  /// arbitrary.
  std::array<bool, Dim> open_axis = {};
  /// Required force of the grains on each wall, in the order of Packing::walls (force); absent for a wall on which any
  /// force is allowed. Without this list, the required force on each pair of walls follows from the present forces.
  std::optional<std::vector<std::optional<double>>> wall_force = {};
  /// Largest error of the balance, divided by the mean normal force, with which forces are accepted if rounding errors
  /// ended the search for them. Rounding errors end a search early if no set of forces lies inside all cones, for
  /// example because the balance determines all forces.
  double accepted_error = 1e-6;

  /// Returns the faults of the options, each as "key = value: requirement"; empty if the options are valid.
  std::vector<std::string> validate() const;
};

/// Errors of the equations of balance for a set of forces.
struct BalanceError {
  double force = 0.0;  ///< largest net force on a grain, divided by the mean normal force
  /// largest net moment on a grain, divided by the product of the mean normal force and the size of the grain
  double moment = 0.0;
  /// largest error of a component of the stress, divided by the pressure for contacts that all have the mean normal
  /// force
  double stress = 0.0;
};

/// Contact whose force is unknown. The block of this contact in the unknown x of the cone program is (P, T/mu), in
/// units of ForceBalance::unit. Here P = F_N + F_a is the repulsive part of the normal force F_N, F_a is the adhesion,
/// T is the tangential force, and mu is the friction coefficient.
template <int Dim>
struct UnknownForce {
  int contact;       ///< index in the contacts of the packing
  double friction;   ///< friction coefficient mu
  double adhesion;   ///< adhesion F_a >= 0 (force)
  Vec<Dim> present;  ///< present force (P, T) in the packing, in the axes of `frame` (force)
  double kn, kt;     ///< stiffnesses K_N and K_T (force/length), > 0
  Mat<Dim> frame;    ///< axes of the contact as columns: the normal, then the tangents
};

/// Balance of the contact forces of a packing at rest, as the constraints of a cone program: the net force and the net
/// moment on each grain are zero, and the forces give the required stress. Each contact satisfies Coulomb's condition,
/// P >= 0 and |T| <= mu P. Attractions across a gap keep their present forces.
template <int Dim>
struct ForceBalance {
  std::vector<UnknownForce<Dim>> unknowns;
  ConeProgram<Dim> program;  ///< constraints of the balance; the objective is zero
  /// for each row of the program, the index of the grain; -1 for rows of the boundary (stress of the cell or forces on
  /// walls)
  std::vector<int> row_grain;
  std::vector<bool> row_is_moment;  ///< for each row, whether it is a balance of moments
  /// unit of the forces in the program, close to the mean normal force (force)
  double unit = 1.0;
  /// Typical load of a row of the boundary, in units of the program: the load for contacts that all have the mean
  /// normal force.
  double unit_of_boundary = 1.0;
};

/// Returns the balance of the contact forces of a packing. The weight of the grains is part of the balance. A contact
/// whose force must be zero in equilibrium is left out, for example the only contact of a grain, if it does not adhere.
/// @param place  name of the file of the packing, for messages
/// @throws InputError if an option is not valid; if the contact law resists rolling or twisting, because the balance
/// does not include moments at contacts; if no contact touches; if no stress is given and the present forces are zero;
/// if a stress is given for a packing between walls; or if wall_force does not have one entry for each wall
template <int Dim>
ForceBalance<Dim> force_balance(const std::string& place, const Packing<Dim>& packing,
                                const ForceBalanceOptions<Dim>& options);

}  // namespace floc
