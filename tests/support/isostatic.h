#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "support/rigid_gas.h"

/// Counts the constraints in packings of rigid grains.
namespace floc::test {

/// Number of constraints of the contacts with a force, and number of motions (degrees of freedom) of the grains that
/// have such contacts.
struct ConstraintCount {
  int constraints = 0, motions = 0;
};

/// Counts the constraints of contacts with forces above 1e-6 of the mean force. Each contact point of a pair gives one
/// constraint, but a pair has at most two constraints for an edge on a side or face, and at most three for two faces.
template <int Dim>
ConstraintCount count_constraints(const Packing<Dim>& packing, int motions_per_grain) {
  double mean = 0.0;
  for (const Contact<Dim>& c : packing.contacts)
    mean += c.elastic_force / static_cast<double>(packing.contacts.size());
  ConstraintCount out;
  std::vector<bool> carries(packing.grains.size(), false);
  int of_pair = 0;
  const Contact<Dim>* last = nullptr;
  for (const Contact<Dim>& c : packing.contacts) {
    if (!(c.elastic_force > 1e-6 * mean)) continue;
    carries[c.i] = carries[c.j] = true;
    const bool same = last && last->i == c.i && last->j == c.j && last->image == c.image;
    of_pair = same ? of_pair + 1 : 1;
    out.constraints += of_pair <= Dim;
    last = &c;
  }
  for (const bool one : carries) out.motions += one ? motions_per_grain : 0;
  // Contacts do not constrain uniform translations of all grains, but they do constrain the free side lengths of the
  // cell. The number of translations equals the number of side lengths, so the two cancel.
  return out;
}

/// Expects that frictionless rigid grains at rest are isostatic: their contacts give as many constraints as the
/// grains have motions.
template <int Dim>
void expect_isostatic(const std::optional<ShapeOptions>& shape, int motions_per_grain, int n = 200) {
  const RigidEnd<Dim> end = relaxed<Dim>(make_rigid_gas<Dim>({.count = n, .shape = shape}));
  expect_at_rest(end);
  const ConstraintCount count = count_constraints(end.packing, motions_per_grain);
  EXPECT_GT(count.motions, n / 2 * motions_per_grain);
  EXPECT_NEAR(count.constraints, count.motions, 0.01 * count.motions + 1.0);
}

/// Expects that frictionless polyhedra come to rest with at most as many constraints as motions (force balance allows one
/// more for each set of forces without load, which random packings do not have), and with at least a share of them. The
/// curvature of the gaps of crossed edges holds the remaining motions, as that of the surfaces does in packings of
/// ellipses [DCST2007].
inline void expect_nearly_isostatic(int n, std::uint64_t seed, double least_share) {
  const RigidEnd<3> end =
      relaxed<3>(make_rigid_gas<3>({.count = n, .shape = ShapeOptions{.kind = CutOptions{}}, .seed = seed}));
  expect_at_rest(end);
  const ConstraintCount count = count_constraints(end.packing, 6);
  EXPECT_GT(count.motions, 3 * n);
  EXPECT_LE(count.constraints, count.motions);
  EXPECT_GE(count.constraints, least_share * count.motions);
}

}  // namespace floc::test
