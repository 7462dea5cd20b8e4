#include "floc/elasticity/elastic_response.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "floc/elasticity/force_increments.h"
#include "support/contact_laws.h"
#include "support/lattices.h"

namespace floc {
namespace {

struct DenseAnswer {
  Eigen::MatrixXd relaxed;
  int nullity;
  int n_negative;
};

/// Computes the response of a network directly, with the pseudo-inverse of a block of the stiffness matrix: the rows
/// and columns of the unknowns of the grains.
template <int Dim>
DenseAnswer dense_response(const ContactNetwork<Dim>& network, bool prestress) {
  const StiffnessMatrix k = stiffness_matrix(network, {StrainSet::full, prestress});
  const int n = network.n_unknowns();
  const Eigen::MatrixXd grains = Eigen::MatrixXd(k.whole()).topLeftCorner(n, n);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(grains);
  DenseAnswer answer{k.boundary, 0, 0};
  for (int m = 0; m < n; ++m) {
    const double value = eigen.eigenvalues()[m];
    if (value < -1e-11) ++answer.n_negative;
    if (std::abs(value) < 1e-11) {
      ++answer.nullity;
      continue;
    }
    const Eigen::VectorXd b = k.border.transpose() * eigen.eigenvectors().col(m);
    answer.relaxed -= b * b.transpose() / value;
  }
  return answer;
}

int structural_zero_modes(const FreeMotions& free, int dofs) {
  int removed = 0;
  for (const bool kept : free.kept) removed += kept ? 0 : 1;
  int dead = 0;
  for (const bool d : free.dead_end) dead += d ? 1 : 0;
  return removed - dofs * dead;
}

template <int Dim>
void expect_dense_answer(const ContactNetwork<Dim>& network, double tolerance) {
  ResponseOptions options;
  options.strains = StrainSet::full;
  const ElasticResponse response = elastic_response(network, options);
  const DenseAnswer dense = dense_response(network, false);
  EXPECT_LT((response.relaxed - dense.relaxed).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_EQ(response.n_negative, dense.n_negative);
  EXPECT_LT(response.residual, 1e-12);
}

/// Tolerance of the compared results: rounding errors are multiplied by condition numbers of up to 1e4.
constexpr double kTolerance = 1e-10;

TEST(ElasticResponse, EqualsThePseudoInverseWithEveryKindOfContact) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    expect_dense_answer(contact_network(test::random_packing<2>(25, seed, test::elastic_law(1.0, 0.6, 0.1))),
                        kTolerance);
    expect_dense_answer(contact_network(test::random_packing<3>(12, seed, test::elastic_law(1.0, 0.6, 0.1))),
                        kTolerance);
  }
}

/// Returns the Schur complement for the retained unknowns, computed from the rigidity matrix in extended
/// precision.
template <int Dim>
Eigen::MatrixXd extended_response(const ContactNetwork<Dim>& network, const std::vector<bool>& kept) {
  using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  const Eigen::MatrixXd g = rigidity_matrix(network, StrainSet::full);
  const int n = network.n_unknowns();
  std::vector<int> columns;
  for (int u = 0; u < n; ++u)
    if (kept[u]) columns.push_back(u);
  const Extended a = Eigen::MatrixXd(g(Eigen::all, columns)).cast<long double>();
  const Extended b = g.rightCols(g.cols() - n).cast<long double>();
  Extended ka = a, kb = b;
  for (int r = 0; r < g.rows(); ++r) {
    const long double k = row_stiffness(network.contacts[r / kDofs<Dim>])[r % kDofs<Dim>];
    ka.row(r) *= k;
    kb.row(r) *= k;
  }
  const Extended u = Extended(a.transpose() * ka).fullPivLu().solve(a.transpose() * kb);
  return Extended(kb.transpose() * (b - a * u)).cast<double>();
}

TEST(ElasticResponse, LiesWithinItsErrorBound) {
  // rounding error in extended precision, used as the tolerance if a modulus vanishes
  constexpr double kReference = 1e-17;
  ResponseOptions options;
  options.strains = StrainSet::full;
  for (const double kr : {0.1, 1e-5, 1e-10})
    for (unsigned seed = 0; seed < 10; ++seed) {
      const auto network =
          contact_network(test::random_packing<2>(25, seed, test::elastic_law(1.0, 0.6, kr), 2.2));
      const ElasticResponse response = elastic_response(network, options);
      const Eigen::MatrixXd exact =
          extended_response(without_grains(network, response.free.dead_end), response.free.kept);
      const Eigen::MatrixXd error = (response.relaxed - exact).cwiseAbs();
      EXPECT_TRUE((error.array() <= response.error.array() + kReference).all())
          << "seed " << seed << ", K_R = " << kr << "\n"
          << error << "\n"
          << response.error;
      EXPECT_LT(response.error.maxCoeff(), 1e-11) << "seed " << seed << ", K_R = " << kr;
    }
}

TEST(ElasticResponse, EqualsThePseudoInverseWithMechanismsInPlenty) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    expect_dense_answer(
        contact_network(test::random_packing<2>(25, seed, test::elastic_law(1.0, 0.6, 0.0), 1.3)), 1e-7);
    expect_dense_answer(
        contact_network(test::random_packing<2>(25, seed, test::elastic_law(1.0, 0.0, 0.0), 1.8)), 1e-7);
    expect_dense_answer(contact_network(test::random_packing<3>(12, seed, test::elastic_law(1.0, 0.6, 0.0))),
                        1e-7);
  }
}

TEST(ElasticResponse, CountsEveryZeroModeOnceByStructureOrAsAMechanism) {
  int n_mechanisms = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    // If every contact has stiffness in all directions, dead ends cause no zero modes of the dense matrix.
    for (const double kr : {0.0, 0.1}) {
      const auto network =
          contact_network(test::random_packing<2>(20, seed, test::elastic_law(1.0, 0.6, kr), 1.5));
      const ElasticResponse response = elastic_response(network, {});
      const int found =
          structural_zero_modes(response.free, 3) + response.free.n_free_rollers + response.n_mechanisms;
      EXPECT_EQ(found, dense_response(network, false).nullity) << "seed " << seed;
      n_mechanisms += response.n_mechanisms;
      if (kr > 0.0) {
        EXPECT_EQ(response.n_mechanisms, 0);
      }
    }
  }
  EXPECT_GT(n_mechanisms, 0);
}

/// In a long chain without rolling stiffness, the linear dependence of matrix columns involves the columns of many
/// disks. The solver must nevertheless count every mechanism of the chain, and must not take a mechanism for a motion
/// with a small stiffness.
TEST(ElasticResponse, CountsTheMechanismsOfLongChainsWithoutRollingStiffness) {
  for (const int n : {5, 20, 40}) {
    const auto network = contact_network(test::square_frames(n, 1.0, test::elastic_law(1.0, 0.6, 0.0)));
    const ElasticResponse response = elastic_response(network, {});
    const Eigen::MatrixXd g =
        Eigen::MatrixXd(scaled_rigidity_matrix(network, StrainSet::diagonal)).leftCols(network.n_unknowns());
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(g);
    qr.setThreshold(1e-10);
    const auto translations = 2;
    EXPECT_EQ(response.n_mechanisms, network.n_unknowns() - qr.rank() - translations) << n;
    EXPECT_TRUE(response.resolved);
  }
}

TEST(ElasticResponse, CountsNegativeEigenvaluesOfDistantBonds) {
  Law law = test::elastic_law(1.0, 0.6, 0.1);
  law += test::tail_adhesion(0.05, 0.1);
  int n_negative = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto network = contact_network(test::random_packing<2>(20, seed, law, 1.0));
    const ElasticResponse response = elastic_response(network, {});
    EXPECT_EQ(response.n_negative, dense_response(network, false).n_negative) << "seed " << seed;
    n_negative += response.n_negative;
  }
  EXPECT_GT(n_negative, 0);
}

TEST(ForceIncrements, BalanceOnEveryGrainAndAddUpToTheStress) {
  const auto network = contact_network(test::random_packing<2>(30, 4, test::elastic_law(1.0, 0.6, 0.1), 1.6));
  ResponseOptions options;
  options.strains = StrainSet::full;
  const ElasticResponse response = elastic_response(network, options);
  const Eigen::Vector3d strain(0.3, -0.2, 0.5);
  const auto increments = force_increments<2>(network, response, strain);
  Eigen::VectorXd forces(3 * increments.size());
  for (int c = 0; c < static_cast<int>(increments.size()); ++c)
    forces.segment<3>(3 * c) << increments[c].normal, increments[c].shear[0], increments[c].rolling_moment[0];
  const Eigen::VectorXd loads = rigidity_matrix(network, StrainSet::full).transpose() * forces;
  EXPECT_LT(loads.head(network.n_unknowns()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((loads.tail(3) - response.relaxed * strain).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace floc
