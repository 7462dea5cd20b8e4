#include "floc/network/free_motions.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "floc/network/rattlers.h"
#include "floc/network/stiffness_matrix.h"
#include "support/contact_laws.h"
#include "support/lattices.h"

namespace floc {
namespace {

int n_kept(const FreeMotions& free) {
  return static_cast<int>(std::count(free.kept.begin(), free.kept.end(), true));
}

TEST(FreeMotions, PinOneGrainOfANetworkThatWrapsBothWays) {
  const auto network = contact_network(test::square_frames(4, 1.0, test::elastic_law(1.0, 0.5, 0.1)));
  const FreeMotions free = find_free_motions(network);
  EXPECT_EQ(free.n_components, 1);
  EXPECT_EQ(free.n_free_rotations, 0);
  EXPECT_EQ(n_kept(free), network.n_unknowns() - 2);
}

TEST(FreeMotions, LoneTriangleAlsoTurns) {
  Packing<2> packing;
  packing.law = test::elastic_law(1.0, 0.5, 0.1);
  packing.cell.matrix *= 10.0;
  for (const double kt : {0.5, 0.0}) {
    packing = test::disks(10.0 * Mat<2>::Identity(), {{1, 1}, {2, 1}, {1.5, 1.0 + std::sqrt(0.75)}}, 1.0,
                          test::elastic_law(1.0, kt, 0.0));
    const FreeMotions free = find_free_motions(contact_network(packing));
    EXPECT_EQ(free.n_components, 1);
    EXPECT_EQ(free.n_free_rotations, 1);
    EXPECT_EQ(free.n_free_spins, kt > 0.0 ? 0 : 3);
    EXPECT_EQ(n_kept(free), 9 - 3 - free.n_free_spins);
  }
}

TEST(FreeMotions, FrictionlessGrainsWithRollingStiffnessSpinTogether) {
  auto network = contact_network(test::square_frames(4, 1.0, test::elastic_law(1.0, 0.0, 0.0)));
  EXPECT_EQ(find_free_motions(network).n_free_spins, network.n_grains);
  set_rolling_stiffness(network, 0.1);
  const FreeMotions free = find_free_motions(network);
  EXPECT_EQ(free.n_free_spins, 1);
  EXPECT_EQ(n_kept(free), network.n_unknowns() - 3);
}

TEST(FreeMotions, ColumnOfSpheresKeepsItsTurnAboutItsOwnAxis) {
  Packing<3> packing;
  packing.law = test::elastic_law(1.0, 0.5, 0.1);
  packing.cell.matrix = Vec<3>(4.0, 4.0, 3.0).asDiagonal();
  packing.grains = Grains<3>::with_size(3);
  for (int k = 0; k < 3; ++k) packing.grains.position[k] = Vec<3>(1.0, 1.0, k);
  packing.grains.radius.assign(3, 0.51);
  find_contacts(packing);
  const FreeMotions free = find_free_motions(contact_network(packing));
  EXPECT_EQ(free.n_free_rotations, 1);
  EXPECT_EQ(n_kept(free), 18 - 4);
}

TEST(FreeMotions, BranchesAndTreesAreDeadEnds) {
  // A chain across the cell with a side branch of two disks, a separate pair and a single disk.
  Packing<2> packing = test::chain_across(6, 1.0, 8.0, test::elastic_law(1.0, 0.5, 0.0));
  for (const Vec<2>& x : {Vec<2>(2, 1), Vec<2>(2, 2), Vec<2>(4, 4), Vec<2>(4, 5), Vec<2>(1, 5)}) {
    packing.grains.position.push_back(x);
    packing.grains.radius.push_back(0.51);
  }
  packing.grains.mass.resize(packing.grains.radius.size(), 1.0);
  find_contacts(packing);
  const FreeMotions free = find_free_motions(contact_network(packing));
  EXPECT_EQ(std::count(free.dead_end.begin(), free.dead_end.end(), true), 3);
  EXPECT_EQ(free.n_alone, 2);  // the single disk, and one disk of the pair
  EXPECT_EQ(free.n_free_rollers, 3);
  EXPECT_EQ(free.n_components, 1);
  EXPECT_EQ(n_kept(free), 6 * 3 - 2);
}

/// Checks that the free motions of a network are independent and need no energy. Returns their number.
template <int Dim>
int expect_modes_of_no_energy(const ContactNetwork<Dim>& network) {
  const FreeMotions free = find_free_motions(network);
  const StiffnessMatrix k = stiffness_matrix(network, {});
  const int n = network.n_unknowns();
  const Eigen::MatrixXd grains = Eigen::MatrixXd(k.whole()).topLeftCorner(n, n);
  // Sums of a few terms of order one have rounding errors. Displacements in long dead ends are about 10 times larger,
  // and so are their errors.
  if (free.modes.cols() > 0) {
    EXPECT_LT((grains * free.modes).cwiseAbs().maxCoeff(), 1e-12);
  }
  const Eigen::MatrixXd modes(free.modes);
  EXPECT_EQ(modes.cols() == 0 ? 0 : modes.colPivHouseholderQr().rank(), modes.cols());
  EXPECT_EQ(free.kind.size(), static_cast<std::size_t>(modes.cols()));
  return static_cast<int>(modes.cols());
}

template <int Dim>
int dense_nullity(const ContactNetwork<Dim>& network) {
  const Eigen::MatrixXd g = scaled_rigidity_matrix(network, StrainSet::diagonal);
  if (g.rows() == 0) return network.n_unknowns();
  const Eigen::VectorXd s =
      Eigen::JacobiSVD<Eigen::MatrixXd>(g.leftCols(network.n_unknowns())).singularValues();
  return network.n_unknowns() - static_cast<int>((s.array() > 1e-9).count());
}

TEST(FreeMotions, AreTheWholeNullSpaceWhereEveryContactIsRigid) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto law = test::elastic_law(1.0, 0.6, 0.1);
    for (const double density : {0.4, 0.9, 1.5}) {
      const auto disks = contact_network(test::random_packing<2>(20, seed, law, density));
      EXPECT_EQ(expect_modes_of_no_energy(disks), dense_nullity(disks)) << "seed " << seed;
      auto spheres = contact_network(test::random_packing<3>(12, seed, law, density));
      for (NetworkContact<3>& c : spheres.contacts) c.ktw = c.kr;
      EXPECT_EQ(expect_modes_of_no_energy(spheres), dense_nullity(spheres)) << "seed " << seed;
    }
  }
}

TEST(FreeMotions, LeaveOnlyMechanismsOutWithFewerStiffnesses) {
  int n_equal = 0;
  for (unsigned seed = 0; seed < 30; ++seed)
    for (const auto& law :
         {test::elastic_law(1.0, 0.6, 0.0), test::elastic_law(1.0, 0.0, 0.1), test::elastic_law(1.0, 0.0, 0.0)})
      for (const double density : {0.5, 1.2, 2.5}) {
        const auto disks = contact_network(test::random_packing<2>(20, seed, law, density));
        auto spheres = contact_network(test::random_packing<3>(12, seed, law, density));
        for (NetworkContact<3>& c : spheres.contacts) c.ktw = c.kr;
        const int in_2d = expect_modes_of_no_energy(disks);
        const int in_3d = expect_modes_of_no_energy(spheres);
        EXPECT_LE(in_2d, dense_nullity(disks)) << "seed " << seed;
        EXPECT_LE(in_3d, dense_nullity(spheres)) << "seed " << seed;
        n_equal += (in_2d == dense_nullity(disks)) + (in_3d == dense_nullity(spheres));
      }
  EXPECT_GT(n_equal, 200);  // of 540 networks
}

TEST(FreeMotions, SphereBetweenTwoContactsSpinsAboutTheLineThroughThem) {
  // A zigzag column of two spheres across the periodic cell.
  Packing<3> packing;
  packing.law = test::elastic_law(1.0, 0.5, 0.0);
  packing.cell.matrix = Vec<3>(4.0, 4.0, 2.0 * std::sqrt(0.75)).asDiagonal();
  packing.grains = Grains<3>::with_size(2);
  packing.grains.position = {Vec<3>(1.0, 1.0, 0.0), Vec<3>(1.5, 1.0, std::sqrt(0.75))};
  packing.grains.radius.assign(2, 0.51);
  find_contacts(packing);
  const auto zigzag = contact_network(packing);
  const FreeMotions free = find_free_motions(zigzag);
  EXPECT_EQ(free.count(FreeMotionKind::spin), 2);
  EXPECT_EQ(free.count(FreeMotionKind::translation), 3);
  expect_modes_of_no_energy(zigzag);
  // In a straight column, each sphere can spin about the axis. The rotation of the whole column about its axis is the
  // sum of these spins.
  packing.grains.position[1] = Vec<3>(1.0, 1.0, 1.0);
  packing.cell.matrix(2, 2) = 2.0;
  find_contacts(packing);
  const auto straight = contact_network(packing);
  EXPECT_EQ(find_free_motions(straight).n_free_rotations, 0);
  EXPECT_EQ(expect_modes_of_no_energy(straight), 5);
}

TEST(Rattlers, OfACohesivePackingAreAlone) {
  Packing<2> packing = test::chain_across(4, 1.0, 4.0, test::elastic_law(1.0, 0.5, 0.0));
  packing.law += test::tail_adhesion(0.02, 0.1);  // F_N = 0 at the overlap of 0.02
  packing.grains.position.emplace_back(1.0, 2.0);
  packing.grains.radius.push_back(0.51);
  packing.grains.mass.push_back(1.0);
  find_contacts(packing);
  const std::vector<bool> rattlers = find_rattlers(packing, 1e-3);
  EXPECT_EQ(rattlers, (std::vector<bool>{false, false, false, false, true}));
}

TEST(Rattlers, OfACohesionlessPackingCarryNothingOrHangOnOneContact) {
  Packing<2> packing = test::chain_across(4, 1.0, 4.0, test::elastic_law(1.0, 0.5, 0.0));
  // Three disks are added to the chain. The first touches two disks of the chain, with almost no force. The second
  // touches only the first added disk. The third touches the chain at one contact with a force.
  const double lean = std::sqrt(1.02 * 1.02 - 0.25) - 1e-9;
  for (const Vec<2>& x : {Vec<2>(0.5, lean), Vec<2>(0.5, lean + 1.0), Vec<2>(3.0, -1.0)}) {
    packing.grains.position.push_back(x);
    packing.grains.radius.push_back(0.51);
  }
  packing.grains.mass.resize(7, 1.0);
  find_contacts(packing);
  const std::vector<bool> rattlers = find_rattlers(packing, 1e-4);
  EXPECT_EQ(rattlers, (std::vector<bool>{false, false, false, false, true, true, true}));
}

TEST(Rattlers, UnstressedPackingDoesNotTell) {
  Packing<2> packing = test::chain_across(4, 1.0, 4.0, test::elastic_law(1.0, 0.5, 0.0));
  for (Contact<2>& c : packing.contacts) c.normal_force = 0.0;
  EXPECT_EQ(find_rattlers(packing, 0.0), std::vector<bool>(4, false));
}

}  // namespace
}  // namespace floc
