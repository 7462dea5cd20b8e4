#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;

constexpr int kSeeds = 2;

/// Fixture: one of the series of [AR2007], from the gas to 100 MPa and back, with 500 beads instead of 4000. The tests
/// compare means over the samples with the published values. The tolerances are those for 500 beads.
class GlassBeads : public ::testing::Test {
 protected:
  void make(const std::string& state) {
    ASSERT_EQ(run_floc("run " + source_directory() + "/data/scenes/spheres_" + state +
                           ".toml -o out --set grains.count=500 --seeds 1..2 --jobs 2",
                       scratch_.path())
                  .code,
              0);
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const std::string files = " out/seed-" + std::to_string(seed) + "/state-*.h5";
      EXPECT_EQ(run_floc("verify" + files, scratch_.path()).code, 0);
      rows_.push_back(
          json::parse(run_floc("network" + files + " --zero-force 1e-4 --format json", scratch_.path()).out));
    }
  }

  /// Returns the mean of a column over the samples.
  /// @param state  index of the state; a negative index counts from the end
  double mean(const std::string& column, int state) const {
    double sum = 0.0;
    for (const json& sample : rows_) {
      const int n = static_cast<int>(sample.size());
      sum += sample[state < 0 ? n + state : state].at(column).get<double>() / kSeeds;
    }
    return sum;
  }

  ScratchDirectory scratch_;
  std::vector<json> rows_;
};

TEST_F(GlassBeads, PutTogetherWithoutFrictionAreAsPublished) {
  make("a");
  constexpr int kTop = 8;
  EXPECT_NEAR(mean("phi", 0), 0.6370, 0.008);
  EXPECT_NEAR(mean("z_star_carrying", 0), 6.074, 0.05);
  EXPECT_LT(mean("x0_carrying", 0), 0.03);
  EXPECT_NEAR(mean("Z_2", 0), 1.53, 0.12);
  EXPECT_NEAR(mean("z_star_carrying", kTop), 7.3, 0.12);
  EXPECT_LT(mean("x0_carrying", kTop), 0.005);
  EXPECT_LT(mean("Z_2", kTop), mean("Z_2", 0));
  EXPECT_NEAR(mean("phi", -1), mean("phi", 0), 1e-3);
}

TEST_F(GlassBeads, PutTogetherWithAllTheirFrictionAreAsPublished) {
  make("d");
  EXPECT_NEAR(mean("phi", 0), 0.5923, 0.012);
  EXPECT_NEAR(mean("z_star_carrying", 0), 4.546, 0.06);
  EXPECT_NEAR(mean("x0_carrying", 0), 0.111, 0.03);
  EXPECT_NEAR(mean("z_star_carrying", -1), 4.5, 0.15);
}

}  // namespace
}  // namespace floc::test
