#include "floc/elasticity/force_increments.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "floc/base/dense_solvers.h"
#include "floc/elasticity/mechanisms.h"

namespace floc {
namespace {

/// Share of the elastic energy of all touching contacts. StepResponse::n_holding is the smallest number of contacts
/// that together have this share; these are the contacts with the largest elastic energies.
constexpr double kHeldShare = 0.95;
/// Up to this value, the work of a unit stress on a strain that no stiffness resists counts as zero. Such a strain is a
/// computed eigenvector, whose rounding errors change the work.
constexpr double kNoWork = 1e-9;

template <int Dim>
using ForceRows = Eigen::Matrix<double, kDofs<Dim>, 1>;

template <int Dim>
Eigen::VectorXd stress_of(StressStep step) {
  Eigen::VectorXd stress = Eigen::VectorXd::Ones(Dim);
  if (step == StressStep::deviatoric) stress.tail(Dim - 1).setConstant(-1.0 / (Dim - 1));
  return stress;
}

/// Returns the diagonal strain of the cell under a diagonal stress.
/// @return no value if the stress does work on a strain that no stiffness resists
template <int Dim>
std::optional<Eigen::VectorXd> strain_of(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                         const Eigen::VectorXd& stress) {
  const Eigen::MatrixXd relaxed = response.relaxed.topLeftCorner(Dim, Dim);
  const Eigen::MatrixXd free = vanishing_strains(relaxed, affine_stiffness(network, StrainSet::diagonal));
  if ((free.transpose() * stress).norm() > kNoWork) return std::nullopt;
  // The strains in `free`, which no stiffness resists, are given a stiffness to make the system solvable. The stress
  // does no work on them.
  const Eigen::MatrixXd held = relaxed + relaxed.trace() * free * free.transpose();
  return Eigen::VectorXd(network.volume * solve_symmetric(held, stress));
}

template <int Dim>
double energy_of(const NetworkContact<Dim>& c, const ForceIncrement<Dim>& f) {
  const auto term = [](double square, double k) { return k == 0.0 ? 0.0 : 0.5 * square / k; };
  return term(f.normal * f.normal, c.kn) + term(f.shear.squaredNorm(), c.kt) +
         term(f.rolling_moment.squaredNorm(), c.kr) + term(f.twisting_moment * f.twisting_moment, c.ktw);
}

/// Converts the components of a contact's force and moment from the order of ContactRows into a ForceIncrement.
template <int Dim>
ForceIncrement<Dim> increment_of(const NetworkContact<Dim>& c, const ForceRows<Dim>& forces) {
  ForceIncrement<Dim> f{forces[0], forces.template segment<Dim - 1>(1), RotationVector<Dim>::Zero(), 0.0};
  RotationVector<Dim> about_axes = forces.template tail<kRotations<Dim>>();
  if constexpr (Dim == 3) f.twisting_moment = std::exchange(about_axes[0], 0.0);
  f.rolling_moment = rotation_axes(c.frame) * about_axes;
  return f;
}

template <int Dim>
void rank_by_energy(const ContactNetwork<Dim>& network, StepResponse<Dim>& out) {
  const auto n = static_cast<int>(network.contacts.size());
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return out.energy[a] > out.energy[b]; });
  out.rank.resize(n);
  double total = 0.0;
  int n_touching = 0;
  for (int c = 0; c < n; ++c) {
    out.rank[order[c]] = c;
    if (network.contacts[c].distant) continue;
    total += out.energy[c];
    ++n_touching;
  }
  double held = 0.0;
  while (out.n_holding < n && held < kHeldShare * total) held += out.energy[order[out.n_holding++]];
  out.energy_share_95 = n_touching == 0 ? 0.0 : static_cast<double>(out.n_holding) / n_touching;
}

}  // namespace

template <int Dim>
std::vector<ForceIncrement<Dim>> force_increments(const ContactNetwork<Dim>& network,
                                                  const ElasticResponse& response,
                                                  const Eigen::VectorXd& strain) {
  const Eigen::VectorXd motion = response.fluctuation.leftCols(strain.size()) * strain;
  std::vector<ForceIncrement<Dim>> increments;
  increments.reserve(network.contacts.size());
  for (const NetworkContact<Dim>& c : network.contacts) {
    // A dead end moves with the grain on which it hangs, so that the forces of its contact do not change.
    if (response.free.dead_end[c.i] || response.free.dead_end[c.j]) {
      increments.push_back(increment_of<Dim>(c, ForceRows<Dim>::Zero()));
      continue;
    }
    const ContactRows<Dim> g = contact_rows(c);
    ForceRows<Dim> displacement = g.on_i * motion.segment<kDofs<Dim>>(first_unknown<Dim>(c.i)) +
                                  g.on_j * motion.segment<kDofs<Dim>>(first_unknown<Dim>(c.j)) +
                                  g.on_strain.leftCols(strain.size()) * strain;
    if (c.on_wall()) displacement += g.on_wall * response.wall_shift.leftCols(strain.size()) * strain;
    const ForceRows<Dim> forces = row_stiffness(c).cwiseProduct(displacement);
    increments.push_back(increment_of(c, forces));
  }
  return increments;
}

template <int Dim>
std::optional<StepResponse<Dim>> step_response(const ContactNetwork<Dim>& network,
                                               const ElasticResponse& response, StressStep step) {
  const std::optional<Eigen::VectorXd> strain = strain_of(network, response, stress_of<Dim>(step));
  if (!strain) return std::nullopt;
  StepResponse<Dim> out;
  out.strain = *strain;
  out.increments = force_increments(network, response, *strain);
  for (std::size_t c = 0; c < out.increments.size(); ++c)
    out.energy.push_back(energy_of(network.contacts[c], out.increments[c]));
  rank_by_energy(network, out);
  return out;
}

#define FLOC_INSTANTIATE(Dim)                                                                                 \
  template std::vector<ForceIncrement<Dim>> force_increments(const ContactNetwork<Dim>&,                      \
                                                             const ElasticResponse&, const Eigen::VectorXd&); \
  template std::optional<StepResponse<Dim>> step_response(const ContactNetwork<Dim>&, const ElasticResponse&, \
                                                          StressStep);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
