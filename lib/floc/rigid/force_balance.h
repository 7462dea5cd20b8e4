#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/rigid/cone_program.h"

namespace floc {

/// Conditions on static forces that the packing does not give by itself.
template <int Dim>
struct ForceBalanceOptions {
  std::optional<double> friction;  ///< friction coefficient; absent: that of the law
  std::optional<double> kn, kt;    ///< K_N and K_T (force/length); absent: those of each contact
  /// Stress that the forces transmit, symmetric (force/length^(Dim-1)); absent: that of the present forces.
  std::optional<Mat<Dim>> stress;
  /// Stress on each axis that the forces transmit, compression positive (force/length^(Dim-1)), while shear stresses
  /// are free; absent: `stress`. Only one of the two may be given.
  std::optional<Vec<Dim>> axis_stress;
  /// With `axis_stress`: axes whose length is held, so that the forces may transmit any stress along them.
  std::array<bool, Dim> open_axis = {};
  /// Force of the grains on each wall, in the order of Packing::walls (force); absent for a wall that bears any force.
  /// Without this list, the force on each pair of walls is that of the present forces.
  std::optional<std::vector<std::optional<double>>> wall_force = {};

  /// Every fault as "key = value: requirement"; empty when the options can be used.
  std::vector<std::string> validate() const;
};

/// Errors of the balance of a set of forces.
struct BalanceError {
  double force = 0.0;   ///< largest net force on a grain, over the mean normal force
  double moment = 0.0;  ///< largest net moment on a grain, over the mean normal force and the size of the grain
  double stress = 0.0;  ///< largest error of a component of the stress, over the pressure of mean normal forces
};

/// One contact whose force is unknown: block k of the cone program is (P, T/mu) of contact `contact`, in units of
/// ForceBalance::unit, with the repulsive part P = F_N + F_a of the normal force.
template <int Dim>
struct UnknownForce {
  int contact;       ///< index in the contacts of the packing
  double friction;   ///< mu
  double adhesion;   ///< F_a >= 0 (force)
  Vec<Dim> present;  ///< P and T of the packing, in `frame` (force)
  double kn, kt;     ///< K_N and K_T (force/length), > 0
  Mat<Dim> frame;    ///< columns: the normal, then the tangents
};

/// Balance of the contact forces of a packing at rest as the constraints of a cone program: force and moment vanish on
/// each grain, and the forces transmit the given stress. Each contact satisfies Coulomb's condition P >= 0,
/// |T| <= mu P. Attractions across a gap keep the forces that they have.
template <int Dim>
struct ForceBalance {
  std::vector<UnknownForce<Dim>> unknowns;
  ConeProgram<Dim> program;         ///< its objective is zero
  std::vector<int> row_grain;       ///< grain of each row of the program; -1 for rows of the boundary
  std::vector<bool> row_is_moment;  ///< whether a row is the balance of moments
  double unit = 1.0;                ///< of the forces in the program (force): about the mean normal force
  /// Value of the rows of the boundary that belongs to the pressure of mean normal forces.
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
