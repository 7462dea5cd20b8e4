#pragma once

#include <memory>
#include <vector>

#include "floc/rigid/step_contact.h"

namespace floc {

/// Result of the sweeps of a step.
struct SweepResult {
  int n_sweeps = 0;
  /// Largest contact_error(), divided by the mean normal impulse of the contacts that carry an impulse.
  double residual = 0.0;
  bool converged = false;
};

template <int Dim>
class ContactSweeps;

/// Non-linear Gauss-Seidel method for the contacts of one implicit time step (Moreau 1988; Jean 1999). Contacts of one
/// colour share no body that moves, so the result does not depend on the order within a colour and is bitwise identical
/// for any number of threads. After each sweep, the impulses are extrapolated in the direction of their earlier changes
/// (Silcowitz-Hansen, Niebe and Erleben 2010), which saves most of the sweeps.
///
/// All contacts move the cell. The rate of stretch of the cell is updated after each colour. To keep this delay from
/// adding energy, the response of a contact contains the response of the cell once for each contact of the colour. The
/// solution does not depend on this.
template <int Dim>
class GaussSeidel {
 public:
  /// Takes the contacts of a step, with their present impulses as initial values. Contacts of two bodies that cannot
  /// move are left unchanged.
  /// @param bodies   velocities without the impulses of the contacts, to which all external impulses have been added
  /// @param threads  number of threads, >= 1. Colours with few contacts are solved by one thread.
  /// @pre bodies and contacts outlive this object
  GaussSeidel(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts, int threads = 1);
  ~GaussSeidel();

  /// Sweeps over all contacts until the residual is below a tolerance. Afterwards the bodies have the velocities at the
  /// end of the step, with the impulses of the contacts. Another call continues from there.
  /// @param check_every  number of sweeps between two computations of the residual
  /// @throws InputError if OpenMP cannot start that many threads
  SweepResult solve(double tolerance, int max_sweeps, int check_every = 10);

  /// Number of colours of the contacts.
  int n_colours() const;

  /// Returns the largest contact_error() of the present impulses, divided by the mean of the nonzero normal impulses.
  /// It contains the response of the cell that the sweeps use.
  double residual() const;

 private:
  std::unique_ptr<ContactSweeps<Dim>> sweeps_;
};

}  // namespace floc
