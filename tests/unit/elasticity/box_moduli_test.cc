#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <utility>

#include "floc/elasticity/force_increments.h"
#include "floc/elasticity/moduli.h"
#include "floc/elasticity/stability.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/network/rigidity_matrix.h"
#include "floc/packing/wall_forces.h"
#include "support/contact_laws.h"

namespace floc {
namespace {

/// Returns a cubic crystal of spheres (in 2D a square crystal of disks) of diameter 1 between walls, with n
/// grains along each axis. All contacts have the same overlap.
template <int Dim>
Packing<Dim> crystal(int n, const Law& law, const Law& wall_law, double overlap) {
  Packing<Dim> packing;
  packing.law = law;
  packing.wall_law = wall_law;
  const int count = Dim == 2 ? n * n : n * n * n;
  packing.grains = Grains<Dim>::with_size(count);
  const double spacing = 1.0 - overlap;
  packing.cell.matrix *= n - (n + 1) * overlap;
  for (int i = 0; i < count; ++i) {
    int index = i;
    for (int a = 0; a < Dim; ++a, index /= n)
      packing.grains.position[i][a] = 0.5 - overlap + spacing * (index % n);
    packing.grains.radius[i] = 0.5;
    packing.grains.mass[i] = 1.0;
  }
  for (int a = 0; a < Dim; ++a) {
    packing.walls.push_back({a, -1, 0.0, 0.0, 1.0});
    packing.walls.push_back({a, +1, packing.cell.matrix(a, a), 0.0, 1.0});
  }
  find_contacts(packing);
  return packing;
}

Law linear(double kn, double kt) {
  Law law;
  law += test::linear(kn);
  if (kt > 0.0) law += test::coulomb(0.5, kt);
  return law;
}

/// Along each axis, the crystal consists of n^(Dim-1) chains of n + 1 springs between two walls. In a box of
/// side L, this gives C11 = K_N n^(Dim-1)/((n + 1) L^(Dim-2)).
template <int Dim>
void expect_moduli_of_chains(int n) {
  const double kn = 1e4, overlap = 1e-3;
  const Packing<Dim> packing = crystal<Dim>(n, linear(kn, 0.0), linear(kn, 0.0), overlap);
  const Moduli m = elastic_moduli(packing, ModuliOptions{});
  const double side = packing.cell.matrix(0, 0);
  const double expected = kn * std::pow(n, Dim - 1) / ((n + 1) * std::pow(side, Dim - 2));
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b) EXPECT_NEAR(m.C(a, b), a == b ? expected : 0.0, 1e-9 * expected);
  // The springs of a chain are in series and carry equal forces, so B_reuss is exact. For n > 1 the displacements are
  // not affine: the branches at walls are shorter than those between grains. B_voigt is then larger than B.
  EXPECT_GE(m.bounds.B_voigt, n == 1 ? m.B * (1.0 - 1e-9) : 1.01 * m.B);
  EXPECT_NEAR(m.bounds.B_reuss, m.B, 1e-9 * m.B);
  EXPECT_NEAR(m.pressure, wall_pressure(packing)[0], 1e-9 * m.pressure);
  EXPECT_EQ(m.n_mechanisms, 0);
  EXPECT_EQ(m.response.n_free_shifts,
            Dim);  // across each axis, the grains can move together with the two smooth walls
  EXPECT_EQ(m.response.free.count(FreeMotionKind::translation), 0);
}

TEST(BoxModuli, OfACrystalAreThoseOfItsChains) {
  for (const int n : {1, 2, 4}) {
    SCOPED_TRACE(n);
    expect_moduli_of_chains<2>(n);
    expect_moduli_of_chains<3>(n);
  }
}

/// Returns a straight chain of n grains between two walls across the last axis. The other axes are periodic,
/// with cell sides of two diameters.
template <int Dim>
Packing<Dim> chain_betweekWalls(int n, const Law& law, const Law& wall_law) {
  const double overlap = 1e-3;
  Packing<Dim> packing;
  packing.law = law;
  packing.wall_law = wall_law;
  packing.grains = Grains<Dim>::with_size(n);
  packing.cell.matrix *= 2.0;
  packing.cell.matrix(Dim - 1, Dim - 1) = n - (n + 1) * overlap;
  for (int i = 0; i < n; ++i) {
    packing.grains.position[i] = Vec<Dim>::Ones();
    packing.grains.position[i][Dim - 1] = 0.5 - overlap + (1.0 - overlap) * i;
    packing.grains.radius[i] = 0.5;
    packing.grains.mass[i] = 1.0;
  }
  packing.walls = {{Dim - 1, -1, 0.0, 0.0, 1.0},
                   {Dim - 1, +1, packing.cell.matrix(Dim - 1, Dim - 1), 0.0, 1.0}};
  find_contacts(packing);
  return packing;
}

/// A chain has two contacts with walls (stiffness k_w) and n - 1 contacts between grains (stiffness k_n), all in
/// series. The stiffness k of the chain follows from 1/k = 2/k_w + (n - 1)/k_n. Expects that the modulus along the
/// chain is k times the side, divided by the area of a wall, and that the moduli along the other axes are zero.
template <int Dim>
void expect_moduli_of_a_chain(int n, double kt) {
  const double kn = 1e4, kw = 3e4;
  const Packing<Dim> packing = chain_betweekWalls<Dim>(n, linear(kn, kt), linear(kw, kt));
  const Moduli m = elastic_moduli(packing, ModuliOptions{});
  const double side = packing.cell.matrix(Dim - 1, Dim - 1);
  const double expected = side / wall_area(packing, Dim - 1) / (2.0 / kw + (n - 1) / kn);
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b)
      EXPECT_NEAR(m.C(a, b), a == Dim - 1 && b == Dim - 1 ? expected : 0.0, 1e-9 * expected) << a << b;
  EXPECT_EQ(m.n_coupled_mechanisms, Dim - 1);
  EXPECT_EQ(m.n_negative, 0);
  if (n > 1) return;
  // On smooth walls a sphere can slide without energy; this motion does not count as a mechanism. On rough walls the
  // sphere cannot slide.
  EXPECT_EQ(m.response.free.count(FreeMotionKind::translation), kt == 0.0 ? Dim - 1 : 0);
  EXPECT_EQ(m.n_mechanisms, m.n_coupled_mechanisms);
}

TEST(BoxModuli, OfAChainBetweenTwoWallsAreThoseOfSpringsInSeries) {
  for (const int n : {1, 2, 5})
    for (const double kt : {0.0, 8e3}) {
      SCOPED_TRACE(n);
      SCOPED_TRACE(kt);
      expect_moduli_of_a_chain<2>(n, kt);
      expect_moduli_of_a_chain<3>(n, kt);
    }
}

/// A crystal of smooth disks may buckle under its own load, even between fixed walls. If the disks are displaced along
/// one axis, the chains along this axis act like springs of stiffness K_N with fixed ends. The chains along the other
/// axis act like springs with free ends and the negative stiffness -F/r (normal force F, branch length r).
TEST(BoxModuli, CompressedCrystalBucklesInAsManyWaysAsItsChainsSay) {
  const double kn = 1e4, pi = std::acos(-1.0);
  for (const auto& [n, overlap] : {std::pair(4, 1e-3), {8, 0.03}, {8, 0.1}}) {
    const Packing<2> packing = crystal<2>(n, linear(kn, 0.0), linear(kn, 0.0), overlap);
    int expected = 0;
    for (int p = 1; p <= n; ++p)
      for (int q = 0; q < n; ++q)
        expected +=
            2 * (1.0 - std::cos(p * pi / (n + 1)) < overlap / (1.0 - overlap) * (1.0 - std::cos(q * pi / n)));
    EXPECT_EQ(stability(packing, true).n_negative, expected) << n << " " << overlap;
    EXPECT_EQ(stability(packing).n_negative, 0);
    EXPECT_EQ(expected > 0, overlap > 0.05);
  }
}

/// Returns a disordered box: the crystal with displaced grains and unequal overlaps.
Packing<2> disordered() {
  Packing<2> packing = crystal<2>(5, linear(1e4, 8e3), linear(1.3e4, 5e3), 2e-2);
  for (int i = 0; i < packing.grains.size(); ++i)
    packing.grains.position[i] += 5e-3 * Vec<2>(std::sin(3.0 * i), std::cos(7.0 * i));
  find_contacts(packing);
  return packing;
}

constexpr int kWalls = 4;

/// Returns the dense stiffness matrix of grains and walls. Each of the four walls is a separate body.
Eigen::MatrixXd stiffness_of_bodies(const Packing<2>& packing) {
  const ContactNetwork<2> network = contact_network(packing);
  const int n = network.n_unknowns();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n + kWalls, n + kWalls);
  for (const NetworkContact<2>& c : network.contacts) {
    const ContactRows<2> g = contact_rows(c);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(kDofs<2>, n + kWalls);
    rows.middleCols<3>(3 * c.i) += g.on_i;
    if (c.on_wall())
      rows(0, n + c.wall) = -c.normal()[packing.walls[c.wall].axis];
    else
      rows.middleCols<3>(3 * c.j) += g.on_j;
    K += rows.transpose() * row_stiffness(c).asDiagonal() * rows;
  }
  return K;
}

/// Returns the strains that unit pressures on the walls cause. Column b contains the strains due to a pressure on axis
/// b.
Eigen::MatrixXd compliance_by_bodies(const Packing<2>& packing) {
  const Eigen::MatrixXd K = stiffness_of_bodies(packing);
  const Eigen::Index n = K.rows() - kWalls;
  Eigen::MatrixXd strain(2, 2);
  for (int b = 0; b < 2; ++b) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(n + kWalls);
    for (int w = 0; w < kWalls; ++w)
      if (packing.walls[w].axis == b) load[n + w] = -packing.walls[w].side * wall_area(packing, b);
    const Eigen::VectorXd u = K.completeOrthogonalDecomposition().solve(load);
    for (int a = 0; a < 2; ++a) strain(a, b) = -(u[n + 2 * a + 1] - u[n + 2 * a]) / packing.cell.matrix(a, a);
  }
  return strain;
}

TEST(BoxModuli, AreTheInverseOfWhatPressuresOnFreeWallsDo) {
  const Packing<2> packing = disordered();
  const Moduli m = elastic_moduli(packing, ModuliOptions{});
  const Eigen::MatrixXd C = compliance_by_bodies(packing).inverse();
  EXPECT_LT((m.C - C).cwiseAbs().maxCoeff(), 1e-8 * C(0, 0)) << m.C << "\n\n" << C;
  EXPECT_GE(m.bounds.B_voigt, m.B);
  // the two walls of an axis also move in the same direction
  EXPECT_GT(m.response.wall_shift.cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(m.response.n_free_shifts, 0);
}

/// Attractions at a distance have negative stiffness. The number of unstable modes must equal the number of negative
/// eigenvalues of a dense stiffness matrix. The unknowns of the dense matrix are the displacements of each grain and of
/// each wall. The library uses strains and common displacements of two walls instead.
TEST(BoxModuli, AttractionsAcrossGapsDestabiliseInAsManyWaysAsTheMatrixOfAllBodiesSays) {
  int n_stable = 0, n_unstable = 0;
  for (const double force : {1.0, 30.0, 100.0, 300.0}) {
    Law law = linear(1e4, 8e3), wall_law = linear(1.3e4, 5e3);
    law += test::tail_adhesion(force, 0.05);
    wall_law += test::tail_adhesion(0.5 * force, 0.05);
    law += test::rolling_spring(0.1, 100.0);
    Packing<2> packing = crystal<2>(5, law, wall_law, 3e-3);
    for (int i = 0; i < packing.grains.size(); ++i)
      packing.grains.position[i] += 5e-3 * Vec<2>(std::sin(3.0 * i), std::cos(7.0 * i));
    find_contacts(packing);
    int n_across_gaps = 0;
    for (const Contact<2>& c : packing.contacts) n_across_gaps += c.distant;
    EXPECT_GT(n_across_gaps, 5);
    const Eigen::VectorXd eigenvalue =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness_of_bodies(packing)).eigenvalues();
    const auto n_negative = static_cast<int>((eigenvalue.array() < -1e-9 * eigenvalue.maxCoeff()).count());
    EXPECT_EQ(stability(packing).n_negative, n_negative) << force;
    ++(n_negative == 0 ? n_stable : n_unstable);
  }
  EXPECT_GT(n_stable, 0);
  EXPECT_GT(n_unstable, 1);
}

/// In 2D a modulus has the unit of a contact stiffness, so it does not depend on the unit of length.
TEST(BoxModuli, DoNotDependOnTheUnitOfLength) {
  Packing<2> packing = crystal<2>(3, linear(1e4, 0.0), linear(1.3e4, 0.0), 1e-2);
  const Moduli before = elastic_moduli(packing, ModuliOptions{});
  constexpr double kUnit = 1e-6;
  packing.cell.matrix *= kUnit;
  for (Vec<2>& x : packing.grains.position) x *= kUnit;
  for (double& radius : packing.grains.radius) radius *= kUnit;
  for (Wall<2>& wall : packing.walls) wall.position *= kUnit;
  find_contacts(packing);
  const Moduli after = elastic_moduli(packing, ModuliOptions{});
  EXPECT_LT((after.C - before.C).cwiseAbs().maxCoeff(), 1e-9 * before.C(0, 0));
  EXPECT_EQ(after.response.n_free_shifts, 2);
}

/// On every grain, the force increments sum to zero. On a wall, they sum to the increment of pressure times the area of
/// the wall.
TEST(BoxModuli, IncrementsAreInBalanceWithTheStepOfPressure) {
  const Packing<2> packing = disordered();
  const ModuliOptions options;
  const ContactNetwork<2> network = options.loaded_network(packing);
  const Moduli m = elastic_moduli(packing, options);
  const auto step = step_response(network, m.response, StressStep::isotropic);
  ASSERT_TRUE(step.has_value());
  std::vector<Vec<2>> net(packing.grains.size(), Vec<2>::Zero());
  std::vector<double> on_wall(4, 0.0);
  double largest = 0.0;
  for (std::size_t k = 0; k < network.contacts.size(); ++k) {
    const NetworkContact<2>& c = network.contacts[k];
    const ForceIncrement<2>& f = step->increments[k];
    const Vec<2> on_i = f.shear[0] * c.frame.col(1) - f.normal * c.normal();
    net[c.i] += on_i;
    if (c.on_wall())
      on_wall[c.wall] += f.normal;
    else
      net[c.j] -= on_i;
    largest = std::max(largest, std::abs(f.normal));
  }
  for (const Vec<2>& force : net) EXPECT_LT(force.norm(), 1e-9 * largest);
  for (int w = 0; w < 4; ++w)
    EXPECT_NEAR(on_wall[w], wall_area(packing, packing.walls[w].axis), 1e-8 * largest) << w;
}

/// A disk whose only contact is with a wall can roll on this wall. This motion is not a mechanism of the other grains.
TEST(BoxModuli, DiskOnAWallAloneIsADeadEnd) {
  Packing<2> packing = crystal<2>(2, linear(1e4, 8e3), linear(1e4, 8e3), 1e-3);
  const Moduli before = elastic_moduli(packing, ModuliOptions{});
  packing.grains.position.push_back(Vec<2>(0.049, 0.999));
  packing.grains.velocity.push_back(Vec<2>::Zero());
  packing.grains.radius.push_back(0.05);
  packing.grains.mass.push_back(1.0);
  packing.grains.orientation.push_back(0.0);
  packing.grains.angular_velocity.push_back(RotationVector<2>::Zero());
  packing.law += test::constant_adhesion(1.0);  // with adhesion, only grains without contacts are rattlers
  packing.wall_law += test::constant_adhesion(1.0);
  find_contacts(packing);
  const ContactNetwork<2> network = contact_network(packing);
  const FreeMotions free = find_free_motions(network);
  EXPECT_EQ(free.n_dead_ends(), 1);
  EXPECT_EQ(free.n_free_rollers, 1);
  const Moduli after = elastic_moduli(packing, ModuliOptions{});
  EXPECT_EQ(after.n_mechanisms, 0);
  EXPECT_NEAR(after.C(0, 0), before.C(0, 0), 1e-9 * before.C(0, 0));
}

}  // namespace
}  // namespace floc
