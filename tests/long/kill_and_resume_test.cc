#include "support/kill_and_resume.h"

namespace floc::test {
namespace {

TEST(KillAndResume, TwoHundredKillsLeaveNoTrace) {
  kill_and_resume(200, 6);
}

}  // namespace
}  // namespace floc::test
