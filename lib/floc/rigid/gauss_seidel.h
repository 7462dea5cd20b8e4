#pragma once

#include <memory>
#include <vector>

#include "floc/rigid/step_contact.h"

namespace floc {

/// Result of the sweeps of a step.
struct SweepResult {
  int n_sweeps = 0;
  /// Largest contact_error() over the mean normal impulse of the contacts that carry one.
  double residual = 0.0;
  bool converged = false;
};

template <int Dim>
class ContactSweeps;

/// Non-linear Gauss-Seidel method for the contacts of one implicit time step. Contacts of one colour share no body that
/// moves, so that the result does not depend on the order within a colour: it has the same bits for any number of
/// threads. Moreau 1988; Jean 1999. After each sweep, the impulses go on in the direction of earlier changes
/// (Silcowitz-Hansen, Niebe and Erleben 2010), which saves most of the sweeps.
///
/// All contacts move the cell. Its rate of stretch is renewed after each colour, and the response of a contact contains
/// that of the cell once for each contact of the colour, so that the delay cannot add energy. The solution does not
/// depend on this.
template <int Dim>
class GaussSeidel {
 public:
  /// Takes the contacts of a step with their impulses as a start. Contacts of two bodies that nothing moves are left as
  /// they are.
  /// @param bodies   velocities without the impulses of the contacts, to which all external impulses have been added
  /// @param threads  number of threads, >= 1. Colours with few contacts are solved by one of them.
  /// @pre bodies and contacts outlive this object
  GaussSeidel(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts, int threads = 1);
  ~GaussSeidel();

  /// Sweeps over all contacts until the residual is below a tolerance. Afterwards the bodies have the velocities at the
  /// end of the step, with the impulses of the contacts. Another call goes on from there.
  /// @param check_every  number of sweeps between two computations of the residual
  /// @throws InputError if OpenMP cannot start that many threads
  SweepResult solve(double tolerance, int max_sweeps, int check_every = 10);

  /// Number of colours of the contacts.
  int n_colours() const;

  /// Largest contact_error() of the present impulses over the mean of the normal impulses that are not zero. The response of the cell in it is
  /// that of the sweeps.
  double residual() const;

 private:
  std::unique_ptr<ContactSweeps<Dim>> sweeps_;
};

}  // namespace floc
