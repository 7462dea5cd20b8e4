#include "floc/structure/contact_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/structure/long_axes.h"
#include "support/rigid_states.h"

namespace floc::test {
namespace {

/// Returns the argument in [0, 1] at which an increasing function has the given value.
template <class Function>
double argument_of(const Function& f, double value) {
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (f(middle) < value ? low : high) = middle;
  }
  return low;
}

/// Returns a structure in which all contacts of a packing carry a force.
template <int Dim>
CarryingStructure all_of(const Packing<Dim>& packing) {
  CarryingStructure out;
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) out.contacts.push_back(static_cast<int>(k));
  return out;
}

Packing<2> anisotropic(double a, double b, double c) {
  Packing<2> packing;
  packing.grains = Grains<2>::with_size(2);
  constexpr int kContacts = 4000;
  for (int k = 0; k < kContacts; ++k) {
    const auto share = [&](double t) {
      return t + a * std::sin(4.0 * std::numbers::pi * t) / (4.0 * std::numbers::pi);
    };
    const double angle = 2.0 * std::numbers::pi * argument_of(share, (k + 0.5) / kContacts);
    Contact<2>& contact = packing.contacts.emplace_back();
    contact.j = 1;
    contact.normal = Vec<2>(std::cos(angle), std::sin(angle));
    contact.arm_i = 0.5 * contact.normal;
    contact.arm_j = -contact.arm_i;
    contact.normal_force = contact.elastic_force = 1.0 + b * std::cos(2.0 * angle);
    contact.shear_force = c * std::sin(2.0 * angle) * Vec<2>(-std::sin(angle), std::cos(angle));
  }
  return packing;
}

/// The directions t of the contacts have the density 1 + a cos 2t. The normal forces are 1 + b cos 2t, and the
/// tangential forces are c sin 2t. Sums over contacts are then integrals over t, and the mean normal force is 1 + ab/2.
TEST(ContactStatistics, AnisotropiesOfKnownDensities) {
  const double a = 0.4, b = 0.3, c = 0.2, mean = 1.0 + 0.5 * a * b;
  const Packing<2> packing = anisotropic(a, b, c);
  const auto found = contact_anisotropy(packing, all_of(packing));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->normals, a, 1e-6);
  EXPECT_NEAR(found->normal_force, (a + b) / mean - a, 1e-6);
  EXPECT_NEAR(found->tangential_force, c / mean, 1e-6);
  EXPECT_NEAR(found->branch_normal, 0.0, 1e-12);
  EXPECT_NEAR(found->branch_tangential, 0.0, 1e-12);
  // If all branches have the same length, the prediction has only one error: the product of the anisotropies of the
  // tangential forces and of the directions.
  EXPECT_NEAR(found->stress_ratio, 0.5 * (a + b + c) / mean, 1e-6);
  EXPECT_NEAR(found->predicted_ratio, found->stress_ratio, 1e-6);
}

TEST(ContactStatistics, IsotropicForcesHaveNoDirection) {
  const Packing<2> packing = anisotropic(0.0, 0.0, 0.0);
  EXPECT_FALSE(contact_anisotropy(packing, all_of(packing)));
}

/// The contact directions of spheres have the density 1 + a (3 cos^2 t - 1), where t is the angle to the last
/// axis.
TEST(ContactStatistics, AxialAnisotropyInSpace) {
  const double a = 0.2;
  Packing<3> packing;
  packing.grains = Grains<3>::with_size(2);
  constexpr int kPolar = 400, kAround = 8;
  for (int k = 0; k < kPolar; ++k) {
    // With cos t = 1 - 2 s, the fraction of directions with angles below t is (1 - a) s + a (1 - (1 - 2 s)^3)/2.
    const auto share = [&](double s) { return (1.0 - a) * s + 0.5 * a * (1.0 - std::pow(1.0 - 2.0 * s, 3)); };
    const double cosine = 1.0 - 2.0 * argument_of(share, (k + 0.5) / kPolar),
                 sine = std::sqrt(1.0 - cosine * cosine);
    for (int m = 0; m < kAround; ++m) {
      const double angle = 2.0 * std::numbers::pi * m / kAround;
      Contact<3>& contact = packing.contacts.emplace_back();
      contact.j = 1;
      contact.normal = Vec<3>(sine * std::cos(angle), sine * std::sin(angle), cosine);
      contact.arm_i = contact.normal;
      contact.normal_force = contact.elastic_force = 1.0;
    }
  }
  const auto found = contact_anisotropy(packing, all_of(packing));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->normals, a, 1e-4);
  // The difference of the principal stresses is 6/5 a times their mean. The stress ratio is a third of this factor.
  EXPECT_NEAR(found->stress_ratio, 0.4 * a, 1e-4);
  EXPECT_NEAR(found->predicted_ratio, found->stress_ratio, 1e-12);
}

/// The forces are quantiles of the joined form (power law and exponential) with alpha = 0.3.
TEST(ContactStatistics, RecoversTheJoinedForm) {
  const double alpha = 0.3, beta = std::sqrt((1.0 - alpha) * (2.0 - alpha));
  const double k = 1.0 / (1.0 / (1.0 - alpha) + 1.0 / beta), below = k / (1.0 - alpha);
  std::vector<double> forces;
  constexpr int kForces = 40000;
  for (int i = 0; i < kForces; ++i) {
    const double u = (i + 0.5) / kForces;
    forces.push_back(5.0 * (u < below ? std::pow(u / below, 1.0 / (1.0 - alpha))
                                      : 1.0 - std::log((1.0 - u) * beta / k) / beta));
  }
  const ForceShape shape = force_shape(forces);
  EXPECT_NEAR(shape.below_mean, beta / (beta + 1.0 - alpha), 1e-3);
  EXPECT_NEAR(*shape.alpha, alpha, 1e-3);
  EXPECT_NEAR(*shape.beta, beta, 2e-3);
  EXPECT_NEAR(*shape.beta_error, beta / std::sqrt((1.0 - below) * kForces), 1e-4);
  EXPECT_NEAR(*shape.beta2, beta, 5e-3) << "the tail is exponential";
  EXPECT_NEAR(*shape.beta2_error, beta / std::sqrt((1.0 - below) * std::exp(-beta) * kForces), 2e-4);
  EXPECT_GT(*shape.alpha_error, 0.5 / std::sqrt(kForces));
  EXPECT_LT(*shape.alpha_error, 2.0 / std::sqrt(kForces));
}

TEST(ContactStatistics, FewForcesHaveNoShape) {
  EXPECT_FALSE(force_shape({}).alpha);
  EXPECT_FALSE(force_shape({1.0, 2.0, 3.0}).beta);
  std::vector<double> few(100, 1.0);
  for (int k = 0; k < 9; ++k) few.push_back(4.0 + k);
  EXPECT_FALSE(force_shape(few).beta2) << "of nine forces beyond twice the mean";
  few.push_back(13.0);
  EXPECT_TRUE(force_shape(few).beta2);
  EXPECT_FALSE(force_shape(std::vector<double>(50, 1.0)).alpha);
}

/// Bricks that touch their six neighbours along sides, at two contact points per neighbour. The pressure is P. Each
/// point between neighbours in a row has the force P/2. Each point between neighbours in different rows, which share
/// half of a side, has the force P/4.
TEST(ContactStatistics, BricksMeetAlongSides) {
  const State<2> state = brick_bond(0.7, 0.3);
  const CarryingStructure held = carrying_structure(state.packing, 1e-6, 2);
  const ContactKinds kinds = contact_kinds(contact_pairs(state.packing, held), held.n_held());
  EXPECT_NEAR(kinds.z, 6.0, 1e-12);
  EXPECT_NEAR(kinds.share[static_cast<int>(ContactType::kFaceFace)], 1.0, 1e-12);
  EXPECT_NEAR(kinds.force[static_cast<int>(ContactType::kFaceFace)], 1.0, 1e-12);
  EXPECT_NEAR(*mean_mobilisation(state.packing, held), 0.0, 1e-15);
}

/// If only one of the two contact points between two sides has a force, the pair counts as a contact with a vertex.
TEST(ContactStatistics, KindsGoByCarryingPoints) {
  State<2> state = brick_bond(0.7, 0.3);
  state.packing.contacts[0].normal_force = state.packing.contacts[0].elastic_force = 0.0;
  const CarryingStructure held = carrying_structure(state.packing, 1e-6, 2);
  const ContactKinds kinds = contact_kinds(contact_pairs(state.packing, held), held.n_held());
  EXPECT_NEAR(kinds.share[static_cast<int>(ContactType::kVertexFace)], 1.0 / 36.0, 1e-12);
  EXPECT_NEAR(kinds.share[static_cast<int>(ContactType::kFaceFace)], 35.0 / 36.0, 1e-12);
}

TEST(LongAxes, OrderOfRectanglesAndBoxes) {
  Packing<2> flat;
  flat.grains = Grains<2>::with_size(3);
  set_shape(flat.grains, box<2>(Vec<2>(1.0, 3.0), 0.0), 1.0);
  flat.grains.orientation = {0.2, 0.2, 0.2 + std::numbers::pi};
  auto order = long_axes_order(flat);
  ASSERT_TRUE(order);
  EXPECT_EQ(order->n_grains, 3);
  EXPECT_NEAR(order->order, 1.0, 1e-12);
  EXPECT_NEAR(std::abs(order->direction.dot(Vec<2>(-std::sin(0.2), std::cos(0.2)))), 1.0, 1e-12);
  flat.grains.orientation = {0.0, std::numbers::pi / 3.0, 2.0 * std::numbers::pi / 3.0};
  EXPECT_NEAR(long_axes_order(flat)->order, 0.0, 1e-12);
  set_shape(flat.grains, box<2>(Vec<2>(1.0, 1.0), 0.0), 1.0);
  EXPECT_FALSE(long_axes_order(flat));
  // Rounding makes a rectangle of 1.3 by 1 less elongated than its core, by 1.04 in place of 1.3.
  set_shape(flat.grains, box<2>(Vec<2>(1.3, 1.0), 0.4), 1.0);
  EXPECT_FALSE(long_axes_order(flat));
  set_shape(flat.grains, capsule<2>(1.5), 1.0);
  EXPECT_TRUE(long_axes_order(flat));

  Packing<3> solid;
  solid.grains = Grains<3>::with_size(4);
  set_shape(solid.grains, box<3>(Vec<3>(1.0, 2.0, 3.0), 0.0), 1.0);
  EXPECT_NEAR(long_axes_order(solid)->order, 1.0, 1e-12);
  set_shape(solid.grains, capsule<3>(1.5), 1.0);
  EXPECT_NEAR(long_axes_order(solid)->order, 1.0, 1e-12);
  set_shape(solid.grains, box<3>(Vec<3>(3.0, 3.0, 1.0), 0.0), 1.0);  // a plate has no long axis
  EXPECT_FALSE(long_axes_order(solid));
  EXPECT_FALSE(long_axes_order(triangular_crystal(1.0, 0.0).packing));
}

}  // namespace
}  // namespace floc::test
