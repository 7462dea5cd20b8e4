#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "floc/elasticity/moduli.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/equilibrator.h"
#include "floc/relaxation/static_solver.h"
#include "support/consistent_tangent.h"
#include "support/contact_laws.h"
#include "support/crystals.h"
#include "support/dynamics.h"
#include "support/few_grains.h"
#include "support/lattices.h"

namespace floc {
namespace {

/// Law of linear contacts without adhesion, with K_T = 0.8 K_N, in units of K_N and a.
Law linear_law(double friction) {
  Law law;
  law += test::linear(1.0);
  law += test::coulomb(friction, 0.8);
  law += test::viscous_damping(0.1);
  return law;
}

/// Returns a load that changes the length of one axis by a logarithmic strain. The other axes keep their lengths if
/// `others_strained` is true, and their stresses otherwise.
template <int Dim>
LoadTarget<Dim> driven(const Packing<Dim>& packing, int axis, double strain, bool others_strained) {
  LoadTarget<Dim> load;
  const Mat<Dim> stress = static_stress(packing);
  for (int a = 0; a < Dim; ++a) {
    if (a == axis)
      load.side[a] = packing.cell.matrix(a, a) * std::exp(-strain);
    else if (others_strained)
      load.side[a] = packing.cell.matrix(a, a);
    else
      load.stress[a] = stress(a, a);
  }
  return load;
}

template <int Dim>
Packing<Dim> solved(const Packing<Dim>& from, const LoadTarget<Dim>& load) {
  StaticSolverOptions options;
  options.target = 1e-13;
  options.max_iterations = 60;
  options.largest_displacement = 1.0;
  auto control = BoundaryControl<Dim>::imposing(load, load.stress_with(static_stress(from)), 0.0);
  for (int a = 0; a < Dim; ++a)
    if (load.strained(a)) control.ramp.from[a] = from.cell.matrix(a, a), control.ramp.to[a] = load.side[a];
  if (load.offset) {
    const int axis = control.ramp.sheared_axis = load.offset->axis;
    control.ramp.offset_from = from.cell.matrix(axis, 0);
    control.ramp.offset_to = load.offset->offset;
    control.ramp.height = from.cell.matrix(axis, axis);
  }
  const StaticSolution<Dim> solution = solve_statics(from, control, options);
  EXPECT_LT(solution.residual, 1e-11) << solution.reason;
  return solution.packing;
}

/// Compresses a gas without friction, then switches friction on, without tangential forces at first. Returns the
/// equilibrium that is then found.
template <int Dim>
Packing<Dim> dense_packing(int n, double pressure, std::uint64_t seed) {
  Law smooth = linear_law(0.5);
  smooth += test::without("friction");
  RelaxationOptions options;
  options.inertial_number_cap = 1e-2;
  const auto relaxer = make_equilibrator<Dim>(
      options, test::gas_of<Dim>(n, smooth, Dim == 2 ? 0.6 : 0.45, seed), Vec<Dim>::Constant(pressure));
  while (relaxer->advance() == RelaxationStatus::running) continue;
  Packing<Dim> packing = relaxer->packing();
  packing.law = linear_law(1e3);  // friction coefficient so large that no contact slides
  refresh_contacts(packing);
  return solved<Dim>(packing, LoadTarget<Dim>::normal_stress(Vec<Dim>::Constant(pressure)));
}

template <int Dim>
Mat<Dim> stiffness(const Packing<Dim>& packing) {
  ModuliOptions options;
  options.prestress = true;
  return elastic_moduli(packing, options).C;
}

constexpr double kStrain = 3e-7;

/// Changes of stress and of logarithmic strain in a small load step: half the difference between two steps of opposite
/// sign.
template <int Dim>
struct Answer {
  Vec<Dim> stress, strain;
};
template <int Dim>
Answer<Dim> answer(const Packing<Dim>& packing, int axis, bool others_strained) {
  const auto end = [&](double strain) {
    const Packing<Dim> at = solved(packing, driven(packing, axis, strain, others_strained));
    EXPECT_EQ(at.contacts.size(), packing.contacts.size());
    return at;
  };
  const Packing<Dim> more = end(kStrain), less = end(-kStrain);
  return {0.5 * (static_stress(more) - static_stress(less)).diagonal(),
          0.5 * (less.cell.matrix.diagonal().array() / more.cell.matrix.diagonal().array()).log()};
}

/// Expects for every driven axis d and lateral axis l that d sigma_l/d sigma_d = C_ld/C_dd. Also expects Young's moduli
/// and Poisson's ratios that follow from the compliance.
template <int Dim>
void expect_elastic_answers(const Packing<Dim>& packing, const Mat<Dim>& C) {
  const Mat<Dim> S = C.inverse();
  for (int d = 0; d < Dim; ++d) {
    const Answer<Dim> oedometric = answer(packing, d, true);
    const Answer<Dim> triaxial = answer(packing, d, false);
    EXPECT_NEAR(oedometric.stress[d] / kStrain / C(d, d), 1.0, 1e-5) << d;
    EXPECT_NEAR(triaxial.stress[d] / kStrain * S(d, d), 1.0, 1e-5) << d;
    for (int l = 0; l < Dim; ++l) {
      if (l == d) continue;
      EXPECT_NEAR(oedometric.stress[l] / oedometric.stress[d], C(l, d) / C(d, d), 1e-5) << d << l;
      EXPECT_NEAR(-triaxial.strain[l] / triaxial.strain[d], -S(l, d) / S(d, d), 1e-5) << d << l;
    }
  }
}

template <int Dim>
void expect_answers_of_moduli(const Packing<Dim>& packing) {
  expect_elastic_answers<Dim>(packing, stiffness(packing));
}

TEST(DirectedLoad, OfATriangularCrystalIsThatOfItsModuli) {
  expect_answers_of_moduli(test::triangular_crystal(4, 1.0, linear_law(0.5)));
}

TEST(DirectedLoad, OfAnFccCrystalIsThatOfItsModuli) {
  expect_answers_of_moduli(test::crystal_of(test::face_centred_cubic(), 0.99, 1.0, linear_law(0.5)));
}

TEST(DirectedLoad, OfDensePackingsIsThatOfTheirModuli) {
  expect_answers_of_moduli(dense_packing<2>(60, 1e-3, 3));
  expect_answers_of_moduli(dense_packing<3>(60, 1e-3, 4));
}

/// Returns C_ab = R_ab/V + sigma_a. R is the derivative of the virial (sum of f r over the contacts) with respect to
/// the strains, where the grains follow the strains. R is computed with the consistent tangent of all forces, including
/// tangential ones.
template <int Dim>
Mat<Dim> consistent_stiffness(const Packing<Dim>& packing) {
  const Eigen::MatrixXd whole = test::consistent_tangent(packing, Dim);
  const Eigen::Index n = whole.rows() - Dim;
  const Eigen::MatrixXd grains = whole.topLeftCorner(n, n), border = whole.topRightCorner(n, Dim);
  // Translations and rattlers have no stiffness. The solution of least norm sets their displacements to zero.
  const Eigen::MatrixXd followed = grains.completeOrthogonalDecomposition().solve(border);
  const Mat<Dim> relaxed = whole.bottomRightCorner<Dim, Dim>() - whole.bottomLeftCorner(Dim, n) * followed;
  const Vec<Dim> stress = static_stress(packing).diagonal();
  return relaxed / packing.cell.volume() + stress * Vec<Dim>::Ones().transpose();
}

template <int Dim>
double largest_mobilisation(const Packing<Dim>& packing) {
  double largest = 0.0;
  for (const Contact<Dim>& c : packing.contacts)
    largest = std::max(largest, c.shear_force.norm() / std::max(c.normal_force, 1e-12));
  return largest;
}

/// A packing is compressed along one axis by many times its elastic strain, which causes tangential forces. The
/// response of this packing follows the consistent tangent, and not the elastic moduli, which omit the geometric terms
/// of the tangential forces.
template <int Dim>
void expect_answers_of_the_consistent_tangent(std::uint64_t seed) {
  Packing<Dim> packing = dense_packing<Dim>(60, 1e-2, seed);
  for (int step = 0; step < 4; ++step) packing = solved(packing, driven(packing, Dim - 1, 5e-4, true));
  EXPECT_GT(largest_mobilisation(packing), 0.1);
  const Mat<Dim> C = consistent_stiffness(packing);
  EXPECT_GT((C - stiffness(packing)).cwiseAbs().maxCoeff(), 1e-4 * C.cwiseAbs().maxCoeff());
  expect_elastic_answers<Dim>(packing, C);
}

TEST(DirectedLoad, UnderTangentialForcesIsThatOfTheConsistentTangent) {
  expect_answers_of_the_consistent_tangent<2>(3);
  expect_answers_of_the_consistent_tangent<3>(4);
}

/// Returns a load that keeps all lengths and displaces the planes across `axis` in the direction of the first
/// axis.
template <int Dim>
LoadTarget<Dim> sheared(const Packing<Dim>& packing, int axis, double strain) {
  LoadTarget<Dim> load;
  load.side = packing.cell.matrix.diagonal();
  load.offset = ImposedOffset{axis, packing.cell.matrix(axis, 0) + strain * load.side[axis]};
  return load;
}

/// Expects that d tau/d gamma equals the shear modulus. A simple shear also contains a rotation, which has no effect if
/// the stresses on the two axes are equal, as here.
template <int Dim>
void expect_shear_answers(const Packing<Dim>& packing) {
  ModuliOptions options;
  options.prestress = true;
  options.strains = StrainSet::full;
  const Eigen::MatrixXd C = elastic_moduli(packing, options).C;
  for (int axis = 1; axis < Dim; ++axis) {
    const Packing<Dim> more = solved(packing, sheared(packing, axis, kStrain));
    const Packing<Dim> less = solved(packing, sheared(packing, axis, -kStrain));
    EXPECT_NEAR((more.cell.matrix(axis, 0) - less.cell.matrix(axis, 0)) / packing.cell.matrix(axis, axis),
                2 * kStrain, 1e-14);
    const double answer = (static_stress(less)(0, axis) - static_stress(more)(0, axis)) / (2 * kStrain);
    const int k = shear_component<Dim>(axis);
    EXPECT_NEAR(answer / C(k, k), 1.0, 1e-5) << axis;
  }
}

TEST(DirectedLoad, OfSimpleShearIsThatOfTheShearModuli) {
  expect_shear_answers(test::triangular_crystal(4, 1.0, linear_law(0.5)));
  expect_shear_answers(test::crystal_of(test::face_centred_cubic(), 0.99, 1.0, linear_law(0.5)));
}

/// Imposes a closed cycle of strains. Expects that the relaxer solves each step statically, and that all grains are at
/// their old positions after the cycle.
template <int Dim>
void expect_closed_cycle(const Packing<Dim>& start) {
  Packing<Dim> packing = start;
  const std::vector<Vec<Dim>> before = start.grains.position;
  const Vec<Dim> sides = start.cell.matrix.diagonal();
  RelaxationOptions options;
  options.tolerance = {1e-9, 1e-9, 1e-9, 5e-8};
  for (const double strain : {1e-5, 0.0}) {
    LoadTarget<Dim> load = LoadTarget<Dim>{Vec<Dim>::Zero(), sides};
    load.side[Dim - 1] *= std::exp(-strain);
    const auto relaxer = make_equilibrator<Dim>(options, packing, load);
    ASSERT_EQ(relaxer->advance(), RelaxationStatus::converged);
    EXPECT_EQ(relaxer->report().ending, "static");
    EXPECT_EQ(relaxer->target_stress(), Vec<Dim>(relaxer->stress().diagonal()));
    packing = relaxer->packing();
    EXPECT_NEAR(packing.cell.matrix(Dim - 1, Dim - 1) / load.side[Dim - 1], 1.0, 1e-15);
  }
  double farthest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i)
    farthest = std::max(farthest, (packing.grains.position[i] - before[i]).norm());
  EXPECT_LT(farthest, 1e-9);
}

TEST(DirectedLoad, AClosedElasticCycleBringsGrainsBack) {
  expect_closed_cycle(test::triangular_crystal(4, 1.0, linear_law(0.5)));
  expect_closed_cycle(dense_packing<2>(60, 1e-3, 3));
}

/// Options with which the relaxer only integrates the motion, without static steps.
RelaxationOptions moving() {
  RelaxationOptions options;
  options.finish = Finish::dynamic;
  options.inertial_number_cap = 1e-3;
  return options;
}

TEST(DirectedLoad, AStrainedAxisMovesToItsLengthAndStandsStill) {
  const Packing<2> start = dense_packing<2>(60, 1e-3, 3);
  const LoadTarget<2> load = driven<2>(start, 1, 2e-3, false);
  const auto relaxer = make_equilibrator<2>(moving(), start, load);
  double fastest = 0.0, shortest = start.cell.matrix(1, 1);
  relaxer->set_observer({0.0, [&](const Packing<2>& packing, double) {
                           fastest = std::max(
                               fastest, std::abs(packing.cell.velocity(1, 1) / packing.cell.matrix(1, 1)));
                           shortest = std::min(shortest, packing.cell.matrix(1, 1));
                         }});
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) status = relaxer->advance();
  ASSERT_EQ(status, RelaxationStatus::converged) << relaxer->report().blocking;
  const Packing<2>& end = relaxer->packing();
  EXPECT_NEAR(end.cell.matrix(1, 1) / load.side[1], 1.0, 1e-14);
  EXPECT_GE(shortest, load.side[1] * (1.0 - 1e-14));  // the axis never overshoots its target
  EXPECT_EQ(end.cell.velocity(1, 1), 0.0);
  // the strain rate is below its cap; the pressure is close to the initial one
  EXPECT_LE(fastest, 1.001e-3 * std::sqrt(1e-3 / 1.0) * 1.1);
  const Mat<2> stress = static_stress(end);
  EXPECT_NEAR(stress(0, 0), 1e-3, 1e-8);  // imposed
  EXPECT_GT(stress(1, 1), 1.05e-3);       // increased by the strain
  EXPECT_LT(relaxer->report().residuals.stress, 1e-5);
}

/// Imposes a simple shear at constant normal stress on the shear planes, without static steps.
TEST(DirectedLoad, AShearedLatticeMovesToItsOffsetAndStandsStill) {
  const Packing<2> start = dense_packing<2>(60, 1e-3, 3);
  const double height = start.cell.matrix(1, 1);
  LoadTarget<2> load;
  load.side[0] = start.cell.matrix(0, 0);
  load.stress[1] = 1e-3;
  load.offset = ImposedOffset{1, 5e-3 * height};
  auto whole = make_equilibrator<2>(moving(), start, load);
  auto broken = make_equilibrator<2>(moving(), start, load);
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) {
    status = whole->advance();
    EXPECT_EQ(broken->advance(), status);
    if (status != RelaxationStatus::running) break;
    const std::string progress = broken->progress();
    broken = make_equilibrator<2>(moving(), broken->release_packing(), load, progress);
  }
  ASSERT_EQ(status, RelaxationStatus::converged) << whole->report().blocking;
  test::expect_same_bits(whole->packing(), broken->packing());
  const Packing<2>& end = whole->packing();
  EXPECT_NEAR(end.cell.matrix(1, 0), load.offset->offset, 1e-14 * height);
  EXPECT_EQ(end.cell.matrix(0, 1), 0.0);
  EXPECT_EQ(end.cell.velocity(1, 0), 0.0);
  EXPECT_NEAR(end.cell.matrix(0, 0) / load.side[0], 1.0, 1e-14);
  const Mat<2> stress = static_stress(end);
  EXPECT_NEAR(stress(1, 1), 1e-3, 2e-8);
  EXPECT_LT(stress(0, 1), static_stress(start)(0, 1) - 1e-4);  // the packing resists the shear
}

TEST(DirectedLoad, IsContinuedFromItsProgressBitByBit) {
  const Packing<2> start = dense_packing<2>(60, 1e-3, 3);
  const LoadTarget<2> load = driven<2>(start, 1, 5e-3, true);
  auto whole = make_equilibrator<2>(moving(), start, load);
  auto broken = make_equilibrator<2>(moving(), start, load);
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) {
    status = whole->advance();
    EXPECT_EQ(broken->advance(), status);
    if (status != RelaxationStatus::running) break;
    const std::string progress = broken->progress();
    broken = make_equilibrator<2>(moving(), broken->release_packing(), load, progress);
  }
  EXPECT_EQ(status, RelaxationStatus::converged);
  test::expect_same_bits(whole->packing(), broken->packing());
}

/// Returns the report of a relaxation whose target lengths cannot be reached.
RelaxationReport refused(const Packing<2>& start, const LoadTarget<2>& load) {
  const auto relaxer = make_equilibrator<2>(moving(), start, load);
  RelaxationStatus status = RelaxationStatus::running;
  int n_chunks = 0;
  while (status == RelaxationStatus::running && ++n_chunks < 5000) status = relaxer->advance();
  EXPECT_EQ(status, RelaxationStatus::gave_up);
  return relaxer->report();
}

/// If every axis is extended, the grains lose contact and never come to rest. The relaxer must say so.
TEST(DirectedLoad, APackingDrawnApartEndsInWords) {
  const Packing<2> start = dense_packing<2>(60, 1e-3, 3);
  LoadTarget<2> load;
  load.side = 1.02 * start.cell.matrix.diagonal();
  EXPECT_THAT(refused(start, load).blocking, testing::HasSubstr("stress zero"));
}

/// Grains with adhesion but without contacts cannot carry a load either.
TEST(DirectedLoad, CohesiveGrainsWithoutContactsEndInWords) {
  Packing<2> start = test::unit_grains<2>({{1.0, 1.0}, {3.0, 3.0}}, 4.0, test::cohesive_law());
  find_contacts(start);
  ASSERT_TRUE(start.contacts.empty());
  LoadTarget<2> load;
  load.side = 1.01 * start.cell.matrix.diagonal();
  EXPECT_THAT(refused(start, load).blocking, testing::HasSubstr("stress zero"));
}

TEST(DirectedLoad, ACellThatWouldCloseIsRefusedAtOnce) {
  const Packing<2> start = dense_packing<2>(60, 1e-3, 3);
  LoadTarget<2> load;
  load.side = start.cell.matrix.diagonal();
  load.side[1] *= 0.7;
  const RelaxationReport full = refused(start, load);
  EXPECT_THAT(full.blocking, testing::HasSubstr("times that of the cell; impose a smaller strain"));
  EXPECT_EQ(full.n_steps, 0);
  load = driven<2>(start, 0, std::log(start.cell.matrix(0, 0) / 0.3), false);
  EXPECT_THAT(refused(start, load).blocking, testing::HasSubstr("the imposed length of axis 1 is 0.3"));
}

}  // namespace
}  // namespace floc
