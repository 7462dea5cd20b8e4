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

/// Number of constraints that the contacts with a force give, and number of motions (degrees of freedom) of the grains
/// with such contacts.
struct ConstraintCount {
  int constraints = 0, motions = 0;
};

/// Returns the contacts with elastic forces above 1e-6 times the mean force, in their order.
template <int Dim>
std::vector<const Contact<Dim>*> carrying_contacts(const Packing<Dim>& packing) {
  const double least = 1e-6 * mean_repulsive_force(packing);
  std::vector<const Contact<Dim>*> out;
  for (const Contact<Dim>& c : packing.contacts)
    if (c.elastic_force > least) out.push_back(&c);
  return out;
}

/// Counts the constraints of carrying_contacts(). Each contact point gives one constraint, but a pair of grains has at
/// most two constraints in 2D and at most three in 3D.
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
  // Two numbers are left out, because they are equal: the number of uniform translations of all grains, which contacts
  // do not constrain, and the number of side lengths of the cell, which contacts do constrain.
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

/// Motions that close or open no contact with a force, and the second derivatives of P V along these motions. The
/// packing is at rest. Its grains are rigid, without friction, in a periodic cell under the pressure P.
struct HeldMotions {
  /// number of these motions that are independent, without uniform translations
  int n_motions = 0;
  double least = 0.0;  ///< smallest eigenvalue of the second derivatives along these motions, divided by P
};

/// Returns the motions z with grad g . z = 0 for the gaps g of all contacts with a force f: to first order, the
/// contacts do not resist them. A motion is nevertheless held if the second derivative of P V - sum f g along z is
/// positive.
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

/// Counts the independent closed loops of polygons in which all neighbours touch along a side, with a force at both
/// ends of the side. If the polygons are equal and regular, their rotations along the loop always sum to a multiple of
/// the angle between two sides. One of the constraints on the rotations then follows from the others.
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

/// Random polyhedra have no such loops.
inline int count_side_loops(const Packing<3>&) {
  return 0;
}

/// Expects that frictionless grains with corners come to rest with at most as many independent constraints as motions,
/// and with at least the fraction `least_share` of this number. (The forces are then unique: force balance would allow
/// one more constraint for each set of forces that balance without a load.) The constraints are independent except for
/// those of count_side_loops(). The remaining motions are held by the curvature of the gaps, for example of two crossed
/// edges, or of a corner that turns on a side. In packings of ellipses, the curvature of the surfaces has this effect
/// [DCST2007].
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
