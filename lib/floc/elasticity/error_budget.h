#pragma once

#include <optional>

#include "floc/elasticity/force_increments.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/rounding_floor.h"
#include "floc/packing/state.h"

namespace floc {

/// Contributions to the error of a bulk modulus B, in the unit of B (force/length^(Dim-1)).
struct ErrorBudget {
  double solver = 0.0;  ///< bound on the error from solving and rounding (Moduli::B_error)
  /// Contribution to B of the undecided contacts, which might as well be open: their elastic force is below the
  /// residual of the state, or below the rounding floor of the residual if that is higher. The contribution is B times
  /// their share of the elastic energy in an isotropic step of stress. Absent if there is no response to that step.
  std::optional<double> equilibrium;
  int n_undecided = 0;  ///< number of undecided contacts
  /// Scatter of B between samples, estimated from one sample. In a large isotropic sample, C11, C22 (and C33) would be
  /// equal. Their range divided by Dim^2, the number of entries of C that B averages, estimates the scatter of B.
  double sampling = 0.0;
  /// Smallest residuals that rounding allows: net force over the force scale F1 of `residual`, and stress over
  /// F1/a^(Dim-1), with the largest diameter a.
  RoundingFloor floor;
  /// largest net force on a grain over F1 = max(F0, P a^(Dim-1)) (pull-off force F0, pressure P, largest diameter a)
  double residual = 0.0;

  /// Returns the name of the largest contribution: "solver", "sampling", or, if it is `equilibrium`, the reason why
  /// contacts are undecided: "rounding" or "residual".
  const char* limit() const;
};

/// Computes the error budget of the bulk modulus B.
/// @param network  contact network from which the moduli were computed
/// @param moduli   moduli of that network
/// @param step     response of that network to an isotropic step of stress; null if there is none
template <int Dim>
ErrorBudget error_budget(const State<Dim>& state, const ContactNetwork<Dim>& network, const Moduli& moduli,
                         const StepResponse<Dim>* step);

}  // namespace floc
