#include "floc/elasticity/mechanisms.h"

#include <fmt/format.h>

#include <cmath>

#include "floc/base/dense_solvers.h"
#include "floc/base/random.h"

namespace floc {
namespace {

/// An eigenvalue of the stiffness against strain of the cell (after relaxation of the grains) counts as zero if its
/// absolute value, divided by the trace of the stiffness without relaxation, is at most this number. Such an eigenvalue
/// may be due to rounding.
constexpr double kVanishingStiffness = 1e-11;
/// Standard deviation of the random displacements that bring grains to general positions, divided by the size of the
/// grain. The value is of order one, but small enough that the two grains of a contact do not exchange their positions.
constexpr double kDisplacement = 0.2;

/// Returns |p|^2/|v|^2, where p is the projection of the vector v onto the span of the given orthonormal columns.
double share_in(const Eigen::MatrixXd& columns, const Eigen::VectorXd& v) {
  return (columns.transpose() * v).squaredNorm() / v.squaredNorm();
}

/// Returns the extensions among the strains that are spanned by the given orthonormal columns, as orthonormal columns:
/// the strains without shear components.
template <int Dim>
Eigen::MatrixXd extensions_in(const Eigen::MatrixXd& strains, double rounding) {
  const Eigen::MatrixXd shears = strains.bottomRows(strains.rows() - Dim);
  const SymmetricEigen eigen = symmetric_eigen(shears.transpose() * shears);
  std::vector<Eigen::Index> which;
  for (Eigen::Index k = 0; k < strains.cols(); ++k)
    if (eigen.values[k] <= rounding) which.push_back(k);
  return strains.topRows<Dim>() * eigen.vectors(Eigen::all, which);
}

template <int Dim>
std::vector<std::string> vanishing_moduli(const Eigen::MatrixXd& strains) {
  // Eigenvectors of the eigenvalue zero are accurate up to rounding errors, because all other eigenvalues are much
  // larger.
  constexpr double kRounding = 1e-9;
  const Eigen::Index n = strains.rows();
  const auto vanishes = [&](const Eigen::VectorXd& v) { return share_in(strains, v) > 1.0 - kRounding; };
  std::vector<std::string> names;
  for (Eigen::Index a = 0; a < n; ++a)
    if (vanishes(Eigen::VectorXd::Unit(n, a))) names.push_back(fmt::format("C{0}{0}", a + 1));
  Eigen::VectorXd isotropic = Eigen::VectorXd::Zero(n);
  isotropic.head<Dim>().setOnes();
  if (vanishes(isotropic)) names.emplace_back("B");
  // B_S belongs to extensions without shear strains. A mechanism in which the cell also shears does not act on it.
  if (share_in(extensions_in<Dim>(strains, kRounding), Eigen::VectorXd::Ones(Dim)) > kRounding)
    names.emplace_back("B_S");
  bool shears = true;
  for (int a = 1; a < Dim; ++a)
    shears = shears && vanishes(Eigen::VectorXd::Unit(n, 0) - Eigen::VectorXd::Unit(n, a));
  if (shears) names.emplace_back("G");
  return names;
}

template <int Dim>
ContactNetwork<Dim> in_general_position(const ContactNetwork<Dim>& network) {
  ContactNetwork<Dim> moved = network;
  RandomStream random(1, 1);
  std::vector<Vec<Dim>> displacement(network.n_grains);
  for (int i = 0; i < network.n_grains; ++i)
    for (int a = 0; a < Dim; ++a) displacement[i][a] = kDisplacement * network.grain_size[i] * random.normal();
  for (NetworkContact<Dim>& c : moved.contacts) {
    const double size = network.grain_size[c.i];
    c.kn = c.kn == 0.0 ? 0.0 : 1.0;
    c.kt = c.kt == 0.0 ? 0.0 : 1.0;
    c.kr = c.kr == 0.0 ? 0.0 : size * size;
    c.ktw = c.ktw == 0.0 ? 0.0 : size * size;
    if (c.on_wall()) continue;
    const double share = 0.5 + 0.2 * (random.uniform() - 0.5);
    c.branch += displacement[c.j] - displacement[c.i];
    c.arm_i = share * c.branch;
    c.arm_j = (share - 1.0) * c.branch;
    c.frame = contact_frame(Vec<Dim>(c.branch.normalized()));
  }
  return moved;
}

}  // namespace

Eigen::MatrixXd vanishing_strains(const Eigen::MatrixXd& relaxed, const Eigen::MatrixXd& affine) {
  const SymmetricEigen eigen = symmetric_eigen(relaxed);
  const double bound = kVanishingStiffness * affine.trace();
  std::vector<Eigen::Index> which;
  for (Eigen::Index k = 0; k < relaxed.rows(); ++k)
    if (std::abs(eigen.values[k]) <= bound) which.push_back(k);
  return eigen.vectors(Eigen::all, which);
}

template <int Dim>
StrainMechanisms strain_mechanisms(const ElasticResponse& response, const Eigen::MatrixXd& affine) {
  StrainMechanisms out;
  out.strains = vanishing_strains(response.relaxed, affine);
  out.motions = response.fluctuation * out.strains;
  if (out.strains.cols() > 0) out.vanishing = vanishing_moduli<Dim>(out.strains);
  return out;
}

template <int Dim>
StructuralMechanisms structural_mechanisms(const ContactNetwork<Dim>& network, StrainSet strains) {
  const ContactNetwork<Dim> moved = in_general_position(network);
  ResponseOptions options;
  options.strains = strains;
  const ElasticResponse response = elastic_response(moved, options);
  const Eigen::MatrixXd affine = affine_stiffness(moved, strains);
  return {response.n_mechanisms, static_cast<int>(vanishing_strains(response.relaxed, affine).cols())};
}

#define FLOC_INSTANTIATE(Dim)                                                                       \
  template StrainMechanisms strain_mechanisms<Dim>(const ElasticResponse&, const Eigen::MatrixXd&); \
  template StructuralMechanisms structural_mechanisms(const ContactNetwork<Dim>&, StrainSet);
FLOC_INSTANTIATE(2)
FLOC_INSTANTIATE(3)
#undef FLOC_INSTANTIATE

}  // namespace floc
