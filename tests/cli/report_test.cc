#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/io/state_file.h"
#include "support/run_program.h"
#include "support/scratch_directory.h"
#include "support/states.h"

namespace floc::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Fixture: the directory of a run with two states of spheres.
class ReportOfSpheres : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(scratch_.file("run"));
    for (const int step : {0, 1}) write_state(file_of(step), state_at<3>(step));
    write_text(scratch_.file("run/path.csv"),
               "step,branch,P_star,phi,z,z_plus,z_minus,z_zero,state\n"
               "0,load,0.01,0.50,4.1,4.0,0.1,0,state-0000.h5\n1,load,0.02,0.51,4.2,4.1,0.1,0,state-0001.h5\n");
  }
  std::string file_of(int step) { return scratch_.file("run/state-000" + std::to_string(step) + ".h5"); }
  template <int Dim>
  static State<Dim> state_at(int step) {
    State<Dim> state = busy_state<Dim>();
    state.path.step = step;
    return state;
  }
  Outcome report() { return run_floc("report run -o run.html", scratch_.path()); }

  ScratchDirectory scratch_;
};

TEST_F(ReportOfSpheres, HasPicturesAndTables) {
  const Outcome o = report();
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(content_of(scratch_.file("run.html")),
              AllOf(HasSubstr("3 spheres, 2 equilibrium states"), HasSubstr("radialGradient"),
                    HasSubstr("F0/a²"), HasSubstr("Scattered intensity I(k) of the grains")));
}

TEST_F(ReportOfSpheres, RefusesDisksAmongThem) {
  write_state(file_of(1), state_at<2>(1));
  const Outcome o = report();
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err,
              HasSubstr("state-0001.h5: this state has another dimension than the 3D state run/state-0000.h5: "
                        "expected the states of one run"));
}

}  // namespace
}  // namespace floc::test
