#include "floc/fitting/compression_starts.h"

#include <algorithm>
#include <cmath>

#include "floc/base/dense_solvers.h"
#include "floc/base/infinity.h"
#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

/// Returns starting values of D0: the given value, or several values below the first solid fraction.
std::vector<double> values_of_D0(const CompressionPoints& points, double D0) {
  if (D0 > 0.0) return {D0};
  std::vector<double> values;
  for (const double share : {0.999, 0.95, 0.85, 0.7}) values.push_back(share * points.D[0]);
  return values;
}

/// Points in Heckel's coordinates P and y = ln[1/(1 - D)], before the first point with D >= 1. The weights of D are
/// converted to weights of y.
struct HeckelPoints {
  Eigen::VectorXd P, y, weight;
};

HeckelPoints heckel_points(const CompressionPoints& points) {
  const auto n = static_cast<Eigen::Index>(
      std::find_if(points.D.begin(), points.D.end(), [](double D) { return D >= 1.0; }) - points.D.begin());
  const Eigen::VectorXd pores = 1.0 - points.D.head(n).array();
  return {points.P.head(n), -pores.array().log(), points.weight.head(n).cwiseProduct(pores)};
}

/// Result of a test whether ln[1/(1 - D)] is a straight function of P.
struct Straightness {
  bool is_straight;
  double t;  ///< magnitude of the quadratic term divided by its standard error
};

Straightness straightness(const HeckelPoints& h, Eigen::Index first, Eigen::Index n) {
  constexpr double kSmallChange = 0.1;  // largest change of the slope from end to end, divided by the slope
  constexpr double kRounding = 1e-9;
  const Eigen::ArrayXd w = h.weight.segment(first, n);
  const Eigen::ArrayXd P = h.P.segment(first, n);
  const double half = 0.5 * (P[n - 1] - P[0]);
  const Eigen::ArrayXd x = (P - P.mean()) / half;
  Eigen::MatrixXd columns(n, 3);
  columns << w, w * x, w * x.square();
  const LinearFit parabola = fit_linear(columns, (w * h.y.segment(first, n).array()).matrix());
  const double slope = parabola.coefficients[1], curvature = parabola.coefficients[2];
  const double error = std::max(std::sqrt(parabola.covariance(2, 2)), kRounding);
  const double t = std::abs(curvature) / error;
  if (slope <= 0.0) return {false, t};
  const bool is_small = 4.0 * std::abs(curvature) < kSmallChange * slope;
  return {is_small || t < student_t_95(parabola.dof), t};
}

Eigen::VectorXd vector_of(std::initializer_list<double> values) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

std::vector<double> geometric(double low, double high, int n) {
  std::vector<double> values;
  for (int k = 0; k < n; ++k) values.push_back(low * std::pow(high / low, k / (n - 1.0)));
  return values;
}

}  // namespace

std::pair<int, int> straight_part(const CompressionPoints& points) {
  constexpr Eigen::Index kLeast = 4;
  constexpr Eigen::Index kPlaces = 60;  // number of positions to try for each end of the straight part
  const HeckelPoints h = heckel_points(points);
  const Eigen::Index n = h.P.size();
  const Eigen::Index step = std::max<Eigen::Index>(n / kPlaces, 1);
  for (Eigen::Index length = n; length >= kLeast; length -= step) {
    std::pair<Eigen::Index, double> best{-1, kInfinity};
    for (Eigen::Index first = 0; first + length <= n; first += step)
      if (const Straightness s = straightness(h, first, length); s.is_straight && s.t < best.second)
        best = {first, s.t};
    if (best.first >= 0) return {static_cast<int>(best.first), static_cast<int>(length)};
  }
  return {0, static_cast<int>(points.P.size())};
}

template <>
std::vector<Eigen::VectorXd> starts_of<HeckelModel>(const CompressionPoints& points, double /*D0*/) {
  const HeckelPoints h = heckel_points(points);
  if (h.P.size() < 2) return {};
  const WeightedLine line = fit_weighted_line(h.P, h.y, h.weight);
  if (line.slope <= 0.0) return {};
  return {vector_of({-std::log(line.slope), line.intercept})};
}

template <>
std::vector<Eigen::VectorXd> starts_of<KawakitaModel>(const CompressionPoints& points, double D0) {
  std::vector<Eigen::VectorXd> starts;
  const double last = points.D[points.D.size() - 1];
  for (const double from : values_of_D0(points, D0))
    for (const double beyond : {1.01, 1.1, 1.3})
      for (const double P : geometric(points.P[0], points.P[points.P.size() - 1], 3))
        starts.push_back(vector_of({std::log(from), -std::log(P), std::log(beyond * last)}));
  return starts;
}

template <>
std::vector<Eigen::VectorXd> starts_of<CooperEatonModel>(const CompressionPoints& points, double D0) {
  const double first = points.P[0], last = points.P[points.P.size() - 1];
  struct Start {
    Eigen::VectorXd theta;
    double squares;
  };
  std::vector<Start> found;
  for (const double from : values_of_D0(points, D0)) {
    const Eigen::VectorXd filled = (1.0 - from * points.D.array().inverse()) / (1.0 - from);
    for (const double k1 : geometric(0.3 * first, last, 6))
      for (const double ratio : {3.0, 10.0, 50.0}) {
        Eigen::MatrixXd columns(points.P.size(), 2);
        columns << (-k1 * points.P.array().inverse()).exp(), (-ratio * k1 * points.P.array().inverse()).exp();
        const Eigen::VectorXd a = least_squares_solution(columns, filled).cwiseMax(1e-3);
        found.push_back(
            {vector_of({std::log(from), std::log(k1), std::log(ratio), std::log(a[0]), std::log(a[1])}),
             (columns * a - filled).squaredNorm()});
      }
  }
  std::sort(found.begin(), found.end(), [](const Start& a, const Start& b) { return a.squares < b.squares; });
  constexpr std::size_t kTried = 4;
  std::vector<Eigen::VectorXd> starts;
  for (std::size_t k = 0; k < std::min(kTried, found.size()); ++k) starts.push_back(found[k].theta);
  return starts;
}

template <>
std::vector<Eigen::VectorXd> starts_of<WalkerModel>(const CompressionPoints& points, double /*D0*/) {
  const WeightedLine line = fit_weighted_line(points.P.array().log(), points.D.cwiseInverse(),
                                              Eigen::VectorXd::Ones(points.P.size()));
  if (line.slope >= 0.0) return {};
  return {vector_of({std::log(-line.slope), line.intercept})};
}

template <>
std::vector<Eigen::VectorXd> starts_of<GurnhamModel>(const CompressionPoints& points, double /*D0*/) {
  const WeightedLine line = fit_weighted_line(points.P.array().log(), points.D, points.weight);
  if (line.slope <= 0.0) return {};
  return {vector_of({std::log(line.slope), line.intercept})};
}

template <>
std::vector<Eigen::VectorXd> starts_of<AdamsModel>(const CompressionPoints& points, double D0) {
  std::vector<Eigen::VectorXd> starts;
  for (const double from : values_of_D0(points, D0))
    for (const double alpha : {2.0, 8.0})
      for (const double P : geometric(points.P[0], points.P[points.P.size() - 1], 3))
        starts.push_back(vector_of({std::log(from), std::log(alpha * P), std::log(alpha)}));
  return starts;
}

}  // namespace floc
