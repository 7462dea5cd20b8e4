#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/kill_and_resume.h"
#include "support/places.h"
#include "support/threaded_run.h"

namespace floc::test {
namespace {

namespace fs = std::filesystem;

/// Fixture: a scratch directory that contains the small scene, and a complete run of this scene that several
/// tests read.
class RunCommand : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchDirectory;
    write_text(scratch_->file("small.toml"), small_scene());
    whole_ = new Outcome(run_floc("run small.toml -o whole", scratch_->path()));
  }
  static void TearDownTestSuite() {
    delete whole_;
    delete scratch_;
  }

  static Outcome run(const std::string& arguments) { return run_floc("run " + arguments, scratch_->path()); }
  static std::string file(const std::string& name) { return scratch_->file(name); }

  static ScratchDirectory* scratch_;
  static Outcome* whole_;
};
ScratchDirectory* RunCommand::scratch_ = nullptr;
Outcome* RunCommand::whole_ = nullptr;

TEST_F(RunCommand, SavesAStateAndARowForEachEquilibriumAndNamesWhatComesNext) {
  EXPECT_EQ(whole_->code, 0) << whole_->err;
  EXPECT_TRUE(whole_->out.empty());
  for (int k = 0; k < 9; ++k) EXPECT_TRUE(fs::exists(file("whole/state-000" + std::to_string(k) + ".h5"))) << k;
  EXPECT_TRUE(fs::is_empty(file("whole/checkpoint")));
  EXPECT_THAT(whole_->err, ::testing::HasSubstr("floc moduli whole/state-*.h5"));
  const std::string table = content_of(file("whole/path.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 10);
  EXPECT_THAT(table, ::testing::StartsWith(
                         "step,branch,P_star,P,phi,void_ratio,L1,L2,z,z_plus,z_minus,z_zero,n_contacts,"
                         "n_distant,x0,residual_force,residual_moment,residual_stress,kinetic_energy,"
                         "n_negative,time,n_steps,seconds,state,ending,stress_1,stress_2,strain_1,"
                         "strain_2,p,q,K0,volumetric_strain,mobilised_friction,dilatancy,control,axis,"
                         "shear_strain,shear_stress,P_driven,P_driven_star\n"
                         "0,assembly,0,"));
}

TEST_F(RunCommand, MakesStatesThatVerify) {
  const Outcome verify = run_floc("verify whole/state-*.h5", scratch_->path());
  EXPECT_EQ(verify.code, 0) << verify.out << verify.err;
}

TEST_F(RunCommand, GivesTheSameFilesForTwoThreads) {
  // The scene has enough grains for three blocks, so that both threads have work (tests/unit/relaxation tests this). To
  // save time, the pressure is applied in a single step: threads are slow if they share a core with other tests.
  std::string scene = small_scene();
  const auto replace = [&scene](const std::string& old, const std::string& with) {
    scene.replace(scene.find(old), old.size(), with);
  };
  replace("count = 40", "count = 130");
  replace("\"aggregation\"\nagitation = 3.0\npressure = 0.01", "\"direct\"\npressure = 0.1");
  write_text(file("direct.toml"), scene);
  ASSERT_EQ(run("direct.toml --until 0 -o one").code, 0);
  ASSERT_TRUE(run_with_threads(file("direct.toml"), file("two"), 2, 0));
  EXPECT_TRUE(content_of(file("one/state-0000.h5")) == content_of(file("two/state-0000.h5")));
}

/// With several seeds, the program prints the message once and does not repeat it in the log of each sample.
TEST_F(RunCommand, SaysThatThreadsAreOfNoUseToFewGrains) {
  const std::string words = "40 disks: 1 of 2 threads is used, since ";
  const auto n_told = [&](const std::string& text) {
    int n = 0;
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++n;
    return n;
  };
  const Outcome one = run("small.toml --until 0 --threads 2 -o few");
  EXPECT_EQ(one.code, 0);
  EXPECT_EQ(n_told(one.err), 1) << one.err;
  EXPECT_EQ(n_told(run("small.toml --until 0 --threads 1 -o few --overwrite").err), 0);
  EXPECT_EQ(n_told(run("small.toml --until 0 --set run.threads=2 -o few --overwrite").err), 1);
  const Outcome all = run("small.toml --until 0 --threads 2 -o ensemble --seeds 1..2 --jobs 2");
  EXPECT_EQ(all.code, 0);
  EXPECT_EQ(n_told(all.err), 1) << all.err;
  EXPECT_EQ(n_told(content_of(file("ensemble/seed-1.log")) + content_of(file("ensemble/seed-2.log"))), 0);
}

TEST_F(RunCommand, SurvivesTwentyKillsWithoutATrace) {
  kill_and_resume(20, 5);
}

/// The small scene, compressed isotropically and then along its last axis.
std::string triaxial_scene() {
  const std::string scene = small_scene();
  const auto load = scene.find("[[load]]"), run = scene.find("[run]");
  return scene.substr(0, load) + R"([[load]]
to = 0.1
steps = 1
[[load]]
control = "triaxial"
strain = 0.05
strain_step = 0.01
)" + scene.substr(run);
}

TEST_F(RunCommand, SurvivesKillsOnATriaxialTurn) {
  kill_and_resume(10, 12, triaxial_scene(), 8);
}

TEST_F(RunCommand, StoppedBySignalsWritesACheckpointAndContinues) {
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove_all(file("stopped"));
    // Periodic checkpoints are switched off, so the signal must have caused the checkpoint that is found.
    const pid_t child = start_run(scratch_->path(), "small.toml -o stopped --set run.checkpoint_every=1e6");
    for (int k = 0; k < 60000 && !fs::exists(file("stopped/checkpoint")); ++k) ::usleep(1000);
    ::usleep(50000);
    ::kill(child, signal);
    const int status = wait_for(child);
    ASSERT_TRUE(WIFEXITED(status));
    ASSERT_EQ(WEXITSTATUS(status), 130);
    EXPECT_TRUE(fs::exists(file("stopped/checkpoint/checkpoint.h5")));
    ASSERT_EQ(run("small.toml -o stopped --resume --set run.checkpoint_every=1e6").code, 0);
  }
  // State files contain the scene. The command line changed the scene, so the files differ from those of the whole run.
  // The moduli of both runs must agree.
  const Outcome whole = run_floc("moduli whole/state-0008.h5 --format json", scratch_->path());
  const Outcome stopped = run_floc("moduli stopped/state-0008.h5 --format json", scratch_->path());
  const auto C11 = [](const Outcome& o) { return nlohmann::json::parse(o.out).at(0).at("C11").get<double>(); };
  EXPECT_EQ(C11(whole), C11(stopped));
}

TEST_F(RunCommand, StopsAfterTheStepAskedForAndGoesOn) {
  ASSERT_EQ(run("small.toml -o until --until 2").code, 0);
  EXPECT_TRUE(fs::exists(file("until/state-0002.h5")));
  EXPECT_FALSE(fs::exists(file("until/state-0003.h5")));
  ASSERT_EQ(run("small.toml -o until --resume").code, 0);
  expect_same_results(file("whole"), file("until"));
}

TEST_F(RunCommand, SaysWhatBlocksAStepThatDoesNotConverge) {
  const Outcome moving = run("small.toml -o short --set equilibrium.max_time=40");
  EXPECT_EQ(moving.code, 3);
  EXPECT_THAT(moving.err, ::testing::AllOf(::testing::HasSubstr("did not converge"),
                                           ::testing::AnyOf(::testing::HasSubstr("(tolerance "),
                                                            ::testing::HasSubstr("(limit "))));
  const Outcome apart = run("small.toml -o apart --set equilibrium.max_time=1");
  EXPECT_EQ(apart.code, 3);
  EXPECT_THAT(apart.err, ::testing::HasSubstr("clusters, but the aggregation ends only when they form one"));
}

TEST_F(RunCommand, TakesAStaticStepWhereNothingRearranges) {
  ASSERT_EQ(run("small.toml -o static --set equilibrium.finish=static").code, 0);
  EXPECT_EQ(run_floc("verify static/state-*.h5", scratch_->path()).code, 0);
}

TEST_F(RunCommand, RefusesADirectoryThatHoldsARun) {
  const Outcome refused = run("small.toml -o whole");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, ::testing::AllOf(::testing::HasSubstr("whole"), ::testing::HasSubstr("--resume"),
                                            ::testing::HasSubstr("--overwrite")));
}

TEST_F(RunCommand, RefusesToContinueAnotherScenesRun) {
  const Outcome refused = run("small.toml -o whole --resume --set contact.friction.coefficient=0.4");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, ::testing::HasSubstr("another scene"));
  EXPECT_EQ(run("small.toml -o whole --resume --seed 4").code, 4);
}

TEST_F(RunCommand, OverwritesWhenAsked) {
  ASSERT_EQ(run("small.toml -o over --seed 4 --until 1").code, 0);
  ASSERT_EQ(run("small.toml -o over --overwrite").code, 0);
  expect_same_results(file("whole"), file("over"));
}

TEST_F(RunCommand, CompletesARowThatAKillLeftOut) {
  fs::copy(file("whole"), file("rowless"), fs::copy_options::recursive);
  std::string table = content_of(file("whole/path.csv"));
  table.erase(table.rfind('\n', table.size() - 2) + 1);
  write_text(file("rowless/path.csv"), table);
  ASSERT_EQ(run("small.toml -o rowless --resume").code, 0);
  expect_same_results(file("whole"), file("rowless"));
}

TEST_F(RunCommand, ReportsADirectoryThatCannotBeWritten) {
  // Even root cannot create a directory below a file.
  write_text(file("taken"), "a file, no directory");
  const Outcome failed = run("small.toml -o taken/results");
  EXPECT_EQ(failed.code, 1);
  EXPECT_THAT(failed.err, ::testing::HasSubstr("taken/results"));
}

TEST_F(RunCommand, ReportsAFullDiskAndLeavesNoHalfWrittenFile) {
  // A limit of the file size has the same effect as a full disk: the kernel refuses to write.
  const Outcome failed =
      run_floc("--version >/dev/null; trap '' XFSZ; ulimit -f 4; " + floc_program() + " run small.toml -o full",
               scratch_->path());
  EXPECT_EQ(failed.code, 1);
  EXPECT_THAT(failed.err, ::testing::HasSubstr("full/"));
  for (const auto& entry : fs::recursive_directory_iterator(file("full")))
    EXPECT_TRUE(entry.is_directory()) << entry.path();
}

TEST_F(RunCommand, RefusesATruncatedStateByName) {
  fs::copy(file("whole"), file("cut"), fs::copy_options::recursive);
  fs::resize_file(file("cut/state-0008.h5"), 5000);
  const Outcome refused = run("small.toml -o cut --resume");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, ::testing::HasSubstr("state-0008.h5"));
}

TEST_F(RunCommand, SaysWhatIsWrongWithTheCommandLine) {
  EXPECT_EQ(run("small.toml").code, 2);
  EXPECT_EQ(run("small.toml -o x --threads 0").code, 2);
  EXPECT_EQ(run("absent.toml -o x").code, 4);
}

}  // namespace
}  // namespace floc::test
