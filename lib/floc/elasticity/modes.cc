#include "floc/elasticity/modes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "floc/elasticity/isotropic_moduli.h"
#include "floc/elasticity/reduced_unknowns.h"
#include "floc/linalg/lowest_eigenpairs.h"
#include "floc/network/geometric_springs.h"

namespace floc {
namespace {

/// Smallest and largest number of modes that are computed if ModeOptions::count is absent.
constexpr int kMinCount = 10;
constexpr int kMaxCount = 100;

/// Returns, for each unknown of the stiffness matrix, whether its grain has a contact.
template <int Dim>
std::vector<bool> connected_unknowns(const ContactNetwork<Dim>& network) {
  std::vector<bool> connected(network.n_unknowns(), false);
  for (const NetworkContact<Dim>& c : network.contacts)
    for (const int grain : {c.i, c.j})
      std::fill_n(connected.begin() + first_unknown<Dim>(grain), kDofs<Dim>, true);
  return connected;
}

/// For each unknown of the stiffness matrix, returns whether a contact resists the motion that the unknown describes.
/// No contact resists the rotation of a grain if its contacts have only a normal stiffness, and if their normal forces
/// have no moments about its centre.
template <int Dim>
std::vector<bool> resisted_unknowns(const ContactNetwork<Dim>& network) {
  std::vector<bool> resisted(network.n_unknowns(), false);
  for (const NetworkContact<Dim>& c : network.contacts) {
    for (const int grain : {c.i, c.j})
      std::fill_n(resisted.begin() + first_unknown<Dim>(grain),
                  resists_rotation(network, c, grain) ? kDofs<Dim> : Dim, true);
  }
  return resisted;
}

/// Returns the free motions of a network as columns of unit length, without the motions of grains that have no contact.
Eigen::SparseMatrix<double> scaled_free_motions(const FreeMotions& free, const ReducedUnknowns& u) {
  std::vector<Eigen::Triplet<double>> entries;
  int n = 0;
  for (int m = 0; m < free.modes.cols(); ++m) {
    if (free.kind[m] == FreeMotionKind::rattler) continue;
    const double length = [&] {
      double square = 0.0;
      for (Eigen::SparseMatrix<double>::InnerIterator it(free.modes, m); it; ++it)
        square += std::pow(it.value() / u.length[u.row[it.row()]], 2);
      return std::sqrt(square);
    }();
    for (Eigen::SparseMatrix<double>::InnerIterator it(free.modes, m); it; ++it) {
      const int a = u.row[it.row()];
      entries.emplace_back(a, n, it.value() / (u.length[a] * length));
    }
    ++n;
  }
  Eigen::SparseMatrix<double> motions(u.length.size(), n);
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

/// Computes the energies of a mode, without and with prestress, and the coupling of the mode to strain. All values are
/// sums over the contacts, so that the rounding errors of the stiffness matrix have no influence.
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
    for_each_geometric_term(network, c, g, [&](const ContactRows<Dim>& rows, const RowStiffness<Dim>& k) {
      const RowStiffness<Dim> motion = rows.on_i * u_i + rows.on_j * u_j;
      geometric += motion.dot(k.cwiseProduct(motion));
    });
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
Mode<Dim> describe(const ContactNetwork<Dim>& network, const ReducedUnknowns& u, const Eigen::VectorXd& vector,
                   const ModeOptions& options, double near) {
  Mode<Dim> mode;
  mode.motion = Eigen::VectorXd::Zero(network.n_unknowns());
  for (Eigen::Index a = 0; a < vector.size(); ++a) mode.motion[u.unknown[a]] = vector[a] * u.length[a];
  add_energies(network, options.strains, mode);
  add_participation(network, static_cast<int>(vector.size()) / kDofs<Dim>, mode);
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
  const ReducedUnknowns unknowns = reduce_unknowns(network, connected_unknowns(network));
  if (unknowns.unknown.empty()) return out;
  const Eigen::SparseMatrix<double> free_motions = scaled_free_motions(out.free, unknowns);
  SymmetricFactor factor(options.ordering);
  factor.set_matrix(
      reduce(stiffness_matrix(network, {options.strains, false}).grains, unknowns, stiffness_scale(network)),
      grain_of_rows<Dim>(unknowns));
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
std::optional<int> count_near_mechanisms(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                         double largest_factor) {
  const double unit = stiffness_scale(network), bound = near_bound(network) / unit;
  if (network.contacts.empty() || bound <= ModeOptions{}.mechanism_bound) return 0;
  const std::vector<bool> connected = connected_unknowns(network), resisted = resisted_unknowns(network);
  const ReducedUnknowns unknowns = reduce_unknowns(network, resisted);
  SymmetricFactor factor;
  factor.set_matrix(reduce(stiffness_matrix(network, {}).grains, unknowns, unit), grain_of_rows<Dim>(unknowns));
  if (factor.predicted_cost().bytes > largest_factor) return std::nullopt;
  const FreeMotions& free = response.free;
  const auto n_unresisted = std::count(connected.begin(), connected.end(), true) -
                            static_cast<std::ptrdiff_t>(unknowns.unknown.size());
  const int n_free =
      static_cast<int>(free.kind.size()) - free.count(FreeMotionKind::rattler) - static_cast<int>(n_unresisted);
  // The matrix is assembled with fixed walls. Therefore negative eigenvalues due to displacements of walls are left
  // out.
  const int n_negative = response.n_negative - response.n_negative_shifts;
  return factor.count_eigenvalues_below(bound) - n_free - response.n_mechanisms - n_negative;
}

template std::optional<int> count_near_mechanisms(const ContactNetwork<2>&, const ElasticResponse&, double);
template std::optional<int> count_near_mechanisms(const ContactNetwork<3>&, const ElasticResponse&, double);
template SoftModes<2> soft_modes(const ContactNetwork<2>&, const ModeOptions&);
template SoftModes<3> soft_modes(const ContactNetwork<3>&, const ModeOptions&);

}  // namespace floc
