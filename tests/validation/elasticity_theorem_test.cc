#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "floc/elasticity/bounds.h"
#include "floc/elasticity/force_increments.h"
#include "floc/elasticity/isotropic_moduli.h"
#include "support/network_packings.h"

namespace floc {
namespace {

template <int Dim>
void randomise_stiffness(ContactNetwork<Dim>& network, std::mt19937& engine) {
  std::uniform_real_distribution<double> uniform(0.1, 2.0);
  for (NetworkContact<Dim>& c : network.contacts) {
    c.kn = uniform(engine);
    c.kt = uniform(engine);
    c.kr = 0.1 * uniform(engine);
  }
}

/// Density at which most networks span the cell in every direction.
constexpr double kGrainsPerVolume = 2.5;

template <int Dim>
ContactNetwork<Dim> random_network(int n_grains, unsigned seed) {
  return contact_network(
      test::random_packing<Dim>(n_grains, seed, test::elastic_law(1.0, 0.5, 0.1), kGrainsPerVolume));
}

bool carries_any_stress(const Eigen::MatrixXd& C) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(C).eigenvalues()[0] > 1e-6;
}

/// Sets the forces of a network to the response of another network, with the same contacts, to a unit isotropic stress.
template <int Dim>
void take_forces(ContactNetwork<Dim>& network, const ContactNetwork<Dim>& from) {
  const ElasticResponse response = elastic_response(from, {});
  const Eigen::MatrixXd C = response.relaxed / from.volume;
  const auto forces = force_increments<Dim>(from, response, C.inverse() * Eigen::VectorXd::Ones(Dim));
  for (int c = 0; c < static_cast<int>(forces.size()); ++c) {
    NetworkContact<Dim>& contact = network.contacts[c];
    contact.normal_force = forces[c].normal;
    contact.shear_force = contact.frame.template rightCols<Dim - 1>() * forces[c].shear;
    contact.rolling_moment = forces[c].rolling_moment;
  }
}

/// Tests the order of the bounds of a network. Returns whether the network could be tested: it cannot be under an
/// isotropic stress if it does not span the cell.
template <int Dim>
bool expect_bounds_in_order(int n_grains, unsigned seed) {
  std::mt19937 engine(seed);
  ContactNetwork<Dim> network = random_network<Dim>(n_grains, seed);
  randomise_stiffness(network, engine);
  const Eigen::MatrixXd C = elastic_response(network, {}).relaxed / network.volume;
  if (!carries_any_stress(C)) return false;
  // The forces are the response of a network with other stiffnesses. They balance, but differ from the response of this
  // network.
  ContactNetwork<Dim> foreign = network;
  randomise_stiffness(foreign, engine);
  take_forces(network, foreign);
  const Bounds bounds = elastic_bounds(network, 1.0, {6.0, 0.8});
  const double B_C = bulk_modulus(C);
  const double B_S = 1.0 / C.inverse().sum();
  // The bounds may equal the moduli, so rounding errors must be allowed for.
  const double slack = 1e-12 * bounds.B_voigt;
  EXPECT_GT(bounds.B_reuss, 0.0);
  EXPECT_LE(bounds.B_reuss, B_S + slack) << "seed " << seed;
  EXPECT_LE(B_S, B_C + slack) << "seed " << seed;
  EXPECT_LE(B_C, bounds.B_voigt + slack) << "seed " << seed;
  EXPECT_LE(pure_shear_modulus(C), bounds.G_voigt + slack) << "seed " << seed;
  return true;
}

TEST(Bounds, AreInOrderOn1000RandomNetworks) {
  int n_tested = 0;
  for (unsigned seed = 0; n_tested < 700; ++seed)
    n_tested += expect_bounds_in_order<2>(10 + static_cast<int>(seed) % 30, seed) ? 1 : 0;
  for (unsigned seed = 0; n_tested < 1000; ++seed)
    n_tested += expect_bounds_in_order<3>(10 + static_cast<int>(seed) % 20, seed) ? 1 : 0;
}

TEST(Bounds, ReussIsExactForTheNetworksOwnResponse) {
  ContactNetwork<2> network = random_network<2>(30, 7);
  const Eigen::MatrixXd C = elastic_response(network, {}).relaxed / network.volume;
  ASSERT_TRUE(carries_any_stress(C));
  take_forces(network, ContactNetwork<2>(network));
  // The complementary energy of the response equals the work of the stress. Rounding errors are multiplied by a
  // condition number of about 1e3.
  EXPECT_NEAR(elastic_bounds(network, 1.0, {6.0, 0.8}).B_reuss * C.inverse().sum(), 1.0, 1e-11);
}

}  // namespace
}  // namespace floc
