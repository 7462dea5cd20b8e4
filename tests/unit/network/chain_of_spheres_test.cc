#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "floc/network/contact_network.h"
#include "floc/network/rigidity_matrix.h"
#include "support/contact_laws.h"
#include "support/network_packings.h"

namespace floc {
namespace {

constexpr double kR = 0.5;
constexpr double kN = 3.0, kT = 2.0, kRolling = 0.7, kTwisting = 0.3;

/// Returns n spheres on a line along x. The cell is so large that they have no other contacts.
Packing<3> straight_chain(int n) {
  Packing<3> packing;
  packing.law = test::elastic_law(kN, kT, kRolling);
  packing.law += test::twisting_spring(1e6, kTwisting);
  packing.cell.matrix *= 4.0 * n;
  packing.grains = Grains<3>::with_size(n);
  for (int i = 0; i < n; ++i) {
    packing.grains.position[i] = Vec<3>(1.0 + 2.0 * kR * i * (1.0 - 1e-12), 1.0, 1.0);
    packing.grains.radius[i] = kR;
    packing.grains.mass[i] = 1.0;
  }
  find_contacts(packing);
  return packing;
}

/// Returns the compliance of the last sphere: its displacement and rotation under unit forces and moments. The first
/// sphere is fixed.
Eigen::Matrix<double, 6, 6> end_compliance(int n) {
  const ContactNetwork<3> network = contact_network(straight_chain(n));
  EXPECT_EQ(static_cast<int>(network.contacts.size()), n - 1);
  const Eigen::MatrixXd g = rigidity_matrix(network, StrainSet::diagonal);
  Eigen::VectorXd k(g.rows());
  for (int c = 0; c < n - 1; ++c) k.segment<6>(6 * c) = row_stiffness(network.contacts[c]);
  const Eigen::MatrixXd stiffness = g.transpose() * k.asDiagonal() * g;
  const int free = 6 * (n - 1);
  const Eigen::MatrixXd inverse = stiffness.block(6, 6, free, free).inverse();
  return inverse.bottomRightCorner<6, 6>();
}

TEST(ChainOfSpheres, TwistsBendsAndShearsAsSpringsInSeries) {
  for (const int n : {2, 3, 5, 12}) {
    const auto c = end_compliance(n);
    EXPECT_NEAR(c(0, 0), (n - 1) / kN, 1e-11 * n);
    EXPECT_NEAR(c(3, 3), (n - 1) / kTwisting, 1e-11 * n);
    for (const int axis : {4, 5}) EXPECT_NEAR(c(axis, axis), (n - 1) / kRolling, 1e-10 * n);
    // If a transverse force acts at the middle of the chain, it exerts no moment about the middle. The ends then do not
    // rotate relative to each other.
    for (const auto& [along, about, sign] : {std::tuple(1, 5, 1.0), std::tuple(2, 4, -1.0)}) {
      Eigen::Matrix<double, 6, 1> middle = Eigen::Matrix<double, 6, 1>::Zero();
      middle[along] = 1.0;
      middle[about] = -sign * (n - 1) * kR;
      const double expected = (n - 1) / kT + n * (n - 1.0) * (n - 2.0) * kR * kR / (3.0 * kRolling);
      EXPECT_NEAR(middle.dot(c * middle), expected, 1e-10 * expected);
    }
  }
}

}  // namespace
}  // namespace floc
