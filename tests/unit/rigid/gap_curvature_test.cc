#include "floc/rigid/gap_curvature.h"

#include <gtest/gtest.h>

#include "floc/base/random.h"
#include "floc/rigid/contact_points.h"
#include "support/rigid_gas.h"

namespace floc::test {
namespace {

/// Returns the packing after displacements and rotations of the two grains of a contact.
template <int Dim>
Packing<Dim> moved(Packing<Dim> packing, const Contact<Dim>& c, const PairMotion<Dim>& motion) {
  for (const int side : {0, 1}) {
    const int body = side == 0 ? c.i : c.j;
    packing.grains.position[body] += motion.template segment<Dim>(side * kDofs<Dim>);
    const RotationVector<Dim> turn = motion.template segment<kRotations<Dim>>(side * kDofs<Dim> + Dim);
    Orientation<Dim>& orientation = packing.grains.orientation[body];
    if constexpr (Dim == 2)
      orientation += turn[0];
    else
      orientation = Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) * orientation;
  }
  return packing;
}

/// Returns the gap between the features that are in contact in `of`; absent if these features no longer form a contact.
template <int Dim>
std::optional<double> gap_of(const Packing<Dim>& packing, const Contact<Dim>& of) {
  for (const Contact<Dim>& c : ContactPoints<Dim>().find(packing, 0.2))
    if (c.i == of.i && c.j == of.j && c.image == of.image && c.key == of.key) return c.gap;
  return std::nullopt;
}

/// Compares the second derivatives of the gap with second differences, for all pairs with a single contact point.
/// @return number of comparisons
template <int Dim>
int compare_with_differences(const Packing<Dim>& packing, RandomStream& random) {
  constexpr double kMotion = 1e-4;
  int n = 0;
  const std::vector<Contact<Dim>> contacts = ContactPoints<Dim>().find(packing, 0.1);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Contact<Dim>& c = contacts[k];
    const auto same = [&](const Contact<Dim>& d) { return d.i == c.i && d.j == c.j && d.image == c.image; };
    if (c.i == c.j || std::ranges::count_if(contacts, same) > 1) continue;
    // If shapes overlap deeply, other features are in contact than on touching surfaces.
    if (!packing.grains.are_round() && c.gap < 0.0) continue;
    const PairMatrix<Dim> curvature = gap_curvature(packing, c);
    for (int trial = 0; trial < 3; ++trial) {
      PairMotion<Dim> motion;
      for (double& m : motion) m = kMotion * random.uniform(-1.0, 1.0);
      const auto second_difference = [&](double part) -> std::optional<double> {
        const auto ahead = gap_of(moved(packing, c, PairMotion<Dim>(part * motion)), c),
                   back = gap_of(moved(packing, c, PairMotion<Dim>(-part * motion)), c);
        if (!ahead || !back) return std::nullopt;
        return (*ahead + *back - 2.0 * c.gap) / (part * part * kMotion * kMotion);
      };
      const auto expected = second_difference(1.0), half = second_difference(0.5);
      // If the closest features change during the motion, the gap has no second derivative.
      if (!expected || !half || std::abs(*expected - *half) > 5e-3 * curvature.norm()) continue;
      const double found = motion.dot(curvature * motion) / (kMotion * kMotion);
      EXPECT_NEAR(found, *expected, 5e-3 * curvature.norm());
      ++n;
    }
  }
  return n;
}

template <int Dim>
void expect_second_differences(const std::optional<ShapeOptions>& shape, double solid_fraction_share) {
  RandomStream random(3, 1);
  Packing<Dim> packing = make_rigid_gas<Dim>({.count = 60, .shape = shape});
  // Compresses the packing until many pairs are close to contact.
  packing.cell.matrix *= solid_fraction_share;
  for (Vec<Dim>& x : packing.grains.position) x *= solid_fraction_share;
  EXPECT_GT(compare_with_differences(packing, random), 20);
}

TEST(GapCurvature, IsTheSecondDifferenceOfTheGapOfDisksAndSpheres) {
  expect_second_differences<2>(std::nullopt, 0.8);
  expect_second_differences<3>(std::nullopt, 0.8);
}

TEST(GapCurvature, IsTheSecondDifferenceOfTheGapOfPolygonsAndCapsules) {
  for (const double rounding : {0.0, 0.1})
    expect_second_differences<2>(ShapeOptions{.kind = PolygonOptions{5}, .rounding = rounding}, 0.75);
  expect_second_differences<2>(ShapeOptions{.kind = CapsuleOptions{3.0}}, 0.75);
}

TEST(GapCurvature, IsTheSecondDifferenceOfTheGapOfPolyhedraAndCapsules) {
  for (const double rounding : {0.0, 0.1})
    expect_second_differences<3>(ShapeOptions{.kind = CutOptions{}, .rounding = rounding, .count = 5}, 0.65);
  expect_second_differences<3>(ShapeOptions{.kind = CapsuleOptions{3.0}}, 0.65);
}

}  // namespace
}  // namespace floc::test
