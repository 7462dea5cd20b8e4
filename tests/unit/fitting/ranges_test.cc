#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "floc/base/error.h"
#include "floc/fitting/consolidation.h"
#include "floc/fitting/dynamic_compaction.h"
#include "floc/fitting/force_distribution.h"
#include "floc/fitting/scattering_fit.h"

/// Tests that the library itself refuses invalid options of fits. The checks of the program are not involved.
namespace floc::test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kInf = std::numeric_limits<double>::infinity();

template <class Call>
void expect_refused(const char* name, const Call& call) {
  EXPECT_THAT(call, ThrowsMessage<InputError>(HasSubstr(std::string(name) + " = "))) << name;
}

TEST(Ranges, OfFitsAreTheLibrarys) {
  const std::vector<CompactedSample> samples(12, {1.0, 0.1, 0.01, 50.0});
  const std::vector<double> forces(20, 1.0);
  const ConsolidationCurve curve{{1.0, 2.0, 3.0}, {0.5, 0.6, 0.7}, {}};
  const std::vector<ScatteredPoint> points(10, {1.0, 1.0, 1});
  for (const double x : {std::nan(""), kInf, -kInf, -1.0}) {
    expect_refused("p_D", [&] { (void)fit_dynamic_compaction(samples, {.p_D = x}); });
    expect_refused("eta_m", [&] { (void)fit_dynamic_compaction(samples, {.eta_m = x}); });
    expect_refused("p_0", [&] { (void)fit_dynamic_compaction(samples, {.p_0 = x}); });
    expect_refused("threshold", [&] { (void)fit_exponential_tail("tail", forces, x, {}); });
    ConsolidationOptions options;
    options.window = {x, 2.0};
    expect_refused("window", [&] { (void)fit_consolidation(curve, options); });
    expect_refused("fit_range", [&] { (void)fit_scattering(points, 1.0, x); });
  }
  for (const int n : {-1, 0, 200'000}) {
    expect_refused("draws", [&] { (void)fit_exponential_tail("tail", forces, 0.5, {.n_draws = n}); });
    expect_refused("draws", [&] { (void)fit_compressive_forces(power_exponential(), forces, {.n_draws = n}); });
  }
  for (const int n : {-1, 1, 2'000'000}) {
    ConsolidationOptions options;
    options.n_bootstrap = n;
    expect_refused("bootstrap", [&] { (void)fit_consolidation(curve, options); });
  }
}

}  // namespace
}  // namespace floc::test
