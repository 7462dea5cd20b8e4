#include "floc/fitting/modulus_law.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "floc/fitting/line_fit.h"
#include "floc/fitting/profile_likelihood.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

Eigen::VectorXd logarithms_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size())).log();
}

Eigen::MatrixXd line_columns(const Eigen::VectorXd& x) {
  Eigen::MatrixXd columns(x.size(), 2);
  columns << Eigen::VectorXd::Ones(x.size()), x;
  return columns;
}

/// Returns the reason why a power law cannot be fitted to points; empty if a fit is possible.
std::string why_no_power(const char* quantity, const std::vector<double>& x, std::size_t least) {
  if (x.size() < least)
    return fmt::format("there are {} states, but this law needs at least {}", x.size(), least);
  if (!(x.back() > x.front())) return fmt::format("all states have the same {}, {:.4g}", quantity, x.front());
  return "";
}

void warn_of_pattern(ModulusLaw& law) {
  if (law.pattern.is_systematic())
    law.warnings.push_back(fmt::format(
        "the residuals follow a pattern (correlation of neighbours {:.2f}; for independent errors, the "
        "probability of such a pattern would be {:.1g}): the modulus does not follow this power "
        "law, and the intervals are widened",
        law.pattern.correlation, std::min(law.pattern.smoothness_p, law.pattern.runs_p)));
}

/// Fit of the power law M = coefficient (Phi - phi_0)^exponent to moduli M at solid fractions Phi. For a given phi_0, a
/// straight line of ln M against ln(Phi - phi_0) gives exponent and coefficient. Only one coordinate has to be
/// searched: u = ln[(smallest Phi) - phi_0].
class FractionProblem {
 public:
  FractionProblem(const std::vector<double>& phi, const std::vector<double>& modulus)
      : phi_(Eigen::Map<const Eigen::VectorXd>(phi.data(), static_cast<Eigen::Index>(phi.size()))),
        y_(logarithms_of(modulus)),
        // phi_0 is at least 0. If phi_0 were too close to the smallest Phi, the first state, with a very negative
        // ln(Phi - phi_0), would outweigh all other states.
        low_(std::log(kNearest * (phi.back() - phi.front()))),
        high_(std::log(phi.front())) {}

  Eigen::VectorXd x_at(double u) const { return (phi_.array() - phi_[0] + std::exp(u)).log(); }
  LinearFit line_at(double u) const { return fit_linear(line_columns(x_at(u)), y_); }
  double squares(double u) const { return line_at(u).sum_of_squares; }
  /// Returns the sum of squared residuals of the best line with the given slope.
  double squares_with_slope(double u, double slope) const {
    const Eigen::ArrayXd rest = y_ - slope * x_at(u);
    return (rest - rest.mean()).square().sum();
  }
  /// Returns the sum of squared residuals of the best line with the given value at x = 0.
  double squares_with_intercept(double u, double intercept) const {
    const Eigen::VectorXd x = x_at(u), rest = y_.array() - intercept;
    return (rest - x.dot(rest) / x.squaredNorm() * x).squaredNorm();
  }
  const Eigen::VectorXd& y() const { return y_; }
  double phi_0(double u) const { return phi_[0] - std::exp(u); }
  double low() const { return low_; }
  double high() const { return high_; }

  /// Returns the position and the value of the minimum of a function f(u) between the limits of u. The best point of a
  /// grid is found first, and then refined by golden-section search.
  std::pair<double, double> minimum_of(const std::function<double(double)>& f) const {
    constexpr int kGrid = 60, kSections = 40;
    const double step = (high_ - low_) / kGrid;
    int best = 0;
    double least = f(low_);
    for (int k = 1; k <= kGrid; ++k)
      if (const double value = f(low_ + k * step); value < least) best = k, least = value;
    double a = std::max(low_, low_ + (best - 1) * step), b = std::min(high_, low_ + (best + 1) * step);
    constexpr double kGolden = 0.6180339887498949;
    double c = b - kGolden * (b - a), d = a + kGolden * (b - a), of_c = f(c), of_d = f(d);
    for (int k = 0; k < kSections; ++k) {
      if (of_c < of_d) {
        b = d, d = c, of_d = of_c;
        of_c = f(c = b - kGolden * (b - a));
      } else {
        a = c, c = d, of_c = of_d;
        of_d = f(d = a + kGolden * (b - a));
      }
    }
    const double middle = 0.5 * (a + b), of_middle = f(middle);
    // The smallest value may be at an end of the range.
    const double end = best == 0 ? low_ : high_;
    if ((best == 0 || best == kGrid) && least <= of_middle) return {end, least};
    return {middle, of_middle};
  }

 private:
  // smallest distance of phi_0 from the smallest Phi, divided by the range of Phi
  static constexpr double kNearest = 1e-3;
  Eigen::VectorXd phi_, y_;
  double low_, high_;
};

/// Returns a basis of the space of the derivatives of ln M with respect to the three parameters.
Eigen::MatrixXd tangent_of(const FractionProblem& problem, double u) {
  const Eigen::VectorXd x = problem.x_at(u);
  Eigen::MatrixXd columns(x.size(), 3);
  columns << Eigen::VectorXd::Ones(x.size()), x, (-x.array()).exp().matrix();
  return basis_of(columns);
}

/// Limits of the sum of squares of a power law in the solid fraction: `least` of the best fit, and `allowed` at the
/// ends of a 95 % interval.
struct Profile {
  double least, allowed, t95;

  /// Returns a parameter with its interval from the profile of the sum of squares.
  /// @param squares  smallest sum of squares as a function of a coordinate c
  /// @param value    parameter as a function of c
  template <class Squares, class Value>
  FittedParameter parameter(const char* name, const ProfileSearch& search, const Squares& squares,
                            const Value& value) const {
    ProfileSearch own = search;
    own.least = least;
    own.allowed = allowed;
    const ProfileInterval c = profile_interval(own, [&] { return ProfileFunction(squares); });
    FittedParameter p{name, value(search.center), {}, {}, {}, c.low && c.high};
    const auto end = [&](const std::optional<double>& at) {
      return at ? std::optional(value(*at)) : std::nullopt;
    };
    p.low95 = end(c.low);
    p.high95 = end(c.high);
    // phi_0 falls as its coordinate u grows, so the ends of its interval are in reverse order.
    if (value(search.low_end) > value(search.high_end)) std::swap(p.low95, p.high95);
    if (p.identified) p.standard_error = (*p.high95 - *p.low95) / (2.0 * t95);
    return p;
  }
};

/// Returns the parameters of the power law in the solid fraction.
/// @param u     coordinate of the best fit
/// @param line  line fitted at this coordinate
std::vector<FittedParameter> parameters_of_fractions(const FractionProblem& problem, double u,
                                                     const LinearFit& line, const Profile& profile) {
  const auto exponential = [](double c) { return std::exp(c); };
  const double of_exponent = std::log(line.coefficients[1]), intercept = line.coefficients[0];
  // Range of the search for the ends of intervals: exponents from 1/100 to 100 times the best exponent, coefficients
  // from 10^-20 to 10^20 times the best coefficient.
  const double far = std::log(100.0), farther = 20.0 * std::log(10.0);
  return {
      profile.parameter(
          "exponent", {of_exponent, 0.0, 0.0, of_exponent - far, of_exponent + far, 0.01},
          [&](double c) {
            return problem.minimum_of([&](double v) { return problem.squares_with_slope(v, std::exp(c)); })
                .second;
          },
          exponential),
      profile.parameter(
          "phi_0", {u, 0.0, 0.0, problem.low(), problem.high(), 0.01 * (problem.high() - problem.low())},
          [&](double c) { return problem.squares(c); }, [&](double c) { return problem.phi_0(c); }),
      profile.parameter(
          "coefficient", {intercept, 0.0, 0.0, intercept - farther, intercept + farther, 0.01},
          [&](double c) {
            return problem.minimum_of([&](double v) { return problem.squares_with_intercept(v, c); }).second;
          },
          exponential)};
}

}  // namespace

ModulusLaw fit_modulus_of_pressure(const std::vector<double>& P, const std::vector<double>& modulus) {
  assert(P.size() == modulus.size());
  constexpr std::size_t kLeast = 4;
  ModulusLaw law;
  law.failure_reason = why_no_power("pressure", P, kLeast);
  if (!law.found()) return law;
  const Eigen::VectorXd y = logarithms_of(modulus);
  const Eigen::MatrixXd columns = line_columns(logarithms_of(P));
  const LinearFit line = fit_linear(columns, y);
  law.pattern = residual_pattern(columns * line.coefficients - y, basis_of(columns));
  law.rms = std::sqrt(line.sum_of_squares / static_cast<double>(y.size()));
  const double widened = std::sqrt(law.pattern.variance_factor()), t95 = student_t_95(line.dof);
  const auto error = [&](int k) { return widened * std::sqrt(line.covariance(k, k)); };
  law.parameters = {from_value("exponent", line.coefficients[1], error(1), t95),
                    from_logarithm("coefficient", line.coefficients[0], error(0), t95)};
  warn_of_pattern(law);
  return law;
}

ModulusLaw fit_modulus_of_fraction(const std::vector<double>& phi, const std::vector<double>& modulus) {
  assert(phi.size() == modulus.size());
  constexpr std::size_t kLeast = 6;
  ModulusLaw law;
  law.failure_reason = why_no_power("solid fraction", phi, kLeast);
  if (!law.found()) return law;
  const FractionProblem problem(phi, modulus);
  const double u = problem.minimum_of([&](double at) { return problem.squares(at); }).first;
  const LinearFit line = problem.line_at(u);
  if (!(line.coefficients[1] > 0.0)) {
    law.failure_reason = "the modulus does not grow with the solid fraction";
    return law;
  }
  const Eigen::VectorXd residuals = line_columns(problem.x_at(u)) * line.coefficients - problem.y();
  law.pattern = residual_pattern(residuals, tangent_of(problem, u));
  law.rms = std::sqrt(line.sum_of_squares / static_cast<double>(phi.size()));
  const int dof = line.dof - 1;  // phi_0 is fitted too
  const double t95 = student_t_95(dof);
  // If the residuals are only rounding, the ends of an interval are at this small increase of the sum of squares.
  constexpr double kRounding = 1e-20;
  const double growth = t95 * t95 * law.pattern.variance_factor() * line.sum_of_squares / dof;
  const Profile profile{line.sum_of_squares, line.sum_of_squares + std::max(growth, kRounding), t95};
  law.parameters = parameters_of_fractions(problem, u, line, profile);
  for (FittedParameter& p : law.parameters) {
    if (p.identified) continue;
    law.warnings.push_back(fmt::format("{} is not identified by these states: its interval is open", p.name));
    p.value = std::nullopt;
  }
  warn_of_pattern(law);
  return law;
}

}  // namespace floc
