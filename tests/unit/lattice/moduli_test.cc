#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/elasticity/elastic_response.h"
#include "floc/lattice/node_stress.h"
#include "floc/lattice/phase_bounds.h"
#include "support/lattice_samples.h"

namespace floc {
namespace {

using test::exactly;
using test::moduli_of;
using test::sample_of;
using test::uniform_network;

constexpr double kRoot3 = std::numbers::sqrt3;

TEST(TriangularLattice, HasTheModuliOfItsSpringsWhateverTheBending) {
  for (const double shear : {0.0, 0.4, 1.0})
    for (const double bending : {0.0, 0.05}) {
      if (shear == 0.0 && bending > 0.0) continue;
      const double k = 2.5;
      const Eigen::MatrixXd C = moduli_of(uniform_network(triangular_lattice(7, 8, 0.3), k, shear, bending));
      const double K = kRoot3 / 2 * k, G = kRoot3 / 4 * k * (1 + shear);
      EXPECT_NEAR(C(0, 0), K + G, 1e-10);
      EXPECT_NEAR(C(1, 1), K + G, 1e-10);
      EXPECT_NEAR(C(0, 1), K - G, 1e-10);
      EXPECT_NEAR(C(2, 2), G, 1e-10);
      EXPECT_NEAR(C(0, 2), 0.0, 1e-10);
      const Eigen::MatrixXd S = C.inverse();
      EXPECT_NEAR(1 / S(0, 0), 2 * kRoot3 * k * (1 + shear) / (3 + shear), 1e-9);  // E
      EXPECT_NEAR(-S(0, 1) / S(0, 0), (1 - shear) / (3 + shear), 1e-10);           // nu
      const ElasticPhase phase = triangular_moduli(1.0, k, shear * k);
      EXPECT_DOUBLE_EQ(phase.K, K);
      EXPECT_DOUBLE_EQ(phase.G, G);
    }
}

/// Under a uniaxial stress, all bonds of the same direction have equal forces, and all nodes have the same stress.
TEST(TriangularLattice, UnderUniaxialStressLoadsItsBondsByTheirDirection) {
  const double l = 0.3, sigma = 1.7;
  const Lattice<2> lattice = triangular_lattice(6, 6, l);
  const LatticeNetwork<2> network = uniform_network(lattice, 1.3);
  for (const int axis : {0, 1}) {
    LatticeSolver<2> solver(network, exactly());
    const LatticeSolution<2> s = solver.solve(LatticeLoad<2>::uniaxial(axis, sigma));
    ASSERT_TRUE(s.report.converged);
    for (int e = 0; e < static_cast<int>(network.elements.size()); ++e) {
      const bool along_rows = std::abs(network.elements[e].branch[1]) < 1e-12;
      const double expected =
          axis == 0 ? (along_rows ? 2 / kRoot3 * 0.75 : 0.0) : (along_rows ? -1 / (2 * kRoot3) : 1 / kRoot3);
      EXPECT_NEAR(s.normal_force[e] / (sigma * l), expected, 1e-10) << axis;
    }
    for (const Mat<2>& stress : node_stress(lattice, network, s)) {
      Mat<2> expected = Mat<2>::Zero();
      expected(axis, axis) = sigma;
      EXPECT_LT((stress - expected).norm(), 1e-10);
    }
  }
}

/// A laminate has the stiffness 1 in 5 of its 12 rows, and the stiffness `soft` in the other rows.
TEST(Laminate, OfRowsHasTheClosedFormForAnyContrastWithTheInterfaceInSeries) {
  const auto laminate = [](double soft, std::optional<double> interface) {
    const double height = kRoot3 / 2;
    const CementedSample<2> sample = sample_of<2>(triangular_lattice(6, 12, 1.0), [&](const Vec<2>& x) {
      return static_cast<int>(x[1] / height) < 5 ? 0 : -1;
    });
    ElementStiffness stiffness;
    stiffness.grain = 1.0;
    stiffness.matrix = soft;
    stiffness.interface = interface;
    stiffness.contact = BareContact::bilateral;  // rows touch their own images across the cell boundary
    return moduli_of(lattice_network(sample, stiffness));
  };
  const Eigen::MatrixXd C = laminate(0.1, std::nullopt);
  EXPECT_NEAR(C(1, 1), 0.2078461, 1e-7);
  EXPECT_NEAR(C(0, 1), 0.0692820, 1e-7);
  EXPECT_NEAR(C(2, 2), 0.0692820, 1e-7);
  EXPECT_NEAR(C(0, 0), 0.5715768, 1e-7);
  for (const double soft : {1e-3, 0.5, 20.0}) {
    const Eigen::MatrixXd C_of = laminate(soft, std::nullopt);
    const double inverse = 5.0 / 12 + 7.0 / 12 / soft, mean = 5.0 / 12 + 7.0 / 12 * soft;
    const double C22 = 3 * kRoot3 / 4 / inverse;
    EXPECT_NEAR(C_of(1, 1) / C22, 1.0, 1e-9) << soft;
    EXPECT_NEAR(C_of(0, 1) / C22, 1.0 / 3, 1e-9) << soft;
    EXPECT_NEAR(C_of(0, 0) / (2 * kRoot3 / 3 * mean + C22 / 9), 1.0, 1e-9) << soft;
  }
  // The interface stiffness 0.55 is the arithmetic mean of the two stiffnesses. It makes the laminate too stiff.
  EXPECT_NEAR(laminate(0.1, 0.55)(1, 1) / C(1, 1), 1.11, 0.005);
}

/// Compares all entries of C with the moduli that the code for contact networks gives for the same elements. The
/// elements have central forces alone, or also shear and bending.
TEST(LatticeModuli, AreThoseOfItsContactNetwork) {
  RandomStream random(3, 0);
  for (const double shear : {0.0, 0.5}) {
    const CementedSample<2> sample = sample_of<2>(
        triangular_lattice(9, 8, 1.0), [&](const Vec<2>&) { return random.uniform() < 0.6 ? 0 : -1; });
    ElementStiffness stiffness;
    stiffness.grain = 7.0;
    stiffness.shear = shear;
    stiffness.bending = 0.1 * shear;
    stiffness.contact = BareContact::bilateral;
    const LatticeNetwork<2> network = lattice_network(sample, stiffness);
    const Eigen::MatrixXd C = moduli_of(network);
    const ElasticResponse response = elastic_response(contact_network(network), {.strains = StrainSet::full});
    EXPECT_LT((C - response.relaxed / network.volume).cwiseAbs().maxCoeff(), 1e-10 * C.maxCoeff()) << shear;
  }
}

}  // namespace
}  // namespace floc
