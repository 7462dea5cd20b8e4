#pragma once

#include <optional>
#include <vector>

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Change of the forces and moments of one contact, as components in the frame of the contact, with the sign
/// conventions of `Contact`.
template <int Dim>
struct ForceIncrement {
  double normal;  ///< change of the normal force (force)
  Eigen::Matrix<double, Dim - 1, 1>
      shear;  ///< change of the tangential force on grain i, along the tangents of the frame (force)
  RotationVector<Dim> rolling_moment;  ///< change of the rolling moment on grain i (force * length)
  double twisting_moment;  ///< change of the moment on grain i about the normal, in 3D (force * length)
};

/// Computes the forces k G U that a small strain of the cell adds in every contact if no contact slides. Here k
/// contains the contact stiffnesses, G is the rigidity matrix, and U contains the strains and the motions of the
/// grains. Without prestress, the forces on dead ends (grains that hang on a single contact) do not change.
/// @param strain  strains of the cell, in the order in which the response contains them, shortening positive
template <int Dim>
std::vector<ForceIncrement<Dim>> force_increments(const ContactNetwork<Dim>& network,
                                                  const ElasticResponse& response,
                                                  const Eigen::VectorXd& strain);

enum class StressStep {
  isotropic,   ///< every diagonal stress increases by 1
  deviatoric,  ///< sigma_11 increases by 1, every other diagonal stress decreases by 1/(Dim - 1)
};

/// Response of a network to a small step of the diagonal stresses, per unit of stress. Shear strains are fixed at zero.
template <int Dim>
struct StepResponse {
  Eigen::VectorXd strain;                       ///< diagonal strains of the cell (1/stress)
  std::vector<ForceIncrement<Dim>> increments;  ///< increment of the forces in each contact, per unit of stress
  /// Elastic energy 1/2 sum f^2/k of each contact (energy/stress^2), with the force increments f and the stiffnesses k;
  /// negative for an attraction across a gap. The sum over all contacts is half the work of the stress, V/2 times the
  /// scalar product of strain and stress, with the volume V.
  std::vector<double> energy;
  std::vector<int> rank;  ///< position (from 0) of each contact in the list sorted by descending energy
  /// Smallest number of touching contacts that together have 95 % of the elastic energy of all touching contacts.
  int n_holding = 0;
  double energy_share_95 = 0.0;  ///< `n_holding` divided by the number of touching contacts
};

/// Computes the response of a network to a small step of the diagonal stresses.
/// @param response  elastic response of the network, computed without prestress
/// @return no value if the stress does work on a strain that no stiffness resists, or if there are no contacts
template <int Dim>
std::optional<StepResponse<Dim>> step_response(const ContactNetwork<Dim>& network,
                                               const ElasticResponse& response, StressStep step);

}  // namespace floc
