#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/small_run.h"

namespace floc::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Scene that starts from four copies of an equilibrium of the small scene, side by side, and increases the pressure in
/// two steps. A run of the scene takes one or two seconds.
std::string tiled_scene() {
  std::string text = small_scene();
  const auto cut = [&text](const std::string& from, const std::string& to, const std::string& instead) {
    const auto at = text.find(from);
    text.replace(at, text.find(to, at) - at, instead);
  };
  cut("[grains]", "[contact]", "");
  cut("solid_fraction", "mass", "");
  cut("[assembly]", "[run]", R"([assembly]
protocol = "state"
state = "run/state-0003.h5"
copies = [2, 2]
pressure = 0.046415888336127795
[[load]]
to = 0.1
steps = 2
)");
  return text;
}

class RunFromAState : public SmallRun {
 protected:
  static void SetUpTestSuite() {
    SmallRun::SetUpTestSuite();
    write_text(file("tiled.toml"), tiled_scene());
  }
  static nlohmann::json row(const std::string& arguments) {
    return nlohmann::json::parse(floc(arguments + " --format json").out).at(0);
  }
};

TEST_F(RunFromAState, CopiesOfAnEquilibriumAreThatEquilibrium) {
  ASSERT_EQ(floc("run tiled.toml -o copies --until 0").code, 0);
  EXPECT_EQ(floc("verify copies/state-0000.h5").code, 0);
  const auto one = row("moduli run/state-0003.h5"), four = row("moduli copies/state-0000.h5");
  EXPECT_EQ(four.at("n_grains").get<int>(), 4 * one.at("n_grains").get<int>());
  EXPECT_EQ(four.at("n_contacts").get<int>(), 4 * one.at("n_contacts").get<int>());
  EXPECT_EQ(four.at("n_negative"), 0);
  // The response of a periodic network is periodic, so the four copies have the moduli of the single packing. The
  // errors of the solver and of rounding are at most 1e-10 (see moduli --tolerance).
  for (const char* modulus : {"phi", "B", "B_S", "G", "B_reuss", "B_voigt"})
    EXPECT_NEAR(four.at(modulus).get<double>() / one.at(modulus).get<double>(), 1.0, 1e-9) << modulus;
  const auto about = row("info copies/state-0000.h5"), parent = row("info run/state-0003.h5");
  EXPECT_EQ(about.at("ending"), "static");
  EXPECT_EQ(about.at("n_steps"), 0);
  EXPECT_EQ(about.at("parent_sha256"), parent.at("sha256"));
}

/// The start has the masses that follow from the density, and they are in the states of the run again.
TEST_F(RunFromAState, MovesWithEqualMasses) {
  const Outcome made =
      floc("run tiled.toml --set assembly.agitation=0.5 --set equilibrium.masses=equal -o equal");
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome verified = floc("verify equal");
  EXPECT_EQ(verified.code, 0) << verified.out;
}

TEST_F(RunFromAState, IsContinuedBitByBit) {
  const std::string agitated = "tiled.toml --set assembly.agitation=0.5";
  const Outcome whole = floc("run " + agitated + " -o whole");
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_THAT(whole.err, HasSubstr("starting state: run/state-0003.h5, 40 grains"));
  // agitated grains have to move before they come to rest
  EXPECT_GT(row("info whole/state-0000.h5").at("n_steps"), 0);
  const pid_t child = start_run(file("."), agitated + " -o broken");
  ::usleep(100000);
  ::kill(child, SIGTERM);
  wait_for(child);
  ASSERT_EQ(floc("run " + agitated + " -o broken --until 0 --resume").code, 0);
  ASSERT_EQ(floc("run " + agitated + " -o broken --resume").code, 0);
  expect_same_results(file("whole"), file("broken"), 3);
}

TEST_F(RunFromAState, DiffersBySeedOnlyWhereItIsAgitated) {
  const Outcome refused = floc("run tiled.toml -o same --seeds 1..2");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("--seeds 1..2"),
                                 HasSubstr("set assembly.agitation in the scene, or omit --seeds")));
  ASSERT_EQ(floc("run tiled.toml -o seeds --seeds 1..2 --until 0 --set assembly.agitation=2").code, 0);
  EXPECT_NE(row("info seeds/seed-1/state-0000.h5").at("phi"), row("info seeds/seed-2/state-0000.h5").at("phi"));
}

TEST_F(RunFromAState, IsReportedWithoutTheStateItBeganWith) {
  ASSERT_EQ(floc("run tiled.toml -o elsewhere/told --until 0").code, 0);
  const Outcome report = floc("report elsewhere/told -o told.html");
  EXPECT_EQ(report.code, 0);
  EXPECT_THAT(report.err, ::testing::Not(HasSubstr("cannot read the scene of the run")));
  EXPECT_THAT(content_of(file("told.html")), AllOf(HasSubstr("Dimensionless groups"), HasSubstr("160")));
}

TEST_F(RunFromAState, SaysWhichKeyNamesAFileThatIsNoState) {
  const Outcome refused = floc("run tiled.toml -o none --set assembly.state=tiled.toml");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("--set assembly.state=tiled.toml: assembly.state: tiled.toml"),
                                 HasSubstr("is not a state file of floc")));
  EXPECT_FALSE(exists("none"));
  const Outcome check = floc("scene check tiled.toml");
  EXPECT_EQ(check.code, 0);
  EXPECT_THAT(check.out, HasSubstr("N,160,number of grains"));
}

TEST_F(RunFromAState, IsNotContinuedFromAnotherState) {
  ASSERT_EQ(floc("run tiled.toml -o other --until 0").code, 0);
  const std::string original = content_of(file("run/state-0003.h5"));
  std::filesystem::copy_file(file("run/state-0004.h5"), file("run/state-0003.h5"),
                             std::filesystem::copy_options::overwrite_existing);
  const Outcome refused = floc("run tiled.toml -o other --resume");
  write_text(file("run/state-0003.h5"), original);
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, HasSubstr("another scene"));
}

}  // namespace
}  // namespace floc::test
