#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floc/picture/change_picture.h"
#include "floc/picture/force_picture.h"
#include "floc/picture/pressure_picture.h"
#include "floc/picture/seen_packing.h"
#include "floc/picture/sheet.h"
#include "floc/shape/generators.h"
#include "floc/structure/contact_changes.h"
#include "support/network_packings.h"
#include "support/pixels.h"
#include "support/plain_png.h"

namespace floc {
namespace {

using test::Pixels;
using test::rgb_of;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Returns unrotated grains of the given shapes, magnified by `scale`, in a cell of side 4.
template <int Dim>
Packing<Dim> packing_of(const std::vector<Shape<Dim>>& shapes, const std::vector<Vec<Dim>>& position,
                        double scale) {
  const auto n = static_cast<int>(position.size());
  Packing<Dim> packing;
  packing.cell.matrix *= 4.0;
  packing.law = test::elastic_law(1.0, 0.5, 0.0);
  packing.grains = Grains<Dim>::with_size(n);
  packing.grains.position = position;
  packing.grains.shapes = std::make_shared<std::vector<Shape<Dim>>>(shapes);
  for (int i = 0; i < n; ++i) {
    packing.grains.shape.push_back(i % static_cast<int>(shapes.size()));
    packing.grains.scale.push_back(scale);
    packing.grains.radius[i] = scale * shapes[packing.grains.shape[i]].outer_radius;
    packing.grains.mass[i] = 1.0;
  }
  return packing;
}

/// Returns a contact of grains i and j.
/// @param arm  vector from the centre of i to the contact point
template <int Dim>
Contact<Dim> contact_at(const Packing<Dim>& packing, int i, int j, const Vec<Dim>& arm) {
  Contact<Dim> c;
  c.i = i;
  c.j = j;
  c.arm_i = arm;
  if (!packing.is_wall(j)) c.arm_j = arm - branch(packing, c);
  c.normal = arm.normalized();
  c.normal_force = 1.0;
  c.elastic_force = 1.0;
  return c;
}

/// Returns two pentagons and a disk in a row. One contact is between the pentagons, and one is across the cell
/// boundary.
Packing<2> pentagons() {
  Packing<2> packing = packing_of<2>({regular_polygon(5, 0.0), regular_polygon(5, 0.1), round_shape<2>(0.5)},
                                     {{0.7, 1.0}, {2.0, 1.0}, {3.3, 1.0}}, 1.2);
  packing.contacts = {contact_at<2>(packing, 0, 1, {0.6, 0.3})};
  Contact<2> across = contact_at<2>(packing, 0, 2, {-0.6, 0.2});
  across.image = {-1, 0};
  packing.contacts.push_back(across);
  return packing;
}

/// Returns eight cubes with one contact between two of them.
Packing<3> cubes() {
  std::vector<Vec<3>> positions;
  for (const double x : {1.0, 3.0})
    for (const double y : {1.0, 3.0})
      for (const double z : {1.0, 3.0}) positions.emplace_back(x, y, z);
  Packing<3> packing = packing_of<3>({box<3>({1.0, 1.0, 1.0}, 0.0)}, positions, std::sqrt(3.0));
  packing.contacts = {contact_at<3>(packing, 0, 1, {0.2, 0.1, 1.0})};
  return packing;
}

/// Returns the area (length^2) that has the blue of the end of the colour scale. Pixels at edges have mixed colours and
/// count in part.
double blue_area(const std::string& png, double pixels_per_length) {
  const Pixels pixels(png);
  const int red = rgb_of(palette::diverging(1.0)) >> 16;
  double n = 0.0;
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) n += (255.0 - (pixels.rgb(x, y) >> 16)) / (255.0 - red);
  return n / (pixels_per_length * pixels_per_length);
}

/// Whether all pixels in a margin along the edges of the picture are white.
bool is_white_outside(const Pixels& pixels, int margin) {
  for (int y = 0; y < pixels.height(); ++y)
    for (int x = 0; x < pixels.width(); ++x) {
      const bool outside =
          x < margin || y < margin || x >= pixels.width() - margin || y >= pixels.height() - margin;
      if (outside && pixels.rgb(x, y) != 0xFFFFFF) return false;
    }
  return true;
}

TEST(GrainsOf, HaveTheShapesOfThePacking) {
  const PackingPicture<2> picture = grains_of(pentagons());
  ASSERT_EQ(picture.shape.size(), 3u);
  EXPECT_FALSE(picture.is_round(0));
  EXPECT_TRUE(picture.is_round(2));
  EXPECT_EQ(picture.shape[1].scale, 1.2);
  EXPECT_TRUE(grains_of(Packing<2>()).shape.empty());
}

TEST(ContactLine, BendsAtTheContactPointOfGrainsWithCorners) {
  const Packing<2> packing = pentagons();
  const ContactLine<2> line = contact_line(packing, packing.contacts[1], LineKind::tension, 2.0);
  EXPECT_EQ(line.from, Vec<2>(0.7, 1.0));
  ASSERT_TRUE(line.through);
  EXPECT_TRUE(line.through->isApprox(Vec<2>(0.1, 1.2)));
  EXPECT_TRUE(line.to.isApprox(Vec<2>(-0.7, 1.0)));
  Packing<2> round = packing;
  round.grains.shapes = nullptr;
  EXPECT_FALSE(contact_line(round, packing.contacts[1], LineKind::tension, 2.0).through);
}

TEST(ContactLine, EndsAtTheContactPointOnAWall) {
  Packing<2> packing = pentagons();
  packing.walls.resize(2);
  packing.walls[0].axis = packing.walls[1].axis = 1;
  packing.walls[0].side = -1;
  const ContactLine<2> line =
      contact_line(packing, contact_at<2>(packing, 0, 3, {0.3, -1.0}), LineKind::compression, 1.0);
  EXPECT_FALSE(line.through);
  EXPECT_TRUE(line.to.isApprox(Vec<2>(1.0, 0.0)));
}

TEST(SheetOfShapes, DrawnAreasAreThoseOfTheShapes) {
  for (const Shape<2>& shape : {regular_polygon(5, 0.0), regular_polygon(3, 0.15), box<2>({3.0, 1.0}, 0.1),
                                capsule<2>(3.0), round_shape<2>(0.5)})
    for (const double angle : {0.0, 1.0}) {
      Packing<2> packing = packing_of<2>({shape}, {{1.0, 2.0}}, 3.0);
      packing.grains.orientation[0] = angle;
      PackingPicture<2> picture = grains_of(packing);
      picture.shade.value = {1.0};
      SheetOptions options = test::plain_png();
      options.resolution = 144.0;
      // Two lines change the blue area: the outline of the shape, of which half the width of 0.6 points lies outside
      // the shape, and the border of the cell, which is 0.5 points wide.
      const double area = blue_area(draw_sheet<2>({picture}, options), 200.0);
      EXPECT_NEAR(area, 9.0 * shape.volume, 0.1) << angle;
    }
}

TEST(SheetOfShapes, CornersAreAtTheirCoordinates) {
  // A unit square from (1.5, 1.5) to (2.5, 2.5), with 100 points per length. The y axis of the page points
  // down.
  Packing<2> packing = packing_of<2>({box<2>({1.0, 1.0}, 0.0)}, {{2.0, 2.0}}, std::sqrt(2.0));
  SheetOptions options = test::plain_png();
  options.format = PictureFormat::svg;
  const std::string sharp = draw_sheet<2>({grains_of(packing)}, options);
  for (const char* corner : {"155 155 ", "255 155 ", "255 255 ", "155 255 "})
    EXPECT_THAT(sharp, HasSubstr(corner));
  EXPECT_THAT(sharp, Not(HasSubstr(" C ")));
  // After a rotation by 45 degrees, the corners lie straight above, below and beside the centre of the square.
  packing.grains.orientation[0] = 0.25 * 3.14159265358979;
  const std::string turned = draw_sheet<2>({grains_of(packing)}, options);
  for (const char* corner : {"205 134.29 ", "275.71 205 "}) EXPECT_THAT(turned, HasSubstr(corner));
  // Rounded corners are drawn as curves.
  packing = packing_of<2>({box<2>({1.0, 1.0}, 0.1)}, {{2.0, 2.0}}, std::sqrt(2.0));
  EXPECT_THAT(draw_sheet<2>({grains_of(packing)}, options), HasSubstr(" C "));
}

TEST(SheetOfShapes, PeriodicCopiesAreDrawnAndCutAtTheBorder) {
  const Packing<2> packing = packing_of<2>({box<2>({1.0, 1.0}, 0.1)}, {{0.0, 0.0}}, 1.2);
  const Pixels pixels(draw_sheet<2>({grains_of(packing)}, test::plain_png()));
  for (const int x : {8, 401})
    for (const int y : {8, 401}) EXPECT_EQ(pixels.rgb(x, y), rgb_of(palette::kGrain)) << x << ' ' << y;
  EXPECT_EQ(pixels.rgb(205, 205), 0xFFFFFF);
  EXPECT_TRUE(is_white_outside(pixels, 4));
}

TEST(SheetOfShapes, LinesPassThroughTheContactPoint) {
  const Pixels pixels(draw_sheet<2>({equilibrium_forces(pentagons(), 0.0)}, test::plain_png()));
  const auto at = [&](double x, double y) {
    return pixels.rgb(static_cast<int>(5.0 + 100.0 * x), static_cast<int>(5.0 + 100.0 * (4.0 - y)));
  };
  // The line from (0.7, 1) to (2, 1) bends at (1.3, 1.3). The line across the cell boundary bends at (0.1,
  // 1.2).
  for (const auto& [x, y] : {std::pair(1.3, 1.3), std::pair(1.0, 1.15), std::pair(1.65, 1.15),
                             std::pair(0.1, 1.2), std::pair(3.7, 1.1)})
    EXPECT_EQ(at(x, y), rgb_of(palette::kCompression)) << x << ' ' << y;
  EXPECT_NE(at(1.3, 1.0), rgb_of(palette::kCompression));
}

template <int Dim>
std::vector<PackingPicture<Dim>> all_kinds_of_pictures(const Packing<Dim>& packing) {
  Packing<Dim> after = packing;
  after.contacts.pop_back();
  for (Vec<Dim>& x : after.grains.position) x[0] += 0.1 * x[1];
  return {equilibrium_forces(packing, 0.0),
          pressure_phases_of(packing, 0.0),
          grain_pressures(packing, 1.0),
          grains_of(packing),
          contacts_changed(packing, after, contact_changes(packing, after)),
          contacts_changed(after, packing, contact_changes(after, packing))};
}

/// Draws every kind of picture with every option of a sheet, in every format.
template <int Dim>
void draw_with_all_options(const Packing<Dim>& packing) {
  std::vector<SheetOptions> variants(9);
  variants[1].columns = 1;
  variants[2].line_width = 0.5;
  variants[3].same_force_scale = true;
  variants[4].bare = true;
  variants[5].as_image = true;
  variants[6].as_image = false;
  variants[7].view.azimuth = 10.0;
  variants[7].view.elevation = -40.0;
  variants[8].view.sphere_size = 0.6;
  for (SheetOptions& options : variants) {
    options.width = 200.0;
    options.resolution = 72.0;
    for (const PackingPicture<Dim>& picture : all_kinds_of_pictures(packing)) {
      options.format = PictureFormat::svg;
      EXPECT_THAT(draw_sheet<Dim>({picture}, options), StartsWith("<?xml"));
      options.format = PictureFormat::pdf;
      EXPECT_THAT(draw_sheet<Dim>({picture}, options), StartsWith("%PDF"));
      options.format = PictureFormat::png;
      const Pixels pixels(draw_sheet<Dim>({picture}, options));
      // In 3D, arrows may extend beyond the rectangle around the grains.
      const bool may_leave = Dim == 3 && !picture.arrows.empty();
      EXPECT_TRUE(may_leave || is_white_outside(pixels, 2));
    }
    const std::string strip = draw_sheet<Dim>(all_kinds_of_pictures(packing), options);
    EXPECT_TRUE(strip == draw_sheet<Dim>(all_kinds_of_pictures(packing), options));
  }
}

TEST(SheetOfShapes, EveryOptionWorksForPentagons) {
  draw_with_all_options(pentagons());
}

TEST(SheetOfShapes, EveryOptionWorksForCubes) {
  draw_with_all_options(cubes());
}

TEST(SheetOfShapes, ACubeHasTheAreaOfItsProjection) {
  const Packing<3> packing = packing_of<3>({box<3>({1.0, 1.0, 1.0}, 0.0)}, {{2.0, 2.0, 2.0}}, std::sqrt(3.0));
  const auto count_grey = [](const Pixels& pixels) {
    // All edges of the cell are in its outline, which lies in a margin of 20 pixels. All other pixels that are not
    // white belong to the cube.
    int n = 0;
    for (int y = 20; y < pixels.height() - 20; ++y)
      for (int x = 20; x < pixels.width() - 20; ++x) n += pixels.rgb(x, y) != 0xFFFFFF;
    return n;
  };
  SheetOptions options = test::plain_png();
  options.view.azimuth = -90.0;
  options.view.elevation = 90.0;
  // In a view along one of its edges, a cube of side 1 is a square of 100 x 100 pixels. Half the width of the
  // outline is added on each side.
  EXPECT_NEAR(count_grey(Pixels(draw_sheet<3>({grains_of(packing)}, options))), 100 * 100, 410);
}

TEST(SheetOfShapes, TheNearerCubeHidesTheFarther) {
  Packing<3> packing =
      packing_of<3>({box<3>({1.0, 1.0, 1.0}, 0.0)}, {{2.0, 2.0, 1.0}, {2.3, 2.0, 3.0}}, std::sqrt(3.0));
  PackingPicture<3> picture = grains_of(packing);
  picture.shade.value = {-1.0, 1.0};
  SheetOptions options = test::plain_png();
  options.view.azimuth = -90.0;
  const auto is_blue = [](int rgb) { return (rgb & 255) > (rgb >> 16 & 255); };
  options.view.elevation = 90.0;
  EXPECT_TRUE(is_blue(Pixels(draw_sheet<3>({picture}, options)).rgb(5 + 220, 5 + 200)));
  options.view.elevation = -90.0;
  EXPECT_FALSE(is_blue(Pixels(draw_sheet<3>({picture}, options)).rgb(5 + 220, 5 + 200)));
}

TEST(SeenPackingOfShapes, TubesLeadFromFaceToFaceThroughTheContactPoint) {
  Packing<3> packing =
      packing_of<3>({box<3>({1.0, 1.0, 1.0}, 0.0)}, {{2.0, 2.0, 1.0}, {2.0, 2.0, 3.0}}, std::sqrt(3.0));
  packing.contacts = {contact_at<3>(packing, 0, 1, {0.5, 0.0, 1.0})};
  View view;
  view.azimuth = -90.0;
  view.elevation = 90.0;
  view.sphere_size = 1.0;
  PackingPicture<3> picture = equilibrium_forces(packing, 0.0);
  const SeenPacking seen = seen_packing(picture, view, {});
  ASSERT_EQ(seen.tubes.size(), 2u);
  const Vec<3> bend(2.5, 2.0, 2.0);
  // The tubes end on the faces at z = 1.5 and z = 2.5, up to a small correction for the width of a tube.
  EXPECT_TRUE(seen.tubes[0].from.isApprox(Vec<3>(2.25, 2.0, 1.5), 1e-3));
  EXPECT_TRUE(seen.tubes[0].to.isApprox(bend));
  EXPECT_EQ(seen.tubes[0].to_end, TubeEnd::round);
  EXPECT_TRUE(seen.tubes[1].from.isApprox(bend));
  EXPECT_TRUE(seen.tubes[1].to.isApprox(Vec<3>(2.25, 2.0, 2.5), 1e-3));
  ASSERT_EQ(seen.bodies.size(), 2u);
  EXPECT_EQ(seen.bodies[0].facets.size(), 1u);
}

TEST(SeenPackingOfShapes, EdgesOfTheCellAreBrokenByBodies) {
  // A cube with faces parallel to those of the cell covers the middle of an upper edge of the cell.
  const Packing<3> packing = packing_of<3>({box<3>({1.0, 1.0, 1.0}, 0.0)}, {{2.0, 0.0, 3.9}}, std::sqrt(3.0));
  const SeenPacking seen = seen_packing(grains_of(packing), View(), {});
  for (const SeenEdge& edge : seen.cell_edges) {
    if (edge.axis != 0 || edge.behind || edge.outline) continue;
    ASSERT_EQ(edge.visible.size(), 2u);
    EXPECT_NEAR(edge.visible[0].second, 1.5 / 4.0, 0.1);
    EXPECT_NEAR(edge.visible[1].first, 2.5 / 4.0, 0.1);
  }
}

TEST(PartInSlab, KeepsTheShapesOfItsGrains) {
  Packing<3> packing = packing_of<3>({box<3>({1.0, 1.0, 1.0}, 0.0), capsule<3>(2.0), round_shape<3>(0.5)},
                                     {{1.0, 1.0, 0.5}, {1.0, 1.0, 2.5}, {1.0, 1.0, 3.5}}, 1.0);
  const PackingPicture<3> part = part_in_slab(grains_of(packing), {2, 0.5, 1.0});
  ASSERT_EQ(part.shape.size(), 2u);
  EXPECT_EQ(part.shape[0].shape->n_vertices(), 2);
  EXPECT_TRUE(part.is_round(1));
  EXPECT_THAT(draw_sheet<3>({part}, {}), StartsWith("<?xml"));
}

}  // namespace
}  // namespace floc
