#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "floc/elasticity/indeterminacy.h"
#include "support/rigid_states.h"

namespace floc::test {
namespace {

/// Computes the degree of indeterminacy from its definition: the number of force components minus the rank of a matrix.
/// The matrix maps force components to the net forces and moments of the grains and to the stresses along the axes.
/// @param tangential  whether tangential forces are included
template <int Dim>
int counted(const Packing<Dim>& packing, bool tangential) {
  const ContactNetwork<Dim> network = contact_network(packing);
  const int n_each = tangential ? Dim : 1, n = n_each * static_cast<int>(network.contacts.size());
  Eigen::MatrixXd balance = Eigen::MatrixXd::Zero(kDofs<Dim> * network.n_grains + Dim, n);
  int column = 0;
  for (const NetworkContact<Dim>& c : network.contacts)
    for (int k = 0; k < n_each; ++k, ++column) {
      const Vec<Dim> force = c.frame.col(k);
      const auto act = [&](int grain, const Vec<Dim>& on, const Vec<Dim>& arm) {
        const int row = kDofs<Dim> * grain;
        for (int a = 0; a < Dim; ++a) balance(row + a, column) += on[a];
        if constexpr (Dim == 2) {
          balance(row + 2, column) += arm[0] * on[1] - arm[1] * on[0];
        } else {
          const Vec<3> moment = arm.cross(on);
          for (int a = 0; a < 3; ++a) balance(row + 3 + a, column) += moment[a];
        }
      };
      act(c.j, force, c.arm_j);
      act(c.i, -force, c.arm_i);
      for (int a = 0; a < Dim; ++a) balance(kDofs<Dim> * network.n_grains + a, column) = force[a] * c.branch[a];
    }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(balance);
  factor.setThreshold(1e-10);
  return n - static_cast<int>(factor.rank());
}

TEST(RigidIndeterminacy, IsTheNumberOfComponentsMinusTheRankOfTheBalance) {
  for (const double friction : {0.0, 0.3}) {
    const State<2> disks = triangular_crystal(0.7, friction), bricks = brick_bond(0.7, friction);
    const State<3> spheres = cubic_crystal(0.7, friction);
    EXPECT_EQ(rigid_indeterminacy(disks.packing, 0.0).degree, counted(disks.packing, friction > 0.0));
    EXPECT_EQ(rigid_indeterminacy(bricks.packing, 0.0).degree, counted(bricks.packing, friction > 0.0));
    EXPECT_EQ(rigid_indeterminacy(spheres.packing, 0.0).degree, counted(spheres.packing, friction > 0.0));
  }
}

/// The crystal has 27 lines of three spheres. The forces of a line are equal, so there are 27 independent forces. The
/// three given stresses along the axes are three equations for these forces.
TEST(RigidIndeterminacy, OfACubicCrystalWithoutFrictionIsThatOfItsLines) {
  EXPECT_EQ(rigid_indeterminacy(cubic_crystal(0.7, 0.0).packing, 0.0).degree, 27 - 3);
}

TEST(RigidIndeterminacy, CountsOneComponentOfAContactThatSlides) {
  State<2> state = triangular_crystal(0.7, 0.3);
  for (Contact<2>& c : state.packing.contacts) c.sliding = true;
  EXPECT_EQ(rigid_indeterminacy(state.packing, 0.0).degree, counted(state.packing, false));
}

TEST(RigidIndeterminacy, LeavesOutContactsThatCarryNothing) {
  State<2> state = brick_bond(0.7, 0.3), fewer = state;
  const Contact<2> idle = state.packing.contacts.front();
  state.packing.contacts.front().normal_force = state.packing.contacts.front().elastic_force = 0.0;
  std::erase_if(fewer.packing.contacts, [&](const Contact<2>& c) {
    return c.i == idle.i && c.j == idle.j && c.key == idle.key && c.image == idle.image;
  });
  EXPECT_EQ(rigid_indeterminacy(state.packing, 0.0).degree, counted(fewer.packing, true));
}

}  // namespace
}  // namespace floc::test
