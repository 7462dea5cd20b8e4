#include <gtest/gtest.h>

#include <string>

#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_directory.h"

namespace floc::test {
namespace {

/// One of its grains touches few others and hangs on its bridges: without the geometric terms of their pull it would
/// be on a saddle, with them it is not.
TEST(WetRun, ComesToRestWhereTheirPullAloneHoldsAGrain) {
  const ScratchDirectory scratch;
  const Outcome made = run_floc("run " + source_directory() +
                                    "/data/scenes/wet_demo.toml --set assembly.friction=0.4 "
                                    "--set equilibrium.max_time=400 --seed 1 --until 1 -o out",
                                scratch.path());
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome verified = run_floc("verify out/state-*.h5", scratch.path());
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

}  // namespace
}  // namespace floc::test
