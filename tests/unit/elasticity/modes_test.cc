#include "floc/elasticity/modes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <vector>

#include "floc/elasticity/elastic_response.h"
#include "floc/elasticity/isotropic_moduli.h"
#include "support/contact_laws.h"
#include "support/lattices.h"

namespace floc {
namespace {

/// Returns all eigenvalues of the stiffness matrix K of the grains with contacts, in ascending order. Rotations
/// are multiplied by the size of the grain.
template <int Dim>
Eigen::VectorXd dense_eigenvalues(const ContactNetwork<Dim>& network) {
  const int n = network.n_unknowns();
  Eigen::MatrixXd k = Eigen::MatrixXd(stiffness_matrix(network, {}).whole()).topLeftCorner(n, n);
  for (int u = 0; u < n; ++u)
    if (u % kDofs<Dim> >= Dim) {
      k.row(u) /= network.grain_size[u / kDofs<Dim>];
      k.col(u) /= network.grain_size[u / kDofs<Dim>];
    }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
}

template <int Dim>
void expect_dense_eigenvalues(const ContactNetwork<Dim>& network, int count) {
  ModeOptions options;
  options.count = count;
  const SoftModes<Dim> soft = soft_modes(network, options);
  EXPECT_TRUE(soft.complete);
  ASSERT_EQ(soft.modes.size(), static_cast<std::size_t>(count));
  const Eigen::VectorXd dense = dense_eigenvalues(network);
  // The dense spectrum also contains the free motions. They appear as zeros after the negative eigenvalues.
  const auto n_negative = (dense.array() < -1e-12).count();
  for (int m = 0; m < count; ++m) {
    const double expected = dense[m < n_negative ? m : m + soft.free.modes.cols()];
    // The two eigenvalues differ by rounding errors and by the square of the error of the eigenvector.
    EXPECT_NEAR(soft.modes[m].eigenvalue, expected, 1e-12) << "mode " << m;
  }
}

TEST(SoftModes, AreThoseOfTheDenseMatrix) {
  for (unsigned seed = 0; seed < 4; ++seed)
    for (const double kr : {0.1, 0.0}) {
      const auto law = test::elastic_law(1.0, 0.6, kr);
      expect_dense_eigenvalues(contact_network(test::random_packing<2>(120, seed, law, 1.5)), 25);
      expect_dense_eigenvalues(contact_network(test::random_packing<3>(60, seed, law, 1.2)), 25);
    }
  expect_dense_eigenvalues(
      contact_network(test::random_packing<2>(150, 7, test::elastic_law(1.0, 0.0, 0.0), 2.0)), 25);
}

TEST(SoftModes, OfALatticeLackNoCopy) {
  expect_dense_eigenvalues(contact_network(test::square_frames(40, 1.0, test::elastic_law(1.0, 0.6, 0.1))), 20);
}

TEST(SoftModes, IncludeUnstableOnes) {
  Law law = test::elastic_law(1.0, 0.6, 0.1);
  law += test::tail_adhesion(0.05, 0.1);
  int n_unstable = 0;
  for (unsigned seed = 0; seed < 5; ++seed) {
    const auto network = contact_network(test::random_packing<2>(80, seed, law, 1.2));
    expect_dense_eigenvalues(network, 15);
    for (const Mode<2>& m : soft_modes(network, {}).modes) n_unstable += m.kind == ModeKind::unstable ? 1 : 0;
  }
  EXPECT_GT(n_unstable, 0);
}

TEST(SoftModes, AllTogetherTakeOffWhatRelaxationDoes) {
  for (const double kr : {0.1, 0.0}) {
    const auto network = contact_network(test::random_packing<2>(60, 3, test::elastic_law(1.0, 0.6, kr), 2.2));
    ModeOptions options;
    options.count = network.n_unknowns();
    const SoftModes<2> soft = soft_modes(network, options);
    double B = bulk_modulus(affine_stiffness(network, StrainSet::diagonal)) / network.volume;
    double G = pure_shear_modulus(affine_stiffness(network, StrainSet::diagonal)) / network.volume;
    for (const Mode<2>& m : soft.modes) B -= m.softens_B, G -= m.softens_G;
    const Eigen::MatrixXd C = elastic_response(network, {}).relaxed / network.volume;
    // Errors of 1e-12 are divided by eigenvalues, of which the smallest are about 1e-4.
    EXPECT_NEAR(B, bulk_modulus(C), 1e-9);
    EXPECT_NEAR(G, pure_shear_modulus(C), 1e-9);
    EXPECT_EQ(soft.modes.size() + soft.free.modes.cols(), static_cast<std::size_t>(network.n_unknowns()));
  }
}

TEST(SoftModes, NameANearMechanismAndWhatPrestressDoesToIt) {
  // A chain of disks across the cell. Two of the disks are displaced from the straight line by 1e-5 and 2e-5. Very
  // little energy is then needed to bend the chain.
  Packing<2> packing = test::chain_across(4, 1.0, 4.0, test::elastic_law(1.0, 0.5, 0.0));
  packing.grains.position[1][1] += 1e-5;
  packing.grains.position[3][1] -= 2e-5;
  find_contacts(packing);
  for (Contact<2>& c : packing.contacts) c.normal_force = 0.01;
  const auto compressed = soft_modes(contact_network(packing), {});
  EXPECT_NEAR(compressed.near_bound, 0.01, 1e-9);
  ASSERT_FALSE(compressed.modes.empty());
  const Mode<2>& softest = compressed.modes.front();
  EXPECT_LT(softest.eigenvalue, 0.01);
  EXPECT_LT(softest.with_prestress, softest.eigenvalue);
  for (Contact<2>& c : packing.contacts) c.normal_force = -0.01;
  const auto network = contact_network(packing);
  const ElasticResponse response = elastic_response(network, {});
  int n_near = 0;
  for (const Mode<2>& m : compressed.modes) n_near += m.kind == ModeKind::near_mechanism ? 1 : 0;
  EXPECT_GT(n_near, 0);
  EXPECT_EQ(count_near_mechanisms(network, response), n_near);
  const auto stretched = soft_modes(contact_network(packing), {});
  EXPECT_GT(stretched.modes.front().with_prestress, stretched.modes.front().eigenvalue);
}

/// Numbers of tested states, of near mechanisms counted in these states, and of states with certain properties.
struct Met {
  int states = 0, without_any = 0, near = 0, largest = 0;
  int with_mechanisms = 0, unstable = 0, with_free_motions = 0, with_rattlers = 0, without_contacts = 0;
};

/// Compares count_near_mechanisms() with the eigenvalues of the dense matrix. The normal forces are scaled so that the
/// largest ratio of a force to its branch length lies between two successive eigenvalues; this is done at several
/// positions in the spectrum. The function must count the eigenvalues below the ratio.
template <int Dim>
void expect_dense_count(ContactNetwork<Dim> network, Met& met) {
  // rounding error of the compared eigenvalues, which are divided by the largest stiffness
  constexpr double kZero = 1e-11;
  const double unit = stiffness_scale(network);
  const ElasticResponse response = elastic_response(network, {});
  const Eigen::VectorXd all = dense_eigenvalues(network) / unit;
  std::vector<double> positive;
  std::copy_if(all.begin(), all.end(), std::back_inserter(positive), [&](double v) { return v > kZero; });
  const auto n = static_cast<int>(positive.size());
  for (const int k : {0, 1, 2, 7, n / 2, n - 1}) {
    if (k < 0 || k > n - 1) continue;
    const double below = k == 0 ? 0.1 * positive[0] : positive[k - 1];
    if (positive[k] - below < 1e-9) continue;  // skips equal eigenvalues
    bool between_grains = false;
    for (NetworkContact<Dim>& c : network.contacts) {
      c.normal_force = 0.5 * (positive[k] + below) * unit * c.branch.norm() * (between_grains ? -0.7 : 1.0);
      between_grains = between_grains || !c.on_wall();
    }
    if (!between_grains) continue;
    EXPECT_EQ(count_near_mechanisms(network, response), k)
        << Dim << "D, " << network.n_grains << " grains, " << network.contacts.size() << " contacts, "
        << network.wall_axes.size() << " axes between walls, " << response.n_mechanisms << " mechanisms, "
        << response.n_negative << " negative, " << response.free.kind.size() << " free, "
        << response.free.n_unstable_ends << " unstable ends, " << (all.array() < -kZero).count()
        << " below and " << (all.array().abs() < kZero).count() << " at zero";
    ++met.states;
    met.without_any += k == 0 ? 1 : 0;
    met.near += k;
    met.largest = std::max(met.largest, k);
    met.with_mechanisms += response.n_mechanisms > 0 ? 1 : 0;
    met.unstable += response.n_negative > 0 ? 1 : 0;
    const int n_rattlers = response.free.count(FreeMotionKind::rattler);
    met.with_rattlers += n_rattlers > 0 ? 1 : 0;
    met.with_free_motions += static_cast<int>(response.free.kind.size()) > n_rattlers + Dim ? 1 : 0;
  }
  network.contacts.clear();
  EXPECT_EQ(count_near_mechanisms(network, elastic_response(network, {})), 0);
  ++met.without_contacts;
}

template <int Dim>
Packing<Dim> between_walls(Packing<Dim> packing) {
  const Vec<Dim> sides = packing.cell.matrix.diagonal();
  packing.cell.matrix = sides.asDiagonal();
  for (Vec<Dim>& x : packing.grains.position)
    for (int a = 0; a < Dim; ++a) x[a] -= sides[a] * std::floor(x[a] / sides[a]);
  packing.wall_law = packing.law;
  for (int a = 0; a < Dim; ++a) {
    packing.walls.push_back({a, -1, 0.0, 0.0, 1.0});
    packing.walls.push_back({a, +1, sides[a], 0.0, 1.0});
  }
  packing.contacts.clear();
  find_contacts(packing);
  return packing;
}

template <int Dim>
void count_in_all_kinds_of_packings(Met& met) {
  Law sticky = test::elastic_law(1.0, 0.7, 0.05), wet = test::elastic_law(1.0, 0.7, 0.0);
  sticky += test::tail_adhesion(0.02, 0.08);
  wet += test::liquid(0.01, 0.0, 2e-3, 2.5);
  for (const Law& law : {test::elastic_law(1.0, 0.6, 0.1), test::elastic_law(1.0, 0.6, 0.0),
                         test::elastic_law(1.0, 0.0, 0.0), test::elastic_law(1.0, 0.0, 0.1), sticky, wet})
    for (const double grains_per_volume : {0.8, 1.3, 2.0})
      for (unsigned seed = 0; seed < 3; ++seed)
        for (const int n_grains : {4, 14}) {
          const Packing<Dim> packing = test::random_packing<Dim>(n_grains, seed, law, grains_per_volume);
          expect_dense_count(contact_network(packing), met);
          expect_dense_count(contact_network(between_walls(packing)), met);
        }
}

TEST(NearMechanisms, AreAsManyAsInTheDenseSpectrum) {
  Met met;
  count_in_all_kinds_of_packings<2>(met);
  count_in_all_kinds_of_packings<3>(met);
  std::cout << met.states << " states, " << met.without_any << " without a near-mechanism, " << met.near
            << " of them in the others, up to " << met.largest << " in one; " << met.with_mechanisms
            << " with mechanisms, " << met.unstable << " unstable, " << met.with_free_motions
            << " with grains that roll or spin, " << met.with_rattlers << " with rattlers; "
            << met.without_contacts << " networks without contacts\n";
  for (const int kind :
       {met.without_any, met.with_mechanisms, met.unstable, met.with_free_motions, met.with_rattlers})
    EXPECT_GT(kind, 20);
  EXPECT_GT(met.states, 1000);
}

TEST(NearMechanisms, AreNotCountedWhereTheFactorWouldNotFit) {
  auto network = contact_network(test::random_packing<2>(60, 0, test::elastic_law(1.0, 0.6, 0.1), 1.6));
  for (NetworkContact<2>& c : network.contacts) c.normal_force = 0.1;
  const ElasticResponse response = elastic_response(network, {});
  EXPECT_TRUE(count_near_mechanisms(network, response).has_value());
  EXPECT_FALSE(count_near_mechanisms(network, response, 100.0).has_value());
}

TEST(SoftModes, NearMechanismsKeepTheirDigitsDownToTheRoundingOfTheGeometry) {
  // A chain in which two disks are displaced from the straight line, by `off` and 2 `off`. One eigenvalue is
  // proportional to off^2, and two mechanisms remain.
  double ratio_before = 0.0;
  for (const double off : {1e-4, 1e-5, 1e-6, 1e-7}) {
    Packing<2> packing = test::chain_across(4, 1.0, 4.0, test::elastic_law(1.0, 0.5, 0.0));
    packing.grains.position[1][1] += off;
    packing.grains.position[3][1] -= 2.0 * off;
    find_contacts(packing);
    for (Contact<2>& c : packing.contacts) c.normal_force = 0.01;
    const SoftModes<2> soft = soft_modes(contact_network(packing), {});
    EXPECT_EQ(soft.modes[0].kind, ModeKind::mechanism);
    EXPECT_EQ(soft.modes[1].kind, ModeKind::mechanism);
    EXPECT_EQ(soft.modes[2].kind, ModeKind::near_mechanism);
    const double ratio = soft.modes[2].eigenvalue / (off * off);
    // Positions of order one have rounding errors of 1e-16. The relative error of `off` is therefore 1e-16/off, and the
    // relative error of off^2 is twice as large.
    if (ratio_before > 0.0) {
      EXPECT_NEAR(ratio / ratio_before, 1.0, 1e-4) << off;
    }
    ratio_before = ratio;
  }
}

TEST(SoftModes, MechanismsAreAsManyAsTheRankOfTheRigidityMatrixLeaves) {
  int n_mechanisms = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto law = test::elastic_law(1.0, 0.6, 0.0);
    const auto network = contact_network(test::random_packing<2>(60, seed, law, 1.4));
    const int expected = elastic_response(network, {}).n_mechanisms;
    ModeOptions options;
    options.count = expected + 3;
    int found = 0;
    for (const Mode<2>& m : soft_modes(network, options).modes) found += m.kind == ModeKind::mechanism ? 1 : 0;
    EXPECT_EQ(found, expected) << "seed " << seed;
    n_mechanisms += found;
  }
  EXPECT_GT(n_mechanisms, 20);
}

TEST(SoftModes, ParticipationOfOneGrainAgainstTheOthers) {
  // One disk of a stiff lattice has soft contacts. In the softest mode, this disk moves by 1 - 1/n and each of the
  // other n - 1 disks by -1/n.
  auto network = contact_network(test::square_frames(4, 1.0, test::elastic_law(1.0, 1.0, 1.0)));
  for (NetworkContact<2>& c : network.contacts)
    if (c.i == 2 || c.j == 2) c.kn = c.kt = c.kr = 1e-8;
  const SoftModes<2> soft = soft_modes(network, {});
  const double n = network.n_grains;
  const double sum = (n - 1.0) / n;
  const double fourth = std::pow(sum, 4) + (n - 1.0) * std::pow(n, -4);
  // The other disks move almost together. Their relative displacements are about 1e-8, the ratio of the soft to the
  // stiff stiffness.
  EXPECT_NEAR(soft.modes.front().participation, sum * sum / (n * fourth), 1e-7);
  EXPECT_EQ(soft.modes.front().grains, std::vector<int>{2});
}

TEST(SoftModes, OfNoContactsAreNone) {
  Packing<3> packing;
  packing.grains = Grains<3>::with_size(3);
  const SoftModes<3> soft = soft_modes(contact_network(packing), {});
  EXPECT_TRUE(soft.modes.empty());
  EXPECT_EQ(soft.free.count(FreeMotionKind::rattler), 18);
}

}  // namespace
}  // namespace floc
