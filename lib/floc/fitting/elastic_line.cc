#include "floc/fitting/elastic_line.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "floc/fitting/line_fit.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

/// Returns the bulk modulus between the neighbouring points i and i + 1 of a branch of a load path.
/// @param y  ln Phi of the points, where Phi is the solid fraction
double secant(const Eigen::VectorXd& P, const Eigen::VectorXd& y, Eigen::Index i) {
  return (P[i + 1] - P[i]) / (y[i + 1] - y[i]);
}

/// Returns whether y = ln Phi is a curved function of the pressure P: the quadratic term of a fitted parabola is larger
/// than its error and than rounding.
/// @param n_errors  the quadratic term must exceed this number of standard errors; if absent, the half width of its 95
/// % interval
bool is_curved(const Eigen::VectorXd& P, const Eigen::VectorXd& y, std::optional<double> n_errors = {}) {
  if (P.size() < 4) return false;
  const Eigen::ArrayXd x = (P.array() - P.mean()) / (P.maxCoeff() - P.minCoeff());
  Eigen::MatrixXd columns(P.size(), 3);
  columns << Eigen::VectorXd::Ones(P.size()), x.matrix(), x.square().matrix();
  const LinearFit parabola = fit_linear(columns, y);
  const double error = std::sqrt(parabola.covariance(2, 2));
  constexpr double kRounding = 1e-12;
  return std::abs(parabola.coefficients[2]) >
         std::max(n_errors.value_or(student_t_95(parabola.dof)) * error, kRounding);
}

/// Straight line fitted to the points [first, first + n) of a branch.
struct FittedPart {
  Eigen::Index first = 0;
  Eigen::Index n = 0;
  LinearFit fit;
  double B() const { return 1.0 / fit.coefficients[1]; }
};

FittedPart line_through(const Eigen::VectorXd& P, const Eigen::VectorXd& y, Eigen::Index first,
                        Eigen::Index n) {
  Eigen::MatrixXd columns(n, 2);
  columns << Eigen::VectorXd::Ones(n), P.segment(first, n);
  return {first, n, fit_linear(columns, y.segment(first, n))};
}

/// Returns whether the line fitted to a whole branch has a positive modulus: the solid fraction falls with the
/// pressure.
bool falls_as_a_whole(const Eigen::VectorXd& P, const Eigen::VectorXd& y) {
  return line_through(P, y, 0, P.size()).fit.coefficients[1] > 0.0;
}

/// Returns the smallest and the largest modulus between neighbouring points of a part of a branch.
std::pair<double, double> secants(const Eigen::VectorXd& P, const Eigen::VectorXd& y, const FittedPart& part) {
  double low = secant(P, y, part.first), high = low;
  for (Eigen::Index i = part.first; i + 1 < part.first + part.n; ++i) {
    low = std::min(low, secant(P, y, i));
    high = std::max(high, secant(P, y, i));
  }
  return {low, high};
}

/// Returns whether all moduli between neighbouring points in a part of a branch differ by at most 15 % from the modulus
/// of the line fitted to this part.
bool has_equal_secants(const Eigen::VectorXd& P, const Eigen::VectorXd& y, const FittedPart& part) {
  constexpr double kEqual = 0.15;
  const auto [low, high] = secants(P, y, part);
  return low > (1.0 - kEqual) * part.B() && high < (1.0 + kEqual) * part.B();
}

/// Returns whether, in a part of a branch, the solid fraction falls from each point to the point at the next lower
/// pressure.
bool falls_throughout(const Eigen::VectorXd& P, const Eigen::VectorXd& y, const FittedPart& part) {
  return secants(P, y, part).first > 0.0;
}

/// Returns the longest straight part of a branch that contains an end of the branch. Of two straight parts with the
/// same number of points, returns the part at low pressures. If the line through the whole branch has no positive
/// modulus, the solid fraction must fall throughout the part, see falls_throughout().
std::optional<FittedPart> straight_part(const Eigen::VectorXd& P, const Eigen::VectorXd& y) {
  constexpr Eigen::Index kFewest = 4;
  // A part of the branch counts as curved if its quadratic term exceeds this number of standard errors. The half width
  // of the 95 % interval would be too strict a limit: with few points, no curvature would exceed it.
  constexpr double kErrors = 2.0;
  const bool falls = P[0] > P[P.size() - 1], whole = falls_as_a_whole(P, y);
  for (Eigen::Index n = P.size(); n >= kFewest; --n)
    for (const bool at_end : {falls, !falls}) {
      const FittedPart part = line_through(P, y, at_end ? P.size() - n : 0, n);
      if (part.fit.coefficients[1] <= 0.0) continue;
      if (!whole && !falls_throughout(P, y, part)) continue;
      if (!is_curved(P.segment(part.first, n), y.segment(part.first, n), kErrors) ||
          has_equal_secants(P, y, part))
        return part;
    }
  return std::nullopt;
}

FittedParameter not_identified(const std::string& name) {
  return bounded_below(name, std::nullopt);
}

/// Sets the parameters B (bulk modulus) and phi_unloaded (solid fraction at zero pressure) from the line through a part
/// of a branch. If the branch is curved and the moduli between neighbouring points of the part are nearly equal, the
/// interval of B is widened to contain all of them.
void set_parameters(const Eigen::VectorXd& P, const Eigen::VectorXd& y, const FittedPart& part,
                    ElasticFit& fit) {
  const double t95 = student_t_95(part.fit.dof);
  const auto error = [&](int k) { return std::sqrt(part.fit.covariance(k, k)); };
  fit.parameters = {from_inverse("B", part.fit.coefficients[1], error(1), t95),
                    from_logarithm("phi_unloaded", part.fit.coefficients[0], error(0), t95)};
  const std::string beyond = keep_in_range({0.0, 1.0}, fit.parameters[1]);
  if (!beyond.empty()) fit.warnings.push_back(beyond);
  fit.rms = std::sqrt(part.fit.sum_of_squares / static_cast<double>(part.n));
  fit.first = static_cast<int>(part.first);
  fit.n_points = static_cast<int>(part.n);
  if (!fit.is_curved) return;
  if (has_equal_secants(P, y, part)) {
    const auto [low, high] = secants(P, y, part);
    FittedParameter& B = fit.parameters[0];
    B.low95 = std::min(*B.low95, low);
    if (B.high95) B.high95 = std::max(*B.high95, high);
  }
  const bool falls = P[0] > P[P.size() - 1];
  if (falls ? part.first + part.n < P.size() : part.first > 0)
    fit.parameters[1] = not_identified("phi_unloaded");
}

/// Returns a message with the reason why a single modulus does not describe the whole branch.
std::string words_of_curved(bool falls, const ElasticFit& fit) {
  if (!falls) return "the branch is not elastic as a whole: its solid fraction grows as the pressure falls";
  return fmt::format(
      "the branch is curved: the modulus is {:.4g} between its two lowest pressures and {:.4g} between its two "
      "highest",
      fit.secant_low, fit.secant_high);
}

/// Adds the parameters of a curved branch, which has no single modulus, and a warning to `fit`.
/// @param part  the longest straight part of the branch; absent if no part is straight
void fit_curved(const Eigen::VectorXd& P, const Eigen::VectorXd& y, const std::optional<FittedPart>& part,
                ElasticFit& fit) {
  fit.is_curved = true;
  const std::string curved = words_of_curved(falls_as_a_whole(P, y), fit);
  if (!part) {
    fit.parameters = {not_identified("B"), not_identified("phi_unloaded")};
    fit.warnings.push_back(curved + "; no part of the branch is straight, so that B is not identified");
    return;
  }
  set_parameters(P, y, *part, fit);
  const auto ends = std::minmax(P[part->first], P[part->first + part->n - 1]);
  fit.warnings.push_back(
      fmt::format("{}; B is the modulus of the straight part of the branch, at pressures from {:.4g} to {:.4g}",
                  curved, ends.first, ends.second));
}

}  // namespace

ElasticFit fit_elastic(const std::vector<double>& P, const std::vector<double>& phi) {
  assert(P.size() == phi.size());
  constexpr int kMinPressures = 3;
  ElasticFit fit;
  const auto n = static_cast<Eigen::Index>(P.size());
  if (n < kMinPressures) {
    fit.failure_reason =
        fmt::format("there are {} pressures on the branch, but the fit needs at least {}", n, kMinPressures);
    return fit;
  }
  const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(P.data(), n);
  const Eigen::VectorXd y = Eigen::Map<const Eigen::ArrayXd>(phi.data(), n).log();
  const bool is_line = falls_as_a_whole(x, y) && !is_curved(x, y);
  const std::optional<FittedPart> part = is_line ? line_through(x, y, 0, n) : straight_part(x, y);
  // A curved branch without a straight part is reported with its secant moduli and without B, if its solid fraction
  // falls with the pressure. Otherwise there is nothing to report, because an elastic modulus is positive.
  if (!part && !falls_as_a_whole(x, y)) {
    fit.failure_reason = "the branch is not elastic: its solid fraction does not fall as the pressure falls";
    return fit;
  }
  // If the pressure falls along the branch, the two lowest pressures are at the end of the branch. The secant moduli
  // must be set before fit_curved(), whose warning may contain them.
  const bool falls = x[0] > x[n - 1];
  fit.secant_low = secant(x, y, falls ? n - 2 : 0);
  fit.secant_high = secant(x, y, falls ? 0 : n - 2);
  if (is_line)
    set_parameters(x, y, *part, fit);
  else
    fit_curved(x, y, part, fit);
  return fit;
}

void hold_against(double B_first, double B_last, ElasticFit& fit) {
  FittedParameter& B = fit.parameters[0];
  if (!B.value || !B.low95) return;
  const auto [low, high] = std::minmax(B_first, B_last);
  if (high >= *B.low95 && (!B.high95 || low <= *B.high95)) return;
  fit.warnings.push_back(fmt::format(
      "B = {:.4g} from the slope of the fitted part of the branch disagrees with the bulk moduli computed from "
      "the states of this part, {:.4g} to {:.4g}: the branch is not elastic there, and B is not identified",
      *B.value, low, high));
  B = not_identified("B");
}

}  // namespace floc
