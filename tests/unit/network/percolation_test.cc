#include "floc/network/percolation.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "floc/base/error.h"
#include "support/lattices.h"

namespace floc {
namespace {

int count(const std::vector<bool>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), true));
}

void add_grains(Packing<2>& packing, const std::vector<Vec<2>>& places) {
  for (const Vec<2>& x : places) {
    packing.grains.position.push_back(x);
    packing.grains.radius.push_back(0.51);
  }
  packing.grains.mass.resize(packing.grains.radius.size(), 1.0);
  find_contacts(packing);
}

TEST(Percolation, OfALatticeIsWhole) {
  const auto network = contact_network(test::square_frames(4, 1.0, test::elastic_law(1.0, 0.5, 0.1)));
  const Percolation p = find_percolation(network);
  EXPECT_EQ(p.n_directions, 2);
  EXPECT_EQ(count(p.scalar_backbone), static_cast<int>(network.contacts.size()));
  EXPECT_EQ(count(p.dead_end), 0);
}

/// Returns a ring of n contacts. Each contact crosses `cells` cells along x.
ContactNetwork<2> ring_around_cells(int n, int cells) {
  ContactNetwork<2> network =
      contact_network(test::chain_across(n, 1.0, 9.0, test::elastic_law(1.0, 0.5, 0.1)));
  for (NetworkContact<2>& c : network.contacts) c.image = {cells, 0};
  return network;
}

/// Each of the eight contacts crosses 2^29 cells, so together they cross 2^32 cells. This number would overflow to 0 in
/// an int.
TEST(Percolation, AddsUpImagesThatAnIntDoesNotHold) {
  const ContactNetwork<2> network = ring_around_cells(8, 1 << 29);
  const Percolation p = find_percolation(network);
  EXPECT_EQ(p.n_directions, 1);
  EXPECT_EQ(count(p.scalar_backbone), 8);
}

TEST(Percolation, RefusesWaysAroundThatNoContactsTake) {
  ContactNetwork<2> network = ring_around_cells(5000, 1 << 29);
  network.contacts.push_back(network.contacts.front());
  network.contacts.back().image = {0, 1};
  try {
    (void)find_percolation(network);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "contacts/image: a chain of contacts passes through more than 2^40 cells before it returns "
                 "to the same grain: the periodic image of at least one contact is wrong");
  }
}

TEST(Percolation, LeavesOutWhatHangsOnOneGrain) {
  // A chain of 8 disks across the cell. Disks 1 and 3 have a side branch of two disks each, and a detour of
  // three disks connects disks 5 and 7.
  Packing<2> packing = test::chain_across(8, 1.0, 9.0, test::elastic_law(1.0, 0.5, 0.0));
  add_grains(packing, {{1.0 - 0.5, std::sqrt(0.75)}, {1.0 + 0.5, 1.0 + 0.8}, {3, -1}, {3, -2}});
  packing.grains.position[9] = {0.5, 1.0 + std::sqrt(0.75)};
  add_grains(packing, {{5, 1}, {6, 1}, {7, 1}});
  const auto network = contact_network(packing);
  const Percolation p = find_percolation(network);
  EXPECT_EQ(p.n_directions, 1);
  for (std::size_t c = 0; c < network.contacts.size(); ++c) {
    const int i = network.contacts[c].i, j = network.contacts[c].j;
    const bool hangs = std::max(i, j) >= 10 && std::max(i, j) <= 11;
    EXPECT_EQ(p.dead_end[c], hangs || std::max(i, j) == 9) << i << ' ' << j;
    EXPECT_NE(p.dead_end[c], p.scalar_backbone[c]) << i << ' ' << j;
  }
}

TEST(Percolation, ContactBetweenTwoWindingChainsConductsNothingAndIsNoDeadEnd) {
  Packing<2> packing = test::chain_across(5, 1.0, 9.0, test::elastic_law(1.0, 0.5, 0.1));
  add_grains(packing, {{0, 2}, {1, 2}, {2, 2}, {3, 2}, {4, 2}, {2, 1}});
  const Percolation p = find_percolation(contact_network(packing));
  EXPECT_EQ(p.n_directions, 1);
  EXPECT_EQ(count(p.scalar_backbone), 10);
  EXPECT_EQ(count(p.dead_end), 0);
}

TEST(Percolation, OfGrainsInAClusterIsNone) {
  const auto triangle = test::disks(9.0 * Mat<2>::Identity(), {{1, 1}, {2, 1}, {1.5, 1.0 + std::sqrt(0.75)}},
                                    1.0, test::elastic_law(1.0, 0.5, 0.0));
  const Percolation p = find_percolation(contact_network(triangle));
  EXPECT_EQ(p.n_directions, 0);
  EXPECT_EQ(count(p.scalar_backbone), 0);
  EXPECT_EQ(count(p.dead_end), 3);
}

/// Returns the currents in a network of random conductances under random gradients along the lattice vectors. The
/// equations are solved with a dense matrix.
template <int Dim>
Eigen::VectorXd currents(const ContactNetwork<Dim>& network, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(0.3, 1.0);
  const int n = static_cast<int>(network.contacts.size());
  Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(n, network.n_grains);
  Eigen::VectorXd drive(n), conductance(n);
  const Vec<Dim> gradient = Vec<Dim>::NullaryExpr([&] { return uniform(engine); });
  for (int c = 0; c < n; ++c) {
    difference(c, network.contacts[c].i) -= 1.0;
    difference(c, network.contacts[c].j) += 1.0;
    drive[c] = gradient.dot(network.contacts[c].image.template cast<double>());
    conductance[c] = uniform(engine);
  }
  const Eigen::MatrixXd laplace = difference.transpose() * conductance.asDiagonal() * difference;
  const Eigen::VectorXd load = difference.transpose() * conductance.cwiseProduct(drive);
  const Eigen::VectorXd potential = laplace.completeOrthogonalDecomposition().solve(load);
  return conductance.cwiseProduct(drive - difference * potential);
}

template <int Dim>
int expect_backbone_conducts(int n_grains, double density, unsigned seed) {
  const auto network =
      contact_network(test::random_packing<Dim>(n_grains, seed, test::elastic_law(1.0, 0.5, 0.0), density));
  const Percolation p = find_percolation(network);
  if (network.contacts.empty()) return 0;
  const Eigen::VectorXd current = currents(network, seed);
  for (int c = 0; c < current.size(); ++c) {
    // In networks this small, real currents are at least about 1e-7; rounding errors are about 1e-15.
    EXPECT_EQ(p.scalar_backbone[c], std::abs(current[c]) > 1e-11) << "seed " << seed << " contact " << c;
    EXPECT_FALSE(p.scalar_backbone[c] && p.dead_end[c]);
  }
  EXPECT_EQ(p.n_directions > 0, count(p.scalar_backbone) > 0);
  const int n_carrying = count(p.scalar_backbone);
  return n_carrying > 0 && n_carrying < current.size() ? 1 : 0;
}

TEST(Percolation, ScalarBackboneIsWhatConducts) {
  int n_mixed = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    for (const double density : {0.8, 1.0, 1.3}) n_mixed += expect_backbone_conducts<2>(30, density, seed);
    for (const double density : {0.6, 0.8}) n_mixed += expect_backbone_conducts<3>(20, density, seed);
  }
  EXPECT_GT(n_mixed, 100);
}

}  // namespace
}  // namespace floc
