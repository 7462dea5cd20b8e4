#include "floc/relaxation/thread_team.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "floc/base/error.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"

namespace floc {
namespace {

constexpr int kPhases = 4;

/// The threads of a set, as bits, throw their number before they reach the barrier at the end of a phase.
/// @return number of the exception that leaves the team, -1 if none does
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

/// Grains without much resistance in a cell that closes: in the end each has more neighbours than a list takes.
template <int Dim>
void close_upon(int n_threads) {
  Law law;
  law += test::linear(1e-6);
  const Packing<Dim> gas = test::gas_of<Dim>(130, law, 0.4);
  BoundaryControl<Dim> control = BoundaryControl<Dim>::fixed();
  control.target.template head<Dim>().setConstant(1.0);
  const auto dynamics = make_dynamics(gas, control, {0.02, 0.05, n_threads});
  dynamics->advance(300, Motion::free);
}

/// The one parallel region of the library throws where its lists of neighbours do.
TEST(ThreadTeam, CarriesOutWhatListsOfNeighboursRefuseInMotion) {
  const auto refused = testing::ThrowsMessage<InputError>(
      testing::HasSubstr("the grains overlap so much, or attract each other across such wide gaps"));
  for (const int n_threads : {1, 2}) {
    EXPECT_THAT([&] { close_upon<2>(n_threads); }, refused) << n_threads;
    EXPECT_THAT([&] { close_upon<3>(n_threads); }, refused) << n_threads;
  }
}

}  // namespace
}  // namespace floc
