#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floc/packing/packing.h"
#include "floc/packing/state.h"
#include "floc/rigid/force_balance.h"
#include "floc/rigid/interior_point.h"

namespace floc {

/// Forces of the contacts of a packing, in their order.
template <int Dim>
struct BalancedForces {
  std::vector<double> normal_force;   ///< compression positive (force)
  std::vector<Vec<Dim>> shear_force;  ///< tangential force on i (force)
  /// Coulomb's limit mu P of the tangential force (force); infinity for contacts without friction and for attractions
  /// across a gap.
  std::vector<double> friction_limit;
  BalanceError error;
  int n_factorizations = 0;
};

/// Normal forces that a contact can carry while all forces balance.
struct ForceRange {
  double smallest = 0.0;  ///< (force)
  double largest = 0.0;   ///< (force); infinity if there is no largest one
};

/// Forces that the contacts of a packing can carry at rest, while its geometry is held. They balance every grain and
/// the stress, and each contact satisfies Coulomb's condition (force_balance.h). In general many sets of forces do:
/// the members select one by its elastic energy 1/2 sum (P^2/K_N + T^2/K_T), or bound all of them.
template <int Dim>
class StaticForces {
 public:
  /// @param place  file, for messages
  /// @throws InputError as force_balance()
  StaticForces(const std::string& place, const Packing<Dim>& packing, const ForceBalanceOptions<Dim>& options);

  /// Returns the balanced forces closest to the present ones, in the norm of the elastic energy.
  /// @throws NoResult if no set of forces balances the load, with the grain that the load moves most, or if rounding
  /// prevents an answer
  BalancedForces<Dim> closest();

  /// Returns the balanced forces of least elastic energy: those of springs without a history.
  /// @throws NoResult as closest()
  BalancedForces<Dim> canonical();

  /// Returns the range of the normal force of a contact over all sets of balanced forces.
  /// @param contact  index in the contacts of the packing
  /// @throws NoResult as closest()
  ForceRange range(int contact);

  /// The present forces of the packing, with the errors of their balance.
  BalancedForces<Dim> present() const;

 private:
  BalancedForces<Dim> solved(const std::vector<Vec<Dim>>& preferred);
  BalancedForces<Dim> forces(const std::vector<Vec<Dim>>& x, int n_factorizations) const;
  double extreme(int block, double sign);
  [[noreturn]] void fail(const ConeSolution<Dim>& solution) const;

  const Packing<Dim>& packing_;
  ForceBalance<Dim> balance_;
  ConeProgram<Dim> program_;  ///< that of the balance, with the objective of the last call
  InteriorPoint<Dim> method_;
};

/// Returns forces as the conditions of a balance (ForceBalanceOptions::wall_force): walls that do not follow forces bear
/// any force.
/// @param force  force on each wall, in the order of Packing::walls (force)
template <int Dim>
std::vector<std::optional<double>> forces_on_moving_walls(const Packing<Dim>& packing,
                                                          const std::vector<double>& force);

/// Relative distance of two sets of forces: sqrt(sum |f - g|^2 / sum |f|^2), 0 if `f` is zero.
template <int Dim>
double force_distance(const BalancedForces<Dim>& f, const BalancedForces<Dim>& g);

/// Returns the relative distance of the forces of a state from the forces of least elastic energy on its geometry that
/// transmit its stress, as floc forces prints it; absent for a state of motion, if no forces balance the state, or if no
/// contact carries a force.
template <int Dim>
std::optional<double> force_freedom(const State<Dim>& state);

}  // namespace floc
