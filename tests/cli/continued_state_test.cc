#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/io/csv.h"
#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

const char* const kDiskContacts = R"([scene]
dimension = 2
units = "reduced"
[contact]
normal = {law = "linear", stiffness = 1.0}
damping = {restitution = 0.015, mass = "effective"}
friction = {coefficient = 0.5, stiffness = 1.0}
)";
const char* const kSixtyDisks = R"([grains]
count = 60
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[cell]
solid_fraction = 0.36
mass = 0.1
inertial_number_cap = 1e-2
[assembly]
protocol = "direct"
pressure = 1e-3
friction = 0.0
)";
const char* const kFromState = R"([cell]
mass = 0.1
inertial_number_cap = 1e-2
[assembly]
protocol = "state"
state = "a/state-0002.h5"
copies = [1, 1]
)";

std::string driven_stage(const std::string& control, double strain, int steps) {
  return fmt::format("[[load]]\ncontrol = \"{}\"\naxis = 2\nstrain = {}\nsteps = {}\n", control, strain, steps);
}

/// Fixture: runs, and scenes that start from the last state of a run and give no pressure.
class ContinuedState : public testing::Test {
 protected:
  void run(const std::string& name, const std::string& text) const {
    write_text(scratch_.file(name + ".toml"), text);
    const Outcome o = run_floc(fmt::format("run {0}.toml -o {0} --no-timing", name), scratch_.path());
    ASSERT_EQ(o.code, 0) << o.err;
  }
  CsvTable path(const std::string& name) const { return CsvTable::read(scratch_.file(name + "/path.csv")); }

  ScratchDirectory scratch_;
};

/// Expects that two tables have equal values in the given rows, within a relative tolerance.
/// @param column  column of both tables
void expect_same(const CsvTable& a, int row_a, const CsvTable& b, int row_b, const char* column,
                 double relative) {
  const double x = a.number(row_a, a.column(column)), y = b.number(row_b, b.column(column));
  EXPECT_NEAR(x, y, relative * std::abs(y)) << column;
}

TEST_F(ContinuedState, KeepsItsStressesAndGoesOnAsIfItHadNotEnded) {
  run("a", std::string(kDiskContacts) + kSixtyDisks + driven_stage("triaxial", 0.008, 2));
  run("whole", std::string(kDiskContacts) + kSixtyDisks + driven_stage("triaxial", 0.012, 3));
  run("b", std::string(kDiskContacts) + kFromState + driven_stage("triaxial", 0.004, 1));
  const CsvTable a = path("a"), b = path("b"), whole = path("whole");
  ASSERT_EQ(b.n_rows(), 2);
  EXPECT_EQ(b.text(0, b.column("ending")), "static");
  for (const char* column : {"P", "phi", "stress_1", "stress_2", "L1", "L2", "z", "P_driven"}) {
    expect_same(b, 0, a, 2, column, 1e-9);
    expect_same(b, 1, whole, 3, column, 1e-3);
  }
  // `floc verify` reads the scene of the second run again.
  EXPECT_EQ(run_floc("verify b", scratch_.path()).code, 0);
}

TEST_F(ContinuedState, GoesOnInASkewedCell) {
  run("a", std::string(kDiskContacts) + kSixtyDisks + driven_stage("simple_shear", 0.02, 2));
  run("b", std::string(kDiskContacts) + kFromState + driven_stage("simple_shear", 0.01, 1));
  run("whole", std::string(kDiskContacts) + kSixtyDisks + driven_stage("simple_shear", 0.03, 3));
  const auto printed = [&](const std::string& state, const std::string& column) {
    return run_floc("info " + state + " --format csv --columns " + column, scratch_.path()).out;
  };
  EXPECT_EQ(printed("b/state-0000.h5", "cell"), printed("a/state-0002.h5", "cell"));
  EXPECT_THAT(printed("b/state-0000.h5", "cell"), testing::Not(HasSubstr(",0;0,")));
  const CsvTable b = path("b"), whole = path("whole");
  // In each stage, the shear strain refers to the height of the cell at the start of the stage, so the two runs differ
  // slightly.
  for (const char* column : {"P", "phi", "stress_1", "stress_2"}) expect_same(b, 1, whole, 3, column, 5e-2);
  EXPECT_EQ(run_floc("verify b", scratch_.path()).code, 0);
  // With an isotropic pressure, the grains relax while the cell stays skewed.
  run("c", std::string(kDiskContacts) + kFromState + "pressure = 1e-3\n");
  EXPECT_NEAR(path("c").number(0, path("c").column("stress_1")), 1e-3, 1e-7);
  EXPECT_EQ(run_floc("verify c", scratch_.path()).code, 0);
}

}  // namespace
}  // namespace floc::test
