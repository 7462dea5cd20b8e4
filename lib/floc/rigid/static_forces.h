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
  std::vector<double> normal_force;   ///< normal force of each contact, positive if compressive (force)
  std::vector<Vec<Dim>> shear_force;  ///< tangential force of each contact on grain i (force)
  /// Coulomb's limit mu P of the tangential force of each contact, with the friction coefficient mu and the repulsive
  /// part P of the normal force (force); infinite for contacts without friction and for attractions across a gap.
  std::vector<double> friction_limit;
  BalanceError error;
  int n_factorizations = 0;
};

/// Range of the normal force of a contact in all sets of balanced forces.
struct ForceRange {
  double smallest = 0.0;  ///< smallest normal force (force)
  double largest = 0.0;   ///< largest normal force (force); infinite if there is no limit
};

/// Contact forces that are possible in a packing at rest with the present geometry. The forces on every grain balance,
/// the forces give the required stress, and each contact satisfies Coulomb's condition (force_balance.h). In general
/// many sets of forces satisfy these conditions. Member functions select the set with the least elastic energy 1/2 sum
/// (P^2/K_N + T^2/K_T), select the set closest to the present forces, or return the range of one force over all sets. P
/// is the repulsive part of the normal force, T the tangential force, and K_N and K_T are the stiffnesses.
template <int Dim>
class StaticForces {
 public:
  /// @param place  name of the file of the packing, for messages
  /// @throws InputError if force_balance() throws it
  StaticForces(const std::string& place, const Packing<Dim>& packing, const ForceBalanceOptions<Dim>& options);

  /// Returns the balanced forces that are closest to the present forces: the elastic energy of the difference is
  /// smallest.
  /// @param costly_gap  If positive, forces across gaps are avoided. As for springs that first have to close a gap g,
  /// the sum of P g is added to the energy. Its weight is such that the mean force across a gap of this size (divided by
  /// the diameter of the smaller grain) adds twice the elastic energy of the mean force.
  /// @throws NoResult if no set of forces balances the load (the message names the grain that the load moves most), or
  /// if rounding errors do not allow a decision
  BalancedForces<Dim> closest(double costly_gap = 0.0);

  /// Returns the balanced forces with the least elastic energy. They depend on the geometry, the stiffnesses and the
  /// load, but not on the history of the packing.
  /// @throws NoResult if closest() throws it
  BalancedForces<Dim> canonical();

  /// Returns the range of the normal force of one contact in all sets of balanced forces.
  /// @param contact  index in the contacts of the packing
  /// @throws NoResult if closest() throws it
  ForceRange range(int contact);

  /// Returns the present forces of the packing, with the errors of their balance.
  BalancedForces<Dim> present() const;

 private:
  BalancedForces<Dim> solved(const std::vector<Vec<Dim>>& preferred, double costly_gap = 0.0);
  BalancedForces<Dim> forces(const std::vector<Vec<Dim>>& x, int n_factorizations) const;
  double extreme(int block, double sign);
  [[noreturn]] void fail(const ConeSolution<Dim>& solution) const;
  std::string largest_grains(const Eigen::VectorXd& of_rows, bool moments) const;

  const Packing<Dim>& packing_;
  ForceBalance<Dim> balance_;
  ConeProgram<Dim> program_;  ///< program of the balance, with the objective of the last call
  InteriorPoint<Dim> method_;
  double accepted_error_;  ///< ForceBalanceOptions::accepted_error
};

/// Converts forces on walls to the option ForceBalanceOptions::wall_force. The force on a wall that does not move under
/// forces is arbitrary (no number).
/// @param force  force on each wall, in the order of Packing::walls (force)
template <int Dim>
std::vector<std::optional<double>> forces_on_moving_walls(const Packing<Dim>& packing,
                                                          const std::vector<double>& force);

/// Returns the relative distance of two sets of forces: sqrt(sum |f - g|^2 / sum |f|^2); 0 if `f` is zero.
template <int Dim>
double force_distance(const BalancedForces<Dim>& f, const BalancedForces<Dim>& g);

/// Returns the relative distance between the forces of a state and its canonical forces (StaticForces::canonical()),
/// which balance the stress of the state with the least elastic energy; `floc forces` prints this number. The result is
/// absent if the state is in motion, if no forces balance the state, if all contact forces are zero, or if the contact
/// law resists rolling or twisting.
template <int Dim>
std::optional<double> force_freedom(const State<Dim>& state);

}  // namespace floc
