#include "support/rigid_run.h"

#include "support/kill_and_resume.h"

namespace floc::test {
namespace {

TEST(RigidRun, KillsOfARunOfDisksLeaveNoTrace) {
  kill_and_resume(3, 21, rigid_scene(""), 4);
}

TEST(RigidRun, KillsOfARunOfPentagonsLeaveNoTrace) {
  kill_and_resume(3, 22, rigid_scene(kPentagons), 4);
}

}  // namespace
}  // namespace floc::test
