#include "floc/elasticity/chain.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "floc/base/error.h"
#include "floc/base/interruption.h"
#include "floc/linalg/spring_inverse.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {
namespace {

void require_length(std::int64_t n) {
  if (!kChainLength.holds(n))
    throw InputError("chain", fmt::format("n = {}: the number of disks must be from {} to {}", n,
                                          kChainLength.least, kChainLength.most));
}

void require_positive(const char* name, double value) {
  if (!kPositiveNumber.holds(value))
    throw InputError("chain", fmt::format("{} = {}: must be > 0 and finite", name, value));
}

void require_valid(std::int64_t n, double R, const ChainStiffness& k) {
  require_length(n);
  require_positive("R", R);
  require_positive("K_N", k.normal);
  require_positive("K_T", k.tangential);
  require_positive("K_R", k.rolling);
}

/// Returns the contact network of a chain in reduced units, in which the radius of a disk and the stiffness `unit`
/// (force/length) are 1.
ContactNetwork<2> chain_network(const std::vector<Vec<2>>& branches, double R, const ChainStiffness& k,
                                double unit) {
  ContactNetwork<2> network;
  network.n_grains = static_cast<int>(branches.size()) + 1;
  network.grain_size.assign(network.n_grains, 1.0);
  for (int c = 0; c < static_cast<int>(branches.size()); ++c) {
    NetworkContact<2> contact;
    contact.i = contact.source = c;
    contact.j = c + 1;
    contact.image.setZero();
    contact.branch = 2.0 * branches[c];
    contact.arm_i = branches[c];
    contact.arm_j = -branches[c];
    contact.frame << branches[c], tangent<double>(branches[c]);
    contact.kn = k.normal / unit;
    contact.kt = k.tangential / unit;
    contact.kr = k.rolling / (unit * R * R);
    contact.normal_force = 0.0;
    contact.shear_force.setZero();
    contact.rolling_moment.setZero();
    contact.distant = false;
    network.contacts.push_back(contact);
  }
  return network;
}

/// Geometry of a chain of unit disks relative to its chord, the line through the centres of its end disks.
struct Chord {
  Vec<2> along, across;
  double length;
  double last_contact;  ///< distance along the chord from the middle of the chord to the last contact
};

Chord chord_of(const std::vector<Vec<2>>& branches) {
  Vec<2> end = Vec<2>::Zero();
  for (const Vec<2>& b : branches) end += 2.0 * b;
  Chord chord;
  chord.length = end.norm();
  if (!(chord.length > 1e-6))
    throw InputError("chain",
                     "the last disk lies on the first, so their centres do not define the chord of the chain");
  chord.along = end / chord.length;
  chord.across = tangent<double>(chord.along);
  chord.last_contact = 0.5 * chord.length - branches.back().dot(chord.along);
  return chord;
}

/// Returns three motions of the last disk, one per column: a unit displacement along the chord (the line through the
/// centres of the end disks), a unit displacement across the chord, and a unit rotation of the disk about its centre.
Mat<3> end_motions(const Chord& chord) {
  Mat<3> motion = Mat<3>::Zero();
  motion.block<2, 1>(0, 0) = chord.along;
  motion.block<2, 1>(0, 1) = chord.across;
  motion.block<2, 1>(0, 2) = 0.5 * chord.length * chord.across;
  motion(2, 2) = 1.0;
  return motion;
}

/// Returns the springs of a chain of disks. The first disk is fixed, the motion of the last disk is a combination of
/// the columns of `motions`, and the disks in between move freely.
SpringSystem chain_springs(const ContactNetwork<2>& network, const Mat<3>& motions) {
  const Eigen::SparseMatrix<double> rigidity = rigidity_matrix(network, StrainSet::diagonal);
  SpringSystem springs;
  springs.on_free = rigidity.middleCols(3, 3 * (network.n_grains - 2));
  springs.on_boundary = Eigen::MatrixXd(rigidity.middleCols(3 * (network.n_grains - 1), 3)) * motions;
  springs.stiffness.resize(rigidity.rows());
  for (int c = 0; c < network.n_grains - 1; ++c)
    springs.stiffness.segment<3>(3 * c) = row_stiffness(network.contacts[c]);
  return springs;
}

SpringInverse invert(const SpringSystem& springs, SymmetricFactor& factor) {
  const Eigen::SparseMatrix<double> a = springs.on_free;
  const Eigen::SparseMatrix<double> ka = springs.stiffness.asDiagonal() * a;
  const Eigen::SparseMatrix<double> stiffness = a.transpose() * ka;
  factor.set_matrix(stiffness);
  if (auto found = invert_positive(factor)) return *found;
  // No contact of a chain has a negative stiffness, so this bound is not used.
  constexpr double kUnused = 0.0;
  return invert_singular(factor, springs, kUnused);
}

/// Compliance matrix of the last disk of a chain (its motion divided by the load on it), and a bound on the error of
/// each entry.
struct Compliance {
  Mat<3> value, error;

  BoundedValue of(const Vec<3>& displacement, const Vec<3>& load) const {
    return {displacement.dot(value * load), displacement.cwiseAbs().dot(error * load.cwiseAbs())};
  }
};

Compliance invert_stiffness(const Mat<3>& stiffness, const Mat<3>& error) {
  Compliance c;
  // The stiffness matrix is inverted in extended precision, because its large terms nearly cancel if soft and stiff
  // directions are mixed.
  c.value = stiffness.cast<long double>().inverse().cast<double>();
  // The matrix S is the computed stiffness, E the bound on its error, and `exact` the stiffness without error. The
  // error changes the inverse by at most |S^-1| E |exact^-1|, where |exact^-1| <= |S^-1|/(1 - change). Here `change` is
  // the norm of |S^-1| E after a diagonal scaling, which gives all entries the same unit.
  const Mat<3> size = c.value.cwiseAbs();
  const Vec<3> scale = stiffness.diagonal().cwiseAbs().cwiseSqrt();
  const Mat<3> relative = scale.asDiagonal() * (size * error) * scale.cwiseInverse().asDiagonal();
  const double change = relative.rowwise().sum().maxCoeff();
  c.error = change < 1.0
                ? Mat<3>(size * error * size / (1.0 - change) + std::numeric_limits<double>::epsilon() * size)
                : Mat<3>(Mat<3>::Constant(std::numeric_limits<double>::infinity()));
  return c;
}

}  // namespace

double chain_axial_compliance(int n, const ChainStiffness& k) {
  require_valid(n, 1.0, k);
  return (n - 1.0) / k.normal;
}

double chain_transverse_compliance(int n, double R, const ChainStiffness& k) {
  require_valid(n, R, k);
  return (n - 1.0) / k.tangential + n * (n - 1.0) * (n - 2.0) * R * R / (3.0 * k.rolling);
}

double chain_rolling_compliance(int n, const ChainStiffness& k) {
  require_valid(n, 1.0, k);
  return (n - 1.0) / k.rolling;
}

double end_disk_deflection(int n, double R, const ChainStiffness& k) {
  require_valid(n, R, k);
  return (n - 1.0) / k.tangential + (n - 1.0) * ((4.0 * n - 11.0) * n + 6.0) * R * R / (3.0 * k.rolling);
}

std::vector<Vec<2>> bent_chain(int n, double bend) {
  require_length(n);
  require_in_range("bend", bend, kFiniteNumber);
  std::vector<Vec<2>> branches;
  for (int c = 0; c < n - 1; ++c) branches.emplace_back(std::cos(c * bend), std::sin(c * bend));
  return branches;
}

SolvedChain solve_chain(const std::vector<Vec<2>>& branches, double R, const ChainStiffness& k) {
  require_valid(static_cast<std::int64_t>(branches.size()) + 1, R, k);
  const double unit = std::max(k.normal, k.tangential);
  const Chord chord = chord_of(branches);
  const SpringSystem springs = chain_springs(chain_network(branches, R, k, unit), end_motions(chord));
  check_interruption();
  SymmetricFactor factor;
  const SpringInverse found = invert(springs, factor);
  check_interruption();
  Condensation end = condense(springs, found.inverse, {.tolerance = 1e-14});
  // A chain has no mechanism. If the factor finds a mechanism, rounding has hidden a stiffness, and the error has no
  // bound.
  if (found.n_mechanisms > 0) end.error.setConstant(std::numeric_limits<double>::infinity());
  const Compliance c = invert_stiffness(end.stiffness, end.error);
  const auto scaled = [](BoundedValue v, double size) { return BoundedValue{v.value / size, v.error / size}; };
  const Vec<3> through_last_contact(0.0, 1.0, chord.last_contact);
  const Vec<3> last_centre(0.0, 1.0, 0.5 * chord.length);
  return {scaled(c.of(Vec<3>::UnitX(), Vec<3>::UnitX()), unit),
          scaled(c.of(Vec<3>::UnitY(), Vec<3>::UnitY()), unit),
          scaled(c.of(Vec<3>::UnitZ(), Vec<3>::UnitZ()), unit * R * R),
          scaled(c.of(last_centre, through_last_contact), unit), found.condition};
}

}  // namespace floc
