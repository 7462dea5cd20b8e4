#include "floc/fitting/consolidation_bootstrap.h"

#include <algorithm>
#include <cmath>

#include "floc/base/interruption.h"
#include "floc/base/random.h"
#include "floc/fitting/least_squares.h"
#include "floc/fitting/regimes.h"

namespace floc {
namespace {

/// Draws n - 1 of the n samples, with replacement. Returns the mean of 1/Phi over the drawn samples at each point:
/// first at the points of the plateau, then at the other points fitted.
Eigen::VectorXd mean_of_draw(const Eigen::MatrixXd& samples, RandomStream& random) {
  const Eigen::Index n_drawn = samples.cols() - 1;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(samples.rows());
  for (Eigen::Index k = 0; k < n_drawn; ++k)
    sum += samples.col(static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(samples.cols()))));
  return sum / static_cast<double>(n_drawn);
}

/// Fitted values and residuals of a fit. The bootstrap draws residuals and adds them to the fitted values. Each
/// residual is enlarged according to the leverage of its point, so that all residuals have the same variance.
struct ResidualPool {
  Eigen::VectorXd fitted, weight, residuals;

  explicit ResidualPool(const LawEstimate& e) {
    const Eigen::Index n_plateau = e.plateau.size();
    const Eigen::Index n = e.points.size();
    fitted.resize(n_plateau + n);
    weight.resize(n_plateau + n);
    fitted.head(n_plateau) = e.plateau.log_P.unaryExpr([&e](double log_P) { return e.line.at(log_P); });
    fitted.tail(n) = e.points.y + e.solution.residuals.cwiseQuotient(e.points.weight);
    weight << e.plateau.weight, e.points.weight;
    const Eigen::MatrixXd& J = e.solution.jacobian;
    const Eigen::VectorXd leverage = (J * unit_covariance(J)).cwiseProduct(J).rowwise().sum();
    residuals = e.solution.residuals.array() / (1.0 - leverage.array()).max(0.01).sqrt();
    residuals.array() -= residuals.mean();
  }

  Eigen::VectorXd draw(RandomStream& random) const {
    Eigen::VectorXd y = fitted;
    for (Eigen::Index i = 0; i < y.size(); ++i)
      y[i] += residuals[static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(residuals.size())))] /
              weight[i];
    return y;
  }
};

FittedParameter summary(const std::string& name, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const Eigen::Map<const Eigen::ArrayXd> v(values.data(), static_cast<Eigen::Index>(values.size()));
  const double mean = v.mean();
  const double deviation = std::sqrt((v - mean).square().sum() / static_cast<double>(values.size() - 1));
  const auto quantile = [&](double q) {
    return values[static_cast<std::size_t>(std::lround(q * static_cast<double>(values.size() - 1)))];
  };
  return {name, mean, deviation, quantile(0.025), quantile(0.975), true};
}

}  // namespace

Resampled resample(const LawEstimate& estimate, const Eigen::MatrixXd& samples, int n, std::uint64_t seed) {
  constexpr std::uint64_t kPurpose = 0xb0075;
  RandomStream random(seed, kPurpose);
  const ResidualPool pool(estimate);
  const Eigen::Index n_plateau = estimate.plateau.size();
  std::vector<std::string> names;
  for (const Quantity& q : quantities_of(estimate)) names.push_back(q.name);
  std::vector<std::vector<double>> values(names.size());
  Resampled found;
  // All bootstrap fits use the pressures, the weights and the ends of the regimes of the original fit. The bootstrap
  // therefore gives the scatter of the parameters for one choice of the regimes. A fit that leaves fewer than three
  // points to regime II does not count.
  for (int k = 0; k < n; ++k) {
    check_interruption();
    const Eigen::VectorXd y = samples.cols() >= 2 ? mean_of_draw(samples, random) : pool.draw(random);
    LawEstimate drawn = estimate;
    drawn.points.y = y.tail(estimate.points.size());
    drawn.plateau.y = y.head(n_plateau);
    if (drawn.has_plateau()) drawn.line = recompression_line(drawn.plateau, estimate.line.slopes);
    const auto solution = solve_law_from(estimate.law, drawn.points, estimate.solution.theta);
    if (!solution || !keeps_regime_two(estimate.law, drawn.points, *solution)) continue;
    drawn.solution = *solution;
    const std::vector<Quantity> quantities = quantities_of(drawn);
    for (std::size_t q = 0; q < quantities.size(); ++q) values[q].push_back(quantities[q].parameter());
    ++found.n;
  }
  if (found.n < 2) return found;
  for (std::size_t q = 0; q < names.size(); ++q) found.parameters.push_back(summary(names[q], values[q]));
  return found;
}

}  // namespace floc
