#include "floc/fitting/regimes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "floc/base/dense_solvers.h"
#include "floc/base/infinity.h"
#include "floc/fitting/law_estimate.h"

namespace floc {
namespace {

using Law = ConsolidationLaw;

/// Returns the Bayesian information criterion of a least-squares fit, up to a constant that depends only on the data.
/// @param n_free  number of fitted parameters
double information(double sum_of_squares, int n, int n_free) {
  const double floor = n * kRoundingOfTables * kRoundingOfTables;
  return n * std::log(std::max(sum_of_squares, floor) / n) + n_free * std::log(n);
}

int n_below(const LawPoints& points, double log_P) {
  return static_cast<int>((points.log_P.array() < log_P).count());
}

/// Fits a constant to 1/Phi (Phi is the solid fraction), and returns the weighted sum of squared residuals.
double residual_of_constant(const LawPoints& points) {
  if (points.size() == 0) return 0.0;
  const Eigen::ArrayXd w2 = points.weight.array().square();
  const double mean = (w2 * points.y.array()).sum() / w2.sum();
  return (w2 * (points.y.array() - mean).square()).sum();
}

bool less_information(const Place& a, const Place& b) {
  return a.information < b.information;
}

/// Returns the weighted sum of squared residuals of the plateau, which consists of the first `k` points. The level of
/// the plateau is limited to the values of the law between the last point of the plateau and the next point.
/// @param theta  solution of the law fitted to the points after the plateau
double residual_of_plateau(Law law, const LawPoints& points, int k, const Eigen::VectorXd& theta) {
  if (k == 0) return 0.0;
  const double first = points.log_P[k];
  const double level =
      std::clamp(recompression_line(points.range(0, k), false).level, law_value(law, theta, first, first),
                 law_value(law, theta, points.log_P[k - 1], first));
  return (points.weight.head(k).array() * (points.y.head(k).array() - level)).square().sum();
}

/// Returns a possible end of the plateau of regime I, between the points `k - 1` and `k`, with its information
/// criterion. The points before this end are fitted by a plateau, and the points after it by the law.
/// @param theta  solution of the law fitted to the points after the plateau
/// @param left   sum of squared residuals of the points after the plateau
Place plateau_end(Law law, const LawPoints& points, int k, const Eigen::VectorXd& theta, double left) {
  // The end of the plateau counts as one more fitted parameter.
  return {k, information(left + residual_of_plateau(law, points, k, theta), points.size(),
                         n_parameters(law) + (k > 0 ? 1 : 0))};
}

/// Returns the possible ends of the plateau of regime I if the points after the plateau follow the full law. An end is
/// left out if fewer than three points lie between this end and P1*, where regime III begins.
std::vector<Place> ends_before_full_law(const LawPoints& points) {
  // The search stops when this number of consecutive plateaus have left too few points to regime II: if a plateau
  // reaches P1*, where regime III begins, all longer plateaus also leave too few points.
  constexpr int kGiveUp = 3;
  std::vector<Place> places;
  std::optional<Eigen::VectorXd> theta;
  const int n = points.size();
  int n_failed = 0;
  for (int k = 0; n - k > n_parameters(Law::full) && n_failed < kGiveUp; ++k) {
    const LawPoints rest = points.range(k, n - k);
    // Each fit has one point less than the previous fit. The solver starts from the previous solution, and also from a
    // new starting point, because the point now left out may have hidden the bend of the law.
    double left = kInfinity;
    if (theta) left = minimize_law(Law::full, rest, *theta);
    if (auto other = start_of_law(Law::full, rest, theta ? 1 : 4)) {
      const double residual_of_other = minimize_law(Law::full, rest, *other);
      if (!(left <= residual_of_other)) left = residual_of_other, theta = other;
    }
    ++n_failed;
    if (!std::isfinite(left) || n_below(rest, (*theta)[3]) < kMinInRegimeTwo) continue;
    places.push_back(plateau_end(Law::full, points, k, *theta, left));
    n_failed = 0;
  }
  return places;
}

/// Returns the possible ends of the plateau of regime I if the points after the plateau follow the line of regime II.
std::vector<Place> ends_before_line(const LawPoints& points) {
  std::vector<Place> places;
  const int n = points.size();
  for (int k = 0; n - k >= kMinInRegimeTwo; ++k)
    if (const auto theta = start_of_law(Law::log, points.range(k, n - k), 1))
      places.push_back(plateau_end(Law::log, points, k, *theta, *residual_of_line(points.range(k, n - k))));
  return places;
}

/// Returns the possible beginnings of regime III. A line in ln P* is fitted to the points before the beginning, and a
/// power law to the points after it. Each part has at least one point more than its law has parameters.
std::vector<Place> onsets_of_three(const LawPoints& points) {
  std::vector<Place> places;
  const int n = points.size();
  for (int k = kMinInRegimeTwo; n - k > n_parameters(Law::power); ++k) {
    const auto line = residual_of_line(points.range(0, k));
    const auto power = residual_of_power_law(points.range(k, n - k));
    // Of the six parameters, two belong to the line, three to the power law, and one is the place of the change.
    if (line && power) places.push_back({k, information(*line + *power, n, 6)});
  }
  return places;
}

/// Fits a linear function of the reduced pressure P* to 1/Phi, and returns the weighted sum of squared residuals.
double residual_of_elasticity(const LawPoints& points) {
  Eigen::MatrixXd columns(points.size(), 2);
  columns.col(0) = points.weight;
  columns.col(1) = points.weight.cwiseProduct(points.log_P.array().exp().matrix());
  const Eigen::VectorXd y = points.weight.cwiseProduct(points.y);
  return (y - columns * least_squares_solution(columns, y)).squaredNorm();
}

/// Finds the regimes of a curve with at most kMostPlaces points.
std::optional<Regimes> regimes_of(const LawPoints& points) {
  const int n = points.size();
  std::vector<Place> ends = ends_before_full_law(points);
  const std::vector<Place> line_ends = ends_before_line(points);
  // The curve has no separate regimes if a constant or an elastic line explains it better than a plateau followed by a
  // law.
  const double flat = std::min(information(residual_of_constant(points), n, 1),
                               information(residual_of_elasticity(points), n, 2));
  const auto explains_more = [flat](const Place& p) { return p.information < flat; };
  Regimes regimes;
  regimes.all_in_one = std::none_of(ends.begin(), ends.end(), explains_more) &&
                       std::none_of(line_ends.begin(), line_ends.end(), explains_more);
  if (regimes.all_in_one) return regimes;

  const auto least = [](const std::vector<Place>& places) {
    return places.empty() ? kInfinity
                          : std::min_element(places.begin(), places.end(), less_information)->information;
  };
  // Data that end before P1*, where regime III begins, do not determine the full law. The line of regime II, with fewer
  // parameters, then has the smaller information criterion.
  if (least(line_ends) < least(ends)) ends = line_ends;
  if (ends.empty()) return std::nullopt;
  const ChangePoint end = change_among(ends, 0);
  regimes.n_plateau = end.first;
  if (end.high95 > 0) regimes.plateau_end = end;

  const LawPoints rest = points.range(end.first, n - end.first);
  regimes.end_of_two = n;
  const std::vector<Place> onsets = onsets_of_three(rest);
  if (onsets.empty()) return regimes;
  const auto best = std::min_element(onsets.begin(), onsets.end(), less_information);
  // Regime III is reported only if a line followed by a power law has a smaller information criterion than one
  // line through all points after the plateau.
  const auto line = residual_of_line(rest);
  if (line && information(*line, rest.size(), n_parameters(Law::log)) <= best->information) return regimes;
  regimes.onset_three = change_among(onsets, end.first);
  regimes.end_of_two = regimes.onset_three->first;
  return regimes;
}

}  // namespace

ChangePoint change_among(std::vector<Place> places, int shift) {
  constexpr double kWorthNaming = 0.01;
  std::stable_sort(places.begin(), places.end(), less_information);
  const double least = places.front().information;
  double total = 0.0;
  for (const Place& p : places) total += std::exp(0.5 * (least - p.information));
  const int best = places.front().first + shift;
  ChangePoint change{best, best, best, {}};
  double held = 0.0;
  for (const Place& p : places) {
    const ChangePlace place{p.first + shift, std::exp(0.5 * (least - p.information)) / total};
    if (held < 0.95) {
      change.low95 = std::min(change.low95, place.first);
      change.high95 = std::max(change.high95, place.first);
    }
    held += place.probability;
    if (place.probability > kWorthNaming) change.places.push_back(place);
  }
  return change;
}

bool detects_bend(const LawPoints& points, const LawSolution& full) {
  const auto line = solve_law(Law::log, points);
  const int n = points.size();
  return !line || information(full.sum_of_squares, n, n_parameters(Law::full)) <
                      information(line->sum_of_squares, n, n_parameters(Law::log));
}

bool detects_regime_three(const LawPoints& points, const LawSolution& full) {
  return full.theta[3] < points.log_P[points.size() - 1] && detects_bend(points, full);
}

int n_before_regime_three(const LawPoints& points, const LawSolution& full) {
  return n_below(points, full.theta[3]);
}

bool keeps_regime_two(Law law, const LawPoints& points, const LawSolution& solution) {
  return law != Law::full || n_before_regime_three(points, solution) >= kMinInRegimeTwo;
}

GroupedPoints grouped(const LawPoints& points) {
  const int n = points.size(), size = (n + kMostPlaces - 1) / kMostPlaces;
  if (size <= 1) return {points, 1};
  const int n_groups = (n + size - 1) / size;
  GroupedPoints means{
      {Eigen::VectorXd(n_groups), Eigen::VectorXd(n_groups), Eigen::VectorXd(n_groups), points.least_limit},
      size};
  for (int k = 0; k < n_groups; ++k) {
    const LawPoints group = points.range(k * size, std::min(size, n - k * size));
    const Eigen::ArrayXd w2 = group.weight.array().square();
    means.points.log_P[k] = (w2 * group.log_P.array()).sum() / w2.sum();
    means.points.y[k] = (w2 * group.y.array()).sum() / w2.sum();
    means.points.weight[k] = std::sqrt(w2.sum() / size);
  }
  return means;
}

Regimes by_point(Regimes regimes, int group_size, int n_points) {
  const auto multiply = [&](int& index) { index = std::min(index * group_size, n_points); };
  multiply(regimes.n_plateau);
  multiply(regimes.end_of_two);
  for (std::optional<ChangePoint>* change : {&regimes.plateau_end, &regimes.onset_three}) {
    if (!*change) continue;
    multiply((*change)->first);
    multiply((*change)->low95);
    multiply((*change)->high95);
    for (ChangePlace& place : (*change)->places) multiply(place.first);
  }
  return regimes;
}

std::optional<Regimes> find_regimes(const LawPoints& points) {
  const GroupedPoints means = grouped(points);
  std::optional<Regimes> regimes = regimes_of(means.points);
  if (regimes) regimes = by_point(*std::move(regimes), means.group_size, points.size());
  return regimes;
}

}  // namespace floc
