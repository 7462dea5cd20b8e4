#include "floc/elasticity/indeterminacy.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "floc/elasticity/mechanisms.h"
#include "floc/linalg/symmetric_factor.h"
#include "floc/network/rigidity_matrix.h"

namespace floc {
namespace {

/// Singular values of a rigidity matrix, whose entries are of order 1, count as zero below this number. The rank is not
/// taken from a factorization that leaves out columns one by one: in packings without friction the columns of the
/// grains alone are independent by the residual forces only, and rounding errors, divided by these, then count as
/// independent columns. The singular values of the whole matrix are either zero up to rounding or far larger.
constexpr double kZero = 1e-5;

/// Returns the rank of a matrix: the number of singular values above kZero.
/// @param group  group of each column, see SymmetricFactor::set_matrix()
int rank_of(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& group) {
  SymmetricFactor factor;
  factor.set_matrix((matrix.transpose() * matrix).triangularView<Eigen::Lower>(), group);
  return static_cast<int>(matrix.cols()) - factor.count_eigenvalues_below(kZero * kZero);
}

}  // namespace

template <int Dim>
Indeterminacy force_indeterminacy(const ContactNetwork<Dim>& network, const ElasticResponse& response,
                                  StrainSet strains) {
  Indeterminacy out;
  std::vector<bool> connected(network.n_grains, false);
  for (const NetworkContact<Dim>& c : network.contacts) {
    out.n_components += static_cast<int>((row_stiffness(c).array() != 0.0).count());
    connected[c.i] = connected[c.j] = true;
  }
  const int n_boundary = n_strains<Dim>(strains);
  const Eigen::MatrixXd relaxed = response.relaxed.topLeftCorner(n_boundary, n_boundary);
  const auto n_coupled =
      static_cast<int>(vanishing_strains(relaxed, affine_stiffness(network, strains)).cols());
  const FreeMotions& free = response.free;
  out.n_unknowns = kDofs<Dim> * static_cast<int>(std::count(connected.begin(), connected.end(), true)) +
                   n_boundary_unknowns(network, strains);
  out.n_null_modes = static_cast<int>(free.kind.size()) - free.count(FreeMotionKind::rattler) +
                     response.n_mechanisms + response.n_free_shifts + n_coupled;
  out.degree = out.n_components - out.n_unknowns + out.n_null_modes;
  return out;
}

template <int Dim>
Indeterminacy rigid_indeterminacy(const Packing<Dim>& packing, double smallest_force) {
  ContactNetwork<Dim> network = contact_network(packing);
  std::erase_if(network.contacts, [&](const NetworkContact<Dim>& c) {
    return !(packing.contacts[c.source].elastic_force > smallest_force);
  });
  // The matrix of the equations of balance is the transpose of the rigidity matrix. Springs of stiffness 1 are added
  // for all force components, so that the scaled rigidity matrix contains one row for each component.
  const bool sticks = packing.law.resists_sliding();
  Indeterminacy out;
  std::vector<bool> connected(network.n_grains, false);
  for (NetworkContact<Dim>& c : network.contacts) {
    c.kn = 1.0;
    c.kt = sticks && !packing.contacts[c.source].sliding ? 1.0 : 0.0;
    out.n_components += c.kt > 0.0 ? Dim : 1;
    connected[c.i] = connected[c.j] = true;
  }
  Eigen::SparseMatrix<double> matrix = scaled_rigidity_matrix(network, StrainSet::diagonal);
  // Rotations and strains are converted to lengths. A column that contains only rounding errors, such as the column of
  // a rotation without resistance, is then far smaller than all other columns.
  std::vector<int> group;
  for (int u = 0; u < matrix.cols(); ++u) {
    const int grain = u / kDofs<Dim>;
    group.push_back(grain < network.n_grains ? grain : u - (kDofs<Dim> - 1) * network.n_grains);
    if (grain >= network.n_grains)
      matrix.col(u) /= std::max(std::numeric_limits<double>::min(), matrix.col(u).norm());
    else if (u % kDofs<Dim> >= Dim)
      matrix.col(u) /= network.grain_size[grain];
  }
  const int rank = rank_of(matrix, group);
  out.n_unknowns = kDofs<Dim> * static_cast<int>(std::count(connected.begin(), connected.end(), true)) + Dim;
  out.n_null_modes = out.n_unknowns - rank;
  out.degree = out.n_components - rank;
  return out;
}

template Indeterminacy rigid_indeterminacy(const Packing<2>&, double);
template Indeterminacy rigid_indeterminacy(const Packing<3>&, double);
template Indeterminacy force_indeterminacy(const ContactNetwork<2>&, const ElasticResponse&, StrainSet);
template Indeterminacy force_indeterminacy(const ContactNetwork<3>&, const ElasticResponse&, StrainSet);

}  // namespace floc
