#pragma once

#include <optional>

#include "floc/elasticity/force_increments.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/rounding_floor.h"
#include "floc/packing/state.h"

namespace floc {

/// Contributions to the error of a bulk modulus B, in its unit, and the name of the largest one.
struct ErrorBudget {
  double solver = 0.0;  ///< bound on the error from solving and rounding (Moduli::B_error), in the unit of B
  /// Part of B that depends on undecided contacts. These contacts have an elastic force below the residual of the
  /// state, or below its rounding floor if that is higher, so that they might as well be open. The part of B is their
  /// share of the elastic energy in an isotropic step. Absent if there is no response to that step.
  std::optional<double> equilibrium;
  int n_undecided = 0;  ///< number of undecided contacts
  /// Scatter of B between samples, estimated from one sample (same unit as B). C11, C22 (and C33) would be equal in a
  /// large isotropic sample; their range divided by Dim^2, the number of entries that B averages, estimates the scatter
  /// of B.
  double sampling = 0.0;
  RoundingFloor
      floor;  ///< smallest residuals that rounding allows: net force (over F1), stress (over F1/a^(Dim-1))
  double residual = 0.0;  ///< largest net force on a grain, over F1 = max(F0, P a^(Dim-1))

  /// Returns the name of the largest contribution: "solver", "sampling", or the reason why contacts are undecided,
  /// "rounding" or "residual".
  const char* limit() const;
};

/// Computes the error budget of the bulk modulus B.
/// @param network  contacts from which the moduli were computed
/// @param step     response of that network to an isotropic step of stress; null if there is none
template <int Dim>
ErrorBudget error_budget(const State<Dim>& state, const ContactNetwork<Dim>& network, const Moduli& moduli,
                         const StepResponse<Dim>* step);

}  // namespace floc
