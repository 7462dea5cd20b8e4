#pragma once

#include <optional>

#include "floc/elasticity/force_increments.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/rounding_floor.h"
#include "floc/packing/state.h"

namespace floc {

/// What the error of a bulk modulus is made of, and which part limits it.
struct ErrorBudget {
  double solver = 0.0;  ///< bound of what solving and rounding leave (Moduli::B_error), in the unit of B
  /// The part of B that is not decided: contacts whose elastic force is below the state's residual, or below
  /// its rounding floor where that is higher, might as well be open. Their part is the energy that they hold in
  /// an isotropic step. Absent where that step has no solution.
  std::optional<double> equilibrium;
  int n_undecided = 0;  ///< those contacts
  /// Scatter between samples as estimated from one: C11 and C22 (, C33) are equal but for it, and their range
  /// over Dim^2, the number of entries that B is the mean of, is of the order of its effect on B.
  double sampling = 0.0;
  RoundingFloor floor;    ///< of the state (F1, F1/a^(Dim-1))
  double residual = 0.0;  ///< largest net force on a grain (F1)

  /// "solver", "rounding" or "residual" (what leaves contacts undecided), or "sampling": the largest part.
  const char* limit() const;
};

/// @param network  the contacts that the moduli were computed from
/// @param step     response of that network to an isotropic step; null where it has none
template <int Dim>
ErrorBudget error_budget(const State<Dim>& state, const ContactNetwork<Dim>& network, const Moduli& moduli,
                         const StepResponse<Dim>* step);

}  // namespace floc
