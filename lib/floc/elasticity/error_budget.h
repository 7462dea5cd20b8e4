#pragma once

#include <optional>

#include "floc/elasticity/force_increments.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/rounding_floor.h"
#include "floc/packing/state.h"

namespace floc {

/// Parts of the error of a bulk modulus, in its unit, and the part that limits it.
struct ErrorBudget {
  double solver = 0.0;  ///< bound on the error left by solving and rounding (Moduli::B_error), in the unit of B
  /// Part of B that rests on undecided contacts: contacts whose elastic force is below the state's residual, or
  /// below its rounding floor where that is higher, might as well be open. Their part is the energy that they
  /// hold in an isotropic step. Absent where that step has no solution.
  std::optional<double> equilibrium;
  int n_undecided = 0;  ///< number of undecided contacts
  /// Scatter between samples as estimated from one: C11 and C22 (, C33) are equal but for it, and their range
  /// over Dim^2, the number of entries that B is the mean of, is of the order of its effect on B.
  double sampling = 0.0;
  RoundingFloor floor;    ///< rounding floor of the state (F1, F1/a^(Dim-1))
  double residual = 0.0;  ///< largest net force on a grain (F1)

  /// Returns the name of the largest part: "solver", "sampling", or the reason why contacts are undecided,
  /// which is "rounding" or "residual".
  const char* limit() const;
};

/// Computes the error budget of B.
/// @param network  the contacts that the moduli were computed from
/// @param step     response of that network to an isotropic step; null where it has none
template <int Dim>
ErrorBudget error_budget(const State<Dim>& state, const ContactNetwork<Dim>& network, const Moduli& moduli,
                         const StepResponse<Dim>* step);

}  // namespace floc
