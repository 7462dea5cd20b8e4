#include "floc/fitting/yield_constructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "floc/base/infinity.h"
#include "floc/base/random.h"
#include "floc/fitting/line_fit.h"
#include "floc/fitting/smoothing_spline.h"

namespace floc {
namespace {

/// Number of points on the line below the bend of a curve, and index of the first point on the line above the
/// bend.
struct Sides {
  Eigen::Index n_below, first_above;
};

Sides sides_of(const Eigen::VectorXd& x, const RoundBend& bend) {
  // smallest distance from the bend of a point that belongs to a line, divided by the width of the bend
  constexpr double kBeyond = 2.0;
  constexpr Eigen::Index kLeast = 3;
  const Eigen::Index n = x.size();
  const auto below = static_cast<Eigen::Index>((x.array() <= bend.bend - kBeyond * bend.width).count());
  const auto above = static_cast<Eigen::Index>((x.array() >= bend.bend + kBeyond * bend.width).count());
  return {std::min(std::max(below, kLeast), n - kLeast), n - std::min(std::max(above, kLeast), n - kLeast)};
}

WeightedLine line_of_part(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::Index first,
                          Eigen::Index n) {
  return fit_weighted_line(x.segment(first, n), y.segment(first, n), Eigen::VectorXd::Ones(n));
}

/// Returns the abscissa at which two lines intersect; absent if they are parallel.
std::optional<double> meeting(const WeightedLine& a, const WeightedLine& b) {
  const double steeper = a.slope - b.slope;
  if (steeper == 0.0) return std::nullopt;
  return (b.intercept - a.intercept) / steeper;
}

/// Constructions of the preconsolidation pressure P_c of a curve y. Each function returns ln P_c. All curves have the
/// same pressures, and the same points below and above the bend (`sides`).
class Constructions {
 public:
  Constructions(const Eigen::VectorXd& P, const SmoothingSpline& spline, const Sides& sides)
      : P_(P), x_(P.array().log()), sides_(sides) {
    constexpr Eigen::Index kPlaces = 400;
    places_ = Eigen::VectorXd::LinSpaced(kPlaces, x_[0], x_[x_.size() - 1]);
    spline_ = spline.operators(places_);
  }

  std::optional<double> casagrande(const Eigen::VectorXd& y) const {
    // Slope and curvature of y against log10 P.
    const double decade = std::numbers::ln10;
    const Eigen::ArrayXd slope = decade * (spline_.slope * y),
                         second = decade * decade * (spline_.curvature * y);
    const Eigen::ArrayXd curvature = -second / (1.0 + slope.square()).pow(1.5);
    Eigen::Index k = 0;
    if (curvature.maxCoeff(&k) <= 0.0) return std::nullopt;
    const double bisector = std::tan(0.5 * std::atan(slope[k])) / decade;
    const double value = spline_.value.row(k).dot(y);
    return meeting(virgin(x_, y), {value - bisector * places_[k], bisector, 0.0});
  }

  std::optional<double> pacheco_silva(const Eigen::VectorXd& y) const {
    const WeightedLine line = virgin(x_, y);
    const std::optional<double> a = meeting(line, {y[0], 0.0, 0.0});
    if (!a || *a < places_[0] || *a > places_[places_.size() - 1]) return std::nullopt;
    const auto k =
        static_cast<Eigen::Index>(std::lower_bound(places_.begin(), places_.end(), *a) - places_.begin());
    return meeting(line, {spline_.value.row(k).dot(y), 0.0, 0.0});
  }

  std::optional<double> butterfield(const Eigen::VectorXd& y) const {
    const Eigen::VectorXd log_y = y.array().log();
    return meeting(line_of_part(x_, log_y, 0, sides_.n_below), virgin(x_, log_y));
  }

  std::optional<double> becker(const Eigen::VectorXd& y) const {
    Eigen::VectorXd work = Eigen::VectorXd::Zero(P_.size());
    for (Eigen::Index i = 1; i < P_.size(); ++i)
      work[i] = work[i - 1] + 0.5 * (P_[i] + P_[i - 1]) * (y[i - 1] - y[i]) / y[0];
    const auto P_c = meeting(line_of_part(P_, work, 0, sides_.n_below), virgin(P_, work));
    if (!P_c || *P_c <= 0.0) return std::nullopt;
    return std::log(*P_c);
  }

 private:
  WeightedLine virgin(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const {
    return line_of_part(x, y, sides_.first_above, x.size() - sides_.first_above);
  }

  Eigen::VectorXd P_, x_, places_;
  SmoothingSpline::Operators spline_;
  Sides sides_;
};

using Construction = std::optional<double> (Constructions::*)(const Eigen::VectorXd&) const;

struct NamedConstruction {
  const char* name;
  Construction construct;
};
constexpr NamedConstruction kConstructions[] = {{"P_c_casagrande", &Constructions::casagrande},
                                                {"P_c_pacheco_silva", &Constructions::pacheco_silva},
                                                {"P_c_butterfield", &Constructions::butterfield},
                                                {"P_c_becker", &Constructions::becker}};

/// Returns the parameter exp(value). For its interval, the logarithms `drawn` are shifted so that their median is
/// `value`; the interval contains 95 % of the shifted logarithms.
FittedParameter parameter_of(const char* name, double value, std::vector<double> drawn) {
  std::sort(drawn.begin(), drawn.end());
  const auto at = [&](double share) {
    return drawn[static_cast<std::size_t>(std::lround(share * static_cast<double>(drawn.size() - 1)))];
  };
  const double low = value + at(0.025) - at(0.5), high = value + at(0.975) - at(0.5);
  constexpr double kDeviationsIn95 = 3.92;
  return {name,          std::exp(value), std::exp(value) * (high - low) / kDeviationsIn95,
          std::exp(low), std::exp(high),  true};
}

}  // namespace

YieldConstructions yield_constructions(const std::vector<double>& P, const Eigen::VectorXd& y,
                                       const RoundBend& bend, const BootstrapDraws& draws) {
  const auto n = static_cast<Eigen::Index>(P.size());
  const Eigen::VectorXd pressures = Eigen::Map<const Eigen::VectorXd>(P.data(), n);
  const Eigen::VectorXd x = pressures.array().log();
  const SmoothingSpline spline(x, y);
  const Constructions constructions(pressures, spline, sides_of(x, bend));
  const Eigen::VectorXd fitted = spline.smoother() * y;
  const double free = std::max(static_cast<double>(n) - spline.smoother().trace(), 1.0);
  const Eigen::VectorXd residuals = (y - fitted) * std::sqrt(static_cast<double>(n) / free);

  std::vector<std::vector<double>> drawn(std::size(kConstructions));
  constexpr std::uint64_t kPurpose = 0xca5a;
  RandomStream random(draws.seed, kPurpose);
  for (int draw = 0; draw < draws.n; ++draw) {
    Eigen::VectorXd again = fitted;
    for (double& value : again)
      value += residuals[static_cast<Eigen::Index>(random.below(static_cast<std::uint64_t>(n)))];
    for (std::size_t k = 0; k < drawn.size(); ++k)
      if (const auto value = (constructions.*kConstructions[k].construct)(again)) drawn[k].push_back(*value);
  }
  YieldConstructions found;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    const auto value = (constructions.*kConstructions[k].construct)(y);
    const bool is_stable = static_cast<double>(drawn[k].size()) > 0.9 * draws.n;
    const bool is_inside = value && *value > x[0] && *value < x[n - 1];
    if (is_stable && is_inside)
      found.parameters.push_back(parameter_of(kConstructions[k].name, *value, drawn[k]));
    else
      found.warnings.push_back(
          fmt::format("{} cannot be constructed: its lines do not meet on the curve", kConstructions[k].name));
  }
  return found;
}

FittedParameter agreed_pressure(const std::vector<FittedParameter>& methods) {
  FittedParameter agreed{"P_c_agreed", {}, {}, {}, {}, false};
  std::vector<double> values;
  double low = 0.0, high = kInfinity;
  for (const FittedParameter& p : methods) {
    if (!p.value) continue;
    values.push_back(*p.value);
    low = std::max(low, p.low95.value_or(0.0));
    high = std::min(high, p.high95.value_or(kInfinity));
  }
  constexpr std::size_t kLeast = 3;
  if (values.size() < kLeast || !(low <= high) || !std::isfinite(high)) return agreed;
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  agreed.value = std::clamp(values[values.size() / 2], low, high);
  agreed.low95 = low;
  agreed.high95 = high;
  agreed.identified = true;
  return agreed;
}

}  // namespace floc
