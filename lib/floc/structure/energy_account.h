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

  /// What the account leaves open: work less everything else.
  double error() const { return work + initial - elastic - kinetic - viscous - sliding - scaling - removed; }
};

/// Keeps the energy account of a moving packing, from its state after each time step alone: work = change of
/// elastic + change of kinetic + viscous + sliding + scaling + removed, up to an error that vanishes with the
/// time step to first order (dashpots and caps) or second (without them).
template <int Dim>
class EnergyAccount {
 public:
  /// @throws InputError if the packing has walls
  explicit EnergyAccount(Packing<Dim> start);

  /// Adds one time step. @param now  the same grains after it, their contacts as the law has them
  void advance(const Packing<Dim>& now, double time_step);

  /// Goes on from an account that was kept up to the present packing.
  void continue_from(const EnergyTerms& terms) { terms_ = terms; }

  const EnergyTerms& terms() const { return terms_; }

 private:
  Packing<Dim> previous_;
  EnergyTerms terms_;
};

}  // namespace floc
