#include "floc/fitting/consolidation_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace floc {
namespace {

using Law = ConsolidationLaw;

/// Returns the correlation matrix of the first `n` parameters of a fit. If the inverse of a parameter was fitted
/// (1/Phi_max instead of Phi_max), its correlations change their sign, because a parameter falls as its inverse grows.
Eigen::MatrixXd correlation_of(const std::vector<Quantity>& quantities, Eigen::Index n,
                               const Eigen::MatrixXd& covariance) {
  Eigen::MatrixXd gradients(n, covariance.cols());
  for (Eigen::Index k = 0; k < n; ++k)
    gradients.row(k) = (quantities[k].is_inverse ? -1.0 : 1.0) * quantities[k].gradient;
  const Eigen::MatrixXd c = gradients * covariance * gradients.transpose();
  const Eigen::VectorXd scale = c.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * c * scale.asDiagonal();
}

/// Replaces the 95 % interval of a fitted parameter by the interval of the profile likelihood. An end of the
/// interval is absent if the data do not limit the parameter on that side.
void profile(const LawEstimate& estimate, int coordinate, const Covariance& covariance, bool is_inverse,
             FittedParameter& p, ConsolidationFit& fit) {
  const ProfileInterval c = profile_interval(estimate, coordinate, covariance);
  const auto parameter = [is_inverse](double at) { return is_inverse ? 1.0 / at : std::exp(at); };
  p.low95 = p.high95 = std::nullopt;
  const auto& low = is_inverse ? c.high : c.low;
  const auto& high = is_inverse ? c.low : c.high;
  if (low) p.low95 = parameter(*low);
  if (high) p.high95 = parameter(*high);
  constexpr double kIdentifiedFactor = 10.0;
  p.identified = p.low95 && p.high95 && *p.value < kIdentifiedFactor * *p.low95 &&
                 *p.high95 < kIdentifiedFactor * *p.value;
  fit.profiled.push_back(p.name);
}

std::string bounds_in_words(const FittedParameter& p) {
  if (p.low95 && p.high95) return fmt::format("between {:.4g} and {:.4g}", *p.low95, *p.high95);
  if (p.low95) return fmt::format("at least {:.4g}", *p.low95);
  if (p.high95) return fmt::format("at most {:.4g}", *p.high95);
  return "not bounded";
}

/// Reports a Phi_max whose best value is at its bound: Phi_max gets no value, and the bound is the upper end of its
/// interval.
void report_limit(double phi_limit, FittedParameter& p, ConsolidationFit& fit) {
  if (!p.low95 || *p.low95 > phi_limit) p.low95 = std::nullopt;
  p.value = p.standard_error = std::nullopt;
  p.high95 = phi_limit;
  p.identified = false;
  fit.warnings.push_back(fmt::format(
      "Phi_max is not identified by these data: it is at its bound, {:g} (option --phi-limit), and "
      "the best fit without this bound has a larger Phi_max. The law may not describe the data, and the other "
      "parameters belong to Phi_max = {:g}",
      phi_limit, phi_limit));
}

}  // namespace

PhysicalRange range_of(const std::string& name, double phi_limit) {
  const bool is_fraction = name == "Phi_max" || name == "Phi0";
  return {0.0, is_fraction ? phi_limit : std::numeric_limits<double>::infinity()};
}

void add_parameters(const LawEstimate& estimate, const Covariance& covariance, double last_phi,
                    ConsolidationFit& fit) {
  const std::vector<Quantity> quantities = quantities_of(estimate);
  for (const Quantity& q : quantities) {
    fit.parameters.push_back(fitted_parameter(q, covariance));
    FittedParameter& p = fit.parameters.back();
    if (q.name == "alpha") profile(estimate, 1, covariance, false, p, fit);
    if (q.name == "Phi_max") profile(estimate, 2, covariance, true, p, fit);
    if (p.name == "Phi_max" && estimate.solution.at_limit) {
      report_limit(fit.phi_limit, p, fit);
      continue;
    }
    if (const std::string why = keep_in_range(range_of(p.name, fit.phi_limit), p); !why.empty()) {
      if (p.name == "Phi_max") p.low95 = std::min(fit.phi_limit, last_phi);
      fit.warnings.push_back(why);
      continue;
    }
    if (p.identified) continue;
    fit.warnings.push_back(fmt::format("{} is not identified by these data: its value is {} (95 % interval)",
                                       p.name, bounds_in_words(p)));
    p.value = p.standard_error = std::nullopt;
  }
  if (estimate.line.slopes) fit.parameters.insert(fit.parameters.begin() + 1, kappa_of(estimate, covariance));
  if (estimate.law != Law::power && !estimate.has_plateau())
    fit.parameters.push_back(held_at("P0_star", fit.window_low));
  const Eigen::Index n_free = estimate.solution.theta.size() - (estimate.law == Law::log ? 1 : 0);
  for (Eigen::Index k = 0; k < n_free; ++k) fit.correlated.push_back(quantities[k].name);
  fit.correlation = correlation_of(quantities, n_free, covariance.matrix);
}

void bound_regime_three(const LawEstimate& reported, const Covariance& covariance, double last_phi,
                        ConsolidationFit& fit) {
  const std::vector<Quantity> quantities = quantities_of(reported);
  fit.parameters.push_back(fitted_parameter(quantities.front(), covariance));
  if (reported.line.slopes) fit.parameters.push_back(kappa_of(reported, covariance));
  fit.parameters.push_back(bounded_below("alpha", std::nullopt));
  fit.parameters.push_back(bounded_below("Phi_max", last_phi));
  fit.parameters.push_back(bounded_below("P1_star", fit.window_high));
  for (const Quantity& q : quantities)
    if (q.name == "Phi0" || q.name == "P0_star") {
      fit.parameters.push_back(fitted_parameter(q, covariance));
      const std::string beyond = keep_in_range(range_of(q.name, fit.phi_limit), fit.parameters.back());
      if (!beyond.empty()) fit.warnings.push_back(beyond);
    }
  if (!reported.has_plateau()) fit.parameters.push_back(held_at("P0_star", fit.window_low));
  fit.correlated = {"lambda"};
  fit.correlation = Eigen::MatrixXd::Ones(1, 1);
  fit.warnings.push_back(
      fmt::format("the data end at P* = {:.6g}, before regime III begins at P1*: alpha is not identified, only "
                  "bounds of P1_star and Phi_max are given, and lambda is the slope of {}",
                  fit.window_high, reported.law == Law::full ? "the full law" : "the line of regime II"));
}

}  // namespace floc
