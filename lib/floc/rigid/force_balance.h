#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/rigid/cone_program.h"

namespace floc {

/// Conditions on static forces in addition to those of the packing.
template <int Dim>
struct ForceBalanceOptions {
  std::optional<double> friction;  ///< friction coefficient; if absent, that of the contact law
  std::optional<double> kn, kt;    ///< stiffnesses K_N and K_T (force/length); if absent, those of each contact
  /// Stress that the forces transmit, symmetric (force/length^(Dim-1)); if absent, the stress of the present forces.
  std::optional<Mat<Dim>> stress;
  /// Stress on each axis that the forces transmit, compression positive (force/length^(Dim-1)), while shear stresses
  /// are arbitrary. If absent, `stress` applies. Only one of the two may be given.
  std::optional<Vec<Dim>> axis_stress;
  /// With `axis_stress`: axes whose length is fixed. The forces may transmit any stress along these axes.
  std::array<bool, Dim> open_axis = {};
  /// Force of the grains on each wall, in the order of Packing::walls (force); absent for a wall that bears any force.
  /// Without this list, the force on each pair of walls is that of the present forces.
  std::optional<std::vector<std::optional<double>>> wall_force = {};

  /// Every fault as "key = value: requirement"; empty when the options can be used.
  std::vector<std::string> validate() const;
};

/// Errors of a set of forces in the equations of balance.
struct BalanceError {
  double force = 0.0;  ///< largest net force on a grain, divided by the mean normal force
  /// largest net moment on a grain, divided by the mean normal force and the size of the grain
  double moment = 0.0;
  /// largest error of a component of the stress, divided by the pressure of mean normal forces
  double stress = 0.0;
};

/// Contact whose force is unknown. Block k of the cone program is (P, T/mu) of this contact, in units of
/// ForceBalance::unit, with the repulsive part P = F_N + F_a of the normal force F_N, the adhesion F_a, the tangential
/// force T and the friction coefficient mu.
template <int Dim>
struct UnknownForce {
  int contact;       ///< index in the contacts of the packing
  double friction;   ///< friction coefficient mu
  double adhesion;   ///< adhesion F_a >= 0 (force)
  Vec<Dim> present;  ///< present forces P and T of the packing, in `frame` (force)
  double kn, kt;     ///< stiffnesses K_N and K_T (force/length), > 0
  Mat<Dim> frame;    ///< axes of the contact as columns: the normal, then the tangents
};

/// Balance of the contact forces of a packing at rest as the constraints of a cone program: force and moment vanish on
/// each grain, and the forces transmit the given stress. Each contact satisfies Coulomb's condition P >= 0,
/// |T| <= mu P. Attractions across a gap keep the forces that they have.
template <int Dim>
struct ForceBalance {
  std::vector<UnknownForce<Dim>> unknowns;
  ConeProgram<Dim> program;         ///< constraints of the balance, with an objective of zero
  std::vector<int> row_grain;       ///< grain of each row of the program; -1 for rows of the boundary
  std::vector<bool> row_is_moment;  ///< for each row: whether it is the balance of moments
  double unit = 1.0;                ///< unit of the forces in the program, about the mean normal force (force)
  /// Value of the rows of the boundary for the pressure that mean normal forces give.
  double unit_of_boundary = 1.0;
};

/// Returns the balance of the forces of a packing, which also carry the weight of the grains. Contacts that cannot carry a force in equilibrium, as those of a
/// grain with one contact that does not adhere, are left out.
/// @param place  file, for messages
/// @throws InputError if an option is not valid; if the law resists rolling or twisting, whose moments this balance
/// does not have; if no contact touches; if no stress is given and the present forces are zero; if a stress is
/// given for a packing between walls; or if wall_force does not have a number for each wall
template <int Dim>
ForceBalance<Dim> force_balance(const std::string& place, const Packing<Dim>& packing,
                                const ForceBalanceOptions<Dim>& options);

}  // namespace floc
