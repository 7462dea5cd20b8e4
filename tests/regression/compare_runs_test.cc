#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "floc/io/state_file.h"
#include "support/kill_and_resume.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

/// Runs compare_runs.py with the Python interpreter for which Debian installs python3-h5py.
Outcome compare_runs(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), source_directory() + "/tests/regression/compare_runs.py");
  return run_arguments("/usr/bin/python3", arguments);
}

/// Fixture: three states of a few dozen grains in a/, and a copy of these states in b/.
class TwoRuns : public ::testing::Test {
 protected:
  void SetUp() override {
    write_text(scratch_.file("small.toml"), small_scene());
    const Outcome made = run_floc("run small.toml -o a --until 2", scratch_.path());
    ASSERT_EQ(made.code, 0) << made.err;
    std::filesystem::copy(a(), b());
  }

  std::string a() const { return scratch_.file("a"); }
  std::string b() const { return scratch_.file("b"); }
  Outcome compared() const { return compare_runs({a(), b()}); }

 private:
  ScratchDirectory scratch_;
};

TEST_F(TwoRuns, ThatAreCopiesAreTheSame) {
  const Outcome result = compared();
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  EXPECT_EQ(result.out, "3 states and path.csv: the same, bit for bit\n");
}

TEST_F(TwoRuns, DifferWhereOneNumberDoes) {
  const std::string changed = b() + "/state-0001.h5";
  auto state = std::get<State<2>>(read_state(changed));
  state.packing.grains.position[3][1] += 1e-13;
  state.packing.contacts[0].shear_force[0] += 0.25;
  write_state(changed, state);
  const Outcome result = compared();
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_THAT(result.out,
              ContainsRegex("^state-0001.h5: grains/position differs in 1 of 80 numbers, by at most "
                            "(9.9|1)[0-9.]*e-(13|14) \\(entry 3, 1: "));
  EXPECT_THAT(result.out, HasSubstr("\n3 states and path.csv: 1 differ\n"));
}

TEST_F(TwoRuns, AreTheSameButForRoundingOfResidualsWhereThatIsAllowed) {
  const std::string changed = b() + "/state-0001.h5";
  auto state = std::get<State<2>>(read_state(changed));
  state.residuals.moment += 1e-15;
  write_state(changed, state);
  EXPECT_EQ(compared().code, 1);
  EXPECT_EQ(compare_runs({a(), b(), "--residuals", "1e-16"}).code, 1);
  const Outcome result = compare_runs({a(), b(), "--residuals", "2e-15"});
  EXPECT_EQ(result.code, 0) << result.out << result.err;
  EXPECT_EQ(
      result.out,
      "3 states and path.csv: the same, bit for bit, but for 1 differences of residuals by at most 2e-15\n");
}

TEST_F(TwoRuns, DifferWhereAStateIsMissing) {
  std::filesystem::remove(b() + "/state-0002.h5");
  const Outcome result = compared();
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_THAT(result.out, HasSubstr("state-0002.h5: is missing in " + b()));
}

TEST_F(TwoRuns, DifferInPathsButNotInTheirSeconds) {
  const std::string header = "step,phi,seconds,state\n";
  write_text(a() + "/path.csv", header + "0,0.5,1.0,state-0000.h5\n1,0.6,1.0,state-0001.h5\n");
  write_text(b() + "/path.csv", header + "0,0.5,2.0,state-0000.h5\n1,0.6,3.0,state-0001.h5\n");
  EXPECT_EQ(compared().code, 0);
  write_text(b() + "/path.csv", header + "0,0.5,1.0,state-0000.h5\n1,0.61,1.0,state-0001.h5\n");
  const Outcome result = compared();
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_THAT(result.out, HasSubstr("path.csv: row 1, phi: 0.6 against 0.61\n"));
}

TEST_F(TwoRuns, AreTheSameWhereverTheFileKeepsItsMemory) {
  // In files of version 1, the history of contacts is stored only in datasets of contacts/.
  const std::string move_memory =
      "import h5py, sys\n"
      "with h5py.File(sys.argv[1], 'r+') as f:\n"
      "    del f['contacts/memory']\n";
  const Outcome moved = run_arguments("/usr/bin/python3", {"-c", move_memory, b() + "/state-0002.h5"});
  ASSERT_EQ(moved.code, 0) << moved.err;
  const Outcome result = compared();
  EXPECT_EQ(result.code, 0) << result.out << result.err;
}

// In the two groups, phi of samples of the same name differs by 0.01, 0.02 and 0.03. The mean is 0.02, the standard
// error 0.01/sqrt(3), and t = 2 sqrt(3). B differs by the factor e (2.718) in all pairs, so the differences of ln B
// have no scatter.
TEST(MeansOfRuns, ComeWithTheirPairedErrorAndStudentsT) {
  const ScratchDirectory scratch;
  std::vector<std::string> samples[2];
  for (const int side : {0, 1})
    for (const int seed : {1, 2, 3}) {
      const std::string directory = scratch.file(side == 0 ? "a" : "b") + "/seed-" + std::to_string(seed);
      samples[side].push_back(directory);
      std::filesystem::create_directories(directory);
      const double phi = 0.3 + 0.1 * seed + side * 0.01 * seed;
      write_text(directory + "/path.csv",
                 "step,phi,z,state\n6," + std::to_string(phi) + ",3.25,state-0006.h5\n");
      write_text(directory + "/moduli.csv", std::string("file,B,G\nelsewhere/state-0006.h5,") +
                                                (side == 0 ? "1" : "2.718281828459045") + ",\n");
    }
  std::vector<std::string> arguments = {"--means"};
  arguments.insert(arguments.end(), samples[0].begin(), samples[0].end());
  arguments.emplace_back("--against");
  // samples are paired by name; here they are given in reverse order
  arguments.insert(arguments.end(), samples[1].rbegin(), samples[1].rend());
  const Outcome result = compare_runs(arguments);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(ContainsRegex("phi +6 +3 +0.5 +0.52 +0.02 +0.00577 +3.46\n"),
                                ContainsRegex("z +6 +3 +3.25 +3.25 +0 +0 +0.00\n"),
                                ContainsRegex("ln B +6 +3 +0 +1 +1 +0 +inf\n"),
                                HasSubstr("largest |t| = inf (ln B at step 6), of 3\n")));
  arguments.pop_back();
  EXPECT_EQ(compare_runs(arguments).code, 2);
}

}  // namespace
}  // namespace floc::test
