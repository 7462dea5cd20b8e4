#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "floc/io/csv.h"
#include "support/kill_and_resume.h"
#include "support/places.h"
#include "support/run_arguments.h"

namespace floc::test {
namespace {

using nlohmann::json;

/// Fixture: a run with --track-contacts, and the same run without.
class TrackContacts : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchDirectory;
    write_text(scratch_->file("small.toml"), small_scene());
    ASSERT_EQ(run_floc("run small.toml -o plain", scratch_->path()).code, 0);
    ASSERT_EQ(run_floc("run small.toml -o seen --track-contacts 0.05", scratch_->path()).code, 0);
  }
  static void TearDownTestSuite() { delete scratch_; }

  static std::string file(const std::string& name) { return scratch_->file(name); }
  static std::string state(int k) { return "seen/state-000" + std::to_string(k) + ".h5"; }

  static ScratchDirectory* scratch_;
};
ScratchDirectory* TrackContacts::scratch_ = nullptr;

TEST_F(TrackContacts, LeavesNoTraceInTheRun) {
  for (int k = 0; k < 9; ++k) {
    const std::string name = "/state-000" + std::to_string(k) + ".h5";
    EXPECT_EQ(content_of(file("plain" + name)), content_of(file("seen" + name))) << k;
  }
  EXPECT_FALSE(std::filesystem::exists(file("plain/contacts.csv")));
}

TEST_F(TrackContacts, RowsAddUpAndEndWithWhatCompareFinds) {
  const CsvTable rows = CsvTable::read(file("seen/contacts.csv"));
  const auto at = [&rows](int row, const char* name) { return rows.number(row, rows.column(name)); };
  ASSERT_GT(rows.n_rows(), 100);
  int n_events = 0;
  for (int r = 1; r < rows.n_rows(); ++r) {
    EXPECT_EQ(at(r, "n_contacts"), at(r - 1, "n_contacts") + at(r, "gained") - at(r, "lost")) << r;
    EXPECT_GE(at(r, "time"), at(r - 1, "time"));
    EXPECT_LE(at(r, "time"), at(r - 1, "time") + 0.08) << r;
    n_events += static_cast<int>(at(r, "gained") + at(r, "lost"));
  }
  EXPECT_GT(n_events, 20);
  const json net = json::parse(run_floc("compare seen/state-*.h5 --format json", scratch_->path()).out);
  ASSERT_EQ(net.size(), 8u);
  int step = 0;
  for (int r = 0; r + 1 < rows.n_rows(); ++r) {
    if (at(r + 1, "step") == at(r, "step")) continue;
    if (step > 0) {
      EXPECT_EQ(at(r, "kept"), net.at(step - 1).at("n_kept").get<int>()) << step;
      EXPECT_EQ(at(r, "n_contacts"), net.at(step - 1).at("n_after").get<int>()) << step;
    }
    ++step;
  }
  EXPECT_EQ(step, 8);
}

TEST_F(TrackContacts, GoesOnWhereItStopped) {
  // The run is first stopped between two load steps, and then several times at random within load steps.
  ASSERT_EQ(run_floc("run small.toml -o halves --track-contacts 0.05 --until 2", scratch_->path()).code, 0);
  int n_interrupted = 0;
  for (double seconds = 0.05; seconds < 5.0 && n_interrupted < 2; seconds *= 1.3) {
    const Outcome o = run_arguments(
        "/usr/bin/timeout", {"-s", "TERM", std::to_string(seconds), floc_program(), "run", file("small.toml"),
                             "-o", file("halves"), "--track-contacts", "0.05", "--resume"});
    n_interrupted += o.err.find("interrupted") != std::string::npos;
    if (o.code == 0) break;
  }
  EXPECT_GT(n_interrupted, 0);
  ASSERT_EQ(run_floc("run small.toml -o halves --track-contacts 0.05 --resume", scratch_->path()).code, 0);
  EXPECT_EQ(content_of(file("halves/contacts.csv")), content_of(file("seen/contacts.csv")));
}

TEST_F(TrackContacts, RefusesATimeThatIsNone) {
  EXPECT_EQ(run_floc("run small.toml -o none --track-contacts 0", scratch_->path()).code, 2);
  const Outcome o = run_floc("run small.toml -o plain --resume --track-contacts 1", scratch_->path());
  EXPECT_EQ(o.code, 0);  // the run is already complete
}

}  // namespace
}  // namespace floc::test
