#include "floc/elasticity/moduli.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "floc/base/dense_solvers.h"
#include "floc/base/infinity.h"
#include "floc/base/range.h"
#include "floc/elasticity/convected_stress.h"
#include "floc/elasticity/isotropic_moduli.h"
#include "floc/elasticity/parallel/parallel_response.h"
#include "floc/network/geometric_springs.h"
#include "floc/network/rattlers.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/require_elastic.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

/// A modulus up to this share of the Voigt stiffness counts as zero, because it may be due to rounding. The share is
/// used only if no error bound is available.
constexpr double kVanishingModulus = 1e-11;
/// Condition number of the stiffness matrix above which a warning says that soft modes dominate the moduli.
constexpr double kWarnCondition = 1e10;
/// Condition number of the stiffness matrix above which the residual forces of a packing can decide whether a motion
/// relaxes a strain of the cell.
constexpr double kSoftCondition = 1e12;
/// B counts as below its lower bound only if the relative difference exceeds this number, because the bound is exact
/// only if the forces balance exactly. The number is ten times the usual tolerance of an equilibrium.
constexpr double kBalancedShare = 1e-4;
/// Values of ResponseOptions::mechanism_length that are tried one after another.
constexpr double kMechanismLengths[] = {1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4};
/// Ratio of the tolerance of a solution by a factor to the tolerance on the moduli. Each refinement step squares the
/// error, so that this strict tolerance costs no additional steps.
constexpr double kToleranceOfSolution = 1e-3;
/// Ratio of the tolerance of a solution by any other method to the tolerance on the moduli. The steps of such a method
/// do not square the error, so that a stricter tolerance would cost more steps.
constexpr double kToleranceOfIterativeSolution = 0.1;
/// B_reuss counts as a lower bound on B_S, the bulk modulus under imposed stress, if the normal stresses along the axes
/// differ from the pressure by at most this share of the pressure.
constexpr double kIsotropic = 1e-4;
/// Bound on the relative rounding error of the cell's volume, and of the stresses that prestress adds to the moduli.
constexpr double kCellRounding = 16.0 * std::numeric_limits<double>::epsilon();

/// Returns the largest absolute value at which an eigenvalue of the moduli C cannot be distinguished from zero.
/// @param scale  Voigt stiffness, the stiffness of affine motion (stress)
double vanishing_bound(double scale, const Moduli& m) {
  const double error = m.C_error.rowwise().sum().maxCoeff();
  return std::isfinite(error) ? error : kVanishingModulus * scale;
}

/// Counts the strains that no spring resists, which are the zero eigenvalues of the moduli C, and sets these eigenvalues
/// to exactly zero. Then adds the terms of the convected stress, but none for these strains, and counts the negative
/// eigenvalues. With these terms, a strain that no spring resists would couple to the other strains, and C would have a
/// negative eigenvalue: a bed on a floor would count as unstable.
/// @param bound  largest absolute value of an eigenvalue that counts as zero
/// @param convected  convected_stress() of a packing between walls; empty without prestress and in a periodic cell, where C
/// contains it
void count_coupled_mechanisms(double bound, Eigen::MatrixXd convected, Moduli& m) {
  const SymmetricEigen eigen = symmetric_eigen(m.C);
  Eigen::VectorXd values = eigen.values;
  Eigen::MatrixXd resisted = Eigen::MatrixXd::Identity(m.C.rows(), m.C.cols());
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (std::abs(values[k]) > bound) continue;
    ++m.n_coupled_mechanisms;
    const Eigen::VectorXd direction = eigen.vectors.col(k);
    m.C_error += std::abs(values[k]) * direction.cwiseAbs() * direction.cwiseAbs().transpose();
    resisted -= direction * direction.transpose();
    values[k] = 0.0;
  }
  if (m.n_coupled_mechanisms > 0) m.C = eigen.vectors * values.asDiagonal() * eigen.vectors.transpose();
  m.n_mechanisms += m.n_coupled_mechanisms;
  if (convected.size() > 0) {
    if (m.n_coupled_mechanisms > 0) convected = (resisted * convected * resisted).eval();
    m.C += convected;
    values = symmetric_eigen(m.C).values;
  }
  m.n_negative += static_cast<int>((values.array() < -bound).count());
}

/// Computes the bulk modulus under imposed stress, B_S = 1/(1^T C^-1 1), and its error from the moduli C. B_S is 0 if
/// an isotropic stress does work on a strain that no stiffness resists.
void derive_stress_controlled_bulk(const Eigen::MatrixXd& c, const Eigen::MatrixXd& error, double bound,
                                   Moduli& m) {
  const SymmetricEigen eigen = symmetric_eigen(c);
  double compliance = 0.0;
  Eigen::VectorXd strain = Eigen::VectorXd::Zero(c.rows());  // C^-1 1, the strain under unit pressure
  for (Eigen::Index k = 0; k < c.rows(); ++k) {
    const double value = eigen.values[k];
    const double load = eigen.vectors.col(k).sum();
    if (std::abs(value) > bound) {
      compliance += load * load / value;
      strain += load / value * eigen.vectors.col(k);
    } else if (std::abs(load) > std::sqrt(kVanishingModulus)) {
      m.B_S_error = bound;
      return;
    }
  }
  if (compliance == 0.0) return;
  m.B_S = 1.0 / compliance;
  // To first order, an error dC of C changes 1/B_S by -strain^T dC strain. As long as this change is small, the terms
  // of higher order are negligible.
  const double change = strain.cwiseAbs().dot(error * strain.cwiseAbs()) / std::abs(compliance);
  m.B_S_error = change < 0.5 ? 2.0 * change * std::abs(m.B_S) : kInfinity;
}

/// @param scale      Voigt stiffness, the stiffness of affine motion (stress)
/// @param convected  see count_coupled_mechanisms()
template <int Dim>
void derive_constants(double scale, const Eigen::MatrixXd& convected, Moduli& m) {
  const double bound = vanishing_bound(scale, m);
  count_coupled_mechanisms(bound, convected, m);
  const Eigen::MatrixXd block = m.C.topLeftCorner(Dim, Dim);
  const Eigen::MatrixXd error = m.C_error.topLeftCorner(Dim, Dim);
  const Eigen::VectorXd diagonal = block.diagonal();
  m.B = bulk_modulus(block);
  m.B_error = bulk_modulus_error(error);
  m.G = pure_shear_modulus(block);
  m.G_error = pure_shear_modulus_error(error);
  derive_stress_controlled_bulk(block, error, bound, m);
  const double mean = diagonal.mean();
  m.isotropy_defect = mean == 0.0 ? 0.0 : (diagonal.maxCoeff() - diagonal.minCoeff()) / std::abs(mean);
}

/// Adds a warning if an error bound exceeds the tolerance, and sets moduli without any correct digit to NaN.
void check_errors(bool resolved, double tolerance, Moduli& m) {
  if (!resolved) {
    m.warnings.push_back(
        "no moduli are given, because rounding leaves none of their digits correct, even with a factor of the "
        "rigidity matrix");
    m.C.setConstant(std::numeric_limits<double>::quiet_NaN());
    m.B = m.B_S = m.G = m.isotropy_defect = m.C(0, 0);
    return;
  }
  if (!std::isfinite(m.B_error + m.G_error)) {
    m.warnings.push_back(
        "the moduli have no error bound, because the stiffness matrix has both mechanisms and negative "
        "eigenvalues");
    return;
  }
  const double relative =
      std::max(m.B == 0.0 ? 0.0 : m.B_error / std::abs(m.B), m.G == 0.0 ? 0.0 : m.G_error / std::abs(m.G));
  if (relative > tolerance)
    m.warnings.push_back(fmt::format(
        "the relative error bound of B or G is {:.1e}, above the tolerance of {:.1e}", relative, tolerance));
}

void add_warnings(Moduli& m) {
  if (m.n_coupled_mechanisms > 0)
    m.warnings.push_back(
        fmt::format("{} mechanism(s) change the strain of the cell without resistance: the moduli along these "
                    "strains are zero",
                    m.n_coupled_mechanisms));
  // `n_mechanisms` also counts the coupled mechanisms, which the first warning reports. Only the other mechanisms leave
  // the moduli unchanged.
  if (m.n_mechanisms > m.n_coupled_mechanisms)
    m.warnings.push_back(fmt::format("{} mechanism(s) do not couple to strain; they do not affect the moduli",
                                     m.n_mechanisms - m.n_coupled_mechanisms));
  if (m.n_negative > 0)
    m.warnings.push_back(
        fmt::format("the state is unstable: the stiffness matrix has {} negative eigenvalue(s)", m.n_negative));
  if (m.n_mobilised > 0)
    m.warnings.push_back(fmt::format(
        "{} contact(s) are mobilised (their force is at its limit); the moduli treat them as elastic",
        m.n_mobilised));
  // The condition number is infinite if the stiffness matrix is singular; the warnings above then report mechanisms.
  // The condition number is NaN if the method of solution does not estimate it.
  if (std::isfinite(m.condition) && m.condition > kWarnCondition)
    m.warnings.push_back(
        fmt::format("the stiffness matrix has a condition number of {:.1e}: soft modes dominate the moduli; "
                    "compare the moduli with those computed with prestress",
                    m.condition));
  if (!m.bounds_hold())
    m.warnings.push_back("B_reuss and B_voigt do not bound B, because " + m.bounds.fault);
  else if (!m.isotropic_stress && m.bounds.B_reuss > m.B_S)
    m.warnings.push_back(
        fmt::format("B_reuss = {:.6g} exceeds B_S = {:.6g}: B_reuss bounds B but not B_S, because the "
                    "principal stresses are unequal",
                    m.bounds.B_reuss, m.B_S));
}

template <int Dim>
MeanField mean_field(const Packing<Dim>& packing) {
  const auto n_touching =
      std::count_if(packing.contacts.begin(), packing.contacts.end(),
                    [&](const Contact<Dim>& c) { return !c.distant && !packing.is_wall(c.j); });
  return {2.0 * static_cast<double>(n_touching) / packing.grains.size(), solid_fraction(packing)};
}

}  // namespace

std::vector<std::string> ModuliOptions::validate() const {
  std::vector<std::string> faults;
  if (!(force_tolerance >= 0.0) || !std::isfinite(force_tolerance))
    faults.push_back(fmt::format("force-tolerance = {}: must be >= 0 and finite", force_tolerance));
  if (!(tolerance > 0.0) || !std::isfinite(tolerance))
    faults.push_back(fmt::format("tolerance = {}: must be > 0 and finite", tolerance));
  if (rolling_stiffness && (!(*rolling_stiffness >= 0.0) || !std::isfinite(*rolling_stiffness)))
    faults.push_back(fmt::format("rolling-stiffness = {}: must be >= 0 and finite", *rolling_stiffness));
  return faults;
}

namespace {

template <int Dim>
ContactNetwork<Dim> loaded(const Packing<Dim>& packing, const ModuliOptions& options, const Mat<Dim>& stress) {
  const Vec<Dim> pressure = Vec<Dim>::Constant(stress.trace() / Dim);
  const double smallest = options.force_tolerance * force_scale<Dim>(packing, pressure).force;
  ContactNetwork<Dim> network = without_grains(contact_network(packing), find_rattlers(packing, smallest));
  if (options.rolling_stiffness) set_rolling_stiffness(network, *options.rolling_stiffness);
  if (options.prestress && !packing.grains.are_round()) network.geometric = geometric_springs(packing);
  return network;
}

}  // namespace

template <int Dim>
NetworkLoad<Dim> network_load(const Packing<Dim>& packing, bool unloaded) {
  const auto n_mobilised = std::count_if(packing.contacts.begin(), packing.contacts.end(),
                                         [](const auto& c) { return c.is_mobilised(); });
  return {load_stress(packing),         unloaded,
          mean_field(packing),          static_cast<int>(n_mobilised),
          !packing.gravity.isZero(0.0), !packing.walls.empty()};
}

template <int Dim>
ContactNetwork<Dim> ModuliOptions::loaded_network(const Packing<Dim>& packing) const {
  require_elastic(packing, "moduli are computed");
  return loaded(packing, *this, load_stress(packing));
}

namespace {

/// Sets B to the mean of B_reuss and B_voigt, G to the mean of 0 and G_voigt, and their errors to half the distance
/// between these bounds. If the bounds are not guaranteed, sets m.failure instead.
void set_midpoint_of_bounds(int n_strains, Moduli& m) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  m.method = ModuliMethod::bounds;
  m.C = m.C_error = Eigen::MatrixXd::Constant(n_strains, n_strains, kNone);
  m.isotropy_defect = m.residual = m.condition = kNone;
  m.B = m.B_S = m.G = m.B_error = m.B_S_error = m.G_error = kNone;
  if (!m.bounds_hold()) {
    m.failure = m.bounds.fault;
    return;
  }
  // B_reuss <= B_voigt holds except for rounding
  const double low = std::min(m.bounds.B_reuss, m.bounds.B_voigt);
  m.B = 0.5 * (low + m.bounds.B_voigt);
  m.B_error = 0.5 * (m.bounds.B_voigt - low);
  m.G = m.G_error = 0.5 * m.bounds.G_voigt;
  if (m.isotropic_stress) {
    m.B_S = m.B;
    m.B_S_error = m.B_error;
  } else {
    m.warnings.emplace_back(
        "B_S is not given: B_reuss bounds it only if the principal stresses are equal, and here they are "
        "unequal");
  }
}

/// Returns whether the normal stresses along the axes are equal. Shear stresses have no influence on the bulk modulus
/// under imposed stress, B_S, because B_S is defined with the shear strains fixed at zero.
template <int Dim>
bool is_isotropic(const Mat<Dim>& stress, double pressure) {
  const Vec<Dim> deviator = stress.diagonal() - Vec<Dim>::Constant(pressure);
  return deviator.cwiseAbs().maxCoeff() <= kIsotropic * std::abs(pressure);
}

/// Returns the moduli that follow from the elastic response of a network.
/// @param m  bounds and other members that do not depend on the response
template <int Dim>
Moduli moduli_of(ElasticResponse response, const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                 const ModuliOptions& options, Moduli m) {
  if (!response.failure.empty()) {
    m.method = options.method;
    m.failure = response.failure;
    m.factor_bytes = response.factor_bytes;
    return m;
  }
  m.C = response.relaxed / network.volume;
  Eigen::MatrixXd convected;
  if (options.prestress) convected = convected_stress<Dim>(load.stress, static_cast<int>(m.C.rows()));
  const Eigen::MatrixXd sum = options.prestress ? m.C + convected : m.C;
  m.C_error = response.error / network.volume + kCellRounding * sum.cwiseAbs();
  if (!load.has_walls) {
    m.C = sum;
    convected.resize(0, 0);
  }
  if (!response.counted) m.method = options.method;
  m.steps = response.steps;
  m.n_negative = response.n_negative;
  m.n_mechanisms = response.n_mechanisms;
  m.n_rattlers = response.free.count(FreeMotionKind::rattler) / kDofs<Dim>;
  m.n_free_rollers = response.free.n_free_rollers;
  m.residual = response.residual;
  m.condition = response.condition;
  derive_constants<Dim>(m.bounds.B_voigt + m.bounds.G_voigt, convected, m);
  check_errors(response.resolved, options.tolerance, m);
  m.response = std::move(response);
  add_warnings(m);
  return m;
}

/// Returns whether a network has motions of almost no stiffness, and B is below its lower bound or has no correct digit.
/// This is impossible if the forces balance the pressure P exactly: P times the change of volume in a motion is the work
/// of the forces, so that a motion without stiffness does not change the volume. Residual forces let such a motion change
/// the volume slightly. With a large amplitude, the motion then relaxes a strain of the cell without energy.
bool is_softened_by_residual_forces(const Moduli& m) {
  if (!m.failure.empty() || !m.bounds_hold()) return false;
  return !m.response.resolved ||
         (m.condition > kSoftCondition && m.B < (1.0 - kBalancedShare) * m.bounds.B_reuss);
}

/// Computes the moduli of a network from its elastic response. If residual forces make B smaller than its lower bound, or
/// leave none of its digits correct, motions of little stiffness count as mechanisms: first the softest motions, then
/// more motions, until B has correct digits and is no longer smaller.
/// @param respond  function that returns the elastic response of a network; it may reuse data of its last call
template <int Dim>
Moduli solved_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                     const ModuliOptions& options, const auto& respond) {
  refuse_faults(options.validate());
  Moduli m;
  m.pressure = load.stress.trace() / Dim;
  m.n_mobilised = load.n_mobilised;
  m.bounds = elastic_bounds(network, load.unloaded ? 0.0 : m.pressure, load.mean_field);
  if (load.has_weight && !m.bounds_hold())
    m.bounds.fault = "the contact forces balance the weights of the grains, and not each other";
  if (options.prestress && m.bounds_hold())
    m.bounds.fault = "B contains the geometric terms of the forces (prestress)";
  m.isotropic_stress = m.bounds.B_reuss == 0.0 || is_isotropic<Dim>(load.stress, m.pressure);
  if (options.method == ModuliMethod::bounds) {
    set_midpoint_of_bounds(n_strains<Dim>(options.strains), m);
    return m;
  }
  ResponseOptions response_options{
      .solver = options.method == ModuliMethod::single_factor ? ResponseSolver::single_factor
                                                              : ResponseSolver::factor,
      .strains = options.strains,
      .prestress = options.prestress,
      .ordering = options.ordering,
      .tolerance =
          (options.method == ModuliMethod::factor ? kToleranceOfSolution : kToleranceOfIterativeSolution) *
          options.tolerance,
      .largest_factor = options.largest_factor};
  Moduli found = moduli_of(respond(network, response_options), network, load, options, m);
  if (!is_softened_by_residual_forces(found)) return found;
  response_options.solver = ResponseSolver::factor;
  for (const double length : kMechanismLengths) {
    response_options.mechanism_length = length;
    Moduli held = moduli_of(respond(network, response_options), network, load, options, m);
    if (is_softened_by_residual_forces(held)) continue;
    held.warnings.push_back(fmt::format(
        "motions that stretch the springs by less than {:.0e} of their size count as mechanisms that do not "
        "change the volume; otherwise the residual forces of this packing would make B smaller than its lower "
        "bound, or leave none of its digits correct",
        length));
    return held;
  }
  if (!found.response.resolved) return found;
  found.warnings.push_back(fmt::format(
      "B = {:.6g} is below its lower bound {:.6g}: the residual forces of this packing are too large for its "
      "motions of little stiffness; compare B with the value computed with prestress",
      found.B, found.bounds.B_reuss));
  return found;
}

/// Copies B, G and the elastic response from the moduli without prestress into the moduli with prestress.
/// @return the completed moduli, or `without` if it contains no moduli
Moduli beside(Moduli without, Moduli with) {
  if (!without.failure.empty()) return without;
  with.B_without_prestress = without.B;
  with.G_without_prestress = without.G;
  with.response = std::move(without.response);
  return with;
}

template <int Dim>
Moduli moduli_with(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                   const ModuliOptions& options, const auto& respond) {
  Moduli m = solved_moduli(network, load, options, respond);
  if (!options.prestress || options.method == ModuliMethod::bounds || !m.failure.empty()) return m;
  ModuliOptions plain = options;
  plain.prestress = false;
  return beside(solved_moduli(network, load, plain, respond), std::move(m));
}

template <int Dim>
Moduli moduli_with(const Packing<Dim>& packing, const ModuliOptions& options, const auto& respond) {
  const NetworkLoad<Dim> load = network_load(packing, options.unloaded);
  return moduli_with(loaded(packing, options, load.stress), load, options, respond);
}

}  // namespace

template <int Dim>
Moduli elastic_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                      const ModuliOptions& options) {
  SymmetricFactor factor(options.ordering);
  return moduli_with(network, load, options, [&](const auto& contacts, const ResponseOptions& response) {
    return elastic_response(contacts, response, factor);
  });
}

template <int Dim>
Moduli prestressed_moduli(const ContactNetwork<Dim>& network, const NetworkLoad<Dim>& load,
                          ModuliOptions options, Moduli without) {
  options.prestress = true;
  SymmetricFactor factor(options.ordering);
  return beside(std::move(without), solved_moduli(network, load, options,
                                                  [&](const auto& contacts, const ResponseOptions& response) {
                                                    return elastic_response(contacts, response, factor);
                                                  }));
}

template <int Dim>
Moduli elastic_moduli(const ContactNetwork<Dim>& network, const std::vector<Vec<Dim>>& centres,
                      const NetworkLoad<Dim>& load, const ModuliOptions& options, ParallelSolver& solver) {
  ModuliOptions by_petsc = options;
  by_petsc.method = ModuliMethod::petsc;
  return moduli_with(network, load, by_petsc, [&](const auto& contacts, const ResponseOptions& response) {
    return elastic_response(contacts, centres, response, solver);
  });
}

template <int Dim>
Moduli elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options) {
  SymmetricFactor factor(options.ordering);
  return moduli_with(packing, options, [&](const auto& network, const ResponseOptions& response) {
    return elastic_response(network, response, factor);
  });
}

template <int Dim>
std::vector<Moduli> elastic_moduli(const Packing<Dim>& packing, const ModuliOptions& options,
                                   const std::vector<double>& rolling_stiffness) {
  SymmetricFactor factor(options.ordering);
  std::vector<Moduli> all;
  ModuliOptions each = options;
  for (const double kr : rolling_stiffness) {
    each.rolling_stiffness = kr;
    all.push_back(moduli_with(packing, each, [&](const auto& network, const ResponseOptions& response) {
      return elastic_response(network, response, factor);
    }));
  }
  return all;
}

template <int Dim>
ModuliSequence<Dim>::ModuliSequence(ModuliOptions options) : options_(options) {}

template <int Dim>
Moduli ModuliSequence<Dim>::next(const Packing<Dim>& packing, bool unloaded) {
  options_.unloaded = unloaded;
  if (options_.method != ModuliMethod::iterative) return elastic_moduli(packing, options_);
  return moduli_with(packing, options_, [this](const auto& network, const ResponseOptions& response) {
    return elastic_response(network, response, memory_);
  });
}

template ContactNetwork<2> ModuliOptions::loaded_network(const Packing<2>&) const;
template ContactNetwork<3> ModuliOptions::loaded_network(const Packing<3>&) const;
template Moduli elastic_moduli(const ContactNetwork<2>&, const NetworkLoad<2>&, const ModuliOptions&);
template Moduli elastic_moduli(const ContactNetwork<3>&, const NetworkLoad<3>&, const ModuliOptions&);
template Moduli prestressed_moduli(const ContactNetwork<2>&, const NetworkLoad<2>&, ModuliOptions, Moduli);
template Moduli prestressed_moduli(const ContactNetwork<3>&, const NetworkLoad<3>&, ModuliOptions, Moduli);
template NetworkLoad<2> network_load(const Packing<2>&, bool);
template NetworkLoad<3> network_load(const Packing<3>&, bool);
template Moduli elastic_moduli(const ContactNetwork<2>&, const std::vector<Vec<2>>&, const NetworkLoad<2>&,
                               const ModuliOptions&, ParallelSolver&);
template Moduli elastic_moduli(const ContactNetwork<3>&, const std::vector<Vec<3>>&, const NetworkLoad<3>&,
                               const ModuliOptions&, ParallelSolver&);
template Moduli elastic_moduli(const Packing<2>&, const ModuliOptions&);
template Moduli elastic_moduli(const Packing<3>&, const ModuliOptions&);
template class ModuliSequence<2>;
template class ModuliSequence<3>;
template std::vector<Moduli> elastic_moduli(const Packing<2>&, const ModuliOptions&,
                                            const std::vector<double>&);
template std::vector<Moduli> elastic_moduli(const Packing<3>&, const ModuliOptions&,
                                            const std::vector<double>&);

}  // namespace floc
