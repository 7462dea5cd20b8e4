#include "floc/structure/rigid_clusters.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "floc/base/disjoint_sets.h"
#include "floc/base/range.h"
#include "floc/packing/grain_sizes.h"

namespace floc {
namespace {

/// Returns the rotation of a grain from the state before to the state after.
/// @param before, after  orientations of the grain
Eigen::Rotation2Dd rotation_of(double before, double after) {
  return Eigen::Rotation2Dd(after - before);
}
Eigen::Quaterniond rotation_of(const Eigen::Quaterniond& before, const Eigen::Quaterniond& after) {
  return after * before.conjugate();
}

double angle_between(const Eigen::Rotation2Dd& p, const Eigen::Rotation2Dd& q) {
  return std::abs(std::remainder(p.angle() - q.angle(), 2.0 * std::numbers::pi));
}
double angle_between(const Eigen::Quaterniond& p, const Eigen::Quaterniond& q) {
  return p.angularDistance(q);
}

/// Returns the branch vector, in the state after, of a contact that exists in both states.
/// @param before  the contact in the state before; the branch vector points from its grain i to its grain j
/// @param c       the contact in the state after
template <int Dim>
Vec<Dim> branch_after(const Packing<Dim>& after, const Contact<Dim>& before, const Contact<Dim>& c) {
  const Vec<Dim> r = branch(after, c);
  return c.i == before.i ? r : Vec<Dim>(-r);
}

template <int Dim>
bool stuck(const Packing<Dim>& before, const Packing<Dim>& after, const KeptContact& kept, double length,
           double angle) {
  const Contact<Dim>& c = before.contacts[kept.before];
  const Vec<Dim> r = branch(before, c);
  const double share_i = before.grains.radius[c.i] / (before.grains.radius[c.i] + before.grains.radius[c.j]);
  const bool round = before.grains.are_round();
  const Vec<Dim> arm_i = round ? Vec<Dim>(share_i * r) : c.arm_i,
                 arm_j = round ? Vec<Dim>((share_i - 1.0) * r) : c.arm_j;
  const auto rotation_i = rotation_of(before.grains.orientation[c.i], after.grains.orientation[c.i]);
  const auto rotation_j = rotation_of(before.grains.orientation[c.j], after.grains.orientation[c.j]);
  const Vec<Dim> point_of_i = rotation_i * arm_i;
  const Vec<Dim> point_of_j = branch_after(after, c, after.contacts[kept.after]) + rotation_j * arm_j;
  return (point_of_j - point_of_i).norm() <= length && angle_between(rotation_i, rotation_j) <= angle;
}

}  // namespace

int RigidClusters::n_clustered() const {
  return std::accumulate(size.begin(), size.end(), 0);
}

template <int Dim>
RigidClusters rigid_clusters(const Packing<Dim>& before, const Packing<Dim>& after,
                             const ContactChanges<Dim>& changes, double tolerance) {
  require_in_range("rigid_tolerance", tolerance, kPositiveNumber);
  RigidClusters out;
  const int n = before.grains.size();
  if (n == 0) return out;
  const double a = largest_diameter(before.grains);
  DisjointSets sets(n);
  for (const KeptContact& kept : changes.kept) {
    if (!stuck(before, after, kept, tolerance * a, tolerance)) continue;
    ++out.n_stuck;
    sets.join(before.contacts[kept.before].i, before.contacts[kept.before].j);
  }
  std::vector<int> root;
  for (int i = 0; i < n; ++i) root.push_back(sets.root(i));
  std::vector<int> count(n, 0);
  for (const int r : root) ++count[r];
  std::vector<int> order;
  for (int r = 0; r < n; ++r)
    if (count[r] > 1) order.push_back(r);
  std::stable_sort(order.begin(), order.end(), [&](int p, int q) { return count[p] > count[q]; });
  std::vector<int> number(n, -1);
  for (const int r : order) number[r] = static_cast<int>(out.size.size()), out.size.push_back(count[r]);
  for (const int r : root) out.cluster.push_back(number[r]);
  return out;
}

template RigidClusters rigid_clusters(const Packing<2>&, const Packing<2>&, const ContactChanges<2>&, double);
template RigidClusters rigid_clusters(const Packing<3>&, const Packing<3>&, const ContactChanges<3>&, double);

}  // namespace floc
