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
  /// Contribution of undecided contacts: B times the share of these contacts in the elastic energy of an isotropic step
  /// of stress. A contact is undecided (it may be open or closed) if its elastic force is below the residual of the
  /// state, or below the smallest residual that rounding allows, whichever residual is larger. Absent if there is no
  /// response to an isotropic step of stress.
  std::optional<double> equilibrium;
  int n_undecided = 0;  ///< number of undecided contacts
  /// Scatter of B between samples, estimated from one sample: the range of the moduli C11, C22 (and C33), divided by
  /// Dim^2, because B is the mean of Dim^2 moduli. In a large isotropic sample, the moduli C11, C22 (and C33) would be
  /// equal.
  double sampling = 0.0;
  /// Smallest residuals that rounding allows: net force divided by F1, and stress divided by F1/a^(Dim-1). The member
  /// `residual` defines the force scale F1 and the largest diameter a.
  RoundingFloor floor;
  /// largest net force on a grain divided by F1 = max(F0, P a^(Dim-1)) (pull-off force F0, pressure P, largest diameter
  /// a)
  double residual = 0.0;

  /// Returns the name of the largest contribution: "solver", "sampling" or, for `equilibrium`, the reason why contacts
  /// are undecided: "rounding" or "residual".
  const char* limit() const;
};

/// Computes the contributions to the error of the bulk modulus B.
/// @param network  contact network from which the moduli were computed
/// @param moduli   moduli of that network
/// @param step     response of that network to an isotropic step of stress; null if there is none
template <int Dim>
ErrorBudget error_budget(const State<Dim>& state, const ContactNetwork<Dim>& network, const Moduli& moduli,
                         const StepResponse<Dim>* step);

}  // namespace floc
