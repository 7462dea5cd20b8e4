#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <random>

#include "floc/network/stiffness_matrix.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_response.h"
#include "floc/packing/locate.h"
#include "support/consistent_tangent.h"
#include "support/contact_laws.h"
#include "support/network_packings.h"
#include "support/springs.h"

namespace floc {
namespace {

/// Law with low limits of the tangential force and the rolling moment. The tests stretch springs up to 1.5 times these
/// limits, so that a third of the contacts slide.
Law sliding_law(int dimension) {
  Law law = test::elastic_law(1.0, 0.7, 0.05);
  law += test::tail_adhesion(0.02, 0.08);
  law += test::changed("friction.coefficient", 0.4);
  law += test::changed("rolling.coefficient", 0.2);
  if (dimension == 3) law += test::twisting_spring(0.1, 0.08);
  return law;
}

/// Stretches the springs of touching contacts at random, up to `reach` times their limits.
template <int Dim>
void stretch(Packing<Dim>& packing, double reach, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto longest = [&](const std::string& slot) {
    return test::law_number(packing.law, slot + ".coefficient") /
           test::law_number(packing.law, slot + ".stiffness");
  };
  for (Contact<Dim>& c : packing.contacts) {
    if (c.distant) continue;
    Vec<Dim> direction;
    for (int a = 0; a < Dim; ++a) direction[a] = uniform(engine);
    const double shear_cap = longest("friction") * c.elastic_force;
    const double rotation_cap = longest("rolling") * c.elastic_force;
    test::shear_spring(c) =
        reach * uniform(engine) * shear_cap * to_shear<double>(c.normal, direction).normalized();
    RotationVector<Dim> rotation;
    for (int a = 0; a < kRotations<Dim>; ++a) rotation[a] = reach * uniform(engine) * rotation_cap;
    test::rolling_spring(c) = rolling_part<double>(c.normal, rotation);
    if constexpr (Dim == 3) {
      test::twisting_spring(c) = reach * uniform(engine) * longest("twisting") * c.elastic_force;
    }
  }
}

template <int Dim>
RotationVector<Dim> rotation_of(const Packing<Dim>& packing, const Eigen::VectorXd& u, int grain) {
  return u.segment<kRotations<Dim>>(kDofs<Dim> * grain + Dim) / packing.grains.radius[grain];
}

double twist_about(const Vec<2>&, const RotationVector<2>&) {
  return 0.0;
}
double twist_about(const Vec<3>& normal, const RotationVector<3>& rotation) {
  return normal.dot(rotation);
}

/// Returns the packing after a small displacement u of its unknowns: first the displacements and rotations
/// (times the radius) of the grains, then symmetric strains (shortening positive). Contacts move with the
/// grains.
template <int Dim>
Packing<Dim> carried_along(const Packing<Dim>& packing, const Eigen::VectorXd& u) {
  const int n = packing.grains.size();
  Mat<Dim> deformation = Mat<Dim>::Identity();
  for (int e = 0; e < kSymmetric<Dim>; ++e) deformation -= u[kDofs<Dim> * n + e] * unit_strain<Dim>(e);
  Packing<Dim> out = packing;
  out.cell.matrix = packing.cell.matrix * deformation.transpose();
  for (int i = 0; i < n; ++i)
    out.grains.position[i] = deformation * packing.grains.position[i] + u.segment<Dim>(kDofs<Dim> * i);
  std::vector<SurfaceMotion<Dim>> motion(out.contacts.size());
  const auto remembered = history_quantities(packing.law, Dim);
  for (std::size_t k = 0; k < out.contacts.size(); ++k) {
    Contact<Dim>& c = out.contacts[k];
    const double radii = packing.grains.radius[c.i] + packing.grains.radius[c.j];
    const RotationVector<Dim> rotation_i = rotation_of(packing, u, c.i),
                              rotation_j = rotation_of(packing, u, c.j);
    const Vec<Dim> r = branch(out, c);
    const Vec<Dim> normal = r.normalized();
    const RotationVector<Dim> mean =
        (packing.grains.radius[c.i] * rotation_i + packing.grains.radius[c.j] * rotation_j) / radii;
    c.gap = r.norm() - radii;
    transport_history<Dim>(remembered, normal,
                           twist_about(normal, RotationVector<Dim>(0.5 * (rotation_i + rotation_j))), c,
                           motion[k]);
    motion[k].slip = to_shear<double>(normal, Vec<Dim>(r - branch(packing, c) - cross<double>(mean, r)));
    motion[k].relative_rotation = rolling_part<double>(normal, RotationVector<Dim>(rotation_i - rotation_j));
    motion[k].twist = twist_about(normal, RotationVector<Dim>(rotation_i - rotation_j));
  }
  set_arms(out);
  respond<Dim>(out, motion, out.contacts);
  return out;
}

/// Returns a vector with three parts: minus the forces on the grains; minus the moments on the grains divided by the
/// radius; and the stress conjugate to each strain times the volume.
template <int Dim>
Eigen::VectorXd load(const Packing<Dim>& packing) {
  const int n = packing.grains.size();
  const Balance<Dim> net = net_forces(packing);
  Eigen::VectorXd f(kDofs<Dim> * n + kSymmetric<Dim>);
  for (int i = 0; i < n; ++i) {
    f.segment<Dim>(kDofs<Dim> * i) = -net.force[i];
    f.segment<kRotations<Dim>>(kDofs<Dim> * i + Dim) = -net.moment[i] / packing.grains.radius[i];
  }
  const Mat<Dim> virial = static_stress(packing) * packing.cell.volume();
  for (int e = 0; e < kSymmetric<Dim>; ++e)
    f[kDofs<Dim> * n + e] = (virial.transpose() * unit_strain<Dim>(e)).trace();
  return f;
}

template <int Dim>
Eigen::MatrixXd tangent_of(const Packing<Dim>& packing) {
  return test::consistent_tangent(packing, kSymmetric<Dim>);
}

template <int Dim>
double difference_error(const Packing<Dim>& packing) {
  const Eigen::MatrixXd k = tangent_of(packing);
  const int n = static_cast<int>(k.rows());
  Eigen::MatrixXd differences(n, n);
  constexpr double kStep = 1e-6;
  for (int u = 0; u < n; ++u) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(n, u);
    differences.col(u) =
        (load(carried_along<Dim>(packing, step)) - load(carried_along<Dim>(packing, -step))) / (2.0 * kStep);
  }
  return (differences - k).cwiseAbs().maxCoeff() / k.cwiseAbs().maxCoeff();
}

/// Tolerance of finite differences, divided by the largest entry. The rounding error is 1e-16/step = 1e-10. If the
/// direction of sliding rotates, the truncation error is the squared ratio of the step to the elongation of the spring.
/// The smallest elongations of springs at their limit are about 1e-3.
constexpr double kTangentTolerance = 1e-7;

template <int Dim>
Packing<Dim> stretched_packing(int n_grains, unsigned seed, double reach) {
  Packing<Dim> packing = test::random_packing<Dim>(n_grains, seed, sliding_law(Dim));
  stretch(packing, reach, seed);
  return packing;
}

template <int Dim>
void expect_to_differ_from_the_symmetric_form(const Packing<Dim>& packing) {
  const Eigen::MatrixXd k = tangent_of(packing);
  EXPECT_GT((k - k.transpose()).cwiseAbs().maxCoeff(), 1e-3 * k.cwiseAbs().maxCoeff());
}

TEST(Tangent, IsTheDerivativeOfTheForcesWhereContactsStick) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const auto plane = stretched_packing<2>(14, seed, 0.5);
    const auto space = stretched_packing<3>(8, seed, 0.5);
    expect_to_differ_from_the_symmetric_form(plane);
    EXPECT_LT(difference_error(plane), kTangentTolerance) << seed;
    EXPECT_LT(difference_error(space), kTangentTolerance) << seed;
  }
}

TEST(Tangent, IsTheDerivativeOfTheForcesWhereContactsSlideAndYield) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    EXPECT_LT(difference_error(stretched_packing<2>(14, seed, 3.0)), kTangentTolerance) << seed;
    EXPECT_LT(difference_error(stretched_packing<3>(8, seed, 3.0)), kTangentTolerance) << seed;
  }
}

TEST(Tangent, HoldsForGrainsThatTouchTheirOwnImages) {
  auto packing = test::random_packing<3>(2, 1, sliding_law(3), 3.0);
  ASSERT_TRUE(
      std::any_of(packing.contacts.begin(), packing.contacts.end(), [](auto& c) { return c.i == c.j; }));
  stretch(packing, 2.0, 1);
  EXPECT_LT(difference_error(packing), kTangentTolerance);
}

/// Checks each contact of a packing alone, so that large terms of other contacts cannot hide an error.
template <int Dim>
void expect_each_contact(const Packing<Dim>& packing) {
  for (const Contact<Dim>& c : packing.contacts) {
    Packing<Dim> one = packing;
    one.contacts = {c};
    EXPECT_LT(difference_error(one), kTangentTolerance) << c.i << " " << c.j;
  }
}

TEST(Tangent, IsTheDerivativeContactByContact) {
  expect_each_contact(stretched_packing<2>(4, 2, 2.0));
  expect_each_contact(stretched_packing<3>(4, 2, 2.0));
}

TEST(Tangent, WithoutTangentialForcesIsTheSymmetricStiffness) {
  const auto packing = test::random_packing<2>(14, 4, sliding_law(2));
  const Eigen::MatrixXd k = tangent_of(packing);
  const Eigen::Index n = k.rows() - kSymmetric<2>;
  EXPECT_LT((k - k.transpose()).topLeftCorner(n, n).cwiseAbs().maxCoeff(), 1e-14);
}

/// If no contact slides, the symmetric part of the tangent matrix must equal the stiffness matrix that is used to test
/// stability.
template <int Dim>
void expect_symmetric_part(const Packing<Dim>& packing) {
  const ContactNetwork<Dim> network = contact_network(test::at_rest(packing));
  const Eigen::MatrixXd grains = stiffness_matrix(network, {StrainSet::full, true, false, true}).whole();
  const Eigen::MatrixXd tangent = tangent_of(packing);
  const int n = kDofs<Dim> * network.n_grains;
  Eigen::VectorXd size = Eigen::VectorXd::Ones(n);
  for (int i = 0; i < network.n_grains; ++i)
    size.segment<kRotations<Dim>>(kDofs<Dim> * i + Dim).setConstant(packing.grains.radius[i]);
  const Eigen::MatrixXd scaled = size.asDiagonal() * tangent.topLeftCorner(n, n) * size.asDiagonal();
  const Eigen::MatrixXd expected = 0.5 * (scaled + scaled.transpose());
  EXPECT_LT((grains.topLeftCorner(n, n) - expected).cwiseAbs().maxCoeff(),
            1e-12 * expected.cwiseAbs().maxCoeff());
  EXPECT_GT((scaled - expected).cwiseAbs().maxCoeff(), 1e-3 * expected.cwiseAbs().maxCoeff());
}

TEST(StiffnessOfAllForces, IsTheSymmetricPartOfTheTangentOfGrains) {
  for (const unsigned seed : {1u, 2u}) {
    expect_symmetric_part<2>(stretched_packing<2>(14, seed, 0.5));
    expect_symmetric_part<3>(stretched_packing<3>(8, seed, 0.5));
  }
}

}  // namespace
}  // namespace floc
