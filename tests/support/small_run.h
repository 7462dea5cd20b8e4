#pragma once

#include <gtest/gtest.h>

#include "support/kill_and_resume.h"

namespace floc::test {

/// Fixture: a directory with a run of the small scene in `run/`. The run is made once for all tests of a suite. It
/// consists of the assembly, seven states of loading and one state of unloading.
class SmallRun : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchDirectory;
    write_text(scratch_->file("small.toml"), small_scene());
    const Outcome made = run_floc("run small.toml -o run", scratch_->path());
    ASSERT_EQ(made.code, 0) << made.err;
  }
  static void TearDownTestSuite() { delete scratch_; }

  static Outcome floc(const std::string& arguments, const std::string& input = "") {
    return run_floc(arguments, scratch_->path(), input);
  }
  static std::string file(const std::string& name) { return scratch_->file(name); }
  static bool exists(const std::string& name) { return std::filesystem::exists(file(name)); }

 private:
  inline static ScratchDirectory* scratch_ = nullptr;
};

}  // namespace floc::test
