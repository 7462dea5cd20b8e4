#include "floc/elasticity/moduli.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "floc/elasticity/isotropic_moduli.h"
#include "floc/network/rattlers.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"

namespace floc {
namespace {

/// A modulus below this share of the Voigt stiffness is what rounding leaves of zero.
constexpr double kVanishingModulus = 1e-11;
/// Product of condition number and rounding beyond which digits of the moduli are in doubt.
constexpr double kWarnCondition = 1e10;

/// Component of a symmetric tensor that a strain unknown does work on.
template <int Dim>
double conjugate(const Mat<Dim>& tensor, int column) {
  return (tensor.transpose() * unit_strain<Dim>(column)).trace();
}

/// What the convection of forces adds to relaxed K/V: -sym(sigma E) + sigma tr E, symmetrised.
template <int Dim>
Eigen::MatrixXd convected_stress(const Mat<Dim>& stress, int n) {
  Eigen::MatrixXd added(n, n);
  for (int b = 0; b < n; ++b) {
    const Mat<Dim> e = unit_strain<Dim>(b);
    const Mat<Dim> turned = stress * e;
    const Mat<Dim> change = stress * e.trace() - 0.5 * (turned + turned.transpose());
    for (int a = 0; a < n; ++a) added(a, b) = conjugate<Dim>(change, a);
  }
  return 0.5 * (added + added.transpose());
}

/// Counts vanishing and negative eigenvalues of C and sets the vanishing ones to zero.
void settle_coupled_mechanisms(double scale, Moduli& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(m.C);
  Eigen::VectorXd values = eigen.eigenvalues();
  const double bound = kVanishingModulus * scale;
  for (double& v : values) {
    if (v < -bound) ++m.n_negative;
    if (std::abs(v) > bound) continue;
    ++m.n_coupled_mechanisms;
    v = 0.0;
  }
  if (m.n_coupled_mechanisms > 0)
    m.C = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
  m.n_mechanisms += m.n_coupled_mechanisms;
}

/// 1/(1^T C^-1 1), and 0 where the unit stress works on a strain that costs nothing.
double stress_controlled_bulk(const Eigen::MatrixXd& c, double scale) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(c);
  double compliance = 0.0;
  for (Eigen::Index k = 0; k < c.rows(); ++k) {
    const double value = eigen.eigenvalues()[k];
    const double load = eigen.eigenvectors().col(k).sum();
    if (std::abs(value) > kVanishingModulus * scale)
      compliance += load * load / value;
    else if (std::abs(load) > std::sqrt(kVanishingModulus))
      return 0.0;
  }
  return compliance == 0.0 ? 0.0 : 1.0 / compliance;
}

template <int Dim>
void derive_constants(double scale, Moduli& m) {
  settle_coupled_mechanisms(scale, m);
  const Eigen::MatrixXd block = m.C.topLeftCorner(Dim, Dim);
  const Eigen::VectorXd diagonal = block.diagonal();
  m.B = bulk_modulus(block);
  m.G = pure_shear_modulus(block);
  m.B_S = stress_controlled_bulk(block, scale);
  const double mean = diagonal.mean();
  m.isotropy_defect = mean == 0.0 ? 0.0 : (diagonal.maxCoeff() - diagonal.minCoeff()) / std::abs(mean);
}

void add_warnings(Moduli& m) {
  if (m.n_coupled_mechanisms > 0)
    m.warnings.push_back(fmt::format("{} mechanism(s) strain the cell at no cost: moduli along them are zero",
                                     m.n_coupled_mechanisms));
  if (m.n_mechanisms > m.n_coupled_mechanisms)
    m.warnings.push_back(
        fmt::format("{} mechanism(s) that do not couple to strain; the moduli do not feel them",
                    m.n_mechanisms - m.n_coupled_mechanisms));
  if (m.n_negative > 0)
    m.warnings.push_back(
        fmt::format("unstable: {} negative eigenvalue(s) of the stiffness matrix", m.n_negative));
  if (m.n_at_cap > 0)
    m.warnings.push_back(
        fmt::format("{} contact(s) slide or yield; the moduli treat them as elastic", m.n_at_cap));
  if (std::isfinite(m.condition) && m.condition > kWarnCondition)
    m.warnings.push_back(
        fmt::format("condition number {:.1e}: soft modes decide the moduli, and rounding limits their "
                    "digits; see the moduli with and without prestress",
                    m.condition));
}

template <int Dim>
MeanField mean_field(const Packing<Dim>& packing) {
  const auto n_touching = std::count_if(packing.contacts.begin(), packing.contacts.end(),
                                        [](const Contact<Dim>& c) { return !c.distant; });
  return {2.0 * static_cast<double>(n_touching) / packing.grains.size(), solid_fraction(packing)};
}

}  // namespace

std::vector<std::string> ModuliOptions::validate() const {
  std::vector<std::string> faults;
  if (!(force_tolerance >= 0.0) || !std::isfinite(force_tolerance))
    faults.push_back(fmt::format("tolerance = {}: must be >= 0 and finite", force_tolerance));
  if (rolling_stiffness && (!(*rolling_stiffness >= 0.0) || !std::isfinite(*rolling_stiffness)))
    faults.push_back(fmt::format("rolling-stiffness = {}: must be >= 0 and finite", *rolling_stiffness));
  return faults;
}

template <int Dim>
ContactNetwork<Dim> ModuliOptions::loaded_network(const Packing<Dim>& packing) const {
  const Vec<Dim> pressure = Vec<Dim>::Constant(static_stress(packing).trace() / Dim);
  const double smallest = force_tolerance * force_scale<Dim>(packing, pressure).force;
  ContactNetwork<Dim> network = without_grains(contact_network(packing), find_rattlers(packing, smallest));
  if (rolling_stiffness) set_rolling_stiffness(network, *rolling_stiffness);
  return network;
}

template <int Dim>
Moduli elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options) {
  assert(options.validate().empty());
  Moduli m;
  const Mat<Dim> stress = static_stress(packing);
  m.pressure = stress.trace() / Dim;
  m.n_at_cap = static_cast<int>(std::count_if(packing.contacts.begin(), packing.contacts.end(),
                                              [](const auto& c) { return c.sliding || c.rolling_yield; }));
  const ContactNetwork<Dim> network = options.loaded_network(packing);
  m.bounds = elastic_bounds(network, m.pressure, mean_field(packing));

  ElasticResponse response = elastic_response(network, {options.strains, options.prestress, options.ordering});
  m.C = response.relaxed / network.volume;
  if (options.prestress) m.C += convected_stress<Dim>(stress, static_cast<int>(m.C.rows()));
  m.n_negative = response.n_negative;
  m.n_mechanisms = response.n_mechanisms;
  m.n_rattlers = response.free.count(FreeMotionKind::rattler) / kDofs<Dim>;
  m.n_free_rollers = response.free.n_free_rollers;
  m.residual = response.residual;
  m.condition = response.condition;
  derive_constants<Dim>(m.bounds.B_voigt + m.bounds.G_voigt, m);
  if (options.prestress) {
    ModuliOptions plain = options;
    plain.prestress = false;
    Moduli without = elastic_moduli(packing, plain);
    m.B_without_prestress = without.B;
    m.G_without_prestress = without.G;
    response = std::move(without.response);
  }
  m.response = std::move(response);
  add_warnings(m);
  return m;
}

template ContactNetwork<2> ModuliOptions::loaded_network(const Packing<2>&) const;
template ContactNetwork<3> ModuliOptions::loaded_network(const Packing<3>&) const;
template Moduli elastic_moduli(const Packing<2>&, const ModuliOptions&);
template Moduli elastic_moduli(const Packing<3>&, const ModuliOptions&);

}  // namespace floc
