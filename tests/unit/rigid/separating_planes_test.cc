#include "floc/rigid/separating_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "floc/base/random.h"
#include "floc/rigid/contact_points.h"
#include "support/rigid_gas.h"

namespace floc::test {
namespace {

constexpr double kReach = 0.2;

ShapeOptions stones(double rounding) {
  return {.kind = CutOptions{}, .rounding = rounding};
}

Packing<3> moved(Packing<3> packing, const Eigen::VectorXd& step, double growth) {
  for (int i = 0; i < packing.grains.size(); ++i) {
    packing.grains.scale[i] *= 1.0 + growth;
    packing.grains.radius[i] *= 1.0 + growth;
    const int at = PlaneUnknowns::of_grain(i);
    const Vec<3> stretch = step.tail<3>();
    packing.grains.position[i] =
        packing.grains.position[i].cwiseProduct(Vec<3>::Ones() + stretch) + step.segment<3>(at);
    const Vec<3> turn = step.segment<3>(at + 3);
    packing.grains.orientation[i] =
        Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * packing.grains.orientation[i];
  }
  return packing;
}

TEST(SeparatingPlanes, LieBetweenAllNearPairs) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Packing<3> packing = make_dense_gas({.count = 8, .shape = stones(0.0), .seed = seed});
    const GrainVertices vertices(packing.grains);
    const PlaneUnknowns unknowns(packing, pressure_on_all_sides(1.0));
    const std::vector<SeparatingPlane> planes = separating_planes(packing, vertices, unknowns, kReach, {});
    ASSERT_GT(planes.size(), 5u);
    for (const Contact<3>& c : ContactPoints<3>().find(packing, kReach)) {
      const SeparatingPlane* plane = plane_of(c, planes);
      ASSERT_NE(plane, nullptr);
      const auto first_of_second = plane->gap.begin() + static_cast<std::ptrdiff_t>(vertices.of(c.i).size());
      const double gap = *std::min_element(plane->gap.begin(), first_of_second) +
                         *std::min_element(first_of_second, plane->gap.end());
      EXPECT_GT(*std::ranges::min_element(plane->gap), 0.0);
      EXPECT_LE(gap, c.gap + 1e-12);
    }
  }
}

/// Compares the first and second derivatives of the gaps with differences, for random steps of all unknowns with and
/// without growth of the grains.
TEST(SeparatingPlanes, HaveTheDerivativesOfTheirGaps) {
  constexpr double kStep = 1e-4, kMu = 0.3;
  RandomStream random(1, 1);
  for (const auto& [rounding, growth] : {std::pair(0.0, 0.0), {0.1, 0.0}, {0.0, 0.7}, {0.1, 0.7}}) {
    const Packing<3> packing = make_dense_gas({.count = 8, .shape = stones(rounding), .seed = 4});
    const GrainVertices vertices(packing.grains);
    const PlaneUnknowns unknowns(packing, pressure_on_all_sides(1.0));
    for (SeparatingPlane plane : separating_planes(packing, vertices, unknowns, kReach, {})) {
      Eigen::VectorXd step(unknowns.n);
      for (double& s : step) s = random.uniform(-1.0, 1.0);
      PlaneVector own;
      for (int a = 0; a < kPairUnknowns; ++a) own[a] = step[plane.unknown[a]];
      for (int a = 0; a < kPlaneUnknowns; ++a) own[kPairUnknowns + a] = random.uniform(-1.0, 1.0);
      const auto gaps_after = [&](double part) {
        const GrainVertices there(moved(packing, part * step, part * growth).grains);
        return moved_plane(plane, step, own, part, there).gap;
      };
      const std::vector<double> ahead = gaps_after(kStep), back = gaps_after(-kStep);
      const std::vector<double> changes = gap_changes(vertices, plane, own, growth);
      const std::vector<double> by_motion = gap_changes(vertices, plane, own, 0.0);
      double expected = 0.0, first_order = 0.0, work = 0.0;
      for (std::size_t v = 0; v < plane.gap.size(); ++v) {
        EXPECT_NEAR(changes[v], (ahead[v] - back[v]) / (2.0 * kStep), 1e-6);
        const double multiplier = plane.multiplier.emplace_back(random.uniform(0.5, 1.5));
        expected -= multiplier * (ahead[v] + back[v] - 2.0 * plane.gap[v]) / (kStep * kStep);
        first_order += multiplier / plane.gap[v] * by_motion[v] * by_motion[v];
        work += (kMu - multiplier * (changes[v] - by_motion[v])) / plane.gap[v] * by_motion[v];
      }
      PlaneMatrix matrix = PlaneMatrix::Zero();
      PlaneVector load = PlaneVector::Zero();
      add_gaps(vertices, plane, {.mu = kMu, .weak = 0.0, .growth = growth}, matrix, load);
      // The matrix has no terms of the growth.
      if (growth == 0.0) {
        EXPECT_NEAR(own.dot(matrix * own), first_order + expected, 1e-5 * first_order + 1e-4);
      }
      EXPECT_NEAR(load.dot(own), work, 1e-9 * std::abs(work) + 1e-9);
    }
  }
}

}  // namespace
}  // namespace floc::test
