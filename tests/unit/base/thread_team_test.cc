#include "floc/base/thread_team.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace floc {
namespace {

constexpr int kPhases = 4;

/// Runs a team of threads. Some of the threads throw their own number in the given phase, before the barrier at the end
/// of the phase.
/// @param throwing  set of the threads that throw, one bit for each thread
/// @return the number that run_in_team() throws; -1 if it throws nothing
int thrown_by(int n_threads, unsigned throwing, int phase) {
  std::vector<int> reached(static_cast<std::size_t>(n_threads), 0);
  try {
    run_in_team(n_threads, [&](int thread, Barrier& barrier) {
      for (int p = 0; p < kPhases; ++p) {
        reached[static_cast<std::size_t>(thread)] = p;
        if (p == phase && (throwing >> thread) % 2 == 1) throw thread;
        barrier.wait();
      }
      reached[static_cast<std::size_t>(thread)] = kPhases;
    });
  } catch (int thread) {
    EXPECT_THAT(reached, testing::Each(phase)) << "nobody goes beyond the barrier that a thread never reaches";
    return thread;
  }
  EXPECT_THAT(reached, testing::Each(kPhases));
  return -1;
}

TEST(ThreadTeam, CarriesOutWhatTheFirstOfItsThreadsThrew) {
  int n_teams = 0;
  for (int n_threads = 1; n_threads <= 4; ++n_threads)
    for (unsigned throwing = 0; throwing < 1u << n_threads; ++throwing)
      for (int phase = 0; phase < kPhases; ++phase)
        for (int again = 0; again < 10; ++again, ++n_teams) {
          int first = -1;
          for (int t = n_threads - 1; t >= 0; --t)
            if ((throwing >> t) % 2 == 1) first = t;
          ASSERT_EQ(thrown_by(n_threads, throwing, phase), first)
              << n_threads << " " << throwing << " " << phase;
        }
  std::cout << "teams: " << n_teams << ", of 1 to 4 threads, every set of which threw in every of " << kPhases
            << " phases\n";
}

}  // namespace
}  // namespace floc
