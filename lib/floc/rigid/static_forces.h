#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/packing/state.h"
#include "floc/rigid/force_balance.h"
#include "floc/rigid/interior_point.h"

namespace floc {

/// Forces of the contacts of a packing, in the order of the contacts.
template <int Dim>
struct BalancedForces {
  std::vector<double> normal_force;   ///< normal force of each contact, compression positive (force)
  std::vector<Vec<Dim>> shear_force;  ///< tangential force of each contact on grain i (force)
  /// Coulomb's limit mu P of the tangential force, with the friction coefficient mu and the repulsive normal force P
  /// (force); infinite for contacts without friction and for attractions across a gap.
  std::vector<double> friction_limit;
  BalanceError error;
  int n_factorizations = 0;
};

/// Range of the normal force that a contact can carry while all forces balance.
struct ForceRange {
  double smallest = 0.0;  ///< smallest normal force (force)
  double largest = 0.0;   ///< largest normal force (force); infinite if there is no limit
};

/// Forces that the contacts of a packing can carry at rest, for its present geometry. They balance every grain and the
/// stress, and each contact satisfies Coulomb's condition (force_balance.h). In general many sets of forces fulfil
/// these conditions. The members select one set by its elastic energy 1/2 sum (P^2/K_N + T^2/K_T), or give bounds of
/// all sets. P and T are the repulsive normal force and the tangential force, K_N and K_T the stiffnesses.
template <int Dim>
class StaticForces {
 public:
  /// @param place  file, for messages
  /// @throws InputError if force_balance() throws it
  StaticForces(const std::string& place, const Packing<Dim>& packing, const ForceBalanceOptions<Dim>& options);

  /// Returns the balanced forces that are closest to the present forces, in the norm of the elastic energy.
  /// @throws NoResult if no set of forces balances the load (the message names the grain that the load moves most), or
  /// if rounding prevents an answer
  BalancedForces<Dim> closest();

  /// Returns the balanced forces with the least elastic energy, which are those of springs without a history.
  /// @throws NoResult if closest() throws it
  BalancedForces<Dim> canonical();

  /// Returns the range of the normal force of a contact over all sets of balanced forces.
  /// @param contact  index in the contacts of the packing
  /// @throws NoResult if closest() throws it
  ForceRange range(int contact);

  /// Returns the present forces of the packing, with the errors of their balance.
  BalancedForces<Dim> present() const;

 private:
  BalancedForces<Dim> solved(const std::vector<Vec<Dim>>& preferred);
  BalancedForces<Dim> forces(const std::vector<Vec<Dim>>& x, int n_factorizations) const;
  double extreme(int block, double sign);
  [[noreturn]] void fail(const ConeSolution<Dim>& solution) const;

  const Packing<Dim>& packing_;
  ForceBalance<Dim> balance_;
  ConeProgram<Dim> program_;  ///< program of the balance, with the objective of the last call
  InteriorPoint<Dim> method_;
};

/// Returns forces as the conditions of a balance (ForceBalanceOptions::wall_force): walls that do not follow forces bear
/// any force.
/// @param force  force on each wall, in the order of Packing::walls (force)
template <int Dim>
std::vector<std::optional<double>> forces_on_moving_walls(const Packing<Dim>& packing,
                                                          const std::vector<double>& force);

/// Returns the relative distance of two sets of forces: sqrt(sum |f - g|^2 / sum |f|^2); 0 if `f` is zero.
template <int Dim>
double force_distance(const BalancedForces<Dim>& f, const BalancedForces<Dim>& g);

/// Returns the relative distance between the forces of a state and the forces with the least elastic energy that
/// transmit the stress of the state in its geometry, as `floc forces` prints it. Absent for a state in motion, if no
/// forces balance the state, or if no contact carries a force.
template <int Dim>
std::optional<double> force_freedom(const State<Dim>& state);

}  // namespace floc
