#include "floc/rigid/interior_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/interruption.h"
#include "floc/rigid/second_order_cone.h"

namespace floc {
namespace {

constexpr int kMostIterations = 200;
/// Length of the step of an iteration, divided by the longest step (at most 1) after which the point is still in the
/// cones.
constexpr double kStepShare = 0.99;
/// Softness s of the constraints: A x may differ from b by s y, which adds s y' y/2 to the objective. Without softness,
/// a program whose load is unbalanced only by rounding would have no solution, and motions that no contact resists
/// would be unlimited.
constexpr double kSoftness = 1e-13;
/// The iteration ends when the relative residual and the relative duality gap are below this value, which is close to
/// rounding errors.
constexpr double kGoal = 1e-13;
/// In programs with more blocks than kManyBlocks, the iteration ends when the relative residual and the relative
/// duality gap are below this value. Rounding errors make further iterations slow, and polish() replaces them.
constexpr double kGoalOfMany = 1e-10;
/// Weight of the duality gap in the error of an iterate. The objective is flat at its minimum, so a relative gap g
/// means an error of about sqrt(g) in the solution.
constexpr double kGapWeight = 1e4;
/// Largest allowed relative error of a proof that the objective has no lower bound.
constexpr double kProof = 1e-8;
/// Number of successive iterations without progress after which the iteration ends.
constexpr int kPatience = 10;
/// Factor by which the mean product of complementary variables, or the residual, has to decrease to count as progress.
constexpr double kProgress = 0.9;
/// In programs with more blocks than this number, a factorization costs far more than a direction, and additional
/// directions make the steps longer.
constexpr int kManyBlocks = 8000;
/// Step of Mehrotra's corrector below which correctors with other weights are tried.
constexpr double kShortStep = 0.1;
/// Largest number of directions that are added to Mehrotra's corrector (Iteration::centred()).
constexpr int kMostCorrectors = 3;
/// An additional direction aims at a step that is twice as long as without it and longer by at least kLongerStep. It
/// is used only if at least the share kWorthwhile of this additional length is reached.
constexpr double kLongerStep = 0.3, kWorthwhile = 0.1;
/// After a step, each product of complementary variables, divided by its target, should lie between kLeastProduct and
/// its inverse.
constexpr double kLeastProduct = 0.1;

template <int Dim>
using Blocks = std::vector<Vec<Dim>>;

template <int Dim>
double dot(const Blocks<Dim>& a, const Blocks<Dim>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].dot(b[k]);
  return sum;
}

/// Returns a' Q b for a diagonal matrix Q with the given diagonal.
template <int Dim>
double dot(const Blocks<Dim>& a, const Blocks<Dim>& diagonal, const Blocks<Dim>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k].cwiseProduct(diagonal[k]).dot(b[k]);
  return sum;
}

double largest(const Eigen::VectorXd& a) {
  return a.size() == 0 ? 0.0 : a.lpNorm<Eigen::Infinity>();
}

/// Returns the largest |(x_1, ..)| - x_0 of a block outside the cone K; 0 if all blocks are in K.
template <int Dim>
double violation(const Blocks<Dim>& x) {
  double most = 0.0;
  for (const Vec<Dim>& v : x) most = std::max(most, -cone::margin<Dim>(v));
  return most;
}

/// Point of the homogeneous embedding, or a direction in which a point is moved.
template <int Dim>
struct Point {
  Blocks<Dim> x, z;
  Eigen::VectorXd y;
  double tau = 1.0, kappa = 1.0;

  void add(const Point& direction, double step) {
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] += step * direction.x[k];
      z[k] += step * direction.z[k];
    }
    y += step * direction.y;
    tau += step * direction.tau;
    kappa += step * direction.kappa;
  }
  bool is_finite() const {
    return std::isfinite(dot(x, x) + dot(z, z) + y.squaredNorm() + tau * tau + kappa * kappa);
  }
  /// Returns the mean product of complementary variables (x and z, tau and kappa). This mean decreases to zero along
  /// the central path.
  double mu() const { return (dot(x, z) + tau * kappa) / (static_cast<double>(x.size()) + 1.0); }
};

/// Returns (S + s) y, with the softness s = kSoftness of the constraints.
template <int Dim>
Eigen::VectorXd softened(const ConeProgram<Dim>& program, const Eigen::VectorXd& y) {
  return program.softened(y) + kSoftness * y;
}

/// Returns x' Q x + y' (S + s) y, with the softness s = kSoftness of the constraints.
template <int Dim>
double twice_energy(const ConeProgram<Dim>& program, const Point<Dim>& at) {
  return dot(at.x, program.compliance, at.x) + at.y.dot(softened(program, at.y));
}

/// Residuals of the homogeneous embedding at a point.
template <int Dim>
struct EmbeddingResiduals {
  Blocks<Dim> dual;        // Q x + c tau - A' y - z
  Eigen::VectorXd primal;  // A x + (S + s) y - b tau
  double gap;              // -(x' Q x + y' (S + s) y)/tau - c' x + b' y - kappa
};

template <int Dim>
EmbeddingResiduals<Dim> residuals(const ConeProgram<Dim>& program, const Point<Dim>& at) {
  EmbeddingResiduals<Dim> out{program.relative_motion(at.y),
                              program.balance(at.x) + softened(program, at.y) - at.tau * program.load, 0.0};
  for (std::size_t k = 0; k < at.x.size(); ++k)
    out.dual[k] =
        program.compliance[k].cwiseProduct(at.x[k]) + program.linear[k] * at.tau - out.dual[k] - at.z[k];
  out.gap = -twice_energy(program, at) / at.tau - dot(program.linear, at.x) + program.load.dot(at.y) - at.kappa;
  return out;
}

/// Returns the longest step, at most 1, after which the point is still in the cones.
template <int Dim>
double longest_step(const Point<Dim>& from, const Point<Dim>& direction) {
  double step = 1.0;
  for (std::size_t k = 0; k < from.x.size(); ++k)
    step = std::min({step, cone::longest_step<Dim>(from.x[k], direction.x[k]),
                     cone::longest_step<Dim>(from.z[k], direction.z[k])});
  if (direction.tau < 0.0) step = std::min(step, -from.tau / direction.tau);
  if (direction.kappa < 0.0) step = std::min(step, -from.kappa / direction.kappa);
  return step;
}

/// Returns the largest error of the condition Q x + c - A' y = z in the solution that a point of the embedding
/// represents.
template <int Dim>
double stationarity_error(const ConeProgram<Dim>& program, const Point<Dim>& at) {
  double error = 0.0;
  for (const Vec<Dim>& r : residuals(program, at).dual) error = std::max(error, r.cwiseAbs().maxCoeff());
  return error / at.tau;
}

/// Returns the solution that a point of the embedding represents.
template <int Dim>
ConeSolution<Dim> solution_at(const ConeProgram<Dim>& program, const Point<Dim>& at) {
  ConeSolution<Dim> out;
  out.x = at.x;
  for (Vec<Dim>& x : out.x) x /= at.tau;
  out.motion = at.y / at.tau;
  const Eigen::VectorXd soft = program.softened(out.motion);
  out.objective =
      0.5 * (dot(out.x, program.compliance, out.x) + out.motion.dot(soft)) + dot(program.linear, out.x);
  out.residual = largest(Eigen::VectorXd(program.balance(out.x) + soft - program.load));
  out.gap = dot(at.x, at.z) / (at.tau * at.tau);
  return out;
}

/// Returns a lower bound of the largest component |A x - b|_max for all x in the cones with entries of order one. The
/// bound follows from b' y <= |A x - b|_max |y|_1 + x' A' y and from x' A' y <= 0. The second inequality is true up to
/// a small violation, because -A' y lies in the cones up to this violation. A negative result means that y gives no
/// bound.
template <int Dim>
double proved_residual(const ConeProgram<Dim>& program, const Eigen::VectorXd& y) {
  const double outside = violation(program.relative_motion(Eigen::VectorXd(-y)));
  return (program.load.dot(y) - outside * program.n_blocks()) / y.lpNorm<1>();
}

/// Returns the error of the proof that c' x has no lower bound: the largest component of A x, with x scaled such that
/// c' x = -1. The result is infinite if c' x does not decrease along x.
template <int Dim>
double error_of_unboundedness(const Blocks<Dim>& linear, const Eigen::VectorXd& balance, const Blocks<Dim>& x) {
  const double fall = -dot(linear, x);
  // The entries of x and c are of order one, so a very small decrease of the objective along x counts as a rounding
  // error.
  return fall > kProof ? largest(balance) / fall : std::numeric_limits<double>::infinity();
}

}  // namespace

/// One iteration: the scaling at a point, and the search directions from this point.
template <int Dim>
struct InteriorPoint<Dim>::Iteration {
  InteriorPoint& method;
  const ConeProgram<Dim>& program;
  const Point<Dim>& at;
  EmbeddingResiduals<Dim> residual;
  std::vector<cone::Scaling<Dim>> scaling;
  Blocks<Dim> scaled;                 // scaled point lambda = W z
  std::vector<Mat<Dim>> flexibility;  // blocks G = (Q + W^-2)^-1
  bool factorized = false;
  Blocks<Dim> constant_x;  // change of x for a change of tau by 1
  Eigen::VectorXd constant_y;

  Iteration(InteriorPoint& owner, const ConeProgram<Dim>& what, const Point<Dim>& start)
      : method(owner), program(what), at(start), residual(residuals(what, start)) {
    const int n = program.n_blocks();
    scaling.reserve(n);
    for (int k = 0; k < n; ++k) {
      const cone::Scaling<Dim>& s = scaling.emplace_back(at.x[k], at.z[k]);
      scaled.push_back(s.scaled(at.z[k]));
      flexibility.push_back(s.flexibility(program.compliance[k]));
    }
    factorized = method.factorize(program, flexibility);
    if (!factorized) return;
    Blocks<Dim> minus_linear = program.linear;
    for (Vec<Dim>& c : minus_linear) c = -c;
    solve(minus_linear, program.load, constant_x, constant_y);
  }

  /// Solves the system G^-1 x - A' y = u, A x + (S + s) y = v for x and y.
  void solve(const Blocks<Dim>& u, const Eigen::VectorXd& v, Blocks<Dim>& x, Eigen::VectorXd& y) const {
    constexpr int kMostRefinements = 10;
    const double enough = 1e-15 * largest(v);
    y = Eigen::VectorXd::Zero(program.n_rows());
    double before = std::numeric_limits<double>::infinity();
    for (int pass = 0;; ++pass) {
      x = program.relative_motion(y);
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = flexibility[k] * (u[k] + x[k]);
      const Eigen::VectorXd rest = v - program.balance(x) - softened(program, y);
      const double error = largest(rest);
      if (error <= enough || error > 0.5 * before || pass == kMostRefinements) break;
      before = error;
      y += method.factor_.solve(rest, 1).col(0);
    }
  }

  /// Returns the direction that reduces the residuals by the share `reduction` and changes the products of
  /// complementary variables by the given amounts.
  /// @param products  required change of (W^-1 x) o (W z), where o is the Jordan product; given as its quotient by
  /// lambda (cone::quotient)
  /// @param tau_kappa  required change of the product of tau and kappa
  Point<Dim> direction(double reduction, const Blocks<Dim>& products, double tau_kappa) const {
    Point<Dim> d;
    Blocks<Dim> u(at.x.size());
    for (std::size_t k = 0; k < u.size(); ++k)
      u[k] = -reduction * residual.dual[k] + scaling[k].unscaled(products[k]);
    solve(u, -reduction * residual.primal, d.x, d.y);
    const auto gap_of = [&](const Blocks<Dim>& x, const Eigen::VectorXd& y) {
      return 2.0 / at.tau * (dot(at.x, program.compliance, x) + at.y.dot(softened(program, y))) +
             dot(program.linear, x) - program.load.dot(y);
    };
    const double curvature = twice_energy(program, at) / (at.tau * at.tau);
    d.tau = (-reduction * residual.gap + tau_kappa / at.tau + gap_of(d.x, d.y)) /
            (curvature + at.kappa / at.tau - gap_of(constant_x, constant_y));
    d.kappa = (tau_kappa - at.kappa * d.tau) / at.tau;
    for (std::size_t k = 0; k < u.size(); ++k) d.x[k] += d.tau * constant_x[k];
    d.y += d.tau * constant_y;
    // The change of z is computed from the dual equation, which is then satisfied up to rounding.
    d.z = program.relative_motion(d.y);
    for (std::size_t k = 0; k < u.size(); ++k)
      d.z[k] = program.compliance[k].cwiseProduct(d.x[k]) + program.linear[k] * d.tau - d.z[k] +
               reduction * residual.dual[k];
    return d;
  }

  /// Returns the products of complementary variables after a step, in the scaled space.
  Vec<Dim> product_after(const Point<Dim>& d, double step, int k) const {
    const Vec<Dim> x = scaling[k].unscaled(Vec<Dim>(at.x[k] + step * d.x[k]));
    const Vec<Dim> z = scaling[k].scaled(Vec<Dim>(at.z[k] + step * d.z[k]));
    return cone::product<Dim>(x, z);
  }

  /// Adds directions that bring outlying products of complementary variables closer to their target, and thus make the
  /// step longer (multiple centrality correctors [G1996]). A few outliers among many blocks would otherwise make all
  /// steps short.
  Point<Dim> centred(Point<Dim> d, double target) const {
    double reached = longest_step(at, d);
    for (int n = 0; n < kMostCorrectors && reached < 1.0 - kWorthwhile; ++n) {
      const double aim = std::min(1.0, std::max(2.0 * reached, reached + kLongerStep));
      const double low = kLeastProduct * target, high = target / kLeastProduct;
      const auto change = [&](double product) {
        return std::max(std::clamp(product, low, high) - product, -high);
      };
      Blocks<Dim> products(at.x.size());
      for (std::size_t k = 0; k < products.size(); ++k)
        products[k] = cone::quotient<Dim>(
            scaled[k], cone::of_eigenvalues<Dim>(product_after(d, aim, static_cast<int>(k)), change));
      const double tau_kappa = change((at.tau + aim * d.tau) * (at.kappa + aim * d.kappa));
      Point<Dim> next = d;
      next.add(direction(0.0, products, tau_kappa), 1.0);
      const double longer = longest_step(at, next);
      if (!(longer > reached + kWorthwhile * (aim - reached))) break;
      reached = longer;
      d = std::move(next);
    }
    return d;
  }

  /// Returns the direction of Mehrotra's corrector.
  /// @param centring  mean product of complementary variables at which the direction aims, divided by the present one
  /// @param weight  factor on the products of the changes of complementary variables in the predictor
  Point<Dim> corrector(const Point<Dim>& predictor, double centring, double weight) const {
    const double target = centring * at.mu();
    Blocks<Dim> products(at.x.size());
    for (std::size_t k = 0; k < products.size(); ++k) {
      const Vec<Dim> dx = scaling[k].unscaled(predictor.x[k]), dz = scaling[k].scaled(predictor.z[k]);
      const Vec<Dim> change = target * Vec<Dim>::Unit(0) - cone::product<Dim>(scaled[k], scaled[k]) -
                              weight * cone::product<Dim>(dx, dz);
      products[k] = cone::quotient<Dim>(scaled[k], change);
    }
    return direction(1.0 - centring, products,
                     target - at.tau * at.kappa - weight * predictor.tau * predictor.kappa);
  }

  /// Returns the direction of the next step. The step length of the predictor determines the centring.
  Point<Dim> direction() const {
    Blocks<Dim> products = scaled;
    for (Vec<Dim>& v : products) v = -v;
    const Point<Dim> predictor = direction(1.0, products, -at.tau * at.kappa);
    const double centring = std::pow(1.0 - longest_step(at, predictor), 3);
    Point<Dim> best = corrector(predictor, centring, 1.0);
    if (program.n_blocks() <= kManyBlocks) return best;
    // The products of the changes are wrong by far if the predictor reaches far beyond the cones.
    for (const double weight : {0.3, 0.0}) {
      if (longest_step(at, best) > kShortStep) break;
      Point<Dim> next = corrector(predictor, centring, weight);
      if (longest_step(at, next) > longest_step(at, best)) best = std::move(next);
    }
    return centred(std::move(best), centring * at.mu());
  }
};

template <int Dim>
InteriorPoint<Dim>::InteriorPoint(const ConeProgram<Dim>& pattern) {
  // Each pair of entries of one block contributes to one element of the matrix. The places of these elements in memory
  // are found only once.
  std::vector<Eigen::Triplet<double>> entries;
  const auto for_each_pair = [&](const auto& visit) {
    for (int k = 0; k < pattern.n_blocks(); ++k)
      for (int e = pattern.first[k]; e < pattern.first[k + 1]; ++e)
        for (int f = pattern.first[k]; f <= e; ++f)
          visit(std::max(pattern.row[e], pattern.row[f]), std::min(pattern.row[e], pattern.row[f]));
  };
  for_each_pair([&](int row, int column) { entries.emplace_back(row, column, 0.0); });
  for (int r = 0; r < pattern.n_rows(); ++r) entries.emplace_back(r, r, 0.0);
  matrix_.resize(pattern.n_rows(), pattern.n_rows());
  matrix_.setFromTriplets(entries.begin(), entries.end());
  place_.reserve(entries.size() - pattern.n_rows());
  for_each_pair([&](int row, int column) {
    const int* const begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
    const int* const end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
    place_.push_back(static_cast<int>(std::lower_bound(begin, end, row) - matrix_.innerIndexPtr()));
  });
}

template <int Dim>
bool InteriorPoint<Dim>::factorize(const ConeProgram<Dim>& program, const std::vector<Mat<Dim>>& flexibility) {
  double* const value = matrix_.valuePtr();
  std::fill(value, value + matrix_.nonZeros(), 0.0);
  const int* place = place_.data();
  for (int k = 0; k < program.n_blocks(); ++k)
    for (int e = program.first[k]; e < program.first[k + 1]; ++e) {
      const Vec<Dim> force = flexibility[k] * program.coefficient[e];
      for (int f = program.first[k]; f <= e; ++f) value[*place++] += program.coefficient[f].dot(force);
    }
  for (std::size_t e = 0; e < program.block_softness.size(); ++e) value[place_[e]] += program.block_softness[e];
  for (int r = 0; r < program.softness.size(); ++r) matrix_.coeffRef(r, r) += program.softness[r];
  double most = 0.0;
  for (int r = 0; r < program.n_rows(); ++r) most = std::max(most, matrix_.coeff(r, r));
  if (!std::isfinite(most)) return false;
  factor_.set_matrix(matrix_, program.group);
  // Rounding may make the matrix indefinite. A larger shift of its diagonal then makes it positive, and iterative
  // refinement removes the effect of the shift.
  for (double shift = kSoftness; shift < 1e-6 * most; shift = std::max(1e-15 * most, 100.0 * shift))
    if (factor_.factorize_positive(shift)) return true;
  return false;
}

template <int Dim>
ConeSolution<Dim> InteriorPoint<Dim>::solve(const ConeProgram<Dim>& program, double tolerance) {
  Point<Dim> at;
  at.x.assign(program.n_blocks(), Vec<Dim>::Unit(0));
  at.z = at.x;
  at.y = Eigen::VectorXd::Zero(program.n_rows());
  const double size_of_load = std::max(1.0, largest(program.load));
  ConeSolution<Dim> best;
  double best_error = std::numeric_limits<double>::infinity(), least_mu = best_error,
         least_residual = best_error;
  int n_factorizations = 0;
  for (int iteration = 0, idle = 0; iteration < kMostIterations && idle < kPatience; ++iteration) {
    check_interruption();
    const ConeSolution<Dim> now = solution_at(program, at);
    // This residual includes the softness s y of the constraints, because rounding errors in a load may leave a small
    // part of it that only s y can balance. The residual without the softness is checked only at the end.
    const double residual =
        largest(Eigen::VectorXd(program.balance(now.x) + softened(program, now.motion) - program.load));
    const double error =
        std::max({residual / size_of_load, kGapWeight * now.relative_gap(), stationarity_error(program, at)});
    // A decrease of mu counts as progress, too. If the program has no solution, mu decreases while the iterates
    // approach a proof of this, but the error does not decrease. If the program has hardly a solution, the residual
    // decreases while mu grows.
    ++idle;
    if (at.mu() < kProgress * least_mu) {
      least_mu = at.mu();
      idle = 0;
    }
    if (residual < kProgress * least_residual) {
      least_residual = residual;
      idle = 0;
    }
    if (error < best_error) {
      best = now;
      best_error = error;
      idle = 0;
    }
    if (error < kGoal) break;
    if (program.n_blocks() > kManyBlocks && std::max(residual / size_of_load, now.relative_gap()) < kGoalOfMany)
      break;
    // If a program has no solution, the iterates grow without bound in a direction that proves that there is none. With
    // S > 0 there is always a solution.
    if (program.softness.size() == 0 && at.kappa > at.tau && proved_residual(program, at.y) > tolerance) {
      ConeSolution<Dim> proof = now;
      proof.status = ConeStatus::kInfeasible;
      proof.n_factorizations = n_factorizations;
      return proof;
    }
    const Iteration step(*this, program, at);
    ++n_factorizations;
    if (!step.factorized) break;
    const Point<Dim> direction = step.direction();
    if (!direction.is_finite()) break;
    at.add(direction, kStepShare * longest_step(at, direction));
    // In the homogeneous embedding only ratios of the values matter. The values are scaled here to avoid overflow.
    const double size = std::max(at.tau, at.kappa);
    for (Vec<Dim>& x : at.x) x /= size;
    for (Vec<Dim>& z : at.z) z /= size;
    at.y /= size;
    at.tau /= size;
    at.kappa /= size;
  }
  best.n_factorizations = n_factorizations;
  if (std::max(best.residual / size_of_load, best.relative_gap()) < tolerance)
    best.status = ConeStatus::kSolved;
  return best;
}

template <int Dim>
bool InteriorPoint<Dim>::falls_without_bound(ConeProgram<Dim> program) {
  // The direction of steepest descent is the d in the cones with A d = 0 that minimises c' d + d' d/2.
  program.load.setZero();
  program.compliance.assign(program.n_blocks(), Vec<Dim>::Ones());
  const ConeSolution<Dim> fall = solve(program);
  return fall.status == ConeStatus::kSolved &&
         error_of_unboundedness(program.linear, program.balance(fall.x), fall.x) < kProof;
}

template <int Dim>
ConeSolution<Dim> InteriorPoint<Dim>::minimise_linear(ConeProgram<Dim> program, double bound) {
  constexpr double kFirstWeight = 1e-2, kLeastWeight = 1e-6, kMostWeight = 10.0;
  constexpr int kMostPoints = 60;
  constexpr double kPrecision = 1e-10;
  const std::vector<Vec<Dim>> objective = program.linear;
  ConeSolution<Dim> best;
  best.x.assign(program.n_blocks(), Vec<Dim>::Zero());
  double weight = kFirstWeight, least = kLeastWeight, before = std::numeric_limits<double>::infinity();
  int n_factorizations = 0;
  for (int n = 0; n < kMostPoints; ++n) {
    for (int k = 0; k < program.n_blocks(); ++k) {
      program.compliance[k].setConstant(weight);
      program.linear[k] = objective[k] - weight * best.x[k];
    }
    ConeSolution<Dim> found = solve(program);
    n_factorizations += found.n_factorizations;
    found.n_factorizations = n_factorizations;
    if (found.status == ConeStatus::kFailed && weight < kMostWeight) {
      // The compliance is too small for this program. The search continues with a larger compliance.
      least = weight = 10.0 * weight;
      continue;
    }
    if (found.status != ConeStatus::kSolved) return found;
    found.objective = dot(objective, found.x);
    const double change = before - found.objective, size = std::max(1.0, std::abs(found.objective));
    before = found.objective;
    best = std::move(found);
    if (before - bound < kPrecision * size || std::abs(change) < kPrecision * size) break;
    if (n > 1 && change > size / 2) {
      ConeProgram<Dim> linear = program;
      linear.linear = objective;
      if (falls_without_bound(std::move(linear))) {
        best.status = ConeStatus::kUnbounded;
        break;
      }
    }
    weight = std::max(least, 0.1 * weight);
  }
  return best;
}

template class InteriorPoint<2>;
template class InteriorPoint<3>;

}  // namespace floc
