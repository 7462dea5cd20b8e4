#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>

#include "floc/network/stiffness_matrix.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "support/contact_laws.h"
#include "support/network_packings.h"
#include "support/springs.h"

namespace floc {
namespace {

/// Returns the packing after a displacement u of its unknowns: first the displacements and rotations of the grains in
/// addition to the affine displacement, then the strains (shortening positive). The springs are initially unstretched
/// and follow the linear kinematics of docs/physics.md, "Stiffness matrix". This code is independent of the library.
template <int Dim>
Packing<Dim> displaced(const Packing<Dim>& packing, const Eigen::VectorXd& u) {
  const int n = packing.grains.size();
  Mat<Dim> strain = Mat<Dim>::Zero();
  for (int e = 0; e < u.size() - kDofs<Dim> * n; ++e) strain += u[kDofs<Dim> * n + e] * unit_strain<Dim>(e);
  const Mat<Dim> deformation = Mat<Dim>::Identity() - strain;
  Packing<Dim> out = packing;
  out.cell.matrix = packing.cell.matrix * deformation.transpose();
  for (int i = 0; i < n; ++i)
    out.grains.position[i] = deformation * packing.grains.position[i] + u.template segment<Dim>(kDofs<Dim> * i);
  for (Contact<Dim>& c : out.contacts) {
    const Vec<Dim> r = branch(packing, c);
    const double ratio = r.norm() / (packing.grains.radius[c.i] + packing.grains.radius[c.j]);
    const auto rotation = [&](int grain) {
      return RotationVector<Dim>(u.template segment<kRotations<Dim>>(kDofs<Dim> * grain + Dim));
    };
    const Vec<Dim> n_ij = r.normalized();
    const Vec<Dim> arms = ratio * (packing.grains.radius[c.i] * cross<double>(rotation(c.i), n_ij) +
                                   packing.grains.radius[c.j] * cross<double>(rotation(c.j), n_ij));
    const Vec<Dim> approach = branch(out, c) - r;
    test::shear_spring(c) = to_shear<double>(n_ij, Vec<Dim>(approach - arms));
    test::rolling_spring(c) = rolling_part<double>(n_ij, RotationVector<Dim>(rotation(c.i) - rotation(c.j)));
    if constexpr (Dim == 3) {
      if (packing.law.has_twisting()) test::twisting_spring(c) = n_ij.dot(rotation(c.i) - rotation(c.j));
    }
  }
  refresh_contacts(out);
  return out;
}

/// Returns the generalised forces that keep the packing in balance: first the force and moment on every grain; then,
/// for each strain, a sum over the contacts of the force times the branch in the packing `reference`. If `reference` is
/// the packing itself, these sums are the volume times the stress.
template <int Dim>
Eigen::VectorXd load(const Packing<Dim>& packing, const Packing<Dim>& reference, StrainSet strains) {
  const int n = packing.grains.size();
  const Balance<Dim> net = net_forces(packing);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(kDofs<Dim> * n + n_strains<Dim>(strains));
  for (int i = 0; i < n; ++i) {
    f.template segment<Dim>(kDofs<Dim> * i) = -net.force[i];
    f.template segment<kRotations<Dim>>(kDofs<Dim> * i + Dim) = -net.moment[i];
  }
  for (const Contact<Dim>& c : packing.contacts) {
    const Vec<Dim> on_j = c.normal_force * c.normal - c.shear_force;
    for (int e = 0; e < n_strains<Dim>(strains); ++e)
      f[kDofs<Dim> * n + e] += on_j.dot(unit_strain<Dim>(e) * branch(reference, c));
  }
  return f;
}

template <int Dim>
double difference_error(const Packing<Dim>& packing, StrainSet strains) {
  const Eigen::MatrixXd k = stiffness_matrix(contact_network(packing), {strains, true}).whole();
  const int n = static_cast<int>(k.rows());
  Eigen::MatrixXd differences(n, n);
  constexpr double kStep = 1e-5;
  for (int u = 0; u < n; ++u) {
    const Packing<Dim> ahead = displaced<Dim>(packing, kStep * Eigen::VectorXd::Unit(n, u));
    const Packing<Dim> behind = displaced<Dim>(packing, -kStep * Eigen::VectorXd::Unit(n, u));
    EXPECT_EQ(ahead.contacts.size(), packing.contacts.size());
    differences.col(u) = (load(ahead, packing, strains) - load(behind, packing, strains)) / (2.0 * kStep);
  }
  return (differences - k).cwiseAbs().maxCoeff() / k.cwiseAbs().maxCoeff();
}

/// Tolerance of finite differences, divided by the largest entry. The truncation error is (step/r)^2 = 1e-10, and the
/// rounding error is 1e-16/step = 1e-11.
constexpr double kDifferenceTolerance = 1e-8;

Law cohesive_law() {
  Law law = test::elastic_law(1.0, 0.7, 0.05);
  law += test::tail_adhesion(0.02, 0.08);
  return law;
}

TEST(Stiffness, IsTheDerivativeOfTheForcesIn2D) {
  for (const StrainSet strains : {StrainSet::diagonal, StrainSet::full})
    for (unsigned seed = 0; seed < 3; ++seed) {
      const auto packing = test::random_packing<2>(14, seed, cohesive_law());
      EXPECT_TRUE(std::any_of(packing.contacts.begin(), packing.contacts.end(),
                              [](const auto& c) { return c.distant; }));
      EXPECT_LT(difference_error(packing, strains), kDifferenceTolerance) << "seed " << seed;
    }
}

TEST(Stiffness, IsTheDerivativeOfTheForcesIn3D) {
  for (const StrainSet strains : {StrainSet::diagonal, StrainSet::full}) {
    const auto packing = test::random_packing<3>(10, 5, cohesive_law());
    EXPECT_LT(difference_error(packing, strains), kDifferenceTolerance);
  }
}

/// Checks the stiffness of liquid bridges for displacements in which each bridge keeps its volume.
template <int Dim>
void expect_derivative_of_bridges(const std::string& form) {
  Law law = test::elastic_law(1.0, 0.7, 0.0);
  law += test::liquid(0.01, 30.0, 5e-3, 2.5, form);
  for (unsigned seed = 0; seed < 3; ++seed) {
    const auto packing = test::random_packing<Dim>(Dim == 2 ? 14 : 10, seed, law, 1.2);
    EXPECT_GT(std::count_if(packing.contacts.begin(), packing.contacts.end(),
                            [](const auto& c) { return c.distant && c.kn < 0.0; }),
              2);
    // The force of a bridge decays within a gap of a tenth of a branch length. The truncation error is therefore a
    // hundred times larger than for contacts.
    EXPECT_LT(difference_error(packing, StrainSet::full), 100.0 * kDifferenceTolerance) << "seed " << seed;
  }
}

TEST(Stiffness, OfLiquidBridgesIsTheDerivativeOfTheForces) {
  for (const char* const form : {"exponential", "rational"}) {
    expect_derivative_of_bridges<2>(form);
    expect_derivative_of_bridges<3>(form);
  }
}

TEST(Stiffness, HoldsForGrainsThatTouchTheirOwnImages) {
  const auto two = test::random_packing<2>(2, 1, cohesive_law(), 3.0);
  const auto three = test::random_packing<3>(2, 1, cohesive_law(), 3.0);
  const auto own = [](const auto& packing) {
    return std::any_of(packing.contacts.begin(), packing.contacts.end(),
                       [](const auto& c) { return c.i == c.j; });
  };
  ASSERT_TRUE(own(two));
  ASSERT_TRUE(own(three));
  EXPECT_LT(difference_error(two, StrainSet::full), kDifferenceTolerance);
  EXPECT_LT(difference_error(three, StrainSet::full), kDifferenceTolerance);
}

/// Returns several laws. Each law makes another term of the stiffness much larger than all other terms, so that the
/// largest entries of K come from this term.
std::vector<Law> laws_by_term() {
  Law tails = test::elastic_law(1.0, 0.7, 0.05);
  tails += test::tail_adhesion(8.0, 0.08);  // F0/D0 = 100
  return {test::elastic_law(1.0, 0.0, 0.0), test::elastic_law(0.01, 1.0, 0.01),
          test::elastic_law(0.01, 0.01, 1.0), tails};
}

TEST(Stiffness, IsTheDerivativeOfTheForcesTermByTerm) {
  for (const Law& law : laws_by_term()) {
    EXPECT_LT(difference_error(test::random_packing<2>(14, 7, law), StrainSet::full), kDifferenceTolerance);
    EXPECT_LT(difference_error(test::random_packing<3>(8, 7, law), StrainSet::full), kDifferenceTolerance);
  }
}

TEST(Stiffness, IsTheDerivativeOfTheForcesOfSpheresThatResistTwisting) {
  Law twisting = test::elastic_law(0.01, 0.01, 0.0), all = test::elastic_law(1.0, 0.7, 0.05);
  twisting += test::twisting_spring(1e6, 1.0);
  all += test::twisting_spring(1e6, 0.09);
  for (const Law& law : {twisting, all})
    EXPECT_LT(difference_error(test::random_packing<3>(8, 7, law), StrainSet::full), kDifferenceTolerance);
}

/// Returns the packing with every contact twice, as if rough grains touched at two points.
template <int Dim>
Packing<Dim> doubly_in_contact(Packing<Dim> packing) {
  std::vector<Contact<Dim>> twice;
  for (Contact<Dim> c : packing.contacts)
    for (c.key = 0; c.key < 2; ++c.key) twice.push_back(c);
  packing.contacts = twice;
  return packing;
}

TEST(Stiffness, AddsUpOverSeveralContactsOfOnePair) {
  EXPECT_LT(
      difference_error(doubly_in_contact(test::random_packing<2>(14, 1, cohesive_law())), StrainSet::full),
      kDifferenceTolerance);
  EXPECT_LT(difference_error(doubly_in_contact(test::random_packing<3>(8, 3, cohesive_law())), StrainSet::full),
            kDifferenceTolerance);
}

TEST(Stiffness, OfAGrainWithHigherNumberFirstIsTheSame) {
  const auto network = contact_network(test::random_packing<2>(12, 3, cohesive_law()));
  ContactNetwork<2> turned = network;
  for (NetworkContact<2>& c : turned.contacts) {
    std::swap(c.i, c.j);
    std::swap(c.arm_i, c.arm_j);
    c.branch *= -1.0;
    c.frame *= -1.0;
  }
  const Eigen::MatrixXd k = stiffness_matrix(network, {StrainSet::full, true}).whole();
  const Eigen::MatrixXd same = stiffness_matrix(turned, {StrainSet::full, true}).whole();
  // Both matrices contain the same products, so they differ only by rounding.
  EXPECT_LT((k - same).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Stiffness, IsTheSquareOfTheRigidityMatrix) {
  const auto network = contact_network(test::random_packing<3>(8, 2, cohesive_law()));
  const Eigen::MatrixXd g = rigidity_matrix(network, StrainSet::full);
  Eigen::VectorXd k(g.rows());
  for (int c = 0; c < static_cast<int>(network.contacts.size()); ++c)
    k.segment<6>(6 * c) = row_stiffness(network.contacts[c]);
  const Eigen::MatrixXd whole = stiffness_matrix(network, {StrainSet::full, false}).whole();
  // Both matrices contain the same products, summed in another order.
  EXPECT_LT((g.transpose() * k.asDiagonal() * g - whole).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Rigidity, ScaledByTheRootsOfTheStiffnessesIsARootOfK) {
  const auto network = contact_network(test::random_packing<2>(12, 2, test::elastic_law(1.0, 0.6, 0.05)));
  const Eigen::MatrixXd root = scaled_rigidity_matrix(network, StrainSet::full);
  const Eigen::MatrixXd whole = stiffness_matrix(network, {StrainSet::full, false}).whole();
  EXPECT_LT((root.transpose() * root - whole).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Rigidity, BalancesForcesWithLoads) {
  auto packing = test::random_packing<2>(12, 3, cohesive_law());
  for (Contact<2>& c : packing.contacts) {
    test::shear_spring(c)[0] = 0.01 * c.gap;
    test::rolling_spring(c)[0] = 0.02 * c.gap;
  }
  refresh_contacts(packing);
  const auto network = contact_network(packing);
  const Eigen::MatrixXd g = rigidity_matrix(network, StrainSet::full);
  Eigen::VectorXd forces(g.rows());
  for (int c = 0; c < static_cast<int>(network.contacts.size()); ++c) {
    const NetworkContact<2>& contact = network.contacts[c];
    forces.segment<3>(3 * c) << contact.normal_force, contact.shear_force.dot(contact.frame.col(1)),
        contact.rolling_moment[0];
  }
  EXPECT_LT((g.transpose() * forces - load(packing, packing, StrainSet::full)).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace floc
