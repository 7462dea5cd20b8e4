#include "floc/elasticity/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "floc/base/dense_solvers.h"
#include "floc/elasticity/convected_stress.h"
#include "floc/elasticity/moduli.h"
#include "floc/elasticity/reduced_unknowns.h"
#include "floc/linalg/positivity.h"
#include "floc/linalg/symmetric_factor.h"
#include "floc/network/free_motions.h"
#include "floc/network/stiffness_matrix.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

/// An eigenvalue of the stiffness against strain of the cell (after relaxation of the grains) counts as zero if it is
/// at most this share of the stiffness without relaxation. The strain of such an eigenvalue is a mechanism.
constexpr double kVanishingStrain = 1e-11;
/// Condition number above which a Cholesky factor may hide a mechanism, so that the eigenvalues are counted as well.
constexpr double kSuspiciousCondition = 1e12;
/// Assumed largest eigenvalue of a stiffness matrix scaled to a diagonal of 1. In packings it is 2 to 4.
constexpr double kLargestEigenvalue = 4.0;

/// Returns whether any contact has a negative normal stiffness.
/// @param contacts  contacts of a network or of a packing
bool has_negative_stiffness(const auto& contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.kn < 0.0; });
}

int count_below(const Eigen::MatrixXd& symmetric, double bound) {
  return static_cast<int>((symmetric_eigenvalues(symmetric).array() < bound).count());
}

/// Stiffness matrix of grains and strains, divided by the largest contact stiffness, without the unknowns of free
/// motions.
struct ReducedStiffness {
  Eigen::SparseMatrix<double> grains;  // rows and columns of the grains, lower triangle
  std::vector<int> group;              // number of the grain of each row of `grains`
  Eigen::MatrixXd border, boundary;
  // largest absolute eigenvalue that counts as zero in the stiffness against strain after relaxation of the grains
  double vanishing = 0.0;
  double unresolved = 0.0;  // absolute value below which the sign of an eigenvalue of `grains` is not certain
  int n_unstable_ends = 0;  // number of negative eigenvalues of the dead ends, which `grains` does not contain
};

/// Returns the largest amount by which the eigenvalue of a mechanism may be below zero, in units of the largest contact
/// stiffness. Only the symmetric part S of the tangent matrix K = S + A is tested. A mechanism v has K v = 0, and thus
/// S v = -A v and v.S v = 0, with the antisymmetric part A of K. Because S v is not zero, S couples v to stiff motions
/// (stiffness k), and the eigenvalue of S is about -|A v|^2/k instead of zero. A results from tangential forces F_T and
/// moments alone and is of the order of F_T/r, with the distance r between centres. For comparison, |A v|^2/k is of the
/// order of (F_T/r)^2/k, whereas the eigenvalue of a real instability from geometric terms is of the order of -F_T/r.
template <int Dim>
double unresolved_by_symmetry(const ContactNetwork<Dim>& network, double unit) {
  double largest = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts)
    if (!c.on_wall() && !c.distant) {
      const double moments = c.rolling_moment.norm() + std::abs(c.twisting_moment);
      const double r = c.branch.norm();
      largest = std::max(largest, (c.shear_force.norm() + moments / r) / r);
    }
  return std::pow(largest / unit, 2);
}

/// Returns the convected stress that counts in the stability of a packing: convected_stress(), in a box only for axes
/// with a wall that forces move. The other lengths of a box cannot change, or nothing resists their change. With its
/// terms, a strain that nothing resists would couple to the other strains, and a bed on a floor would count as
/// unstable.
template <int Dim>
Eigen::MatrixXd free_convected_stress(const Packing<Dim>& packing) {
  Eigen::MatrixXd convected = convected_stress<Dim>(load_stress(packing), Dim);
  for (int a = 0; a < Dim && !packing.walls.empty(); ++a) {
    if (n_moving_walls(packing, a) > 0) continue;
    convected.row(a).setZero();
    convected.col(a).setZero();
  }
  return convected;
}

/// @param convected  terms that prestress adds to the stiffness against strains of the cell (stress); absent without
/// prestress
template <int Dim>
ReducedStiffness reduced_stiffness(const ContactNetwork<Dim>& whole,
                                   const std::optional<Eigen::MatrixXd>& convected) {
  const FreeMotions free = find_free_motions(whole);
  const ContactNetwork<Dim> core = without_grains(whole, free.dead_end);
  const ReducedUnknowns unknowns = reduce_unknowns(core, free.kept);
  const double unit = stiffness_scale(core);
  const bool prestress = convected.has_value();
  const StiffnessMatrix k = stiffness_matrix(core, {StrainSet::diagonal, prestress, true, prestress});
  ReducedStiffness out;
  out.n_unstable_ends = free.n_unstable_ends;
  out.grains = reduce(k.grains, unknowns, unit);
  out.group = grain_of_rows<Dim>(unknowns);
  out.border.resize(unknowns.length.size(), k.border.cols());
  for (Eigen::Index a = 0; a < out.border.rows(); ++a)
    out.border.row(a) =
        k.border.row(unknowns.unknown[static_cast<std::size_t>(a)]) * (unknowns.length[a] / unit);
  out.boundary = k.boundary / unit;
  out.vanishing = kVanishingStrain * k.boundary.cwiseAbs().maxCoeff() / unit;
  out.unresolved = ResponseOptions{}.mechanism_bound;
  if (!convected) return out;
  out.boundary.topLeftCorner(Dim, Dim) += whole.volume / unit * *convected;
  out.unresolved = std::max(out.unresolved, unresolved_by_symmetry(core, unit));
  return out;
}

/// Tests the stability by a factor. By Haynsworth's theorem, the stiffness matrix has as many negative eigenvalues as
/// the block of the grains and its Schur complement together. The Schur complement is the stiffness against strain
/// after relaxation of the grains. No refinement is needed, because a factor with rounding errors is the exact factor
/// of a nearby matrix.
/// @return result of the test; if the factor would be too expensive, the result contains the reason but no number
Stability test_by_factor(const ReducedStiffness& k, const StabilityOptions& options) {
  SymmetricFactor factor;
  factor.set_matrix(k.grains, k.group);
  const FactorCost cost = factor.predicted_cost();
  if (cost.bytes > options.largest_factor || cost.operations > options.most_operations)
    return {std::nullopt,
            fmt::format("a factor of the stiffness matrix would take {:.2g} GB and {:.0e} operations; ",
                        1e-9 * cost.bytes, cost.operations)};
  int n_negative = k.n_unstable_ends;
  if (!factor.factorize_positive() || factor.reciprocal_condition() * kSuspiciousCondition < 1.0)
    n_negative += factor.count_eigenvalues_below(-k.unresolved);
  const Eigen::MatrixXd relaxed = k.boundary - k.border.transpose() * factor.solve(k.border, 0);
  return {n_negative + count_below(relaxed, -k.vanishing), ""};
}

/// Stiffness matrix of grains and strains, scaled to a diagonal of 1. An iterative test uses this matrix only in
/// products with vectors.
class ScaledStiffness {
 public:
  explicit ScaledStiffness(const ReducedStiffness& k) : grains_(k.grains), border_(k.border) {
    const Eigen::Index n = grains_.rows(), n_strains = k.boundary.rows();
    diagonal_.resize(n + n_strains);
    diagonal_ << grains_.diagonal(), k.boundary.diagonal();
    const Eigen::VectorXd root = (diagonal_.array() > 0.0).select(diagonal_.array().sqrt(), 1.0).matrix();
    const Eigen::VectorXd scale = root.cwiseInverse();
    grains_ = scale.head(n).asDiagonal() * grains_ * scale.head(n).asDiagonal();
    border_ = scale.head(n).asDiagonal() * border_ * scale.tail(n_strains).asDiagonal();
    boundary_ = scale.tail(n_strains).asDiagonal() * k.boundary * scale.tail(n_strains).asDiagonal();
  }

  Eigen::Index order() const { return diagonal_.size(); }
  bool has_negative_diagonal(double vanishing) const { return diagonal_.minCoeff() < -vanishing; }
  /// Returns the number of floating-point operations of one product of the matrix with a vector.
  double operations() const {
    return 4.0 * static_cast<double>(grains_.nonZeros()) + 4.0 * static_cast<double>(border_.size());
  }
  Eigen::VectorXd operator()(const Eigen::VectorXd& x) const {
    const Eigen::Index n = grains_.rows();
    Eigen::VectorXd y(x.size());
    y.head(n) = grains_.selfadjointView<Eigen::Lower>() * x.head(n);
    y.head(n) += border_ * x.tail(boundary_.rows());
    y.tail(boundary_.rows()) = border_.transpose() * x.head(n) + boundary_ * x.tail(boundary_.rows());
    return y;
  }

 private:
  Eigen::SparseMatrix<double> grains_;
  Eigen::MatrixXd border_, boundary_;
  Eigen::VectorXd diagonal_;
};

Stability test_by_iteration(const ReducedStiffness& k, const StabilityOptions& options,
                            const std::string& no_factor) {
  if (k.n_unstable_ends > 0)
    return {
        k.n_unstable_ends,
        no_factor + "some grains are held only by an attraction across a gap, which makes the state unstable"};
  const ScaledStiffness scaled(k);
  PositivityOptions test;
  test.bound = options.bound;
  test.max_steps = static_cast<int>(std::min(options.most_operations / scaled.operations(), 1e6));
  if (const int steps = predicted_steps(scaled.order(), kLargestEigenvalue, test); steps > test.max_steps)
    return {std::nullopt,
            fmt::format("not tested: {}and {} steps of an iterative test would take {:.0e} operations",
                        no_factor, steps, steps * scaled.operations())};
  if (scaled.has_negative_diagonal(k.vanishing))
    return {1, no_factor + "the stiffness matrix has a negative diagonal entry"};
  const Positivity found = test_positivity(scaled.order(), scaled, test);
  if (found.negative)
    return {1, fmt::format("{}a direction of negative stiffness was found in {} steps of an iterative test; "
                           "there may be more such "
                           "directions",
                           no_factor, found.steps)};
  const bool far_enough = found.bound <= test.bound;
  return {far_enough ? std::optional<int>(0) : std::nullopt,
          fmt::format("{}{}no eigenvalue below -{:.1e} of the stiffness matrix (its diagonal scaled to 1) was "
                      "found in {} steps of an "
                      "iterative test",
                      far_enough ? "" : "not tested to the required tolerance: ", no_factor, found.bound,
                      found.steps)};
}

template <int Dim>
Stability test(const ContactNetwork<Dim>& network, const std::optional<Eigen::MatrixXd>& convected,
               const StabilityOptions& options) {
  const ReducedStiffness k = reduced_stiffness<Dim>(network, convected);
  const Stability exact = test_by_factor(k, options);
  return exact.n_negative ? exact : test_by_iteration(k, options, exact.note);
}

}  // namespace

template <int Dim>
Stability stability(const ContactNetwork<Dim>& network, const StabilityOptions& options) {
  return has_negative_stiffness(network.contacts) ? test<Dim>(network, std::nullopt, options)
                                                  : Stability{0, ""};
}

template <int Dim>
Stability stability(const ContactNetwork<Dim>& network, const Mat<Dim>& stress,
                    const StabilityOptions& options) {
  return test<Dim>(network, convected_stress<Dim>(stress, Dim), options);
}

template <int Dim>
Stability stability(const Packing<Dim>& packing, bool prestress, const StabilityOptions& options) {
  if (!prestress && !has_negative_stiffness(packing.contacts)) return {0, ""};
  ModuliOptions network_options;
  network_options.prestress = prestress;
  const ContactNetwork<Dim> network = network_options.loaded_network(packing);
  return prestress ? test<Dim>(network, free_convected_stress(packing), options) : stability(network, options);
}

template <int Dim>
Stability stability_at_rest(const Packing<Dim>& packing) {
  return stability(packing, holds_liquid(packing));
}

#define FLOC_INSTANTIATE(Dim)                                                                         \
  template Stability stability(const ContactNetwork<Dim>&, const StabilityOptions&);                  \
  template Stability stability(const ContactNetwork<Dim>&, const Mat<Dim>&, const StabilityOptions&); \
  template Stability stability(const Packing<Dim>&, bool, const StabilityOptions&);                   \
  template Stability stability_at_rest(const Packing<Dim>&);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
