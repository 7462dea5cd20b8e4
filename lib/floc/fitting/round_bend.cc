#include "floc/fitting/round_bend.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include "floc/base/dense_solvers.h"
#include "floc/base/infinity.h"
#include "floc/fitting/least_squares.h"

namespace floc {
namespace {

/// Returns the function s(d) of a RoundBend, which describes the transition from one line to the other.
double softened(double d, double width) {
  if (width == 0.0) return std::max(d, 0.0);
  // ln(1 + e^u) without overflow.
  const double u = d / width;
  return width * (std::max(u, 0.0) + std::log1p(std::exp(-std::abs(u))));
}

Eigen::MatrixXd columns_of(const Eigen::ArrayXd& x, double bend, double width) {
  Eigen::MatrixXd columns(x.size(), 3);
  columns.col(0).setOnes();
  columns.col(1) = x - bend;
  columns.col(2) = (x - bend).unaryExpr([width](double d) { return softened(d, width); });
  return columns;
}

/// For a given position and width of the bend, fits the slopes of both lines, and their common level at the bend. The
/// normal equations are well conditioned, because x is measured from the bend.
RoundBend with_lines(const Eigen::ArrayXd& x, const Eigen::VectorXd& y, double bend, double width) {
  const Eigen::MatrixXd columns = columns_of(x, bend, width);
  const Eigen::VectorXd c = solve_symmetric(columns.transpose() * columns, columns.transpose() * y);
  return {bend, width, c[0], c[1], c[1] + c[2], (y - columns * c).squaredNorm()};
}

/// Returns the best bend between the positions `low` and `high`, found by golden-section search.
RoundBend refined(const Eigen::ArrayXd& x, const Eigen::VectorXd& y, double low, double high, double width) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kRounds = 40;
  RoundBend inner = with_lines(x, y, high - kGolden * (high - low), width);
  RoundBend outer = with_lines(x, y, low + kGolden * (high - low), width);
  for (int round = 0; round < kRounds; ++round) {
    if (inner.sum_of_squares < outer.sum_of_squares) {
      high = std::exchange(outer, inner).bend;
      inner = with_lines(x, y, high - kGolden * (high - low), width);
    } else {
      low = std::exchange(inner, outer).bend;
      outer = with_lines(x, y, low + kGolden * (high - low), width);
    }
  }
  return inner.sum_of_squares < outer.sum_of_squares ? inner : outer;
}

/// Residual of a round bend at one point, with theta = (level, slope_below, slope_above, bend, ln width).
struct BendResidual {
  static constexpr int kParameters = 5;
  double x, y;
  template <class T>
  T operator()(const T* theta) const {
    using std::abs;
    using std::exp;
    using std::log1p;
    const T width = exp(theta[4]), d = x - theta[3], u = d / width;
    const T s = (u > 0.0 ? d : T(0.0)) + width * log1p(exp(-abs(u)));
    return theta[0] + theta[1] * d + (theta[2] - theta[1]) * s - y;
  }
};

/// Minimises the sum of squares over all five parameters, starting from the bend `near`. Returns `near` if the solver
/// fails, finds no smaller sum, or leaves the allowed range. In the allowed range, the bend lies between the second and
/// the second-last x, and the width is at most `widest`.
RoundBend polished(const Eigen::ArrayXd& x, const Eigen::VectorXd& y, const RoundBend& near, double widest) {
  std::vector<BendResidual> residuals;
  for (Eigen::Index i = 0; i < x.size(); ++i) residuals.push_back({x[i], y[i]});
  Eigen::VectorXd start(5);
  start << near.level, near.slope_below, near.slope_above, near.bend, std::log(near.width);
  const auto found = minimize(residuals, start);
  if (!found || !(found->sum_of_squares < near.sum_of_squares)) return near;
  const Eigen::VectorXd& t = found->theta;
  if (t[3] < x[1] || t[3] > x[x.size() - 2] || std::exp(t[4]) > widest) return near;
  return {t[3], std::exp(t[4]), t[0], t[1], t[2], found->sum_of_squares};
}

/// Fits bends of the given widths at all positions in `fit.places`. Updates `fit.best`, and the smallest sum of squares
/// at each position (`fit.profile`).
void try_widths(const std::vector<double>& widths, const Eigen::ArrayXd& x, const Eigen::VectorXd& y,
                RoundBendFit& fit) {
  const Eigen::Index last = fit.places.size() - 1;
  for (const double width : widths) {
    Eigen::Index best = 0;
    double least = kInfinity;
    for (Eigen::Index k = 0; k <= last; ++k) {
      const double left = with_lines(x, y, fit.places[k], width).sum_of_squares;
      fit.profile[k] = std::min(fit.profile[k], left);
      if (left < least) least = left, best = k;
    }
    const RoundBend there = refined(x, y, fit.places[std::max<Eigen::Index>(best - 1, 0)],
                                    fit.places[std::min<Eigen::Index>(best + 1, last)], width);
    if (there.sum_of_squares < fit.best.sum_of_squares) fit.best = there;
  }
}

std::vector<double> widths_between(double low, double high, int n) {
  std::vector<double> values;
  for (int k = 0; k < n; ++k) values.push_back(low * std::pow(high / low, k / (n - 1.0)));
  return values;
}

Eigen::MatrixXd jacobian_of(const Eigen::ArrayXd& x, const RoundBend& b) {
  const bool is_round = b.width > 0.0;
  Eigen::MatrixXd jacobian(x.size(), is_round ? 5 : 4);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double d = x[i] - b.bend, s = softened(d, b.width);
    const double passed = is_round ? 1.0 / (1.0 + std::exp(-d / b.width)) : (d > 0.0 ? 1.0 : 0.0);
    const double steeper = b.slope_above - b.slope_below;
    jacobian.row(i).head(4) << 1.0, d - s, s, -b.slope_below - steeper * passed;
    if (is_round) jacobian(i, 4) = steeper * (s - passed * d) / b.width;
  }
  return jacobian;
}

}  // namespace

double RoundBend::at(double x) const {
  return level + slope_below * (x - bend) + (slope_above - slope_below) * softened(x - bend, width);
}

RoundBendFit fit_round_bend(const Eigen::ArrayXd& x, const Eigen::VectorXd& y, bool is_round) {
  assert(x.size() == y.size() && x.size() >= 5);
  constexpr int kPlaces = 240, kWidths = 11, kNear = 9;
  constexpr double kNarrowest = 0.01, kWidest = 0.1;  // widths of the bend, divided by the range of x
  const double range = x[x.size() - 1] - x[0];
  RoundBendFit fit;
  fit.places = Eigen::VectorXd::LinSpaced(kPlaces + 1, x[1], x[x.size() - 2]);
  fit.profile = Eigen::VectorXd::Constant(kPlaces + 1, kInfinity);
  fit.best.sum_of_squares = kInfinity;
  try_widths({0.0}, x, y, fit);
  if (is_round) {
    try_widths(widths_between(range * kNarrowest, range * kWidest, kWidths), x, y, fit);
    // The grid of widths is coarse. A finer grid around the best width improves the profile near its minimum.
    const double step = std::pow(kWidest / kNarrowest, 1.0 / (kWidths - 1));
    if (const double width = fit.best.width; width > 0.0)
      try_widths(widths_between(width / step, std::min(width * step, kWidest * range), kNear), x, y, fit);
    if (fit.best.width > 0.0) fit.best = polished(x, y, fit.best, range * kWidest);
  }
  fit.residuals = y - x.unaryExpr([&](double at) { return fit.best.at(at); }).matrix();
  fit.jacobian = jacobian_of(x, fit.best);
  return fit;
}

}  // namespace floc
