#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;

/// Fixture: the loading of three samples of the demo scene (type 2, small rolling resistance, N = 400 grains). The
/// published bounds are for N = 1400; the tests compare them with means over the samples.
class Type2Network : public ::testing::Test {
 protected:
  static constexpr int kFirst = 2, kLast = 4;  ///< seeds
  static constexpr int kDensest = 26;          ///< state at P* = 13.33; state 1 is the loosest, at P* = 0.01

  void SetUp() override {
    ASSERT_EQ(
        run_floc("run " + source_directory() + "/data/scenes/demo.toml -o out --seeds 2..4 --jobs 2 --until 26",
                 scratch_.path())
            .code,
        0);
  }

  json rows(const std::string& command, int seed) const {
    const std::string files = " out/seed-" + std::to_string(seed) + "/state-*.h5";
    return json::parse(run_floc(command + files + " --format json", scratch_.path()).out);
  }

  ScratchDirectory scratch_;
};

TEST_F(Type2Network, CarriesLoadsAndKeepsContactsAsPublished) {
  constexpr int kSamples = kLast - kFirst + 1;
  double loose = 0.0, dense = 0.0, distant = 0.0, kept = 0.0;
  for (int seed = kFirst; seed <= kLast; ++seed) {
    const json network = rows("network", seed), changes = rows("compare", seed);
    ASSERT_EQ(network.size(), kDensest + 1u);
    loose += network[1].at("energy_share_95").get<double>() / kSamples;
    dense += network[kDensest].at("energy_share_95").get<double>() / kSamples;
    for (int k = 1; k <= kDensest; ++k)
      distant += network[k].at("n_distant").get<double>() / network[k].at("n_contacts").get<double>() /
                 (kSamples * kDensest);
    // Row 0, the compression from P = 0, is left out.
    for (int k = 1; k < kDensest; ++k)
      kept += changes[k].at("kept_share").get<double>() / (kSamples * (kDensest - 1));
  }
  EXPECT_GT(loose, 0.40);
  EXPECT_LT(loose, 0.55);
  EXPECT_GT(dense, 0.60);
  EXPECT_LT(dense, 0.70);
  EXPECT_LT(distant, 0.02);
  EXPECT_GT(kept, 0.90);
}

}  // namespace
}  // namespace floc::test
