#include "floc/elasticity/force_increments.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "floc/elasticity/backbone.h"
#include "floc/elasticity/force_correlation.h"
#include "floc/network/percolation.h"
#include "support/lattices.h"

namespace floc {
namespace {

template <int Dim>
void expect_work_and_balance(const ContactNetwork<Dim>& network, StressStep step) {
  const ElasticResponse response = elastic_response(network, {});
  const auto found = step_response(network, response, step);
  if (!found) return;
  Eigen::VectorXd stress = Eigen::VectorXd::Ones(Dim);
  if (step == StressStep::deviatoric) stress.tail(Dim - 1).setConstant(-1.0 / (Dim - 1));
  EXPECT_LT((response.relaxed * found->strain / network.volume - stress).norm(), 1e-11);
  // By Clapeyron's theorem the energy is half the work. Errors of 1e-12, divided by the smallest moduli of about 1e-3,
  // become errors of 1e-9.
  const double energy = std::accumulate(found->energy.begin(), found->energy.end(), 0.0);
  EXPECT_NEAR(energy / (0.5 * network.volume * found->strain.dot(stress)), 1.0, 1e-9);
  EXPECT_GT(found->n_holding, 0);
  double held = 0.0, before = 0.0;
  for (std::size_t c = 0; c < found->energy.size(); ++c) {
    if (found->rank[c] < found->n_holding) held += found->energy[c];
    if (found->rank[c] < found->n_holding - 1) before += found->energy[c];
  }
  EXPECT_GE(held, 0.95 * energy);
  EXPECT_LT(before, 0.95 * energy);
}

TEST(StepResponse, DoesTheWorkOfTheStress) {
  for (unsigned seed = 0; seed < 20; ++seed)
    for (const StressStep step : {StressStep::isotropic, StressStep::deviatoric}) {
      const auto law = test::elastic_law(1.0, 0.6, 0.1);
      expect_work_and_balance(contact_network(test::random_packing<2>(30, seed, law, 1.8)), step);
      expect_work_and_balance(contact_network(test::random_packing<3>(15, seed, law, 2.0)), step);
    }
}

TEST(StepResponse, OfASquareLatticeLoadsBothContactsAlike) {
  const auto network = contact_network(test::square_frames(2, 1.0, test::elastic_law(2.0, 0.6, 0.1)));
  const auto pressed = step_response(network, elastic_response(network, {}), StressStep::isotropic);
  ASSERT_TRUE(pressed);
  for (int c = 0; c < 2; ++c) {
    EXPECT_NEAR(pressed->increments[c].normal, 1.0, 1e-14);  // unit stress on a unit length
    EXPECT_NEAR(pressed->energy[c], 0.25, 1e-14);            // a unit force stores the energy 1/(2 K_N)
  }
  EXPECT_EQ(pressed->energy_share_95, 1.0);
  const auto sheared = step_response(network, elastic_response(network, {}), StressStep::deviatoric);
  EXPECT_NEAR(sheared->increments[0].normal, -sheared->increments[1].normal, 1e-14);
}

TEST(StepResponse, IsRefusedWhereTheStressWorksOnAFreeStrain) {
  const auto chain = contact_network(test::chain_across(4, 1.0, 3.0, test::elastic_law(1.0, 0.5, 0.1)));
  const ElasticResponse response = elastic_response(chain, {});
  EXPECT_FALSE(step_response(chain, response, StressStep::isotropic));
  EXPECT_FALSE(step_response(chain, response, StressStep::deviatoric));
  Packing<2> brace = test::triangular(1.0, test::elastic_law(1.0, 0.0, 0.0));
  brace.cell.matrix << 1.0, 1.0, -2.0, 2.0;
  brace.cell.matrix *= std::sqrt(0.5);
  find_contacts(brace);
  // There is only one contact, along (1, 1): it resists compression but not shear.
  const auto network = contact_network(brace);
  EXPECT_TRUE(step_response(network, elastic_response(network, {}), StressStep::isotropic));
  EXPECT_FALSE(step_response(network, elastic_response(network, {}), StressStep::deviatoric));
}

TEST(MechanicalBackbone, LeavesOutDeadEndsAndNothingElseWhereEveryContactIsRigid) {
  int n_dead = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const auto network =
        contact_network(test::random_packing<2>(40, seed, test::elastic_law(1.0, 0.6, 0.1), 1.1));
    const auto step = step_response(network, elastic_response(network, {}), StressStep::isotropic);
    if (!step) continue;
    const std::vector<bool> carries = mechanical_backbone(network, *step);
    const Percolation p = find_percolation(network);
    for (std::size_t c = 0; c < carries.size(); ++c) {
      EXPECT_EQ(carries[c], !p.dead_end[c]) << "seed " << seed << " contact " << c;
      n_dead += p.dead_end[c] ? 1 : 0;
    }
  }
  EXPECT_GT(n_dead, 30);
}

TEST(ForceCorrelation, OfForcesInProportionIsOne) {
  auto network = contact_network(test::random_packing<2>(40, 3, test::elastic_law(1.0, 0.6, 0.1)));
  const auto step = step_response(network, elastic_response(network, {}), StressStep::isotropic);
  ASSERT_TRUE(step);
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    network.contacts[c].normal_force = 3.0 * step->increments[c].normal;
    network.contacts[c].shear_force = 3.0 * network.contacts[c].frame.col(1) * step->increments[c].shear;
  }
  const ForceCorrelation same = force_correlation(network, step->increments);
  EXPECT_NEAR(*same.normal, 1.0, 1e-12);
  EXPECT_NEAR(*same.size, 1.0, 1e-12);
  for (auto& c : network.contacts) c.normal_force = 5.0 - c.normal_force;
  EXPECT_NEAR(*force_correlation(network, step->increments).normal, -1.0, 1e-12);
  // The correlation omits contacts at a distance. If all forces are equal, the correlation is not defined.
  network.contacts[0].distant = true;
  network.contacts[0].normal_force = 1e6;
  EXPECT_NEAR(*force_correlation(network, step->increments).normal, -1.0, 1e-12);
  for (auto& c : network.contacts) c.normal_force = 0.1;
  EXPECT_FALSE(force_correlation(network, step->increments).normal);
}

}  // namespace
}  // namespace floc
