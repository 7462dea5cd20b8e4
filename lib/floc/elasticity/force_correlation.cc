#include "floc/elasticity/force_correlation.h"

#include <cassert>
#include <cmath>

namespace floc {
namespace {

std::optional<double> pearson(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.empty()) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(x.size());
  const Eigen::ArrayXd u = Eigen::Map<const Eigen::ArrayXd>(x.data(), n);
  const Eigen::ArrayXd v = Eigen::Map<const Eigen::ArrayXd>(y.data(), n);
  const Eigen::VectorXd du = u - u.mean(), dv = v - v.mean();
  // Values count as equal if their relative deviation from the mean is at most this number; rounding alone may cause
  // such a deviation.
  constexpr double kVaries = 1e-12;
  if (!(du.norm() > kVaries * u.matrix().norm()) || !(dv.norm() > kVaries * v.matrix().norm()))
    return std::nullopt;
  return du.dot(dv) / (du.norm() * dv.norm());
}

}  // namespace

template <int Dim>
ForceCorrelation force_correlation(const ContactNetwork<Dim>& network,
                                   const std::vector<ForceIncrement<Dim>>& increments) {
  assert(increments.size() == network.contacts.size());
  std::vector<double> normal, added_normal, size, added_size;
  for (std::size_t k = 0; k < increments.size(); ++k) {
    const NetworkContact<Dim>& c = network.contacts[k];
    if (c.distant) continue;
    normal.push_back(c.normal_force);
    added_normal.push_back(increments[k].normal);
    size.push_back(std::hypot(c.normal_force, c.shear_force.norm()));
    added_size.push_back(std::hypot(increments[k].normal, increments[k].shear.norm()));
  }
  return {pearson(normal, added_normal), pearson(size, added_size)};
}

template ForceCorrelation force_correlation(const ContactNetwork<2>&, const std::vector<ForceIncrement<2>>&);
template ForceCorrelation force_correlation(const ContactNetwork<3>&, const std::vector<ForceIncrement<3>>&);

}  // namespace floc
