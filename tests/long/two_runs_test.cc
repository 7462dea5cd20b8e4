#include "support/two_runs.h"

namespace floc::test {
namespace {

TEST(TwoRuns, StartedFiftyTimesOnOneDirectoryNeverMix) {
  start_two_runs_on_one_directory(50, 11);
}

}  // namespace
}  // namespace floc::test
