#include <cairo.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "floc/io/state_file.h"
#include "support/small_run.h"
#include "support/states.h"

namespace floc::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Draw : public SmallRun {};

TEST_F(Draw, WritesTheFormatThatTheNameEndsIn) {
  const std::pair<const char*, const char*> beginnings[] = {
      {"a.svg", "<?xml"}, {"a.pdf", "%PDF"}, {"a.png", "\x89PNG"}};
  for (const auto& [name, beginning] : beginnings) {
    const Outcome o = floc(std::string("draw run/state-0004.h5 -o ") + name);
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_THAT(content_of(file(name)), StartsWith(beginning));
    EXPECT_FALSE(exists(std::string(name) + ".part"));
  }
}

TEST_F(Draw, TellsWhatIsDrawnAsATable) {
  const json row = json::parse(floc("draw run/state-0004.h5 -o t.svg --format json").out).at(0);
  EXPECT_EQ(row.at("file"), "run/state-0004.h5");
  EXPECT_EQ(row.at("picture"), "t.svg");
  EXPECT_EQ(row.at("n_grains"), 40);
  const json network = json::parse(floc("info run/state-0004.h5 --format json").out).at(0);
  EXPECT_EQ(row.at("n_compression").get<int>() + row.at("n_tension").get<int>() + row.at("n_zero").get<int>(),
            network.at("n_contacts").get<int>());
  EXPECT_EQ(row.at("n_distant"), network.at("n_distant"));
}

TEST_F(Draw, MakesAFilmStripOfAPath) {
  const Outcome o = floc("draw run -o strip.svg --steps 1,3,7 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json rows = json::parse(o.out);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_THAT(rows[2]["file"].get<std::string>(), HasSubstr("state-0007.h5"));
  // Without --steps, floc draws four states, evenly spread from the first to the last.
  const json spread = json::parse(floc("draw run -o spread.svg --format json").out);
  ASSERT_EQ(spread.size(), 4u);
  EXPECT_THAT(spread[0]["file"].get<std::string>(), HasSubstr("state-0000.h5"));
  EXPECT_THAT(spread[3]["file"].get<std::string>(), HasSubstr("state-0008.h5"));
}

TEST_F(Draw, RefusesAWidthInCentimetres) {
  for (const char* width : {"0", "-3", "177"}) {
    const Outcome o = floc(std::string("draw run/state-0004.h5 -o w.svg --width ") + width);
    EXPECT_EQ(o.code, 4);
    EXPECT_THAT(o.err, HasSubstr(std::string("--width ") + width +
                                 ": expected a width of the page from 1.8 to 176 cm"));
  }
  EXPECT_EQ(floc("draw run/state-0004.h5 -o w.svg --width 1.8").code, 0);
  EXPECT_EQ(floc("draw run/state-0004.h5 -o w.svg --width 176").code, 0);
}

/// Returns whether the right margin of a png contains a pixel that is not white.
/// @param margin  width of the tested margin (points); pixels are 1/200 inch wide
bool writes_into_margin(const std::string& png, double margin) {
  cairo_surface_t* image = cairo_image_surface_create_from_png(png.c_str());
  const int width = cairo_image_surface_get_width(image), height = cairo_image_surface_get_height(image);
  const int first = width - static_cast<int>(margin * 200.0 / 72.0);
  const unsigned char* data = cairo_image_surface_get_data(image);
  bool found = width == 0;
  for (int y = 0; y < height; ++y)
    for (int x = first; x < width; ++x) {
      const unsigned char* pixel = data + y * cairo_image_surface_get_stride(image) + 4 * x;
      found = found || pixel[0] != 255 || pixel[1] != 255 || pixel[2] != 255;
    }
  cairo_surface_destroy(image);
  return found;
}

TEST_F(Draw, KeepsEveryWordOnThePageHoweverNarrowItIs) {
  const char* kinds[] = {"", "--forces particle-pressure", "--forces increment", "--compare run/state-0007.h5"};
  for (const char* kind : kinds)
    for (const char* width : {"2", "3", "6", "17"}) {
      const Outcome o = floc(std::string("draw run/state-0004.h5 --resolution 200 -o narrow.png --width ") +
                             width + " " + kind);
      ASSERT_EQ(o.code, 0) << o.err;
      EXPECT_FALSE(writes_into_margin(file("narrow.png"), 3.5)) << kind << " at " << width << " cm";
    }
  ASSERT_EQ(floc("draw run --columns 4 --resolution 200 --width 8 -o narrow.png").code, 0);
  EXPECT_FALSE(writes_into_margin(file("narrow.png"), 3.5));
}

TEST_F(Draw, ShowsOfAForceNoMoreThanALineOfTheLegend) {
  // Six large disks fill the page. A line of 0.15 of their diameter would be wider than the height of the letters of
  // the caption.
  ASSERT_EQ(floc("run small.toml -o six --set grains.count=6 --until 2").code, 0);
  ASSERT_EQ(floc("draw six --columns 1 --bare -o bare.svg").code, 0);
  ASSERT_EQ(floc("draw six --columns 1 -o six.svg").code, 0);
  const std::string svg = content_of(file("six.svg"));
  double widest = 0.0;
  // Legend samples are lines 16 points long, in the colour of the text.
  const std::string text_colour = "stroke=\"rgb(11.764706%";
  EXPECT_THAT(svg, HasSubstr("<svg"));
  for (std::size_t at = 0; (at = svg.find("stroke-width=\"", at)) != std::string::npos; at += 14) {
    const std::size_t end = svg.find("/>", at);
    const std::string element = svg.substr(svg.rfind('<', at), end - svg.rfind('<', at));
    if (element.find(text_colour) != std::string::npos)
      widest = std::max(widest, std::atof(svg.c_str() + at + 14));
  }
  EXPECT_LE(widest, 8.0 + 1e-6);
}

TEST_F(Draw, GivesTheSameBytesAgainAndBesideOthers) {
  ASSERT_EQ(floc("draw run/state-0004.h5 -o one.svg").code, 0);
  ASSERT_EQ(floc("draw run/state-0003.h5 run/state-0004.h5 -o each/").code, 0);
  EXPECT_TRUE(content_of(file("one.svg")) == content_of(file("each/state-0004.svg")));
  EXPECT_TRUE(exists("each/state-0003.svg"));
}

TEST_F(Draw, WorksInAPipe) {
  const Outcome o = floc("draw - -o -", content_of(file("run/state-0004.h5")));
  ASSERT_EQ(o.code, 0) << o.err;
  ASSERT_EQ(floc("draw run/state-0004.h5 -o one.svg").code, 0);
  EXPECT_TRUE(o.out == content_of(file("one.svg")));
  EXPECT_THAT(floc("draw run/state-0004.h5 -o - --as png").out, StartsWith("\x89PNG"));
}

TEST_F(Draw, ShowsIncrementsPressuresAndChanges) {
  const json increments =
      json::parse(floc("draw run/state-0006.h5 -o i.svg --forces increment --format json").out).at(0);
  EXPECT_GT(increments.at("n_other"), 0);
  EXPECT_GT(increments.at("n_compression"), 0);
  EXPECT_EQ(floc("draw run/state-0006.h5 -o d.svg --forces increment --step deviatoric").code, 0);
  EXPECT_EQ(floc("draw run --steps 2,6 -o p.svg --forces particle-pressure").code, 0);
  const Outcome o = floc("draw run/state-0001.h5 -o c.svg --compare run/state-0007.h5 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json changes = json::parse(o.out).at(0);
  const json before = json::parse(floc("info run/state-0001.h5 --format json").out).at(0);
  const json after = json::parse(floc("info run/state-0007.h5 --format json").out).at(0);
  const int kept = changes.at("n_other");
  EXPECT_EQ(kept + changes.at("n_lost").get<int>(), before.at("n_contacts").get<int>());
  EXPECT_EQ(kept + changes.at("n_gained").get<int>(), after.at("n_contacts").get<int>());
}

TEST_F(Draw, ReportsABadFileAndDrawsTheOthers) {
  write_text(file("foreign.h5"), "no state");
  const Outcome o = floc("draw run/state-0004.h5 foreign.h5 absent.h5 -o some.svg --format json");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, AllOf(HasSubstr("foreign.h5"), HasSubstr("absent.h5")));
  EXPECT_EQ(json::parse(o.out).size(), 1u);
  EXPECT_THAT(content_of(file("some.svg")), StartsWith("<?xml"));
}

TEST_F(Draw, RefusesInWordsWhatItCannotDraw) {
  write_state(file("spheres.h5"), busy_state<3>());
  const std::pair<const char*, const char*> refusals[] = {
      {"draw run/state-0004.h5 -o s.svg --view 10,20",
       "run/state-0004.h5: this is a state of disks, but --view, --slab, --cut and --sphere-size apply only to "
       "states of spheres"},
      {"draw spheres.h5 -o s.svg --view 10",
       "--view 10: this is not a direction of view: expected AZIMUTH,ELEVATION"},
      {"draw spheres.h5 -o s.svg --view 10,91",
       "elevation of the view = 91 degrees: must be between -90 and 90"},
      {"draw spheres.h5 -o s.svg --slab w,0,1", "--slab w,0,1: this is not a slab: expected AXIS,FROM,TO"},
      {"draw spheres.h5 -o s.svg --slab z,0.6,0.4", "slab from 0.6 to 0.4: must be fractions of the cell"},
      {"draw spheres.h5 -o s.svg --slab x,0.98,0.99",
       "spheres.h5: this state has no grain whose centre lies in --slab"},
      {"draw run/state-0004.h5 -o s.svg --cut y,0.5", "--view, --slab, --cut and --sphere-size apply only to"},
      {"draw spheres.h5 -o s.svg --cut 0.5", "--cut 0.5: this is not a section: expected AXIS,FRACTION"},
      {"draw spheres.h5 -o s.svg --cut y,1.5", "--cut y,1.5: this is not a section: expected AXIS,FRACTION"},
      {"draw spheres.h5 -o s.svg --cut z,0.5",
       "spheres.h5: the plane of --cut z,0.5 crosses no grain of this state"},
      {"draw spheres.h5 -o s.svg --cut y,0.5 --forces kinds",
       "--forces kinds: --cut shows sections of grains without contacts: expected none, particle-pressure or "
       "phases"},
      {"draw spheres.h5 -o s.svg --sphere-size 2",
       "sphere size = 2 times the true size: must be between 0 and 1"},
      {"draw spheres.h5 -o s.svg --compare run/state-0004.h5",
       "run/state-0004.h5: this is a state in 2D, but spheres.h5 is in 3D"},
  };
  for (const auto& [command, words] : refusals) {
    const Outcome o = floc(command);
    EXPECT_EQ(o.code, 4) << command;
    EXPECT_THAT(o.err, HasSubstr(words));
    EXPECT_FALSE(exists("s.svg"));
  }
  EXPECT_THAT(floc("draw run/state-0004.h5 -o a.gif").err,
              HasSubstr("expected a name that ends in .svg, .pdf or .png"));
  EXPECT_EQ(floc("draw run/state-0004.h5 -o a.gif").code, 4);
  EXPECT_THAT(floc("draw run/state-0004.h5 -o a.svg --steps 1").err, HasSubstr("--steps"));
  EXPECT_THAT(floc("draw run -o a.svg --steps 99").err, HasSubstr("state-0099.h5"));
  EXPECT_THAT(floc("draw run/state-0004.h5 -o a.svg --width 0.5").err, HasSubstr("width"));
  EXPECT_THAT(floc("draw run/state-0004.h5 -o a.svg --compare spheres.h5").err,
              HasSubstr("spheres.h5: this is a state in 3D"));
  EXPECT_THAT(floc("draw . -o a.svg").err, HasSubstr("state-0000.h5"));
  EXPECT_EQ(floc("draw run/state-0004.h5 -o absent/a.svg").code, 1);
}

TEST_F(Draw, DrawsSpheres) {
  write_state(file("spheres.h5"), busy_state<3>());
  const Outcome o = floc("draw spheres.h5 -o spheres.svg --view -30,10 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(content_of(file("spheres.svg")), HasSubstr("<radialGradient"));
  EXPECT_EQ(json::parse(o.out).at(0).at("n_grains"), 3);
  EXPECT_EQ(json::parse(o.out).at(0).at("n_distant"), 1);
  for (const std::string rest : {"--forces none", "--forces particle-pressure", "--compare spheres.h5",
                                 "--slab y,0,0.2 --sphere-size 0", "--bare", "--image"})
    EXPECT_EQ(floc("draw spheres.h5 -o other.pdf " + rest).code, 0) << rest;
  for (const std::string rest : {"", "--forces none", "--forces particle-pressure", "--forces phases"}) {
    const Outcome cut = floc("draw spheres.h5 -o cut.svg --format json --cut y,0.1 " + rest);
    EXPECT_EQ(cut.code, 0) << rest << cut.err;
    EXPECT_GE(json::parse(cut.out).at(0).at("n_grains"), 1);
  }
  // Disks and spheres may not be on one strip. In a directory of pictures, each state has its own file.
  const Outcome strip = floc("draw run/state-0004.h5 spheres.h5 -o strip.svg");
  EXPECT_EQ(strip.code, 4);
  EXPECT_THAT(strip.err, HasSubstr("spheres.h5: this is a state in 3D, but the states before it are not"));
  EXPECT_EQ(floc("draw run/state-0004.h5 spheres.h5 -o both/").code, 0);
  EXPECT_TRUE(exists("both/spheres.svg"));
}

TEST_F(Draw, DrawsSkewedCells) {
  write_state(file("skewed.h5"), busy_state<2>());
  const Outcome o = floc("draw skewed.h5 -o skewed.svg");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(content_of(file("skewed.svg")), HasSubstr("</svg>"));
}

TEST_F(Draw, BarePicturesHaveNoLetters) {
  ASSERT_EQ(floc("draw run/state-0004.h5 -o bare.svg --bare").code, 0);
  EXPECT_THAT(content_of(file("bare.svg")), Not(HasSubstr("glyph")));
  ASSERT_EQ(floc("draw run/state-0004.h5 -o full.svg").code, 0);
  EXPECT_THAT(content_of(file("full.svg")), HasSubstr("glyph"));
}

}  // namespace
}  // namespace floc::test
