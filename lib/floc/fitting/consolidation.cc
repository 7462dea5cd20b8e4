#include "floc/fitting/consolidation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "floc/fitting/consolidation_solver.h"
#include "floc/fitting/student_t.h"

namespace floc {
namespace {

using Law = ConsolidationLaw;

/// Regime II needs this many pressures before its slope is one.
constexpr int kFewestInRegimeTwo = 3;
/// (P1*/P*)^alpha above which the local slope of the full law is within a fifth of lambda: regime II.
constexpr double kRegimeTwo = 2.65;
/// (P1*/P*)^alpha below which the power law is within a twentieth of the full one: regime III.
constexpr double kRegimeThree = 0.6;
/// Residuals of 1/Phi below this are rounding of the table, not information about its model.
constexpr double kRounding = 1e-9;
/// A parameter known to less than this factor either way is not identified.
constexpr double kIdentifiedFactor = 10.0;

/// P0* should lie at the end of the plateau to within this factor.
constexpr double kFarFromTheEnd = 2.0;

/// The points of a curve as the laws see them.
struct Points {
  Eigen::VectorXd log_P, y;

  int size() const { return static_cast<int>(y.size()); }
  Points range(int first, int n) const { return {log_P.segment(first, n), y.segment(first, n)}; }
};

Points points_of(const ConsolidationCurve& curve) {
  const auto n = static_cast<Eigen::Index>(curve.phi.size());
  return {Eigen::Map<const Eigen::VectorXd>(curve.P_star.data(), n).array().log(),
          Eigen::Map<const Eigen::VectorXd>(curve.phi.data(), n).array().inverse()};
}

/// Bayesian information criterion of a least-squares model, up to a constant.
double information(double sum_of_squares, int n, int n_free) {
  const double floor = n * kRounding * kRounding;
  return n * std::log(std::max(sum_of_squares, floor) / n) + n_free * std::log(n);
}

/// True if these points tell the full law from the line of regime II.
bool see_a_bend(const Points& points, const LawSolution& full) {
  const auto line = solve_law(Law::log, points.log_P, points.y);
  const int n = points.size();
  return !line || information(full.sum_of_squares, n, n_parameters(Law::full)) <
                      information(line->sum_of_squares, n, n_parameters(Law::log));
}

/// True if they also reach beyond P1*.
bool see_regime_three(const Points& points, const LawSolution& full) {
  return full.theta[3] < points.log_P[points.size() - 1] && see_a_bend(points, full);
}

/// Number of points at pressures below P1*.
int n_before_regime_three(const Points& points, const LawSolution& full) {
  return static_cast<int>((points.log_P.array() < full.theta[3]).count());
}

struct Split {
  int n_plateau;
  LawSolution solution;
};

/// Splits the points into a plateau (a constant) and a rest that follows the law, such that both together leave
/// the least information; as few points in the plateau as explain as much. Absent if no split leaves a regime
/// II.
std::optional<Split> split_off_plateau(Law law, const Points& points) {
  std::optional<Split> best;
  double least = std::numeric_limits<double>::infinity();
  const int n = points.size();
  const int longest = std::min(n / 2, n - n_parameters(law) - 1);
  for (int k = 0; k <= longest; ++k) {
    const Points rest = points.range(k, n - k);
    auto solution = solve_law(law, rest.log_P, rest.y);
    if (!solution || (law == Law::full && n_before_regime_three(rest, *solution) < kFewestInRegimeTwo))
      continue;
    const Eigen::VectorXd plateau = points.y.head(k);
    const double left = k > 0 ? (plateau.array() - plateau.mean()).square().sum() : 0.0;
    // A plateau costs two numbers: its level and its end.
    const double info = information(solution->sum_of_squares + left, n, n_parameters(law) + (k > 0 ? 2 : 0));
    if (info < least) {
      least = info;
      best = Split{k, std::move(*solution)};
    }
  }
  return best;
}

/// A fit under construction: the points fitted, the solution, and the plateau before them.
struct Draft {
  Points points;
  LawSolution solution;
  std::optional<double> plateau;  ///< mean of 1/Phi over the plateau
  double t95;

  /// Of a function of theta with this gradient.
  double standard_error(const Eigen::VectorXd& gradient) const {
    double variance = 0.0;
    for (int i = 0; i < gradient.size(); ++i)
      for (int j = 0; j < gradient.size(); ++j)
        if (gradient[i] != 0.0 && gradient[j] != 0.0)
          variance += gradient[i] * solution.covariance(i, j) * gradient[j];
    return std::sqrt(variance);
  }
};

/// A parameter exp(c) from its logarithm and that one's standard error.
FittedParameter from_log(const std::string& name, double c, double error, double t95) {
  FittedParameter p{
      name, std::exp(c), std::exp(c) * error, std::exp(c - t95 * error), std::exp(c + t95 * error), true};
  p.identified = t95 * error < std::log(kIdentifiedFactor);
  return p;
}

/// A solid fraction 1/y.
FittedParameter from_inverse(const std::string& name, double y, double error, double t95) {
  const double low = y - t95 * error;
  FittedParameter p{
      name, 1.0 / y, error / (y * y), 1.0 / (y + t95 * error), std::nullopt, std::isfinite(error)};
  if (low > 0.0)
    p.high95 = 1.0 / low;
  else
    p.identified = false;
  return p;
}

FittedParameter held(const std::string& name, double value) {
  return {name, value, {}, {}, {}, true};
}

/// P0* and Phi0 of the line y_line - lambda (ln P - log_P_line), lambda = exp(theta[0]), where the gradients of
/// y_line and log_P_line to theta are unit vectors: `at_y` and, if it is a parameter, `at_log_P`.
void add_start_of_regime_two(const Draft& d, double log_P_line, int at_log_P, double y_line, int at_y,
                             ConsolidationFit& fit) {
  const double lambda = std::exp(d.solution.theta[0]);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(d.solution.theta.size());
  if (d.plateau) {
    // The line meets the plateau, whose level has an error of its own.
    const double drop = (y_line - *d.plateau) / lambda;
    gradient[0] = -drop;
    gradient[at_y] = 1.0 / lambda;
    if (at_log_P >= 0) gradient[at_log_P] = 1.0;
    const double n_free = static_cast<double>(d.solution.theta.size());
    const double variance = d.solution.sum_of_squares / (d.points.size() - n_free) / fit.n_plateau;
    const double error = std::hypot(d.standard_error(gradient), std::sqrt(variance) / lambda);
    fit.parameters.push_back(from_inverse("Phi0", *d.plateau, std::sqrt(variance), d.t95));
    fit.parameters.push_back(from_log("P0_star", log_P_line + drop, error, d.t95));
    // The plateau ends between its last point and the first of the window, where the line should meet it.
    const double P0 = std::exp(log_P_line + drop);
    if (P0 < fit.plateau_high / kFarFromTheEnd || P0 > fit.window_low * kFarFromTheEnd)
      fit.warnings.push_back(
          fmt::format("the line of regime II meets the plateau at P0* = {:.4g}, but the plateau ends between "
                      "{:.4g} and {:.4g}: the "
                      "density jumps there; a mean over samples, or --window, gives a better P0*",
                      P0, fit.plateau_high, fit.window_low));
    return;
  }
  const double distance = d.points.log_P[0] - log_P_line;
  gradient[0] = -lambda * distance;
  gradient[at_y] = 1.0;
  if (at_log_P >= 0) gradient[at_log_P] = lambda;
  fit.parameters.push_back(from_inverse("Phi0", y_line - lambda * distance, d.standard_error(gradient), d.t95));
  fit.parameters.push_back(held("P0_star", fit.window_low));
}

/// Parameters that are coordinates of theta themselves.
void add_free(const Draft& d, const std::vector<std::string>& names, ConsolidationFit& fit) {
  const Eigen::VectorXd& theta = d.solution.theta;
  const Eigen::MatrixXd& c = d.solution.covariance;
  for (int k = 0; k < theta.size(); ++k) {
    const double error = std::sqrt(c(k, k));
    fit.parameters.push_back(names[k] == "Phi_max" ? from_inverse(names[k], theta[k], error, d.t95)
                                                   : from_log(names[k], theta[k], error, d.t95));
    if (!fit.parameters.back().identified)
      fit.warnings.push_back(fmt::format("{} is not identified by these data", names[k]));
  }
  fit.correlated = names;
  const Eigen::VectorXd scale = c.diagonal().cwiseSqrt().cwiseInverse();
  fit.correlation = scale.asDiagonal() * c * scale.asDiagonal();
  // Phi_max falls as its coordinate 1/Phi_max grows.
  const auto phi_max = std::find(names.begin(), names.end(), "Phi_max");
  if (phi_max == names.end()) return;
  const auto at = phi_max - names.begin();
  fit.correlation.row(at) *= -1.0;
  fit.correlation.col(at) *= -1.0;
}

FittedParameter bound_from_below(const std::string& name, std::optional<double> low) {
  return {name, std::nullopt, std::nullopt, low, std::nullopt, false};
}

/// The data end before P1*: lambda is that of the law they can tell, the rest is bounded by the last point.
void add_regime_two_alone(Draft d, double last_phi, ConsolidationFit& fit) {
  const bool bends = see_a_bend(d.points, d.solution);
  if (!bends) d.solution = *solve_law(Law::log, d.points.log_P, d.points.y);
  const Eigen::VectorXd& theta = d.solution.theta;
  d.t95 = student_t_95(d.points.size() - static_cast<int>(theta.size()));
  fit.rms = std::sqrt(d.solution.sum_of_squares / d.points.size());
  fit.parameters.push_back(from_log("lambda", theta[0], std::sqrt(d.solution.covariance(0, 0)), d.t95));
  fit.parameters.push_back(bound_from_below("alpha", std::nullopt));
  fit.parameters.push_back(bound_from_below("Phi_max", last_phi));
  fit.parameters.push_back(bound_from_below("P1_star", fit.window_high));
  if (bends)
    add_start_of_regime_two(d, theta[3], 3, theta[2], 2, fit);
  else
    add_start_of_regime_two(d, d.points.log_P[0], -1, theta[1], 1, fit);
  fit.correlated = {"lambda"};
  fit.correlation = Eigen::MatrixXd::Ones(1, 1);
  fit.warnings.push_back(
      fmt::format("the data end at P* = {:.6g}, before P1*: alpha is not identified, P1_star and Phi_max are "
                  "bounds, and lambda is "
                  "that of {}",
                  fit.window_high, bends ? "the full law" : "the line of regime II"));
}

void add_parameters(const Draft& d, ConsolidationFit& fit) {
  const Eigen::VectorXd& theta = d.solution.theta;
  switch (fit.law) {
    case Law::log:
      fit.parameters.push_back(from_log("lambda", theta[0], std::sqrt(d.solution.covariance(0, 0)), d.t95));
      fit.correlated = {"lambda"};
      fit.correlation = Eigen::MatrixXd::Ones(1, 1);
      add_start_of_regime_two(d, d.points.log_P[0], -1, theta[1], 1, fit);
      break;
    case Law::power:
      add_free(d, {"A", "alpha", "Phi_max"}, fit);
      break;
    case Law::full:
      add_free(d, {"lambda", "alpha", "Phi_max", "P1_star"}, fit);
      add_start_of_regime_two(d, theta[3], 3, theta[2], 2, fit);
      break;
  }
}

std::string regime_of(Law law) {
  return law == Law::power ? "regime III" : "regime II";
}

ConsolidationFit refused(Law law, std::string why) {
  ConsolidationFit fit;
  fit.law = law;
  fit.refusal = std::move(why);
  return fit;
}

/// First point and number of points a law is fitted on.
struct Window {
  int first, n;
  int n_plateau;
};

Window given_window(const ConsolidationCurve& curve, std::pair<double, double> window) {
  // A bound typed with a few digits is meant to include the grid pressure it rounds.
  constexpr double kTyped = 1e-3;
  const auto inside = [&](double P) {
    return P >= window.first * (1 - kTyped) && P <= window.second * (1 + kTyped);
  };
  const auto begin = std::find_if(curve.P_star.begin(), curve.P_star.end(), inside);
  return {static_cast<int>(begin - curve.P_star.begin()),
          static_cast<int>(std::count_if(begin, curve.P_star.end(), inside)), 0};
}

/// The pressures that belong to the law by a split of the whole curve with the full law; where that is
/// impossible, with the line alone.
std::optional<Window> found_window(Law law, const Points& points) {
  const int n = points.size();
  const auto full = split_off_plateau(Law::full, points);
  if (!full) {
    const auto line = law == Law::log ? split_off_plateau(Law::log, points) : std::nullopt;
    return line ? std::optional(Window{line->n_plateau, n - line->n_plateau, line->n_plateau}) : std::nullopt;
  }
  const int k = full->n_plateau;
  const Points rest = points.range(k, n - k);
  if (law == Law::full) return Window{k, n - k, k};
  const LawSolution& s = full->solution;
  const bool has_end = see_regime_three(rest, s);
  const double shift = (law == Law::log ? std::log(kRegimeTwo) : std::log(kRegimeThree)) / std::exp(s.theta[1]);
  const double end = has_end ? s.theta[3] - shift : std::numeric_limits<double>::infinity();
  const int n_below = static_cast<int>((rest.log_P.array() <= end).count());
  if (law == Law::log) return Window{k, n_below, k};
  return Window{k + n_below, n - k - n_below, 0};
}

std::string too_few(Law law, int n) {
  const int needed = n_parameters(law) + 1;
  return fmt::format(
      "{} pressures in {}, the {} law needs {}: give more with --window lo,hi or a finer load path", n,
      law == Law::full ? "the window" : regime_of(law),
      law == Law::log     ? "log"
      : law == Law::power ? "power"
                          : "full",
      needed);
}

void describe_window(const ConsolidationCurve& curve, const Window& window, ConsolidationFit& fit) {
  fit.n_plateau = window.n_plateau;
  if (window.n_plateau > 0) fit.plateau_high = curve.P_star[window.first - 1];
  for (int i = 0; i < window.n; ++i) fit.used.push_back(window.first + i);
  fit.window_low = curve.P_star[window.first];
  fit.window_high = curve.P_star[window.first + window.n - 1];
}

}  // namespace

const FittedParameter* ConsolidationFit::find(const std::string& name) const {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

ConsolidationFit fit_consolidation(const ConsolidationCurve& curve, const ConsolidationOptions& options) {
  assert(curve.P_star.size() == curve.phi.size());
  const Law law = options.law;
  const Points points = points_of(curve);
  if (points.size() <= n_parameters(law)) return refused(law, too_few(law, points.size()));
  const auto window = options.window ? given_window(curve, *options.window) : found_window(law, points);
  if (!window)
    return refused(law,
                   fmt::format("no stretch of at least {} pressures over which the solid fraction grows as in "
                               "regime II: try --law log with --window lo,hi",
                               kFewestInRegimeTwo));
  if (window->n <= n_parameters(law)) return refused(law, too_few(law, window->n));

  Draft draft{points.range(window->first, window->n), {}, std::nullopt, 0.0};
  auto solution = solve_law(law, draft.points.log_P, draft.points.y);
  if (!solution) return refused(law, "the solid fraction does not grow with pressure over the window");
  draft.solution = std::move(*solution);
  draft.t95 = student_t_95(window->n - n_parameters(law));
  if (window->n_plateau > 0 && !options.hold_P0) draft.plateau = points.y.head(window->n_plateau).mean();

  ConsolidationFit fit;
  fit.law = law;
  describe_window(curve, *window, fit);
  fit.rms = std::sqrt(draft.solution.sum_of_squares / window->n);
  if (law == Law::full && !see_regime_three(draft.points, draft.solution)) {
    add_regime_two_alone(std::move(draft), curve.phi[fit.used.back()], fit);
    return fit;
  }
  if (law == Law::full && n_before_regime_three(draft.points, draft.solution) < kFewestInRegimeTwo)
    return refused(
        law,
        fmt::format("only {} of the pressures lie before P1* = {:.4g}, regime II needs {}: try --law power",
                    n_before_regime_three(draft.points, draft.solution), std::exp(draft.solution.theta[3]),
                    kFewestInRegimeTwo));
  add_parameters(draft, fit);
  return fit;
}

FirstLoading first_loading(const std::vector<PathRow>& rows) {
  const auto is_load = [](const PathRow& r) { return r.branch == "load"; };
  const auto load = std::find_if(rows.begin(), rows.end(), is_load);
  const auto end = load == rows.end()
                       ? std::is_sorted_until(rows.begin(), rows.end(),
                                              [](const auto& a, const auto& b) { return a.P_star < b.P_star; })
                       : std::find_if_not(load, rows.end(), is_load);
  FirstLoading found;
  for (auto row = rows.begin(); row != end; ++row) {
    if (load != rows.end() && row < load && row->branch != "assembly") continue;
    if (row->P_star == 0.0) {
      ++found.n_zero_pressure;
      continue;
    }
    found.curve.P_star.push_back(row->P_star);
    found.curve.phi.push_back(row->phi);
    found.rows.push_back(static_cast<int>(row - rows.begin()));
  }
  return found;
}

ConsolidationCurve pooled_curve(const std::vector<ConsolidationCurve>& samples) {
  constexpr double kSamePressure = 1e-3;
  ConsolidationCurve pooled;
  if (samples.empty()) return pooled;
  for (const double P : samples.front().P_star) {
    double sum = 0.0;
    std::size_t n = 0;
    for (const ConsolidationCurve& sample : samples) {
      const auto same = std::find_if(sample.P_star.begin(), sample.P_star.end(),
                                     [&](double Q) { return std::abs(Q - P) <= kSamePressure * P; });
      if (same == sample.P_star.end()) break;
      sum += 1.0 / sample.phi[static_cast<std::size_t>(same - sample.P_star.begin())];
      ++n;
    }
    if (n != samples.size()) continue;
    pooled.P_star.push_back(P);
    pooled.phi.push_back(static_cast<double>(n) / sum);
  }
  return pooled;
}

}  // namespace floc
