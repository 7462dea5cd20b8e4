#include "floc/elasticity/modes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "floc/elasticity/isotropic_moduli.h"
#include "floc/linalg/lowest_eigenpairs.h"

namespace floc {
namespace {

constexpr int kMinCount = 10;
constexpr int kMaxCount = 100;

/// Unknowns of the grains that have contacts, rotations times the grain's size.
template <int Dim>
struct ConnectedUnknowns {
  std::vector<int> unknown;  // of K, for each row
  std::vector<int> row;      // of each unknown of K, -1: the grain has no contact
  Eigen::VectorXd size;      // value in a row = size * unknown of K

  explicit ConnectedUnknowns(const ContactNetwork<Dim>& network) : row(network.n_unknowns(), -1) {
    std::vector<bool> connected(network.n_grains, false);
    for (const NetworkContact<Dim>& c : network.contacts) connected[c.i] = connected[c.j] = true;
    for (int u = 0; u < network.n_unknowns(); ++u)
      if (connected[u / kDofs<Dim>]) row[u] = static_cast<int>(unknown.size()), unknown.push_back(u);
    size.resize(static_cast<Eigen::Index>(unknown.size()));
    for (Eigen::Index a = 0; a < size.size(); ++a)
      size[a] = unknown[a] % kDofs<Dim> < Dim ? 1.0 : network.grain_size[unknown[a] / kDofs<Dim>];
  }
  int n() const { return static_cast<int>(unknown.size()); }
  int n_grains() const { return n() / kDofs<Dim>; }
};

template <int Dim>
Eigen::SparseMatrix<double> scaled_stiffness(const ContactNetwork<Dim>& network,
                                             const ConnectedUnknowns<Dim>& u, StrainSet strains) {
  const Eigen::SparseMatrix<double> grains = stiffness_matrix(network, {strains, false}).grains;
  const double scale = stiffness_scale(network);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(grains.nonZeros());
  for (int b = 0; b < u.n(); ++b)
    for (Eigen::SparseMatrix<double>::InnerIterator it(grains, u.unknown[b]); it; ++it) {
      const int a = u.row[it.row()];
      entries.emplace_back(a, b, it.value() / (scale * u.size[a] * u.size[b]));
    }
  Eigen::SparseMatrix<double> matrix(u.n(), u.n());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Motions that are free by structure, those of grains without contact left out; columns of unit length.
template <int Dim>
Eigen::SparseMatrix<double> scaled_free_motions(const FreeMotions& free, const ConnectedUnknowns<Dim>& u) {
  std::vector<Eigen::Triplet<double>> entries;
  int n = 0;
  for (int m = 0; m < free.modes.cols(); ++m) {
    if (free.kind[m] == FreeMotionKind::rattler) continue;
    const double length = [&] {
      double square = 0.0;
      for (Eigen::SparseMatrix<double>::InnerIterator it(free.modes, m); it; ++it)
        square += std::pow(it.value() * u.size[u.row[it.row()]], 2);
      return std::sqrt(square);
    }();
    for (Eigen::SparseMatrix<double>::InnerIterator it(free.modes, m); it; ++it) {
      const int a = u.row[it.row()];
      entries.emplace_back(a, n, it.value() * u.size[a] / length);
    }
    ++n;
  }
  Eigen::SparseMatrix<double> motions(u.n(), n);
  motions.setFromTriplets(entries.begin(), entries.end());
  return motions;
}

template <int Dim>
double near_bound(const ContactNetwork<Dim>& network) {
  double bound = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts)
    if (!c.on_wall()) bound = std::max(bound, std::abs(c.normal_force) / c.branch.norm());
  return bound;
}

/// Energies and coupling of a motion, summed over the contacts: sums of squares lose no digits to the rounding
/// of K.
template <int Dim>
void add_energies(const ContactNetwork<Dim>& network, StrainSet strains, Mode<Dim>& mode) {
  mode.coupling = Eigen::VectorXd::Zero(n_strains<Dim>(strains));
  double geometric = 0.0;
  for (const NetworkContact<Dim>& c : network.contacts) {
    const ContactRows<Dim> g = contact_rows(c);
    const auto u_i = mode.motion.template segment<kDofs<Dim>>(first_unknown<Dim>(c.i));
    const auto u_j = mode.motion.template segment<kDofs<Dim>>(first_unknown<Dim>(c.j));
    const RowStiffness<Dim> change = g.on_i * u_i + g.on_j * u_j;
    const RowStiffness<Dim> force = row_stiffness(c).cwiseProduct(change);
    mode.eigenvalue += force.dot(change);
    mode.coupling += g.on_strain.leftCols(mode.coupling.size()).transpose() * force;
    const ContactRows<Dim> t = translation_rows(g);
    const RowStiffness<Dim> slide = t.on_i * u_i + t.on_j * u_j;
    geometric += slide.dot(row_prestress(c).cwiseProduct(slide));
  }
  mode.with_prestress = mode.eigenvalue + geometric;
}

template <int Dim>
void add_participation(const ContactNetwork<Dim>& network, int n_connected, Mode<Dim>& mode) {
  std::vector<double> square(network.n_grains);
  double sum = 0.0, fourth = 0.0;
  for (int i = 0; i < network.n_grains; ++i) {
    auto u = mode.motion.template segment<kDofs<Dim>>(first_unknown<Dim>(i));
    square[i] = u.template head<Dim>().squaredNorm() +
                std::pow(network.grain_size[i], 2) * u.template tail<kRotations<Dim>>().squaredNorm();
    sum += square[i];
    fourth += square[i] * square[i];
  }
  mode.participation = sum * sum / (n_connected * fourth);
  std::vector<int> order(network.n_grains);
  std::iota(order.begin(), order.end(), 0);
  const auto last = order.begin() + std::min(Mode<Dim>::kMaxNamed, network.n_grains);
  std::partial_sort(order.begin(), last, order.end(), [&](int i, int j) { return square[i] > square[j]; });
  double held = 0.0;
  for (auto i = order.begin(); i != last && held < 0.5 * sum; ++i) {
    mode.grains.push_back(*i);
    held += square[*i];
  }
}

ModeKind kind_of(double eigenvalue, double zero, double near) {
  if (eigenvalue < -zero) return ModeKind::unstable;
  if (eigenvalue <= zero) return ModeKind::mechanism;
  return eigenvalue < near ? ModeKind::near_mechanism : ModeKind::elastic;
}

template <int Dim>
Mode<Dim> describe(const ContactNetwork<Dim>& network, const ConnectedUnknowns<Dim>& u,
                   const Eigen::VectorXd& vector, const ModeOptions& options, double near) {
  Mode<Dim> mode;
  mode.motion = Eigen::VectorXd::Zero(network.n_unknowns());
  for (int a = 0; a < u.n(); ++a) mode.motion[u.unknown[a]] = vector[a] / u.size[a];
  add_energies(network, options.strains, mode);
  add_participation(network, u.n_grains(), mode);
  mode.kind = kind_of(mode.eigenvalue, options.mechanism_bound * stiffness_scale(network), near);
  if (mode.kind == ModeKind::mechanism) return mode;
  const Eigen::VectorXd on_axes = mode.coupling.template head<Dim>();
  const Eigen::MatrixXd softening = on_axes * on_axes.transpose() / (mode.eigenvalue * network.volume);
  mode.softens_B = bulk_modulus(softening);
  mode.softens_G = pure_shear_modulus(softening);
  return mode;
}

}  // namespace

std::string name_of(ModeKind kind) {
  switch (kind) {
    case ModeKind::unstable:
      return "unstable";
    case ModeKind::mechanism:
      return "mechanism";
    case ModeKind::near_mechanism:
      return "near-mechanism";
    case ModeKind::elastic:
      return "elastic";
  }
  return {};
}

template <int Dim>
SoftModes<Dim> soft_modes(const ContactNetwork<Dim>& network, const ModeOptions& options) {
  if (options.count) require_in_range("count", *options.count, ModeOptions::kCount);
  SoftModes<Dim> out;
  out.free = find_free_motions(network);
  out.near_bound = near_bound(network);
  const ConnectedUnknowns<Dim> unknowns(network);
  if (unknowns.n() == 0) return out;
  const Eigen::SparseMatrix<double> free_motions = scaled_free_motions(out.free, unknowns);
  SymmetricFactor factor(options.ordering);
  factor.set_matrix(scaled_stiffness(network, unknowns, options.strains));
  const double bound = std::max(out.near_bound / stiffness_scale(network), options.mechanism_bound);
  out.n_below_near_bound = factor.count_eigenvalues_below(bound) - static_cast<int>(free_motions.cols());
  const int count = options.count.value_or(std::clamp(out.n_below_near_bound, kMinCount, kMaxCount));
  const Eigenpairs pairs = lowest_eigenpairs(factor, free_motions, count);
  out.complete = pairs.complete;
  for (Eigen::Index m = 0; m < pairs.values.size(); ++m)
    out.modes.push_back(describe(network, unknowns, pairs.vectors.col(m), options, out.near_bound));
  return out;
}

template <int Dim>
int count_near_mechanisms(const ContactNetwork<Dim>& network, const ElasticResponse& response) {
  const ConnectedUnknowns<Dim> unknowns(network);
  const double bound = near_bound(network) / stiffness_scale(network);
  if (unknowns.n() == 0 || bound <= ModeOptions{}.mechanism_bound) return 0;
  SymmetricFactor factor;
  factor.set_matrix(scaled_stiffness(network, unknowns, StrainSet::diagonal));
  const FreeMotions& free = response.free;
  const int n_free = static_cast<int>(free.kind.size()) - free.count(FreeMotionKind::rattler);
  return factor.count_eigenvalues_below(bound) - n_free - response.n_mechanisms - response.n_negative;
}

template int count_near_mechanisms(const ContactNetwork<2>&, const ElasticResponse&);
template int count_near_mechanisms(const ContactNetwork<3>&, const ElasticResponse&);
template SoftModes<2> soft_modes(const ContactNetwork<2>&, const ModeOptions&);
template SoftModes<3> soft_modes(const ContactNetwork<3>&, const ModeOptions&);

}  // namespace floc
