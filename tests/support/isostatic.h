#pragma once

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "floc/geometry/frame.h"
#include "floc/packing/contact_order.h"
#include "floc/rigid/gap_curvature.h"
#include "support/rigid_gas.h"

/// Counts the constraints in packings of rigid grains.
namespace floc::test {

/// Number of constraints of the contacts with a force, and number of motions (degrees of freedom) of the grains that
/// have such contacts.
struct ConstraintCount {
  int constraints = 0, motions = 0;
};

/// Returns the contacts with forces above 1e-6 of the mean force, in their order.
template <int Dim>
std::vector<const Contact<Dim>*> carrying_contacts(const Packing<Dim>& packing) {
  const double least = 1e-6 * mean_repulsive_force(packing);
  std::vector<const Contact<Dim>*> out;
  for (const Contact<Dim>& c : packing.contacts)
    if (c.elastic_force > least) out.push_back(&c);
  return out;
}

/// Counts the constraints of carrying_contacts(). Each contact point of a pair gives one
/// constraint, but a pair has at most two constraints for an edge on a side or face, and at most three for two faces.
template <int Dim>
ConstraintCount count_constraints(const Packing<Dim>& packing, int motions_per_grain) {
  ConstraintCount out;
  std::vector<bool> carries(packing.grains.size(), false);
  int of_pair = 0;
  const Contact<Dim>* last = nullptr;
  for (const Contact<Dim>* c : carrying_contacts(packing)) {
    carries[c->i] = carries[c->j] = true;
    of_pair = last && same_pair(*last, *c) ? of_pair + 1 : 1;
    out.constraints += of_pair <= Dim;
    last = c;
  }
  for (const bool one : carries) out.motions += one ? motions_per_grain : 0;
  // Contacts do not constrain uniform translations of all grains, but they do constrain the free side lengths of the
  // cell. The number of translations equals the number of side lengths, so the two cancel.
  return out;
}

/// Expects that frictionless rigid disks or spheres at rest are isostatic: their contacts give as many constraints as
/// the grains have translations.
template <int Dim>
void expect_isostatic() {
  constexpr int kGrains = 200;
  const RigidEnd<Dim> end = relaxed<Dim>(make_rigid_gas<Dim>({.count = kGrains}));
  expect_at_rest(end);
  const ConstraintCount count = count_constraints(end.packing, Dim);
  EXPECT_GT(count.motions, kGrains / 2 * Dim);
  EXPECT_NEAR(count.constraints, count.motions, 0.01 * count.motions + 1.0);
}

/// Second derivatives of P V at rest, along the motions that close or open no contact with a force. The grains are
/// rigid, without friction, in a periodic cell under the pressure P.
struct HeldMotions {
  /// number of independent motions that close or open no contact, without uniform translations
  int n_motions = 0;
  double least = 0.0;  ///< smallest eigenvalue of the second derivatives along these motions, divided by P
};

/// Returns the motions that contacts alone do not hold. A motion z with grad g . z = 0 for all gaps g with forces f is
/// held if the second derivative of P V - sum f g along z is positive.
template <int Dim>
HeldMotions motions_held_by_curvature(const Packing<Dim>& packing, double pressure) {
  constexpr int kDof = kDofs<Dim>;
  const std::vector<const Contact<Dim>*> carrying = carrying_contacts(packing);
  std::vector<int> first(packing.grains.size(), -1);
  int n = Dim;  // the first unknowns are the strains of the sides
  for (const Contact<Dim>* c : carrying)
    for (const int i : {c->i, c->j})
      if (first[i] < 0) first[i] = n, n += kDof;
  Eigen::MatrixXd gradients = Eigen::MatrixXd::Zero(static_cast<int>(carrying.size()), n);
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(n, n);
  for (int a = 0; a < Dim; ++a)
    for (int b = 0; b < Dim; ++b)
      if (a != b) second(a, b) = pressure * packing.cell.volume();
  for (std::size_t k = 0; k < carrying.size(); ++k) {
    const Contact<Dim>& c = *carrying[k];
    // The motion of the pair for each unknown. A strain moves the image of grain j.
    Eigen::MatrixXd pair = Eigen::MatrixXd::Zero(2 * kDof, n);
    pair.block(0, first[c.i], kDof, kDof).setIdentity();
    pair.block(kDof, first[c.j], kDof, kDof) += Eigen::MatrixXd::Identity(kDof, kDof);
    for (int a = 0; a < Dim; ++a) pair(kDof + a, a) = c.image[a] * packing.cell.matrix(a, a);
    PairMotion<Dim> gradient;
    gradient << -c.normal, -moment<double>(c.arm_i, c.normal), c.normal, moment<double>(c.arm_j, c.normal);
    gradients.row(static_cast<int>(k)) = gradient.transpose() * pair;
    second -= c.elastic_force * (pair.transpose() * gap_curvature(packing, c) * pair);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> closing(gradients.transpose() * gradients);
  const int n_free =
      static_cast<int>((closing.eigenvalues().array() < 1e-12 * closing.eigenvalues()[n - 1]).count());
  const Eigen::MatrixXd free = closing.eigenvectors().leftCols(n_free);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> along(free.transpose() * second * free);
  // Uniform translations change nothing. Their Dim eigenvalues are those nearest to zero.
  std::vector<double> values(along.eigenvalues().begin(), along.eigenvalues().end());
  std::ranges::sort(values, {}, [](double v) { return std::abs(v); });
  HeldMotions out;
  out.n_motions = n_free - Dim;
  if (out.n_motions > 0) out.least = *std::min_element(values.begin() + Dim, values.end()) / pressure;
  return out;
}

/// Counts the independent loops of grains in which neighbours touch with two sides, each with a force at both ends.
/// The sides of equal regular polygons include the same angles, so that a loop closes whatever its grains do. One of
/// its constraints on rotations then follows from the others.
inline int count_side_loops(const Packing<2>& packing) {
  std::vector<int> parent(packing.grains.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](int grain) {
    while (parent[grain] != grain) grain = parent[grain];
    return grain;
  };
  int loops = 0;
  const Contact<2>* last = nullptr;
  for (const Contact<2>* c : carrying_contacts(packing)) {
    if (last && same_pair(*last, *c)) {
      const int i = root(c->i), j = root(c->j);
      loops += i == j;
      parent[i] = j;
    }
    last = c;
  }
  return loops;
}

/// Random polyhedra have no loops of faces that close whatever their grains do.
inline int count_side_loops(const Packing<3>&) {
  return 0;
}

/// Expects that frictionless grains with corners come to rest with at most as many independent constraints as motions
/// (force balance allows one more for each set of forces without load), and with at least a share of them. All
/// constraints are independent, so that the forces are unique, but for the loops of count_side_loops(). The curvature
/// of the gaps (of crossed edges, or of a corner that turns on a side) holds the remaining motions, as that of the
/// surfaces does in packings of ellipses [DCST2007].
template <int Dim>
void expect_nearly_isostatic(const ShapeOptions& shape, int n, std::uint64_t seed, double least_share) {
  const RigidEnd<Dim> end = relaxed<Dim>(make_rigid_gas<Dim>({.count = n, .shape = shape, .seed = seed}));
  expect_at_rest(end);
  ConstraintCount count = count_constraints(end.packing, kDofs<Dim>);
  count.constraints -= count_side_loops(end.packing);
  EXPECT_GT(count.motions, n / 2 * kDofs<Dim>);
  EXPECT_LE(count.constraints, count.motions);
  EXPECT_GE(count.constraints, least_share * count.motions);
  const HeldMotions held = motions_held_by_curvature(end.packing, 1.0);
  EXPECT_EQ(held.n_motions, count.motions - count.constraints);
  EXPECT_TRUE(held.n_motions == 0 || held.least > 1e-4) << held.least;
}

}  // namespace floc::test
