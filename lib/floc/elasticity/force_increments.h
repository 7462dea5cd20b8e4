#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Change of the forces of one contact, in its own frame: signs as in `Contact`.
template <int Dim>
struct ForceIncrement {
  double normal;                            ///< (force)
  Eigen::Matrix<double, Dim - 1, 1> shear;  ///< on i, along the tangents of the contact's frame (force)
  RotationVector<Dim> rolling_moment;       ///< on i (force * length)
  double twisting_moment;                   ///< on i about the normal, of spheres (force * length)
};

/// Computes the forces that a small strain adds in every contact, with none sliding: k G U for the response U.
/// Without prestress, the forces of dead ends do not change.
/// @param strain  one entry per strain unknown of the response, shortening positive
template <int Dim>
std::vector<ForceIncrement<Dim>> force_increments(const ContactNetwork<Dim>& network,
                                                  const ElasticResponse& response,
                                                  const Eigen::VectorXd& strain);

enum class StressStep {
  isotropic,   ///< every diagonal stress grows by one
  deviatoric,  ///< sigma_11 grows by one, the others fall by 1/(Dim - 1)
};

/// Response to a small step of the diagonal stresses, with shear strains clamped, per unit of stress.
template <int Dim>
struct StepResponse {
  Eigen::VectorXd strain;                       ///< diagonal (1/stress)
  std::vector<ForceIncrement<Dim>> increments;  ///< one per contact (force/stress)
  /// Elastic energy of the increments of each contact, 1/2 sum f^2/k, negative for a distant attraction; their
  /// sum is half the work of the stress, V (strain . stress)/2 (energy/stress^2).
  std::vector<double> energy;
  std::vector<int> rank;  ///< rank of each contact by that energy, 0 for the largest
  /// The first `n_holding` in rank hold 95 % of the energy of all contacts that touch.
  int n_holding = 0;
  double energy_share_95 = 0.0;  ///< n_holding over the number of contacts that touch
};

/// Computes the response to a small step of the diagonal stresses.
/// @return nothing if the step does work on a strain that costs nothing, or if there are no contacts.
/// @pre the response is without prestress.
template <int Dim>
std::optional<StepResponse<Dim>> step_response(const ContactNetwork<Dim>& network,
                                               const ElasticResponse& response, StressStep step);

}  // namespace floc
