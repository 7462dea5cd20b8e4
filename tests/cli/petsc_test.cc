#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "floc/petsc/parallel_solver.h"
#include "support/places.h"
#include "support/run_arguments.h"

/// Tests of `floc moduli --solver petsc`, as a single process and under mpirun.
namespace floc::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kPackingFolder = source_directory() + "/data/packings/";

/// Environment in which Open MPI runs as root and with more processes than processors. Memory leaks of MPI are
/// ignored.
const std::string kEnvironment =
    "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 "
    "OMPI_MCA_mpi_yield_when_idle=1 "
    "ASAN_OPTIONS=detect_leaks=0; ";

class Petsc : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_parallel_solver()) GTEST_SKIP() << "built without PETSc";
  }
  std::string file(const std::string& name) const { return scratch_.file(name); }
  /// Runs a shell command in the scratch directory, with $0 set to the path of floc.
  Outcome shell(const std::string& line) const {
    return run_arguments("/bin/sh",
                         {"-c", "cd '" + scratch_.path() + "' && " + kEnvironment + line, floc_program()});
  }
  Outcome together(int n_processes, const std::string& arguments) const {
    return shell("mpirun -n " + std::to_string(n_processes) + " \"$0\" moduli " + arguments);
  }
  /// Converts a shipped packing of LAMMPS, with a contact law chosen here.
  void convert(const std::string& name) const {
    const Outcome made =
        floc_arguments({"convert", kPackingFolder + "lammps/" + name + ".dump", file(name + ".h5"), "--law",
                        "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800"});
    ASSERT_EQ(made.code, 0) << made.err;
  }

  ScratchDirectory scratch_;
};

std::vector<std::string> entries_of(const json& row) {
  std::vector<std::string> names;
  for (const auto& [name, value] : row.items())
    if (name[0] == 'C' && name.size() == 3 && !value.is_null()) names.push_back(name);
  return names;
}

/// Compares all entries of C, and B, B_S and G.
void expect_same_moduli(const json& row, const json& exact, double tolerance) {
  std::vector<std::string> names = entries_of(exact);
  ASSERT_GE(names.size(), 3u);
  names.insert(names.end(), {"B", "B_S", "G"});
  const double size = exact.at("C11").get<double>();
  for (const std::string& name : names)
    EXPECT_NEAR(row.at(name).get<double>(), exact.at(name).get<double>(), tolerance * size) << name;
}

TEST_F(Petsc, GivesTheColumnsAndModuliOfAFactorAndAnErrorEstimate) {
  convert("disks"), convert("granular");
  const std::string options = "moduli --force --strains full --format json disks.h5 granular.h5";
  const Outcome o = shell("\"$0\" " + options + " --solver petsc");
  ASSERT_EQ(o.code, 0) << o.err;
  const json rows = json::parse(o.out);
  const json exact = json::parse(shell("\"$0\" " + options + " --solver cholmod").out);
  ASSERT_EQ(rows.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    expect_same_moduli(rows[k], exact[k], 1e-8);
    EXPECT_EQ(rows[k].at("method"), "petsc");
    EXPECT_TRUE(rows[k].at("n_mechanisms").is_null());
    for (const auto& [name, value] : exact[k].items()) EXPECT_TRUE(rows[k].contains(name)) << name;
    for (const char* same : {"n_contacts", "z", "P", "phi", "B_voigt", "n_rattlers", "Z_hat"})
      EXPECT_EQ(rows[k].at(same), exact[k].at(same)) << same;
    EXPECT_GT(rows[k].at("error_B").get<double>(), 0.0);
    EXPECT_LT(rows[k].at("error_B").get<double>(), 1e-9 * rows[k].at("B").get<double>());
  }
}

TEST_F(Petsc, GivesTheSameOnOneTwoAndFourProcesses) {
  convert("disks"), convert("granular");
  const std::string options = "--solver petsc --force --strains full --prestress --format json -o ";
  json one;
  for (const int n : {1, 2, 4}) {
    const std::string name = std::to_string(n) + ".json";
    const Outcome o = together(n, options + name + " disks.h5 granular.h5");
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.out, "");
    // Warnings are printed once, by the first process.
    EXPECT_EQ(o.err.find("is not in equilibrium"), o.err.rfind("is not in equilibrium")) << o.err;
    const json rows = json::parse(content_of(file(name)));
    ASSERT_EQ(rows.size(), 2u);
    if (one.is_null()) one = rows;
    for (std::size_t k = 0; k < 2; ++k) expect_same_moduli(rows[k], one[k], 1e-10);
  }
}

TEST_F(Petsc, IsTakenByItselfWhereAFactorWouldBeTooLarge) {
  convert("granular");
  const Outcome o = shell("\"$0\" moduli granular.h5 --force --format json --memory 1e-6");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("granular.h5: the Cholesky factor of the stiffness matrix would take "));
  EXPECT_THAT(o.err, HasSubstr("GB of memory, but it may take only 1e-06 GB; the moduli are computed by PETSc, "
                               "which needs no factor"));
  const json row = json::parse(o.out).at(0);
  EXPECT_EQ(row.at("method"), "petsc");
  const json exact = json::parse(shell("\"$0\" moduli granular.h5 --force --format json").out).at(0);
  EXPECT_EQ(exact.at("method"), "factor");
  expect_same_moduli(row, exact, 1e-8);
}

TEST_F(Petsc, SaysAFaultOnceAndGoesOnWithTheNextState) {
  convert("disks");
  write_text(file("text.h5"), "not a state");
  const Outcome o = together(2, "--solver petsc --format csv none.h5 text.h5 disks.h5 -o out.csv");
  EXPECT_EQ(o.code, 4);
  for (const char* words : {"none.h5: No such file", "text.h5: the file is not a state file of floc",
                            "disks.h5: this state is not in equilibrium"}) {
    EXPECT_THAT(o.err, HasSubstr(words));
    EXPECT_EQ(o.err.find(words), o.err.rfind(words)) << words;
  }
  const Outcome forced = together(2, "--solver petsc --format csv none.h5 disks.h5 --force -o out.csv");
  EXPECT_EQ(forced.code, 4);
  const std::string table = content_of(file("out.csv"));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2);
  EXPECT_EQ(together(2, "--solver petsc disks.h5").code, 5);
}

TEST_F(Petsc, GoesOnAfterAStateThatCannotHaveModuli) {
  convert("disks"), convert("granular");
  const Outcome o = together(2, "--solver petsc --force --kn 1 --kt 1 disks.h5 granular.h5");
  EXPECT_EQ(o.code, 4);
  for (const char* words :
       {"disks.h5: --kn: the contacts of this packing are elastic", "granular.h5: --kn: the contacts"}) {
    EXPECT_THAT(o.err, HasSubstr(words));
    EXPECT_EQ(o.err.find(words), o.err.rfind(words)) << words;
  }
}

TEST_F(Petsc, IsNotTakenWhereIncrementsNeedTheFactor) {
  convert("granular");
  const Outcome o = shell("\"$0\" moduli granular.h5 --force --memory 1e-6 --increments i.csv");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("and the increments of the forces need it: give a larger --memory"));
  EXPECT_FALSE(std::filesystem::exists(file("i.csv")));
}

TEST_F(Petsc, IsNotForOtherMethodsNorForIncrements) {
  convert("disks");
  for (const char* option : {"--method bounds", "--accuracy 0.1", "--increments i.csv"}) {
    const Outcome o = shell(std::string("\"$0\" moduli disks.h5 --solver petsc ") + option);
    EXPECT_EQ(o.code, 4) << option;
    EXPECT_THAT(o.err, HasSubstr("--solver")) << option;
  }
  EXPECT_EQ(shell("\"$0\" moduli disks.h5 --solver petsc - <disks.h5 --force").code, 0);
  const Outcome two = together(2, "--solver petsc - --force <disks.h5");
  EXPECT_EQ(two.code, 4);
  EXPECT_THAT(two.err, HasSubstr("this name means stdin, which only one process can read"));
}

TEST_F(Petsc, OnAFullDiskIsAFailureWithItsReason) {
  convert("disks");
  const Outcome full = shell("\"$0\" moduli disks.h5 --force --solver petsc >/dev/full");
  EXPECT_EQ(full.code, 1);
  EXPECT_THAT(full.err, HasSubstr("standard output: cannot be written: No space left on device"));
  for (const std::string run : {"", "mpirun -n 2 "}) {
    const Outcome o = shell(run + "\"$0\" moduli disks.h5 --force --solver petsc -o none/out.csv");
    EXPECT_EQ(o.code, 1) << run;
    EXPECT_THAT(o.err, HasSubstr("none/out.csv")) << run;
  }
  const Outcome limited = shell("ulimit -f 1; \"$0\" moduli disks.h5 --force -o out.csv");
  EXPECT_EQ(limited.code, 1);
  EXPECT_THAT(limited.err, HasSubstr("out.csv: cannot be written: File too large"));
  EXPECT_FALSE(fs::exists(file("out.csv")));
}

/// The first process waits for data from a pipe, which never arrive, and the second process waits for the first
/// process. The test then kills the second process.
TEST_F(Petsc, EndsWithinAMinuteWhereAProcessDiesAndLeavesNoTable) {
  const auto start = std::chrono::steady_clock::now();
  const Outcome o = shell(
      "mkfifo state.h5; mpirun -n 2 \"$0\" moduli --solver petsc state.h5 -o out.csv & m=$!; "
      "( sleep 60; kill -9 $m ) & w=$!; "
      "for i in $(seq 300); do for p in $(pgrep -P $m); do "
      "if tr '\\0' '\\n' </proc/$p/environ | grep -qx OMPI_COMM_WORLD_RANK=1; then sleep 1; kill -9 $p; break "
      "2; fi; "
      "done; sleep 0.1; done; wait $m; code=$?; kill $w; exit $code");
  EXPECT_NE(o.code, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(55));
  EXPECT_FALSE(fs::exists(file("out.csv")));
}

TEST_F(Petsc, WithoutItsModuleIsRefusedInWords) {
  convert("disks");
  fs::copy_file(floc_program(), file("floc"));
  const Outcome o = shell("./floc moduli disks.h5 --force --solver petsc");
  EXPECT_EQ(o.code, 1);
  EXPECT_THAT(o.err, HasSubstr("the PETSc module cannot be loaded"));
  EXPECT_EQ(shell("./floc moduli disks.h5 --force").code, 0);
}

TEST(WithoutPetsc, TheSolverIsRefusedInWords) {
  if (has_parallel_solver()) GTEST_SKIP() << "built with PETSc";
  const ScratchDirectory scratch;
  const Outcome o = run_floc("moduli state.h5 --solver petsc", scratch.path());
  EXPECT_EQ(o.code, 1);
  EXPECT_THAT(o.err, HasSubstr("built without PETSc"));
}

}  // namespace
}  // namespace floc::test
