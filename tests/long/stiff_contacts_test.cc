#include <gtest/gtest.h>

#include "floc/io/state_file.h"
#include "support/contact_laws.h"
#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

/// A loose powder of 1400 disks with stiffer and stiffer contacts, up to kappa = 1e9. Every state must reach an
/// equilibrium within the usual tolerance, and the file of the state must pass floc verify.
TEST(StiffContacts, OfALoosePowderReachAnEquilibriumThatTheirFileHolds) {
  const ScratchDirectory scratch;
  const Outcome run =
      run_floc("run " + source_directory() + "/data/scenes/stiff_contacts.toml -o stiff", scratch.path());
  ASSERT_EQ(run.code, 0) << run.err;
  const Outcome verified = run_floc("verify stiff/state-*.h5", scratch.path());
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  const State<2> last = std::get<State<2>>(read_state(scratch.file("stiff/state-0008.h5")));
  EXPECT_EQ(test::law_number(last.packing.law, "normal.stiffness"), 1e9);
  EXPECT_EQ(last.packing.grains.size(), 1400);
  EXPECT_LT(last.residuals.force, 1e-5);
}

}  // namespace
}  // namespace floc::test
