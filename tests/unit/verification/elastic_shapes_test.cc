#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "floc/packing/balance.h"
#include "floc/verification/verification.h"
#include "support/elastic_gas.h"

/// Tests of elastic grains with corners. They come to rest by contact dynamics. Their states meet the criteria of an
/// equilibrium. Their moduli are those of the springs in the contact points.
namespace floc::test {
namespace {

template <int Dim>
State<Dim> state_at(const Packing<Dim>& packing, const Vec<Dim>& stress) {
  State<Dim> state;
  state.packing = packing;
  state.target_stress = stress;
  state.n_negative = 0;
  measure(state);
  return state;
}

/// Returns the names of the criteria that a state does not meet.
template <int Dim>
std::string criteria_violated(const State<Dim>& state) {
  std::string names;
  for (const Criterion& criterion : verify_equilibrium(state))
    if (!criterion.holds) names += std::string(criterion.name) + " (" + criterion.where + ") ";
  return names;
}

const ShapeOptions kRoundedPentagons{.kind = PolygonOptions{5}, .rounding = 0.05};
const ShapeOptions kRoundedStones{.kind = CutOptions{}, .rounding = 0.05, .count = 10};

template <int Dim>
void expect_verified_balance(int count, const ShapeOptions& shape) {
  const RigidEnd<Dim> end = relaxed(elastic_gas<Dim>(count, shape, 1e4, 0.5));
  ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  EXPECT_EQ(end.report.ending, "polished");
  State<Dim> state = state_at<Dim>(end.packing, Vec<Dim>::Ones());
  EXPECT_EQ(criteria_violated(state), "");
  EXPECT_LT(state.residuals.force, 1e-8);
  // Each normal force is that of a spring, and each tangential force is within Coulomb's limit.
  for (const Contact<Dim>& c : end.packing.contacts) {
    EXPECT_NEAR(c.normal_force, -1e4 * c.gap, 1e-9);
    EXPECT_LE(c.shear_force.norm(), 0.5 * c.normal_force * (1.0 + 1e-9));
  }
  // If one force, one position or one contact is changed, the state is no longer an equilibrium.
  State<Dim> wrong = state;
  wrong.packing.contacts[3].normal_force *= 1.01;
  EXPECT_NE(criteria_violated(wrong).find("law"), std::string::npos);
  wrong = state;
  wrong.packing.grains.position[wrong.packing.contacts[0].i][0] += 1e-6;
  EXPECT_NE(criteria_violated(wrong).find("geometry"), std::string::npos);
  wrong = state;
  const Contact<Dim> lost = wrong.packing.contacts.front();
  std::erase_if(wrong.packing.contacts, [&](const Contact<Dim>& c) { return c.i == lost.i && c.j == lost.j; });
  EXPECT_NE(criteria_violated(wrong).find("list"), std::string::npos);
}

TEST(ElasticShapes, PentagonsComeToAVerifiedRest) {
  expect_verified_balance<2>(40, kRoundedPentagons);
}

TEST(ElasticShapes, PolyhedraComeToAVerifiedRest) {
  expect_verified_balance<3>(16, kRoundedStones);
}

/// Polygons and capsules with sharp or rounded corners come to rest, with and without friction.
TEST(ElasticShapes, SmallPackingsRest) {
  const std::vector<ShapeOptions> plane = {
      {.kind = PolygonOptions{3}, .rounding = 0.1}, {.kind = PolygonOptions{7}}, {.kind = CapsuleOptions{2.0}}};
  for (const double friction : {0.0, 0.3})
    for (std::size_t k = 0; k < plane.size(); ++k) {
      const RigidEnd<2> end = relaxed(elastic_gas<2>(12, plane[k], 1e4, friction));
      EXPECT_EQ(end.status, RelaxationStatus::converged) << k << " friction " << friction << ": " << end.reason;
      EXPECT_EQ(criteria_violated(state_at<2>(end.packing, Vec<2>::Ones())), "")
          << k << " friction " << friction;
    }
  const RigidEnd<3> end = relaxed(elastic_gas<3>(8, {.kind = CapsuleOptions{1.5}}, 1e4, 0.3));
  EXPECT_EQ(end.status, RelaxationStatus::converged) << end.reason;
  EXPECT_EQ(criteria_violated(state_at<3>(end.packing, Vec<3>::Ones())), "");
}

/// Most packings of rounded polyhedra without friction come to rest. (The packing of PolyhedraWithoutRestSayWhy does
/// not.)
TEST(ElasticShapes, FrictionlessPolyhedraRest) {
  for (const int n : {6, 12, 16}) {
    const RigidEnd<3> end = relaxed(elastic_gas<3>(n, kRoundedStones, 1e4, 0.0));
    EXPECT_EQ(end.status, RelaxationStatus::converged) << end.reason;
    EXPECT_EQ(criteria_violated(state_at<3>(end.packing, Vec<3>::Ones())), "");
  }
}

TEST(ElasticShapes, PolyhedraWithoutRestSayWhy) {
  const RigidEnd<3> end = relaxed(elastic_gas<3>(18, kRoundedStones, 1e4, 0.0));
  ASSERT_EQ(end.status, RelaxationStatus::gave_up);
  EXPECT_THAT(end.reason, testing::HasSubstr("contact points between two faces appear and vanish abruptly"));
}

TEST(ElasticShapes, RelaxationsRepeatTheirBits) {
  const Packing<2> start = elastic_gas<2>(40, kRoundedPentagons, 1e4, 0.5);
  const RigidEnd<2> whole = relaxed<2>(start);
  ASSERT_EQ(whole.status, RelaxationStatus::converged) << whole.reason;
  expect_same(whole, relaxed<2>(start, rigid_options(), true));
  RelaxationOptions options = rigid_options();
  options.threads = 2;
  expect_same(whole, relaxed<2>(start, options));
}

TEST(ElasticShapes, ModuliOfPolygonsAreThoseOfRelaxedStrains) {
  expect_moduli_of_strains<2>(30, kRoundedPentagons, 0.5, 1e-3);
  expect_moduli_of_strains<2>(30, {.kind = PolygonOptions{5}}, 0.5, 1e-3);
  expect_moduli_of_strains<2>(30, {.kind = CapsuleOptions{2.0}}, 0.3, 1e-3);
}

TEST(ElasticShapes, ModuliOfPolyhedraAreThoseOfRelaxedStrains) {
  expect_moduli_of_strains<3>(16, kRoundedStones, 0.5, 1e-3);
  expect_moduli_of_strains<3>(18, {.kind = CutOptions{}, .count = 10}, 0.5, 1e-3);
  expect_moduli_of_strains<3>(9, {.kind = CapsuleOptions{1.5}}, 0.3, 1e-3);
}

/// Without friction, only the normal forces resist rotations. The packing of pentagons is isostatic, and its shear
/// modulus is only about as large as the pressure.
TEST(ElasticShapes, ModuliOfFrictionlessPolygonsAreThoseOfRelaxedStrains) {
  expect_moduli_of_strains<2>(25, kRoundedPentagons, 0.0, 1e-5);
}

/// A small strain of one axis is imposed, under a constant stress on the other axis. Divided by the strain, the change
/// of the stress on the first axis is C11 - C12^2/C22. The state must be a verified equilibrium.
TEST(ElasticShapes, StressesOfImposedStrainsAreThoseOfTheModuli) {
  constexpr double kStiffness = 1e5, kStrain = 1e-8;
  RigidEnd<2> rested = relaxed(elastic_gas<2>(30, kRoundedPentagons, kStiffness, 0.5), strict_options<2>());
  ASSERT_EQ(rested.status, RelaxationStatus::converged) << rested.reason;
  rested.packing.law = spring_law(kStiffness, 100.0);
  std::vector<double> stress;
  for (const double strain : {kStrain, -kStrain}) {
    LoadTarget<2> load = LoadTarget<2>::normal_stress(Vec<2>::Ones());
    load.side[0] = rested.packing.cell.matrix(0, 0) * std::exp(-strain);
    const RigidEnd<2> end = relaxed_under(load, rested.packing, strict_options<2>());
    ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
    EXPECT_EQ(end.packing.cell.matrix(0, 0), load.side[0]);
    State<2> state = state_at<2>(end.packing, load.stress_with(static_stress(end.packing)));
    state.target_side = load.side;
    measure(state);
    EXPECT_EQ(criteria_violated(state), "");
    stress.push_back(static_stress(end.packing)(0, 0));
  }
  ModuliOptions options;
  options.prestress = true;
  const Moduli m = elastic_moduli(rested.packing, options);
  const double modulus = m.C(0, 0) - m.C(0, 1) * m.C(0, 1) / m.C(1, 1);
  EXPECT_NEAR((stress[0] - stress[1]) / (2.0 * kStrain) / modulus, 1.0, 1e-5);
}

/// Without friction, some motions of a packing have no stiffness. Residual forces couple these motions to the volume.
/// Even then, B must have correct digits and not be smaller than its lower bound. With ModuliMethod::iterative, B without
/// prestress may be the result of an iteration that starts from the solution with prestress.
TEST(ElasticShapes, FrictionlessPackingsKeepTheirBounds) {
  for (const int n : {20, 28, 30, 33, 40, 59}) {
    const RigidEnd<2> end = relaxed(elastic_gas<2>(n, kRoundedPentagons, 1e4, 0.0));
    ASSERT_EQ(end.status, RelaxationStatus::converged) << end.reason;
    for (const ModuliMethod method :
         {ModuliMethod::factor, ModuliMethod::single_factor, ModuliMethod::iterative}) {
      SCOPED_TRACE(testing::Message() << n << " grains, method " << static_cast<int>(method));
      ModuliOptions options;
      options.method = method;
      options.prestress = true;
      const Moduli with = ModuliSequence<2>(options).next(end.packing, false);
      options.prestress = false;
      const Moduli plain = ModuliSequence<2>(options).next(end.packing, false);
      EXPECT_GE(plain.B, plain.bounds.B_reuss * (1.0 - 1e-4));
      EXPECT_LE(plain.B, plain.bounds.B_voigt);
      const double of_iteration = method == ModuliMethod::iterative ? 1e-9 * plain.B : 0.0;
      EXPECT_NEAR(*with.B_without_prestress, plain.B, of_iteration);
      EXPECT_NEAR(with.B, plain.B, 0.01 * plain.B);
      EXPECT_GT(with.G, 0.0);
    }
  }
}

}  // namespace
}  // namespace floc::test
