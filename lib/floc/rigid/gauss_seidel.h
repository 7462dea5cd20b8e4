#pragma once

#include <memory>
#include <vector>

#include "floc/base/instruction_set.h"
#include "floc/rigid/step_contact.h"

namespace floc {

/// Result of the sweeps of a step.
struct SweepResult {
  int n_sweeps = 0;
  /// Largest contact_error(), divided by the mean of the nonzero normal impulses.
  double residual = 0.0;
  bool converged = false;
};

template <int Dim>
class ContactSweeps;

/// Non-linear Gauss-Seidel method for the contacts of one implicit time step (Moreau 1988; Jean 1999). Contacts of one
/// colour share no body that moves, so the result does not depend on their order and is bitwise identical for any
/// number of threads. After each sweep, the impulses are extrapolated in the direction of their earlier changes
/// (Silcowitz-Hansen, Niebe and Erleben 2010); without this extrapolation, many times more sweeps would be needed.
///
/// Every contact changes the rate of stretch of the cell, but this rate is updated only after each colour. The delay
/// could add energy. To prevent this, the response of the cell to each contact is multiplied by the number of contacts
/// of the colour. The solution does not depend on this factor.
template <int Dim>
class GaussSeidel {
 public:
  /// Prepares the contacts of a step. Their present impulses are the initial values. Contacts between two bodies that
  /// cannot move are not changed.
  /// @param bodies   motion of the bodies; the velocities contain all external impulses, but no impulses of contacts
  /// @param threads  number of threads, >= 1. A colour with few contacts is solved by one thread.
  /// @param instructions  instruction set of the sweeps; the results do not depend on it
  /// @pre bodies and contacts outlive this object
  GaussSeidel(BodyMotion<Dim>& bodies, std::vector<StepContact<Dim>>& contacts, int threads = 1,
              InstructionSet instructions = widest_instruction_set());
  ~GaussSeidel();

  /// Sweeps over all contacts until the residual is below a tolerance. Afterwards the velocities of the bodies are
  /// those at the end of the step, including the impulses of the contacts. The next call continues from this result.
  /// @param check_every  number of sweeps from one computation of the residual to the next
  /// @throws InputError if OpenMP cannot start that many threads
  SweepResult solve(double tolerance, int max_sweeps, int check_every = 10);

  /// Returns the number of colours of the contacts.
  int n_colours() const;

  /// Returns the largest contact_error() of the present impulses, divided by the mean of the nonzero normal impulses.
  /// The error is computed with the response of the cell that is used in the sweeps.
  double residual() const;

 private:
  std::unique_ptr<ContactSweeps<Dim>> sweeps_;
};

}  // namespace floc
