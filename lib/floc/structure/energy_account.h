#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Terms of the energy balance of a packing in motion (energy). `elastic` and `kinetic` are values at the present time,
/// `initial` is the energy at the beginning, and all other terms are sums since the beginning.
struct EnergyTerms {
  double work = 0.0;     ///< work of the boundary on the packing
  double elastic = 0.0;  ///< energy stored in contacts, including the energy of attraction
  /// Kinetic energy of the grains: from their velocities relative to the deforming cell, and from their rotation.
  double kinetic = 0.0;
  double viscous = 0.0;  ///< energy dissipated by dashpots
  /// Energy dissipated by friction, rolling and twisting resistance while their forces or moments are at their limits.
  double sliding = 0.0;
  /// Energy dissipated when the tangential stiffness and force fall with the normal load.
  double scaling = 0.0;
  double removed = 0.0;  ///< energy removed by setting all velocities to zero
  double initial = 0.0;  ///< sum of the elastic and the kinetic energy at the beginning
  /// Energy added by the liquid: change of the elastic energy due to changes of the volumes of the liquid bridges.
  double liquid = 0.0;
  /// Energy added by changes of the contact law: change of the elastic energy at fixed positions.
  double law = 0.0;
  /// Energy dissipated by normal forces, if a contact returns less energy during unloading than it stored during
  /// loading.
  double hysteresis = 0.0;

  /// Returns the error of the energy balance: the energy added minus the energy stored, dissipated and removed.
  double error() const {
    return work + initial - elastic - kinetic - viscous - sliding - scaling - hysteresis - removed + liquid +
           law;
  }
};

/// Computes the energy balance of a moving packing from the states after each time step: work + liquid + law = change
/// of elastic + change of kinetic + viscous + sliding + scaling + hysteresis + removed, with the members of
/// EnergyTerms. The error of the balance is of first order in the time step if there are dashpots, limits of forces or
/// liquid, otherwise of second order.
template <int Dim>
class EnergyAccount {
 public:
  /// @throws InputError if the packing has walls
  explicit EnergyAccount(Packing<Dim> start);

  /// Adds one time step to the energy balance.
  /// @param now  the packing after the step, with its contacts and forces
  void advance(const Packing<Dim>& now, double time_step);

  /// Replaces the contact law of the present packing, for a step of the load path with another law. The forces of
  /// tangential springs and the moments of rolling springs remain the same. Normal forces follow from the new law, and
  /// the liquid is distributed anew.
  void change_law(const Law& law);
  const Law& law() const { return previous_.law; }

  /// Continues an energy balance that was computed earlier up to the present packing.
  void continue_from(const EnergyTerms& terms) { terms_ = terms; }

  const EnergyTerms& terms() const { return terms_; }

 private:
  Packing<Dim> previous_;
  EnergyTerms terms_;
};

}  // namespace floc
