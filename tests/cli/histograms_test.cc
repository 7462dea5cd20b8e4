#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "floc/io/csv.h"
#include "support/run_program.h"
#include "support/small_run.h"

namespace floc::test {
namespace {

using testing::HasSubstr;

/// Command that writes a file with several histograms, and the columns that identify the histogram of a row.
struct Histograms {
  std::string command;
  std::vector<std::string> key;
};

/// Checks every distribution of a file. The bins must be ordered and have finite ends. Every value must be counted,
/// either in a bin or as outside of the bins.
/// @return number of distributions
int check_bins(const CsvTable& table, const std::vector<std::string>& key, const std::string& what) {
  std::map<std::string, std::int64_t> counted, n, outside;
  std::map<std::string, double> last;
  for (int r = 0; r < table.n_rows(); ++r) {
    std::string of;
    for (const std::string& column : key) of += table.text(r, table.column(column)) + " ";
    const double low = table.number(r, table.column("low")), high = table.number(r, table.column("high"));
    EXPECT_LT(low, high) << what << ", " << of;
    if (last.contains(of)) {
      EXPECT_GE(low, last[of] - 1e-9 * std::abs(low)) << what << ", " << of;
    }
    last[of] = high;
    counted[of] += table.integer(r, table.column("count"));
    n[of] = table.integer(r, table.column("n"));
    outside[of] = table.integer(r, table.column("n_outside"));
    EXPECT_GE(table.number(r, table.column("density")), 0.0) << what;
  }
  for (const auto& [of, all] : n) EXPECT_EQ(counted[of] + outside[of], all) << what << ", " << of;
  return static_cast<int>(n.size());
}

class HistogramsOfCommands : public SmallRun {};

TEST_F(HistogramsOfCommands, HoldEveryValueOrSayThatItIsOutside) {
  int n_files = 0, n_distributions = 0, n_outside = 0;
  for (const Histograms& of :
       {Histograms{"network run/state-*.h5 --pdf h.csv --unit {} --bin-width {}", {"file", "kind"}},
        {"network run/state-*.h5 --pressure-pdf h.csv --pressure-bin-width {1}", {"file"}},
        {"lattice run/state-0004.h5 --stiffness grain=20,matrix=1 --matrix 0.08 --pdf h.csv "
         "--bin-width {1}",
         {"of"}}}) {
    const bool has_units = of.command.find("--unit") != std::string::npos;
    for (const char* unit : {"mean", "F0", "P"}) {
      if (!has_units && std::string(unit) != "mean") continue;
      for (const char* width : {"0.1", "3", "1e-9", "1e6"}) {
        const std::string command = fmt::format(fmt::runtime(of.command), unit, width);
        const Outcome o = floc(command);
        ASSERT_EQ(o.code, 0) << command << ": " << o.err;
        const bool said = o.err.find("are in no bin of their distribution") != std::string::npos;
        EXPECT_EQ(said, std::string(width) == "1e-9") << command << ": " << o.err;
        n_outside += said ? 1 : 0;
        if (content_of(file("h.csv")).size() > 0)
          n_distributions += check_bins(CsvTable::read(file("h.csv")), of.key, command);
        ++n_files;
      }
    }
  }
  fmt::print("{} files of histograms with {} distributions, {} with values outside\n", n_files, n_distributions,
             n_outside);
  EXPECT_GT(n_distributions, 100);
}

/// Two states with forces of order F0: one at P* = 1e-6 and one at P = 0. The printed P of the second state is not
/// zero, but a small number within the tolerance of equilibrium.
TEST(Histograms, OfSmallPressuresHaveNoUnitOfNoise) {
  const ScratchDirectory scratch;
  write_text(scratch.file("s.toml"), R"([scene]
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e4}
adhesion = {law = "tail", force = 1.0, range = 1e-3}
damping = {restitution = 0.1, mass = "effective"}
friction = {coefficient = 0.5, stiffness = 1e4}
[cell]
solid_fraction = 0.4
[assembly]
protocol = "aggregation"
agitation = 9.5
pressure = 1e-5
[[load]]
to = 1e-6
steps = 1
[equilibrium]
stress = 1e-9
force = 1e-9
moment = 1e-9
energy = 1e-12
)");
  const Outcome run = run_floc("run s.toml -o run", scratch.path());
  ASSERT_EQ(run.code, 0) << run.err;
  const auto said = [&](const std::string& state, const std::string& unit) {
    const Outcome o = run_floc("network run/" + state + " --pdf h.csv --unit " + unit, scratch.path());
    EXPECT_EQ(o.code, 0) << o.err;
    return o.err;
  };
  const std::string none = said("state-0000.h5", "P");
  EXPECT_THAT(none,
              HasSubstr("the distribution of the normal forces is left out, because they cannot be "
                        "expressed in the chosen unit: the pressure P cannot be distinguished from zero"));
  EXPECT_EQ(CsvTable::read(scratch.file("h.csv")).n_rows(), 0);
  EXPECT_THAT(said("state-0002.h5", "P"), HasSubstr("normal forces are in no bin of their distribution"));
  const CsvTable h = CsvTable::read(scratch.file("h.csv"));
  check_bins(h, {"kind"}, "P* = 1e-6");
  for (int r = 0; r < h.n_rows(); ++r)
    if (h.text(r, h.column("kind")) == "normal") {
      EXPECT_LE(std::abs(h.number(r, h.column("low"))), 1e4);
    }
}

}  // namespace
}  // namespace floc::test
