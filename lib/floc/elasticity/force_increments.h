#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Change of the forces and moments of one contact, in the frame of the contact, with the signs of `Contact`.
template <int Dim>
struct ForceIncrement {
  double normal;  ///< change of the normal force (force)
  Eigen::Matrix<double, Dim - 1, 1>
      shear;                           ///< tangential force on grain i, along the tangents of the frame (force)
  RotationVector<Dim> rolling_moment;  ///< rolling moment on grain i (force * length)
  double twisting_moment;              ///< moment on grain i about the normal, in 3D (force * length)
};

/// Computes the forces that a small strain adds in every contact if no contact slides: k G U, with the contact
/// stiffnesses k, the rigidity matrix G and the response U. Without prestress, the forces of dead ends do not change.
/// @param strain  one entry per strain unknown of the response, shortening positive
template <int Dim>
std::vector<ForceIncrement<Dim>> force_increments(const ContactNetwork<Dim>& network,
                                                  const ElasticResponse& response,
                                                  const Eigen::VectorXd& strain);

enum class StressStep {
  isotropic,   ///< every diagonal stress increases by one
  deviatoric,  ///< sigma_11 increases by one, the other diagonal stresses decrease by 1/(Dim - 1)
};

/// Response of a network to a small step of the diagonal stresses, with shear strains fixed at zero, per unit of
/// stress.
template <int Dim>
struct StepResponse {
  Eigen::VectorXd strain;                       ///< diagonal strains (1/stress)
  std::vector<ForceIncrement<Dim>> increments;  ///< increment of the forces in each contact (force/stress)
  /// Elastic energy 1/2 sum f^2/k of the increments f in each contact, negative for an attraction across a gap
  /// (energy/stress^2). The sum over all contacts is half the work of the stress, V (strain . stress)/2.
  std::vector<double> energy;
  std::vector<int> rank;  ///< rank of each contact by `energy`, 0 for the largest
  /// Number of touching contacts of highest energy that together hold 95 % of the energy of all touching contacts.
  int n_holding = 0;
  double energy_share_95 = 0.0;  ///< `n_holding` over the number of touching contacts
};

/// Computes the response of a network to a small step of the diagonal stresses.
/// @return no value if the step does work on a strain that no stiffness resists, or if there are no contacts
/// @pre the response was computed without prestress
template <int Dim>
std::optional<StepResponse<Dim>> step_response(const ContactNetwork<Dim>& network,
                                               const ElasticResponse& response, StressStep step);

}  // namespace floc
