#include "floc/fitting/segments.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "floc/base/infinity.h"
#include "floc/fitting/line_fit.h"
#include "floc/fitting/recompression.h"

namespace floc {
namespace {

/// Sum of squared residuals of one part of the curve, and number of free parameters of this part.
struct Misfit {
  double squares = 0.0;
  int n_free = 0;
};

/// A division of the curve into three parts, with its information criterion. The parts are the points before
/// `lower_end`, the points from `lower_end` to `upper_begin` - 1, and the points from `upper_begin` on.
struct Division {
  int lower_end, upper_begin;
  double information;
};

WeightedLine line_of(const LawPoints& points) {
  return fit_weighted_line(points.log_P, points.y, points.weight);
}

/// Returns the information criterion of a fit to `n` points: Bayes' criterion, with a larger penalty if there are few
/// points (see find_segments()).
double criterion(const Misfit& misfit, int n) {
  const double floor = n * kRoundingOfTables * kRoundingOfTables;
  const double left = n - misfit.n_free - 1;
  if (left <= 0.0) return kInfinity;
  return n * std::log(std::max(misfit.squares, floor) / n) + misfit.n_free * std::log(n) * n / left;
}

/// Fits a recompression line to the first `k` points, and returns its misfit. The curve `upper(ln P)`, with the initial
/// slope -`steeper`, describes the later points. Line and curve have to meet between the points k - 1 and k. If the
/// best line meets the curve elsewhere, another line is fitted, which meets the curve at the point k - 1 or k,
/// whichever is nearer to the first intersection. A line that would rise is replaced by a horizontal line. The result
/// is absent if the line is steeper than the curve.
template <class Upper>
std::optional<Misfit> misfit_below(const LawPoints& points, int k, double steeper, const Upper& upper) {
  if (k == 0) return Misfit{};
  const LawPoints lower = points.range(0, k);
  const double before = points.log_P[k - 1], after = points.log_P[k];
  RecompressionLine line = recompression_line(lower, k > 1);
  if (line.kappa <= 0.0) line = recompression_line(lower, false);
  if (line.kappa >= steeper) return std::nullopt;
  const double above_before = upper(before) - line.at(before), above_after = upper(after) - line.at(after);
  const Misfit met{line.sum_of_squares, line.slopes ? 2 : 1};
  if (above_before >= 0.0 && above_after <= 0.0) return met;
  // Fits a line that meets the curve at the point k - 1 or k, whichever is nearer to the intersection.
  const double at = above_before < 0.0 ? before : after;
  const Eigen::ArrayXd w2 = lower.weight.array().square();
  const Eigen::ArrayXd dx = lower.log_P.array() - at, dy = lower.y.array() - upper(at);
  const double sxx = (w2 * dx.square()).sum();
  const double slope = line.slopes && sxx > 0.0 ? std::min((w2 * dx * dy).sum() / sxx, 0.0) : 0.0;
  if (-slope >= steeper) return std::nullopt;
  return Misfit{(w2 * (dy - slope * dx).square()).sum(), met.n_free};
}

/// Returns the misfit of the points from `first` on, for a line or for the power law of regime III, whichever has the
/// smaller criterion. The index `first` counts as one more parameter. The result is absent if there are too few points.
std::optional<Misfit> misfit_above(const LawPoints& points, int first) {
  constexpr int kOfLine = 2, kOfPower = 3, kPlace = 1;
  const int n = points.size() - first;
  if (n == 0) return Misfit{};
  const LawPoints upper = points.range(first, n);
  std::optional<Misfit> best;
  const auto offer = [&](double squares, int n_free) {
    const Misfit misfit{squares, n_free + kPlace};
    if (!best || criterion(misfit, points.size()) < criterion(*best, points.size())) best = misfit;
  };
  if (n > kOfLine) offer(line_of(upper).sum_of_squares, kOfLine);
  if (n > kOfPower)
    if (const auto squares = residual_of_power_law(upper)) offer(*squares, kOfPower);
  return best;
}

/// Returns whether the curve from the point `j` - 1 on falls much faster than a line with the slope `slope`. This line
/// is then not the steepest part of the curve, but for example a plateau before a collapse.
bool steepens(const LawPoints& points, int j, double slope) {
  constexpr double kMuchSteeper = 2.0;
  const int first = j - 1, n = std::min(3, points.size() - first);
  return n > 1 && line_of(points.range(first, n)).slope < kMuchSteeper * slope;
}

/// Returns all divisions of the curve with a line of regime II.
std::vector<Division> divisions_with_two(const LawPoints& points) {
  const int n = points.size();
  std::vector<std::optional<Misfit>> above;
  for (int j = 0; j <= n; ++j) above.push_back(misfit_above(points, j));
  std::vector<Division> found;
  for (int k = 0; k + kMinInRegimeTwo <= n; ++k)
    for (int j = k + kMinInRegimeTwo; j <= n; ++j) {
      if (!above[static_cast<std::size_t>(j)]) continue;
      const WeightedLine line = line_of(points.range(k, j - k));
      if (line.slope >= 0.0 || steepens(points, j, line.slope)) continue;
      const auto below = misfit_below(points, k, -line.slope, [&](double x) { return line.at(x); });
      if (!below) continue;
      constexpr int kOfLine = 2;
      const Misfit& tail = *above[static_cast<std::size_t>(j)];
      const Misfit all{below->squares + line.sum_of_squares + tail.squares,
                       below->n_free + kOfLine + tail.n_free};
      found.push_back({k, j, criterion(all, n)});
    }
  return found;
}

/// Returns all divisions of the curve in which the power law of regime III follows the recompression line directly.
std::vector<Division> divisions_without_two(const LawPoints& points) {
  const int n = points.size();
  std::vector<Division> found;
  for (int k = 0; n - k > n_parameters(ConsolidationLaw::power); ++k) {
    const LawPoints rest = points.range(k, n - k);
    const auto power = residual_of_power_law(rest);
    if (!power) continue;
    // For the intersection with the recompression line, the line through the first two points of regime III
    // approximates the power law.
    const WeightedLine start = line_of(rest.range(0, 2));
    const auto below = misfit_below(points, k, -start.slope, [&](double x) { return start.at(x); });
    if (!below) continue;
    found.push_back(
        {k, k, criterion({below->squares + *power, below->n_free + n_parameters(ConsolidationLaw::power)}, n)});
  }
  return found;
}

/// Returns the position and the uncertainty of one end of regime II. The probability of a position is the sum over all
/// positions of the other end.
/// @param best   position in the best division
/// @param place  function that returns the position of this end in a division
template <class Place>
ChangePoint change_of(const std::vector<Division>& divisions, int n, int best, const Place& place) {
  double least = kInfinity;
  for (const Division& d : divisions) least = std::min(least, d.information);
  std::vector<double> weight(static_cast<std::size_t>(n) + 1, 0.0);
  for (const Division& d : divisions)
    weight[static_cast<std::size_t>(place(d))] += std::exp(0.5 * (least - d.information));
  std::vector<floc::Place> places;
  for (int k = 0; k <= n; ++k)
    if (const double w = weight[static_cast<std::size_t>(k)]; w > 0.0)
      places.push_back({k, -2.0 * std::log(w)});
  ChangePoint change = change_among(std::move(places), 0);
  change.first = best;
  change.low95 = std::min(change.low95, best);
  change.high95 = std::max(change.high95, best);
  return change;
}

/// Returns whether a constant, or an elastic law (1/Phi linear in P*), describes the curve better than the best
/// division.
/// @param information  criterion of the best division
bool is_elastic(const LawPoints& points, double information) {
  const int n = points.size();
  const double constant = recompression_line(points, false).sum_of_squares;
  const double elastic = fit_weighted_line(points.log_P.array().exp(), points.y, points.weight).sum_of_squares;
  return std::min(criterion({constant, 1}, n), criterion({elastic, 2}, n)) <= information;
}

/// Divides a curve with at most kMostPlaces points.
std::optional<Regimes> segments_of(const LawPoints& points, bool bends) {
  const int n = points.size();
  std::vector<Division> divisions = divisions_with_two(points);
  // The third part of a division describes the bend. Without a bend, only those divisions remain in which regime II
  // extends to the last point.
  if (!bends) std::erase_if(divisions, [n](const Division& d) { return d.upper_begin < n; });
  const auto less = [](const Division& a, const Division& b) { return a.information < b.information; };
  const auto best_with = std::min_element(divisions.begin(), divisions.end(), less);
  const std::vector<Division> without = bends ? divisions_without_two(points) : std::vector<Division>{};
  const auto best_without = std::min_element(without.begin(), without.end(), less);
  if (best_with == divisions.end() && best_without == without.end()) return std::nullopt;
  const double with_two = best_with == divisions.end() ? kInfinity : best_with->information;
  const bool has_two = best_without == without.end() || with_two <= best_without->information;
  const Division best = has_two ? *best_with : *best_without;
  Regimes regimes;
  if (is_elastic(points, best.information)) {
    regimes.all_in_one = true;
    return regimes;
  }
  // Only divisions of the chosen kind count for the positions of the changes, because a position has different meanings
  // in the two kinds: without regime II, the recompression line ends where regime III begins.
  const std::vector<Division>& of_kind = has_two ? divisions : without;
  regimes.n_plateau = best.lower_end;
  regimes.end_of_two = best.upper_begin;
  const ChangePoint end = change_of(of_kind, n, best.lower_end, [](const Division& d) { return d.lower_end; });
  // If high95 is 0, regime II or III begins at the first point with a probability of at least 95 %. In this case there
  // is no recompression line that could end.
  if (end.high95 > 0) regimes.plateau_end = end;
  if (best.upper_begin < n)
    regimes.onset_three =
        change_of(of_kind, n, best.upper_begin, [](const Division& d) { return d.upper_begin; });
  return regimes;
}

}  // namespace

std::optional<Regimes> find_segments(const LawPoints& points, bool bends) {
  const GroupedPoints means = grouped(points);
  std::optional<Regimes> regimes = segments_of(means.points, bends);
  if (regimes) regimes = by_point(*std::move(regimes), means.group_size, points.size());
  return regimes;
}

}  // namespace floc
