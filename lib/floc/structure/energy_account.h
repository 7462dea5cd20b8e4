#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Sources and losses of the energy of a packing in motion (energy). `elastic` and `kinetic` are present
/// values, the others are sums since the beginning.
struct EnergyTerms {
  double work = 0.0;     ///< done on the packing by its boundary
  double elastic = 0.0;  ///< stored in contacts, that of attractions included
  double kinetic = 0.0;  ///< kinetic energy of peculiar velocities and spins
  double viscous = 0.0;  ///< lost in dashpots
  double sliding = 0.0;  ///< lost by springs of friction, rolling and twisting at their caps
  double scaling = 0.0;  ///< lost by tangential forces whose stiffness varies with the load
  double removed = 0.0;  ///< taken out by setting all velocities to zero
  double initial = 0.0;  ///< elastic and kinetic at the beginning
  /// Put in by sharing liquid out, and by bridges that form: change of the elastic energy with their volumes.
  double liquid = 0.0;
  /// Put in by changes of the contact law: change of the elastic energy at fixed positions.
  double law = 0.0;
  /// Lost along the normal, under laws whose unloading returns less energy than loading took.
  double hysteresis = 0.0;

  /// Returns the error of the account: the energy put in less all other terms.
  double error() const {
    return work + initial - elastic - kinetic - viscous - sliding - scaling - hysteresis - removed + liquid +
           law;
  }
};

/// Keeps the energy account of a moving packing, from its state after each time step alone: work + liquid + law
/// = change of elastic + change of kinetic + viscous + sliding + scaling + hysteresis + removed, up to an error
/// that vanishes with the time step to first order (dashpots, caps and liquid) or second (without them).
template <int Dim>
class EnergyAccount {
 public:
  /// @throws InputError if the packing has walls
  explicit EnergyAccount(Packing<Dim> start);

  /// Adds one time step. @param now  the packing after it, with the contacts and forces of the law
  void advance(const Packing<Dim>& now, double time_step);

  /// Replaces the law of the present packing, as at the start of a step of a load path with another law:
  /// springs are kept, forces are those of the new law, and liquid is shared out anew.
  void change_law(const Law& law);
  const Law& law() const { return previous_.law; }

  /// Continues an account that was kept up to the present packing.
  void continue_from(const EnergyTerms& terms) { terms_ = terms; }

  const EnergyTerms& terms() const { return terms_; }

 private:
  Packing<Dim> previous_;
  EnergyTerms terms_;
};

}  // namespace floc
