#include "floc/base/shared_loops.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace floc {
namespace {

TEST(SharedLoops, MakeEachTurnOnce) {
  for (int n_threads = 1; n_threads <= 4; ++n_threads)
    SharedLoops::run(n_threads, [](SharedLoops& loops) {
      for (int n = 0; n < 300; ++n) {
        std::vector<int> count(static_cast<std::size_t>(n), 0);
        loops.for_each(n, [&](int k) { ++count[k]; });
        ASSERT_THAT(count, testing::Each(1));
      }
    });
}

TEST(SharedLoops, SeeWhatWasWrittenBefore) {
  constexpr int kTurns = 20, kLoops = 20'000;
  for (int n_threads = 1; n_threads <= 4; ++n_threads) {
    std::vector<int> a(kTurns, 0), b(kTurns, 0);
    SharedLoops::run(n_threads, [&](SharedLoops& loops) {
      for (int n = 0; n < kLoops; ++n) {
        // Each iteration reads a value that another iteration wrote in the previous loop.
        loops.for_each(kTurns, [&](int k) { b[k] = a[(k + 7) % kTurns] + 1; });
        std::swap(a, b);
      }
    });
    EXPECT_THAT(a, testing::Each(kLoops));
  }
}

TEST(SharedLoops, EndWithTheProgramThatThrows) {
  for (const int n_threads : {1, 3})
    EXPECT_THROW(SharedLoops::run(n_threads, [](SharedLoops&) { throw std::runtime_error("stop"); }),
                 std::runtime_error);
}

}  // namespace
}  // namespace floc
