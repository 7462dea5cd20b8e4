#include "floc/elasticity/stability.h"

#include <algorithm>
#include <optional>

#include "floc/base/dense_solvers.h"
#include "floc/elasticity/convected_stress.h"
#include "floc/elasticity/moduli.h"
#include "floc/elasticity/reduced_unknowns.h"
#include "floc/linalg/symmetric_factor.h"
#include "floc/network/free_motions.h"
#include "floc/network/stiffness_matrix.h"
#include "floc/packing/balance.h"

namespace floc {
namespace {

/// Share of the affine stiffness below which that of the strains is zero: a mechanism that strains the cell.
constexpr double kVanishing = 1e-11;
/// A Cholesky factor of a larger condition may hide a mechanism, which has no sign.
constexpr double kSuspiciousCondition = 1e12;

/// @param contacts  of a network or of a packing
bool has_negative_stiffness(const auto& contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](const auto& c) { return c.kn < 0.0; });
}

int count_below(const Eigen::MatrixXd& symmetric, double bound) {
  return static_cast<int>((symmetric_eigenvalues(symmetric).array() < bound).count());
}

/// Haynsworth: the inertia of K is that of the block of the grains and that of its Schur complement, the
/// stiffness of the strains once the grains have relaxed. The factor's rounding is that of a matrix close to K,
/// so that no refinement would add to it.
template <int Dim>
int inertia(const ContactNetwork<Dim>& whole, const std::optional<Mat<Dim>>& stress) {
  const FreeMotions free = find_free_motions(whole);
  const ContactNetwork<Dim> core = without_grains(whole, free.dead_end);
  const ReducedUnknowns unknowns = reduce_unknowns(core, free.kept);
  const double unit = stiffness_scale(core);
  const StiffnessMatrix k = stiffness_matrix(core, {StrainSet::diagonal, stress.has_value()});
  SymmetricFactor factor;
  factor.set_matrix(reduce(k.grains, unknowns, unit), grain_of_rows<Dim>(unknowns));
  int n_negative = free.n_unstable_ends;
  if (!factor.factorize_positive() || factor.reciprocal_condition() * kSuspiciousCondition < 1.0)
    n_negative += factor.count_eigenvalues_below(-ResponseOptions{}.mechanism_bound);

  Eigen::MatrixXd border(unknowns.length.size(), k.border.cols());
  for (Eigen::Index a = 0; a < border.rows(); ++a)
    border.row(a) = k.border.row(unknowns.unknown[static_cast<std::size_t>(a)]) * (unknowns.length[a] / unit);
  Eigen::MatrixXd relaxed = k.boundary / unit - border.transpose() * factor.solve(border, 0);
  if (stress) relaxed += whole.volume / unit * convected_stress<Dim>(*stress, Dim);
  return n_negative + count_below(relaxed, -kVanishing * k.boundary.cwiseAbs().maxCoeff() / unit);
}

}  // namespace

template <int Dim>
int count_negative_eigenvalues(const ContactNetwork<Dim>& network) {
  return has_negative_stiffness(network.contacts) ? inertia<Dim>(network, std::nullopt) : 0;
}

template <int Dim>
int count_negative_eigenvalues(const ContactNetwork<Dim>& network, const Mat<Dim>& stress) {
  return inertia<Dim>(network, stress);
}

template <int Dim>
int count_negative_eigenvalues(const Packing<Dim>& packing, bool prestress) {
  if (!prestress && !has_negative_stiffness(packing.contacts)) return 0;
  const ContactNetwork<Dim> network = ModuliOptions{}.loaded_network(packing);
  return prestress ? count_negative_eigenvalues(network, static_stress(packing))
                   : count_negative_eigenvalues(network);
}

#define FLOC_INSTANTIATE(Dim)                                                           \
  template int count_negative_eigenvalues(const ContactNetwork<Dim>&);                  \
  template int count_negative_eigenvalues(const ContactNetwork<Dim>&, const Mat<Dim>&); \
  template int count_negative_eigenvalues(const Packing<Dim>&, bool);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
