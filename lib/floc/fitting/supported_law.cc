#include "floc/fitting/supported_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floc/fitting/collapse_jumps.h"
#include "floc/fitting/segments.h"

namespace floc {
namespace {

using Law = ConsolidationLaw;

bool is_within_factor(const FittedParameter* p, double factor) {
  return p && p->value && p->identified && p->low95 && p->high95 && *p->high95 <= factor * *p->low95;
}

/// Returns whether the data determine the parameters of the full law well enough for them to be reported.
bool is_supported(const ConsolidationFit& full) {
  constexpr double kLambda = 3.0, kAlpha = 5.0;
  const FittedParameter* phi_max = full.found() ? full.find("Phi_max") : nullptr;
  return phi_max && phi_max->value && phi_max->identified && is_within_factor(full.find("lambda"), kLambda) &&
         is_within_factor(full.find("alpha"), kAlpha) && !full.pattern.is_systematic();
}

ConsolidationFit fit_as(Law law, const ConsolidationCurve& curve, ConsolidationOptions options) {
  options.law = law;
  return fit_consolidation(curve, options);
}

/// Converts a slope against ln P* to a slope against log10 P*.
FittedParameter per_decade(FittedParameter p, const char* name) {
  p.name = name;
  for (auto* number : {&p.value, &p.standard_error, &p.low95, &p.high95})
    if (*number) *number = **number * std::numbers::ln10;
  return p;
}

/// Adds the compression index C_c and the swelling index C_s after lambda and kappa.
void add_indices(ConsolidationFit& fit) {
  std::vector<FittedParameter> indices;
  if (const FittedParameter* lambda = fit.find("lambda")) indices.push_back(per_decade(*lambda, "C_c"));
  if (const FittedParameter* kappa = fit.find("kappa")) indices.push_back(per_decade(*kappa, "C_s"));
  // lambda and kappa, if the law has these parameters, are the first in the list.
  fit.parameters.insert(fit.parameters.begin() + static_cast<std::ptrdiff_t>(indices.size()), indices.begin(),
                        indices.end());
}

/// Returns the pressure P1*, at which regime III begins: the geometric mean of two neighbouring pressures of the curve.
FittedParameter onset_of(const ChangePoint& change, const ConsolidationCurve& curve) {
  const auto last = static_cast<int>(curve.P_star.size()) - 1;
  const auto at = [&](int i) { return curve.P_star[static_cast<std::size_t>(std::clamp(i, 0, last))]; };
  FittedParameter P1{"P1_star", std::sqrt(at(change.first - 1) * at(change.first)), {}, {}, {}, true};
  P1.low95 = at(change.low95 - 1);
  if (change.high95 <= last) P1.high95 = at(change.high95);
  P1.identified = P1.high95.has_value();
  if (!P1.identified) P1.value = std::nullopt;
  return P1;
}

/// Adds alpha, Phi_max and P1* to a fit of the line of regime II. The values come from a power law fitted to
/// the points beyond this line. Without such a fit, only bounds are added.
void add_beyond(const ConsolidationCurve& curve, const ConsolidationOptions& options, ConsolidationFit& line) {
  FittedParameter alpha = bounded_below("alpha", std::nullopt);
  FittedParameter phi_max = bounded_below("Phi_max", curve.phi.back());
  phi_max.high95 = std::isfinite(options.phi_limit) ? std::optional(options.phi_limit) : std::nullopt;
  FittedParameter P1 = bounded_below("P1_star", line.window_high);
  if (line.regimes && line.regimes->onset_three) {
    P1 = onset_of(*line.regimes->onset_three, curve);
    const ConsolidationFit power = fit_as(Law::power, curve, options);
    if (power.found() && !power.pattern.is_systematic()) {
      if (const FittedParameter* p = power.find("alpha"); p->identified) alpha = *p;
      if (const FittedParameter* p = power.find("Phi_max")) phi_max = *p;
    }
  }
  const auto after_indices = std::find_if(line.parameters.begin(), line.parameters.end(),
                                          [](const FittedParameter& p) { return p.name == "Phi0"; });
  line.parameters.insert(after_indices, {alpha, phi_max, P1});
}

/// Regimes of a mean over samples, and the regimes with a bend if there is one that the samples do not confirm.
struct RegimesOfSamples {
  std::optional<Regimes> chosen, unconfirmed;
};

/// Returns the regimes of a mean over samples. If the samples do not confirm the bend at the end of regime II, the
/// curve is divided again without a bend. This division counts only if it keeps the recompression line: a line through
/// the whole curve would average over the bend and the beginning, and its slope would be far too small.
RegimesOfSamples regimes_of_samples(const ConsolidationCurve& curve, const LawPoints& points) {
  const std::optional<Regimes> regimes = find_segments(points);
  const int n = points.size();
  if (!regimes || regimes->all_in_one || regimes->end_of_two == n) return {regimes, std::nullopt};
  const int first = regimes->n_plateau, end = regimes->end_of_two - first;
  // Without regime II, the position of the bend is unknown, and the middle of the points after the plateau is used.
  const int place = end > 0 ? end : (n - first) / 2;
  if (samples_bend_at(curve.samples.bottomRows(n - first), points.log_P.tail(n - first), place))
    return {regimes, std::nullopt};
  const std::optional<Regimes> straight = find_segments(points, false);
  const bool keeps_line = straight && (first == 0 || straight->n_plateau > 0);
  if (!keeps_line) return {regimes, std::nullopt};
  return {straight, regimes};
}

/// Warns if the slope lambda would be outside of its interval if the bend that the samples do not confirm were real.
void warn_of_unconfirmed(const ConsolidationCurve& curve, ConsolidationOptions options, const Regimes& bent,
                         ConsolidationFit& line) {
  options.regimes = bent;
  const ConsolidationFit other = fit_as(Law::log, curve, options);
  const FittedParameter *own = line.find("lambda"), *steeper = other.found() ? other.find("lambda") : nullptr;
  if (!own || !own->value || !own->high95 || !steeper || !steeper->value || *steeper->value <= *own->high95)
    return;
  line.warnings.push_back(fmt::format(
      "the mean bends beyond P* = {:.4g}, but the jumps of so few samples could cause this by chance: if the "
      "bend is real, lambda is {:.4g} and not {:.4g}; more samples, or larger ones, would show it",
      other.window_high, *steeper->value, *own->value));
}

/// Sets the mean distance between the jumps of samples, and the number of points at which the samples lag behind the
/// line of regime II.
/// @param lambda  slope of the line of regime II that was fitted to the mean of the samples
void find_jumps(const ConsolidationCurve& curve, const LawPoints& points, double lambda, Regimes& regimes) {
  const int first = regimes.n_plateau, n = regimes.end_of_two - first;
  const Eigen::VectorXd log_P = points.log_P.segment(first, n);
  regimes.jump_distance = distance_of_jumps(curve.samples.middleRows(first, n), log_P, lambda);
  // Without a plateau, the samples lag already at the first point, and no points are left out.
  if (first > 0) regimes.n_lagging = points_in_lag(log_P, regimes.jump_distance);
}

/// Adds a parameter lambda without a value to a fit of the power law, and a warning that the curve has no
/// regime II.
ConsolidationFit without_two(ConsolidationFit power) {
  if (!power.found()) return power;
  power.parameters.insert(power.parameters.begin(), bounded_below("lambda", std::nullopt));
  power.warnings.emplace_back(
      "no regime II was found, because the power law of regime III describes the curve from where the solid "
      "fraction begins to grow: lambda is not identified (--law full fits both regimes)");
  return power;
}

}  // namespace

ConsolidationFit fit_supported_law(const ConsolidationCurve& curve, ConsolidationOptions options) {
  options.widen = true;
  options.regimes = std::nullopt;
  constexpr Eigen::Index kMinSamples = 3;
  const bool has_samples = curve.samples.cols() >= kMinSamples;
  // It is not known how the errors in the user's table depend on Phi; the weighting `between` is a compromise.
  if (options.weighting == Weighting::automatic && !has_samples) options.weighting = Weighting::between;
  std::optional<Regimes> unconfirmed;
  if (!options.window) {
    const auto n = static_cast<int>(curve.phi.size());
    constexpr int kEnough = 5;  // smallest number of points for a division into regimes
    const LawPoints points = law_points(curve, Weighting::between);
    if (n >= kEnough && has_samples) {
      const RegimesOfSamples found = regimes_of_samples(curve, points);
      options.regimes = found.chosen;
      unconfirmed = found.unconfirmed;
    } else if (n >= kEnough) {
      options.regimes = find_segments(points);
    }
    if (options.regimes && options.regimes->all_in_one) return fit_as(Law::log, curve, options);
  }
  ConsolidationFit full = fit_as(Law::full, curve, options);
  if (is_supported(full)) {
    add_indices(full);
    return full;
  }
  if (options.regimes && options.regimes->end_of_two == options.regimes->n_plateau)
    return without_two(fit_as(Law::power, curve, options));
  // Weights from the scatter of a few samples would depend on the same deviations as the errors, which would make the
  // intervals of the line too small.
  if (options.weighting == Weighting::automatic) options.weighting = Weighting::between;
  ConsolidationFit line = fit_as(Law::log, curve, options);
  if (!line.found()) return line;
  const FittedParameter* lambda = line.find("lambda");
  if (has_samples && options.regimes && lambda && lambda->value) {
    find_jumps(curve, law_points(curve, Weighting::between), *lambda->value, *options.regimes);
    line = fit_as(Law::log, curve, options);
  }
  if (line.found() && unconfirmed) warn_of_unconfirmed(curve, options, *unconfirmed, line);
  add_indices(line);
  add_beyond(curve, options, line);
  return line;
}

}  // namespace floc
