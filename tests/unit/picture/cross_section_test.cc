#include "floc/picture/cross_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/picture/sheet.h"
#include "floc/shape/generators.h"
#include "support/outline_area.h"
#include "support/pixels.h"
#include "support/plain_png.h"

namespace floc {
namespace {

using test::area_of;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Mat<3> turned(double angle, const Vec<3>& about) {
  return Eigen::AngleAxisd(angle, about.normalized()).toRotationMatrix();
}

/// Returns shapes of all kinds: sharp, rounded, capsules, a ball.
std::vector<Shape<3>> shapes_of_all_kinds() {
  return {box<3>({1.0, 2.0, 3.0}, 0.0), box<3>({1.0, 2.0, 3.0}, 0.1), capsule<3>(3.0),
          box<3>({1.0, 1.0, 1.0}, 0.4), round_shape<3>(0.5)};
}

/// Returns a picture of one grain of each shape, in a slanted cell that is smaller than some grains.
PackingPicture<3> picture_in_slanted_cell(const std::vector<Shape<3>>& shapes) {
  PackingPicture<3> picture;
  picture.cell.matrix << 1.5, 0.0, 0.0, 0.4, 1.2, 0.0, -0.3, 0.2, 0.9;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    picture.position.emplace_back(0.1 * static_cast<double>(i), 1.1, 0.4);
    picture.shape.push_back({&shapes[i], 1.3, turned(0.7 + static_cast<double>(i), {1.0, 2.0, -1.0})});
    picture.radius.push_back(1.3 * shapes[i].outer_radius);
    picture.shade.value.push_back(static_cast<double>(i));
  }
  return picture;
}

TEST(CrossSection, AreasAddUpToTheVolumesOfTheGrains) {
  // Cavalieri's principle, in a slanted cell, for each cell vector. The polygons in place of rounded sections are up to
  // 0.2 % smaller.
  const std::vector<Shape<3>> shapes = shapes_of_all_kinds();
  const PackingPicture<3> picture = picture_in_slanted_cell(shapes);
  constexpr int kPlanes = 400;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> volume(shapes.size(), 0.0);
    for (int k = 0; k < kPlanes; ++k) {
      const auto section = cross_section(picture, {axis, (k + 0.5) / kPlanes});
      const double distance =
          std::abs(picture.cell.matrix.determinant() / section.cell.matrix.determinant()) / kPlanes;
      ASSERT_THAT(section.outline, SizeIs(section.position.size()));
      for (std::size_t n = 0; n < section.outline.size(); ++n)
        volume[static_cast<std::size_t>(section.shade.value[n])] += distance * area_of(section.outline[n]);
    }
    for (std::size_t i = 0; i < shapes.size(); ++i)
      EXPECT_NEAR(volume[i] / (std::pow(1.3, 3) * shapes[i].volume), 1.0, 2e-3) << axis << ' ' << i;
  }
}

TEST(CrossSection, CornersOfRoundedShapesLieOnTheirSurface) {
  const Shape<3> bar = capsule<3>(2.0);
  const PlacedShape<3> placed = {&bar, 1.0, Vec<3>(0.2, 0.1, 0.15), turned(0.4, {1.0, -2.0, 0.5})};
  const Vec<3> from = placed.position + placed.rotation * bar.vertices[0];
  const Vec<3> to = placed.position + placed.rotation * bar.vertices[1];
  const Outline outline = section_outline(placed);
  ASSERT_THAT(outline.corners, SizeIs(kSectionCorners));
  for (const OutlineCorner& corner : outline.corners) {
    const Vec<3> x(corner.centre[0], corner.centre[1], 0.0);
    const double t = std::clamp((x - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    EXPECT_NEAR((x - from - t * (to - from)).norm(), bar.rounding, 1e-12);
  }
}

TEST(CrossSection, OfACubeIsASquareAtItsCoordinates) {
  const Shape<3> cube = box<3>({1.0, 1.0, 1.0}, 0.0);
  const double side = 2.0 * cube.vertices[0].cwiseAbs().maxCoeff();
  PackingPicture<3> picture;
  picture.cell.matrix = Vec<3>(4.0, 5.0, 6.0).asDiagonal();
  picture.position = {{1.0, 2.0, 3.0}};
  picture.radius = {cube.outer_radius};
  picture.shape = {{&cube}};
  const std::pair<CrossSection, Vec<2>> planes[] = {
      {{0, 0.26}, {2.0, 3.0}}, {{1, 0.41}, {1.0, 3.0}}, {{2, 0.51}, {1.0, 2.0}}};
  for (const auto& [plane, centre] : planes) {
    const PackingPicture<2> section = cross_section(picture, plane);
    ASSERT_THAT(section.outline, SizeIs(1));
    EXPECT_TRUE(section.position[0].isApprox(centre));
    EXPECT_EQ(section.cell.matrix(0, 0), picture.cell.matrix(plane.right(), plane.right()));
    EXPECT_EQ(section.cell.matrix(1, 1), picture.cell.matrix(plane.up(), plane.up()));
    EXPECT_NEAR(area_of(section.outline[0]), side * side, 1e-12);
    for (const OutlineCorner& corner : section.outline[0].corners)
      EXPECT_NEAR((corner.centre - centre).cwiseAbs().maxCoeff(), 0.5 * side, 1e-12);
    EXPECT_THAT(cross_section(picture, {plane.axis, 0.9}).outline, IsEmpty());
  }
}

TEST(CrossSection, IsDrawnWithItsPeriodicCopies) {
  // The centre of the ball is at a corner of the cell, and the plane lies just below the upper face of the cell.
  PackingPicture<3> picture;
  picture.cell.matrix *= 4.0;
  picture.position = {{0.0, 0.0, 0.0}};
  picture.radius = {0.5};
  const PackingPicture<2> section = cross_section(picture, {2, 0.925});
  ASSERT_THAT(section.outline, SizeIs(1));
  EXPECT_NEAR(section.outline[0].radius, 0.4, 1e-12);
  const test::Pixels pixels(draw_sheet<2>({section}, test::plain_png()));
  for (const int x : {8, 401})
    for (const int y : {8, 401}) EXPECT_EQ(pixels.rgb(x, y), test::rgb_of(palette::kGrain)) << x << ' ' << y;
  EXPECT_EQ(pixels.rgb(205, 205), 0xFFFFFF);
}

TEST(CrossSection, PlanesOutsideTheCellAreErrors) {
  EXPECT_THAT((CrossSection{1, 0.0}).validate(), IsEmpty());
  for (const CrossSection& plane : {CrossSection{3, 0.5}, CrossSection{0, 1.1}, CrossSection{2, std::nan("")}})
    EXPECT_THAT(plane.validate(), SizeIs(1));
}

}  // namespace
}  // namespace floc
