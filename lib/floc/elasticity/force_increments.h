#pragma once

#include <vector>

#include "floc/elasticity/elastic_response.h"

namespace floc {

/// Change of the forces of one contact, in its own frame: signs as in `Contact`.
template <int Dim>
struct ForceIncrement {
  double normal;                            ///< (force)
  Eigen::Matrix<double, Dim - 1, 1> shear;  ///< on i, along the tangents of the contact's frame (force)
  Spin<Dim> rolling_moment;                 ///< on i (force * length)
};

/// Forces that a small strain adds in every contact, nothing sliding: k G U for the response U.
/// @param strain  one entry a strain unknown of the response, shortening positive
template <int Dim>
std::vector<ForceIncrement<Dim>> force_increments(const ContactNetwork<Dim>& network,
                                                  const ElasticResponse& response,
                                                  const Eigen::VectorXd& strain);

}  // namespace floc
