#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "floc/assembly/diameters.h"
#include "floc/base/error.h"
#include "floc/scene/read_scene.h"
#include "support/message_of.h"
#include "support/scratch_directory.h"

namespace floc {
namespace {

using testing::HasSubstr;

/// Returns a scene of disks.
/// @param diameter  value of the key grains.diameter
std::string scene_of_sizes(const std::string& diameter) {
  return "[scene]\ndimension = 2\nunits = \"reduced\"\n[grains]\ncount = 40\ndiameter = " + diameter +
         "\n[contact]\nnormal = {law = \"linear\", stiffness = 1e4}\ndamping = {restitution = 0.1}\n"
         "[cell]\nsolid_fraction = 0.3\n[assembly]\nprotocol = \"direct\"\npressure = 1.0\n";
}

Scene parsed_sizes(const std::string& text) {
  return parse_scene(text, "sizes.toml", ".");
}

std::string faults_of_sizes(const std::string& text) {
  return test::message_of([&] { parsed_sizes(text); });
}

/// Fixture: a scene with a table of sieves in the same directory.
class SievedScene : public testing::Test {
 protected:
  Scene read_with(const std::string& table, const std::string& keys = "",
                  const std::string& units = "reduced") {
    std::ofstream(dir_ / "sand.csv") << table;
    std::string text = scene_of_sizes("{distribution = \"sieve\", file = \"sand.csv\"" + keys + "}");
    text.replace(text.find("units = \"reduced\""), 17, "units = \"" + units + "\"");
    if (units == "SI") text.replace(text.find("count = 40"), 10, "count = 40\ndensity = 1.0");
    std::ofstream(dir_ / "s.toml") << text;
    return read_scene((dir_ / "s.toml").string());
  }
  std::string refusal(const std::string& table, const std::string& keys = "",
                      const std::string& units = "reduced") {
    return test::message_of([&] { read_with(table, keys, units); });
  }

  const test::ScratchDirectory scratch_;
  const std::filesystem::path dir_ = scratch_.path();
};

TEST_F(SievedScene, ReadsPercentAndFractionsFromFineToCoarseAndBack) {
  for (const char* table :
       {"size,passing\n0.25,0\n0.5,40\n1,100\n", "passing [%],sieve\n100,1\n40,0.5\n0,0.25\n",
        "Sieve Size,Percent finer\n1,100\n0.5,40\n0.25,0\n"}) {
    const DiameterDistribution d = read_with(table).grains.diameter;
    EXPECT_EQ(d.kind, DiameterDistribution::Kind::sieve);
    EXPECT_EQ(d.curve.sizes, (std::vector<double>{0.25, 0.5, 1.0})) << table;
    EXPECT_EQ(d.curve.passing, (std::vector<double>{0.0, 40.0, 100.0})) << table;
    EXPECT_EQ(d.min, 0.25);
    EXPECT_EQ(d.max, 1.0);
    EXPECT_EQ(d.dimension, 2);
  }
  EXPECT_NEAR(read_with("size,passing [-]\n0.25,0\n0.5,0.4\n1,1\n").grains.diameter.curve.passing[1], 40.0,
              1e-13);
}

TEST_F(SievedScene, IsKeptInItsTextBitByBit) {
  for (const char* keys : {"", ", scale = 0.7", ", min = 0.3, max = 0.95", ", scale = 0.7, min = 0.3"}) {
    const Scene s = read_with("size,passing\n0.25,0\n0.5,41.3\n0.7,77.7\n1,100\n", keys);
    const Scene again = parsed_sizes(s.text);
    EXPECT_EQ(again.grains.diameter.curve.sizes, s.grains.diameter.curve.sizes) << keys;
    EXPECT_EQ(equally_spaced_diameters(again.grains.diameter, 40),
              equally_spaced_diameters(s.grains.diameter, 40));
    EXPECT_EQ(again.text, s.text);
  }
}

TEST_F(SievedScene, HasSizesInTheUnitOfTheScene) {
  const std::string table = "size [mm],passing [%]\n0.25,0\n2,100\n";
  EXPECT_NEAR(read_with(table, ", scale = 0.5").grains.diameter.max, 1.0, 1e-15);
  EXPECT_THAT(refusal(table),
              HasSubstr("the sizes are in mm, but the scene is in reduced units: expected the key "
                        "grains.diameter.scale"));
  EXPECT_NEAR(read_with(table, "", "SI").grains.diameter.max, 2e-3, 1e-18);
  EXPECT_THAT(refusal("size,passing\n0.25,0\n2,100\n", "", "SI"), HasSubstr("found no unit here"));
  EXPECT_THAT(refusal("size [kPa],passing\n0.25,0\n2,100\n", "", "SI"), HasSubstr("found the unit kPa here"));
}

TEST_F(SievedScene, ThatIsNoGradingCurveIsRefusedWithLineAndReason) {
  const struct {
    const char *table, *keys, *words;
  } scenes[] = {
      {"size,passing\n1,0\n2,60\n3,50\n4,100\n", "",
       "sand.csv:4: 50 % of the mass pass the sieve of size 3, but 60 % pass the finer sieve of size 2"},
      {"size,passing\n1,3\n4,100\n", "", "sand.csv:2: 3 % of the mass are finer than the finest sieve, 1"},
      {"size,passing\n4,98\n1,0\n", "", "sand.csv:2: only 98 % of the mass pass the coarsest sieve, 4"},
      {"size,passing\n0,0\n4,100\n", "", "sand.csv:2: the size of a sieve is 0: expected a positive size"},
      {"size,passing\n1,0\n4,101\n", "", "sand.csv:3: 101 % of the mass pass the sieve of size 4"},
      {"size,passing\n1,0\n1,50\n4,100\n", "", "sand.csv:3: two rows have the size 1"},
      {"size,passing\n1,100\n", "", "there is one sieve"},
      {"mesh,passing\n1,0\n4,100\n", "", "there is no column with the sizes of the sieves"},
      {"size,retained\n1,0\n4,100\n", "", "there is no column with the percentage of the mass that passes"},
      {"size,passing [g]\n1,0\n4,100\n", "",
       "column passing [g]: found the unit g here: expected a number without unit, or in %"},
      {"size,passing\n1,0\n4,100\n", ", min = 5", "grains.diameter.min = 5: expected a size within the curve"},
      {"size,passing\n1,0\n2,50\n3,50\n4,100\n", ", min = 2.1, max = 2.9",
       "no grains are between the sizes 2.1"},
      {"size,passing\n1,0\n4,x\n", "", "sand.csv:3"},
      {"size,passing\n1,0\n4,100\n", ", scale = 0", "grains.diameter.scale = 0"},
  };
  for (const auto& [table, keys, words] : scenes) EXPECT_THAT(refusal(table, keys), HasSubstr(words)) << table;
  EXPECT_EQ(refusal("size,passing\n1,3\n4,98\n", ", min = 1, max = 4"), "");
  std::filesystem::remove(dir_ / "sand.csv");
  EXPECT_THAT([&] { read_scene((dir_ / "s.toml").string()); },
              testing::ThrowsMessage<InputError>(HasSubstr("sand.csv: No such file or directory")));
}

TEST(SieveKeys, AreArraysOfOneLength) {
  const auto sieve = [&](const std::string& keys) {
    return scene_of_sizes("{distribution = \"sieve\", " + keys + "}");
  };
  EXPECT_EQ(parsed_sizes(sieve("sizes = [0.5, 1], passing = [0, 100]")).grains.diameter.curve.sizes.size(), 2u);
  EXPECT_THAT(
      faults_of_sizes(sieve("sizes = [0.5, 1], passing = [0, 50, 100]")),
      HasSubstr(
          "grains.diameter.passing has 3 numbers, but grains.diameter.sizes has 2: expected equally many"));
  EXPECT_THAT(faults_of_sizes(sieve("sizes = [0.5, 1]")), HasSubstr("grains.diameter.passing is missing"));
  EXPECT_THAT(faults_of_sizes(sieve("quantiles = \"ends\", sizes = [0.5, 1], passing = [0, 100]")),
              HasSubstr("unknown key grains.diameter.quantiles"));
}

TEST(LognormalKeys, ByMassTheMedianIsByMass) {
  const std::string keys = "{distribution = \"lognormal\", median = 1, sigma = 0.3, min = 0.1, max = 10";
  EXPECT_EQ(parsed_sizes(scene_of_sizes(keys + ", by = \"number\"}")).grains.diameter.median, 1.0);
  const DiameterDistribution d =
      parsed_sizes(scene_of_sizes(keys + ", by = \"mass\", quantiles = \"middle\"}")).grains.diameter;
  // Half of the mass of a large sample is in disks smaller than the median diameter.
  double below = 0.0, all = 0.0;
  for (const double x : equally_spaced_diameters(d, 200'000)) all += x * x, below += x < 1.0 ? x * x : 0.0;
  EXPECT_NEAR(below / all, 0.5, 1e-4);
  EXPECT_NEAR(*volume_share_below(d, 2, std::exp(0.3)), 0.8413447460685429, 1e-9);
}

}  // namespace
}  // namespace floc
