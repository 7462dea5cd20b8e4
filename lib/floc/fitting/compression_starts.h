#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "floc/fitting/compression_models.h"

namespace floc {

/// Points of a compression curve, in the order of growing pressure.
struct CompressionPoints {
  Eigen::VectorXd P;       ///< pressures, > 0
  Eigen::VectorXd D;       ///< solid fractions, > 0
  Eigen::VectorXd weight;  ///< factors by which the residuals of D are multiplied

  CompressionPoints range(Eigen::Index first, Eigen::Index n) const {
    return {P.segment(first, n), D.segment(first, n), weight.segment(first, n)};
  }
};

/// Returns starting points of theta for a model. A grid gives the values of some coordinates; straight lines fitted to
/// the points give coordinates in which the model is linear. The result may be empty if the solid fraction does not
/// grow with pressure.
/// @param D0  given solid fraction without pressure; 0 if it is fitted
template <class Model>
std::vector<Eigen::VectorXd> starts_of(const CompressionPoints& points, double D0);
template <>
std::vector<Eigen::VectorXd> starts_of<HeckelModel>(const CompressionPoints& points, double D0);
template <>
std::vector<Eigen::VectorXd> starts_of<KawakitaModel>(const CompressionPoints& points, double D0);
template <>
std::vector<Eigen::VectorXd> starts_of<CooperEatonModel>(const CompressionPoints& points, double D0);
template <>
std::vector<Eigen::VectorXd> starts_of<WalkerModel>(const CompressionPoints& points, double D0);
template <>
std::vector<Eigen::VectorXd> starts_of<GurnhamModel>(const CompressionPoints& points, double D0);
template <>
std::vector<Eigen::VectorXd> starts_of<AdamsModel>(const CompressionPoints& points, double D0);

/// Finds the longest part of a curve in which ln[1/(1 - D)] is a straight function of the pressure. Returns the index
/// of the first point of this part, and the number of its points. If no part with at least four points is straight,
/// returns the whole curve. A straight part contains no points with D >= 1.
std::pair<int, int> straight_part(const CompressionPoints& points);

}  // namespace floc
