#pragma once

#include "floc/packing/packing.h"

namespace floc {

/// Where the energy of a packing in motion has come from and gone to (energy). `elastic` and `kinetic` are
/// present values, the others sums since the beginning.
struct EnergyTerms {
  double work = 0.0;     ///< done on the packing by its boundary
  double elastic = 0.0;  ///< stored in contacts, that of attractions included
  double kinetic = 0.0;  ///< of peculiar velocities and spins
  double viscous = 0.0;  ///< lost in dashpots
  double sliding = 0.0;  ///< lost by springs of friction, rolling and twisting at their caps
  double scaling = 0.0;  ///< lost by tangential forces whose stiffness varies with the load
  double removed = 0.0;  ///< taken out by setting all velocities to zero
  double initial = 0.0;  ///< elastic and kinetic at the beginning
  /// Put in by sharing liquid out, and by bridges that form: change of the elastic energy with their volumes.
  double liquid = 0.0;
  double law = 0.0;  ///< put in by changes of the contact law: change of the elastic energy where grains are
  double hysteresis = 0.0;  ///< lost along the normal, under laws that give back less than they took

  /// What the account leaves open: what was put in less everything else.
  double error() const {
    return work + initial - elastic - kinetic - viscous - sliding - scaling - hysteresis - removed + liquid +
           law;
  }
};

/// Keeps the energy account of a moving packing, from its state after each time step alone: work + liquid + law =
/// change of elastic + change of kinetic + viscous + sliding + scaling + hysteresis + removed, up to an error that vanishes with the
/// time step to first order (dashpots, caps and liquid) or second (without them).
template <int Dim>
class EnergyAccount {
 public:
  /// @throws InputError if the packing has walls
  explicit EnergyAccount(Packing<Dim> start);

  /// Adds one time step. @param now  the same grains after it, their contacts as the law has them
  void advance(const Packing<Dim>& now, double time_step);

  /// Exchanges the law of the present packing, as a step of a load path does that begins with another one: springs are
  /// kept, forces are those of the new law, and liquid is shared out anew.
  void change_law(const Law& law);
  const Law& law() const { return previous_.law; }

  /// Goes on from an account that was kept up to the present packing.
  void continue_from(const EnergyTerms& terms) { terms_ = terms; }

  const EnergyTerms& terms() const { return terms_; }

 private:
  Packing<Dim> previous_;
  EnergyTerms terms_;
};

}  // namespace floc
