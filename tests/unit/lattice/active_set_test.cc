#include <gtest/gtest.h>

#include <cmath>

#include "floc/lattice/node_stress.h"
#include "floc/lattice/spring_rows.h"
#include "support/lattice_samples.h"

namespace floc {
namespace {

using test::exactly;
using test::sample_of;

/// Returns a sample of four grains side by side. Some nodes, chosen at random, are void or matrix instead of grain.
CementedSample<2> random_sample(RandomStream& random, int columns, int rows) {
  const Lattice<2> lattice = triangular_lattice(columns, rows, 1.0);
  std::vector<Vec<2>> centres;
  for (int g = 0; g < 4; ++g)
    centres.push_back(lattice.cell.matrix.transpose() * Vec<2>(random.uniform(), random.uniform()));
  const double holes = random.uniform(0.0, 0.2), drops = random.uniform(0.0, 0.3);
  return sample_of<2>(lattice, [&](const Vec<2>& x) {
    const double lot = random.uniform();
    if (lot < holes) return -2;
    if (lot < holes + drops) return -1;
    int nearest = 0;
    for (int g = 1; g < 4; ++g)
      if ((x - centres[g]).norm() < (x - centres[nearest]).norm()) nearest = g;
    return nearest;
  });
}

ElementStiffness random_stiffness(RandomStream& random) {
  ElementStiffness stiffness;
  stiffness.grain = std::pow(10.0, random.uniform(0.0, 2.0));
  return stiffness;
}

/// Minimises the energy under an imposed strain: moves one unknown at a time to its best value, until no move lowers
/// the energy. This method is slow and independent of the solver.
/// @return force of each row of `springs`
std::vector<double> brute_force(const SpringRows<2, 2>& springs, const Eigen::Vector3d& strain) {
  using Row = SpringRows<2, 2>::Row;
  Eigen::VectorXd u = Eigen::VectorXd::Zero(springs.n_unknowns());
  std::vector<bool> one_sided(springs.rows.size(), false);
  for (const int r : springs.one_sided) one_sided[r] = true;
  std::vector<std::vector<std::pair<int, double>>> rows_of(u.size());
  for (std::size_t r = 0; r < springs.rows.size(); ++r) {
    const Row& row = springs.rows[r];
    for (int a = 0; a < 2; ++a) {
      if (row.on_i[a] != 0.0) rows_of[2 * row.i + a].emplace_back(r, row.on_i[a]);
      if (row.j != row.i && row.on_j[a] != 0.0) rows_of[2 * row.j + a].emplace_back(r, row.on_j[a]);
    }
  }
  std::vector<double> overlap(springs.rows.size());
  for (std::size_t r = 0; r < overlap.size(); ++r) overlap[r] = springs.on_strain[r].dot(strain);
  constexpr int kMostSweeps = 100000;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    double worst = 0.0;
    for (Eigen::Index a = 0; a < u.size(); ++a) {
      double slope = 0.0, curvature = 0.0;
      for (const auto& [r, g] : rows_of[a]) {
        if (one_sided[r] && overlap[r] <= 0.0) continue;
        slope += springs.rows[r].stiffness * overlap[r] * g;
        curvature += springs.rows[r].stiffness * g * g;
      }
      worst = std::max(worst, std::abs(slope));
      if (curvature == 0.0) continue;
      for (const auto& [r, g] : rows_of[a]) overlap[r] -= slope / curvature * g;
    }
    if (worst < 1e-13) break;
  }
  std::vector<double> force;
  for (std::size_t r = 0; r < overlap.size(); ++r)
    force.push_back(one_sided[r] && overlap[r] <= 0.0 ? 0.0 : springs.rows[r].stiffness * overlap[r]);
  return force;
}

TEST(ActiveSet, EqualsABruteForceMinimiserOnSmallRandomCases) {
  RandomStream random(7, 0);
  int n_open = 0, n_closed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const CementedSample<2> sample = random_sample(random, 4, 4);
    const ElementStiffness stiffness = random_stiffness(random);
    const LatticeNetwork<2> network = lattice_network(sample, stiffness);
    LatticeLoad<2> load;
    load.imposed.setConstant(true);
    for (int a = 0; a < 3; ++a) load.value[a] = random.uniform(-1.0, 1.0);
    LatticeSolver<2> solver(network, exactly());
    const LatticeSolution<2> solution = solver.solve(load);
    ASSERT_TRUE(solution.report.converged) << trial;
    const std::vector<double> expected = brute_force(spring_rows<2, 2>(network), load.value);
    const double scale = stiffness.grain * load.value.norm();
    for (std::size_t e = 0; e < expected.size(); ++e) {
      EXPECT_NEAR(solution.normal_force[e], expected[e], 1e-10 * scale) << trial << " " << e;
      if (network.elements[e].unilateral) ++(solution.open[e] ? n_open : n_closed);
    }
  }
  EXPECT_GT(n_open, 1000);  // enough contacts open to make the test meaningful
  EXPECT_GT(n_closed, 1000);
}

TEST(ActiveSet, NeverCycles) {
  RandomStream random(11, 0);
  int n_held = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const CementedSample<2> sample = random_sample(random, 6, 6);
    const LatticeNetwork<2> network = lattice_network(sample, random_stiffness(random));
    LatticeSolver<2> solver(network, {});
    const LatticeSolution<2> s = solver.solve(LatticeLoad<2>::uniaxial(1, trial % 2 == 0 ? 1.0 : -1.0));
    EXPECT_TRUE(s.report.converged || !s.report.holds) << trial;
    EXPECT_LT(s.report.n_rounds, 60) << trial;
    if (!s.report.converged) continue;
    ++n_held;
    for (std::size_t e = 0; e < network.elements.size(); ++e)
      if (network.elements[e].unilateral) {
        EXPECT_GE(s.normal_force[e], 0.0);
      }
    EXPECT_NEAR(std::abs(s.stress[1]), 1.0, 1e-8) << trial;
    EXPECT_NEAR(s.stress[0], 0.0, 1e-8) << trial;
  }
  EXPECT_GT(n_held, 300);
}

/// If contacts are bilateral, the response to tension is minus the response to compression. If contacts are unilateral,
/// it is not.
TEST(ActiveSet, TensionIsMinusCompressionOnlyWhereAllIsBilateral) {
  RandomStream random(5, 0);
  CementedSample<2> sample = random_sample(random, 12, 12);
  for (const BareContact contact : {BareContact::bilateral, BareContact::unilateral}) {
    ElementStiffness stiffness;
    stiffness.contact = contact;
    const LatticeNetwork<2> network = lattice_network(sample, stiffness);
    LatticeSolver<2> pressed(network, exactly()), pulled(network, exactly());
    const LatticeSolution<2> c = pressed.solve(LatticeLoad<2>::uniaxial(1, 1.0));
    const LatticeSolution<2> t = pulled.solve(LatticeLoad<2>::uniaxial(1, -1.0));
    ASSERT_TRUE(c.report.converged && t.report.converged);
    double difference = 0.0;
    for (std::size_t e = 0; e < network.elements.size(); ++e)
      difference = std::max(difference, std::abs(c.normal_force[e] + t.normal_force[e]));
    if (contact == BareContact::bilateral) {
      EXPECT_LT(difference, 1e-9);
    } else {
      EXPECT_GT(difference, 0.1);
    }
  }
}

TEST(ActiveSet, ScalesWithTheLoad) {
  RandomStream random(6, 0);
  const CementedSample<2> sample = random_sample(random, 10, 10);
  const LatticeNetwork<2> network = lattice_network(sample, {});
  LatticeSolver<2> once(network, exactly()), thrice(network, exactly());
  const LatticeSolution<2> a = once.solve(LatticeLoad<2>::uniaxial(1, 1.0));
  const LatticeSolution<2> b = thrice.solve(LatticeLoad<2>::uniaxial(1, 3.0));
  ASSERT_TRUE(a.report.converged && b.report.converged);
  for (std::size_t e = 0; e < network.elements.size(); ++e)
    EXPECT_NEAR(b.normal_force[e], 3.0 * a.normal_force[e], 1e-9);
}

/// Two halves touch but are not bonded, so they do not resist tension. The solver must report that nothing resists the
/// load.
TEST(ActiveSet, SaysWhenNothingResists) {
  const CementedSample<2> sample =
      sample_of<2>(triangular_lattice(6, 8, 1.0), [](const Vec<2>& x) { return x[1] < 3.46 ? 0 : 1; });
  ElementStiffness stiffness;
  const LatticeNetwork<2> network = lattice_network(sample, stiffness);
  LatticeSolver<2> solver(network, {});
  const LatticeSolution<2> pulled = solver.solve(LatticeLoad<2>::uniaxial(1, -1.0));
  EXPECT_FALSE(pulled.report.holds);
  LatticeLoad<2> pressed = LatticeLoad<2>::uniaxial(1, 1.0);
  pressed.imposed << true, false, true;
  LatticeSolver<2> again(network, {});
  EXPECT_TRUE(again.solve(pressed).report.converged);
}

}  // namespace
}  // namespace floc
