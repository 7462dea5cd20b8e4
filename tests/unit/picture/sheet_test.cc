#include "floc/picture/sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floc/packing/tile.h"
#include "floc/picture/force_picture.h"
#include "floc/picture/palette.h"
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

/// Four disks of diameter 1 at the corners of a square in a cell of side 4, and two lines along x with the forces 2 (at
/// y = 1) and 1 (at y = 3).
PackingPicture<2> two_lines() {
  PackingPicture<2> picture;
  picture.cell.matrix *= 4.0;
  picture.position = {{1.0, 1.0}, {3.0, 1.0}, {1.0, 3.0}, {3.0, 3.0}};
  picture.radius.assign(4, 0.5);
  picture.lines = {{{1.0, 1.0}, {3.0, 1.0}, LineKind::compression, 2.0},
                   {{1.0, 3.0}, {3.0, 3.0}, LineKind::tension, 1.0}};
  return picture;
}

int count_in_column(const Pixels& pixels, int x, const Color& color) {
  int n = 0;
  for (int y = 0; y < pixels.height(); ++y) n += pixels.rgb(x, y) == rgb_of(color);
  return n;
}

TEST(Sheet, WidthsOfLinesAreProportionalToForces) {
  const Pixels pixels(draw_sheet<2>({two_lines()}, test::plain_png()));
  ASSERT_EQ(pixels.width(), 410);
  ASSERT_EQ(pixels.height(), 410);
  // The width of a line is proportional to its force, and is 0.15 diameters for the root mean square force. A diameter
  // is 100 pixels. Pixels at edges have mixed colours.
  const double rms = std::sqrt(2.5);
  EXPECT_NEAR(count_in_column(pixels, 205, palette::kCompression), 15.0 * 2.0 / rms, 2.0);
  EXPECT_NEAR(count_in_column(pixels, 205, palette::kTension), 15.0 * 1.0 / rms, 2.0);
  // The y axis points up: the line at y = 1 is the lower one.
  EXPECT_EQ(pixels.rgb(205, 305), rgb_of(palette::kCompression));
  EXPECT_EQ(pixels.rgb(205, 105), rgb_of(palette::kTension));
}

TEST(Sheet, PeriodicCopiesAreDrawnAndCutAtTheBorder) {
  PackingPicture<2> picture = two_lines();
  picture.position = {{0.0, 0.0}};
  picture.radius = {0.5};
  picture.lines = {{{3.5, 2.0}, {4.5, 2.0}, LineKind::compression, 1.0}};
  const Pixels pixels(draw_sheet<2>({picture}, test::plain_png()));
  // Each corner of the picture contains a quarter of the disk; the middle is empty.
  for (const int x : {8, 401})
    for (const int y : {8, 401}) EXPECT_EQ(pixels.rgb(x, y), rgb_of(palette::kGrain)) << x << ' ' << y;
  EXPECT_EQ(pixels.rgb(205, 305), 0xFFFFFF);
  // The line leaves the cell on the right and continues on the left.
  EXPECT_EQ(pixels.rgb(380, 205), rgb_of(palette::kCompression));
  EXPECT_EQ(pixels.rgb(30, 205), rgb_of(palette::kCompression));
  // All pixels outside the border are white.
  for (int k = 0; k < 410; ++k)
    for (const int edge : {0, 2, 407, 409}) {
      EXPECT_EQ(pixels.rgb(edge, k), 0xFFFFFF);
      EXPECT_EQ(pixels.rgb(k, edge), 0xFFFFFF);
    }
}

TEST(Sheet, DoesNotDependOnTheCopyAGrainIsGivenIn) {
  PackingPicture<2> moved = two_lines();
  moved.position[0] += Vec<2>(4.0, -8.0);
  moved.lines[1].from += Vec<2>(-4.0, 4.0);
  moved.lines[1].to += Vec<2>(-4.0, 4.0);
  EXPECT_TRUE(draw_sheet<2>({two_lines()}, test::plain_png()) == draw_sheet<2>({moved}, test::plain_png()));
}

TEST(Sheet, RepeatedDrawingsAreTheSameBytesInEveryFormat) {
  for (const PictureFormat format : {PictureFormat::svg, PictureFormat::pdf, PictureFormat::png}) {
    SheetOptions options;
    options.format = format;
    EXPECT_TRUE(draw_sheet<2>({two_lines()}, options) == draw_sheet<2>({two_lines()}, options));
  }
  SheetOptions pdf;
  pdf.format = PictureFormat::pdf;
  EXPECT_THAT(draw_sheet<2>({two_lines()}, pdf), Not(HasSubstr("CreationDate")));
}

TEST(Sheet, FormatsAreWhatTheyAreCalled) {
  SheetOptions options;
  EXPECT_THAT(draw_sheet<2>({two_lines()}, options), StartsWith("<?xml"));
  options.format = PictureFormat::pdf;
  EXPECT_THAT(draw_sheet<2>({two_lines()}, options), StartsWith("%PDF"));
  options.format = PictureFormat::png;
  EXPECT_THAT(draw_sheet<2>({two_lines()}, options), StartsWith("\x89PNG"));
}

TEST(Sheet, AStripHasOneLengthScale) {
  PackingPicture<2> half = two_lines();
  half.cell.matrix *= 0.5;
  half.position.resize(1);
  half.radius.resize(1);
  half.lines.clear();
  SheetOptions options = test::plain_png();
  options.width = 10.0 + 2 * 400.0 + 12.0;
  const Pixels pixels(draw_sheet<2>({two_lines(), half}, options));
  EXPECT_EQ(pixels.height(), 410);
  // The cell of the second picture has half the side of the first cell. The second picture is at the upper left of its
  // column.
  const auto grey = rgb_of(palette::kGrain);
  EXPECT_EQ(pixels.rgb(5 + 412 + 100, 5 + 100), grey);
  EXPECT_EQ(pixels.rgb(5 + 412 + 100, 5 + 300), 0xFFFFFF);
}

/// Returns a picture with the contacts of about n disks: periodic copies of a random packing.
PackingPicture<2> many(int n) {
  const Packing<2> packing = test::random_packing<2>(100, 3, test::elastic_law(1.0, 0.5, 0.0), 1.2);
  const int side = static_cast<int>(std::lround(std::sqrt(n / 100.0)));
  return equilibrium_forces(tiled<2>(packing, {side, side}), 0.0);
}

TEST(Sheet, FewGrainsAreVectorsAndManyAreAnImage) {
  const std::string few = draw_sheet<2>({many(400)}, {});
  EXPECT_THAT(few, Not(HasSubstr("data:image/png")));
  EXPECT_LT(few.size(), 500'000u);
  const std::string image = draw_sheet<2>({many(10'000)}, {});
  EXPECT_THAT(image, HasSubstr("data:image/png"));
  EXPECT_LT(image.size(), 6'000'000u);
}

TEST(Sheet, AHundredThousandGrainsAreNoBlackSquare) {
  SheetOptions options;
  options.format = PictureFormat::png;
  const Pixels dense(draw_sheet<2>({many(100'000)}, options));
  const Pixels sparse(draw_sheet<2>({many(100)}, options));
  // The two pictures have the same mean brightness, except for the outlines of the grains in the picture with fewer
  // grains.
  EXPECT_NEAR(dense.ink(), sparse.ink(), 0.05);
  EXPECT_LT(dense.ink(), 0.4);
  EXPECT_LE(std::max(dense.width(), dense.height()), 3000);
}

/// Returns four separate spheres, with a contact between two of them.
PackingPicture<3> four_spheres() {
  PackingPicture<3> picture;
  picture.cell.matrix *= 4.0;
  picture.position = {{1, 1, 1}, {3, 1, 1}, {1, 3, 3}, {3, 3, 3}};
  picture.radius.assign(4, 0.5);
  return picture;
}

int count_in(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(SheetOfSpheres, HasAGradientEach) {
  SheetOptions options;
  options.bare = true;
  PackingPicture<3> picture = four_spheres();
  EXPECT_EQ(count_in(draw_sheet<3>({picture}, options), "<radialGradient"), 4);
  picture.lines = {{{1, 1, 1}, {3, 1, 1}, LineKind::compression, 1.0, 0, 1}};
  const std::string network = draw_sheet<3>({picture}, options);
  EXPECT_EQ(count_in(network, "<radialGradient"), 4);
  EXPECT_EQ(count_in(network, "<linearGradient"), 1);
}

TEST(SheetOfSpheres, TheNearerHidesTheFarther) {
  PackingPicture<3> picture = four_spheres();
  picture.shade.value = {-1.0, -1.0, 1.0, 1.0};
  SheetOptions options = test::plain_png();
  options.view.azimuth = -90.0;
  options.view.elevation = 90.0;
  picture.position[2] = {1.2, 1, 3};
  const auto is_blue = [](int rgb) { return (rgb & 255) > (rgb >> 16 & 255); };
  // Seen from above, the third sphere covers most of the first one, which is visible at its left.
  const Pixels above(draw_sheet<3>({picture}, options));
  EXPECT_EQ(above.width(), 410);
  EXPECT_TRUE(is_blue(above.rgb(5 + 110, 5 + 300)));
  EXPECT_FALSE(is_blue(above.rgb(5 + 60, 5 + 300)));
  // Seen from below, the first sphere covers the third one, and up and down are exchanged.
  options.view.elevation = -90.0;
  const Pixels below(draw_sheet<3>({picture}, options));
  EXPECT_FALSE(is_blue(below.rgb(5 + 110, 5 + 100)));
  EXPECT_TRUE(is_blue(below.rgb(5 + 165, 5 + 100)));
}

TEST(SheetOfSpheres, RepeatedDrawingsAreTheSameBytesInEveryFormat) {
  for (const PictureFormat format : {PictureFormat::svg, PictureFormat::pdf, PictureFormat::png}) {
    SheetOptions options;
    options.format = format;
    EXPECT_TRUE(draw_sheet<3>({four_spheres(), four_spheres()}, options) ==
                draw_sheet<3>({four_spheres(), four_spheres()}, options));
  }
}

TEST(SheetOfSpheres, ManyAreAnImageUnlessOthersHideThem) {
  const auto crystal = [](int side, double radius) {
    PackingPicture<3> picture;
    picture.cell.matrix *= side;
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z) picture.position.emplace_back(x + 0.5, y + 0.5, z + 0.5);
    picture.radius.assign(picture.position.size(), radius);
    return picture;
  };
  // Only some of the 8000 touching spheres are visible: those at three faces of the cell, and parts of others in the
  // gaps between them.
  const std::string dense = draw_sheet<3>({crystal(20, 0.5)}, {});
  EXPECT_THAT(dense, Not(HasSubstr("data:image/png")));
  EXPECT_LT(count_in(dense, "<radialGradient"), 4000);
  EXPECT_THAT(draw_sheet<3>({crystal(20, 0.1)}, {}), HasSubstr("data:image/png"));
}

TEST(SheetOptions, FaultsAreNamedWithTheirValue) {
  SheetOptions options;
  EXPECT_TRUE(options.validate().empty());
  options.columns = 0;
  options.line_width = -1.0;
  EXPECT_THAT(options.validate(),
              ::testing::ElementsAre(HasSubstr("columns = 0"), HasSubstr("line width = -1")));
}

}  // namespace
}  // namespace floc
