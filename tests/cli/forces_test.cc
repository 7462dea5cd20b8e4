#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "support/small_run.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The small scene without rolling resistance, because rolling moments would have a limit of their own.
std::string scene_without_rolling() {
  std::string text = small_scene();
  const std::size_t begin = text.find("rolling =");
  if (begin != std::string::npos) text.erase(begin, text.find('\n', begin) - begin);
  return text;
}

std::vector<std::string> separated(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

class ForcesCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new ScratchDirectory;
    write_text(scratch_->file("rolling.toml"), small_scene());
    write_text(scratch_->file("slipping.toml"), scene_without_rolling());
    for (const std::string run :
         {"run rolling.toml -o rolling --until 1", "run slipping.toml -o slipping --until 1",
          "run slipping.toml -o frictionless --until 1 --set contact.friction.coefficient=0"}) {
      const Outcome made = run_floc(run, scratch_->path());
      ASSERT_EQ(made.code, 0) << made.err;
    }
  }
  static void TearDownTestSuite() { delete scratch_; }
  static Outcome forces(const std::string& arguments) {
    return run_floc("forces " + arguments, scratch_->path());
  }
  static json row(const std::string& arguments) {
    const Outcome o = forces(arguments + " --format json");
    EXPECT_EQ(o.code, 0) << o.err;
    return json::parse(o.out).at(0);
  }
  static std::string file(const std::string& name) { return scratch_->file(name); }

 private:
  inline static ScratchDirectory* scratch_ = nullptr;
};

TEST_F(ForcesCommand, LeaveAnEquilibriumWithFrictionAsItIs) {
  const json closest = row("slipping/state-0001.h5");
  EXPECT_EQ(closest.at("selection"), "closest");
  // The saved forces balance only within the tolerance of the state. The exactly balanced forces therefore differ from
  // the saved forces by about this tolerance.
  EXPECT_LT(closest.at("moved").get<double>(), 1e-4);
  EXPECT_LT(closest.at("net_force").get<double>(), 1e-10);
  EXPECT_LT(closest.at("stress_error").get<double>(), 1e-10);
  // Other forces also balance on the same geometry; the saved forces depend on the loading history.
  EXPECT_GT(closest.at("force_freedom").get<double>(), 1e-3);
  const json canonical = row("slipping/state-0001.h5 --selection canonical");
  EXPECT_EQ(canonical.at("force_freedom"), 0.0);
  EXPECT_GT(canonical.at("moved").get<double>(), 1e-3);
}

TEST_F(ForcesCommand, ListContactsWithTheRangesOfTheirForces) {
  const json state =
      row("slipping/state-0001.h5 --selection canonical --kn 2 --kt 1 --contacts c.csv --range-of 0,2");
  const std::vector<std::string> lines = separated(content_of(file("c.csv")), '\n');
  ASSERT_EQ(lines.size(), state.at("n_contacts").get<std::size_t>() + 1);
  EXPECT_EQ(
      lines[0],
      "file,contact,id1,id2,image1,image2,gap,normal_force,shear_force1,shear_force2,smallest_normal_force,"
      "largest_normal_force");
  EXPECT_THAT(lines[2], testing::EndsWith(",,"));
  for (const int contact : {0, 2}) {
    const std::vector<std::string> cells = separated(lines[contact + 1], ',');
    EXPECT_LE(std::stod(cells[10]), std::stod(cells[7]) + 1e-9);
    EXPECT_GE(std::stod(cells[11]), std::stod(cells[7]) - 1e-9);
  }
}

/// Two disks, one on the other, on a floor under a free surface. The weights alone determine the forces, whatever
/// forces the file has; without forces in the file, too.
TEST_F(ForcesCommand, BalanceTheWeightsUnderAFreeSurface) {
  write_text(file("pile.csv"), "id,x,y,radius,mass\n1,1,0.5,0.5,1\n2,1,1.5,0.5,1\n");
  const std::string convert =
      "convert pile.csv pile.h5 --overwrite --law normal.law=rigid,friction.coefficient=0.5 "
      "--walls x=0:2,y=0: --gravity 0,-1 --tolerance 2 ";
  for (const auto& [upper, lower] : {std::pair(1.0, 2.0), {1.02, 2.0}, {1.0, 2.02}, {0.3, 5.0}, {0.0, 0.0}}) {
    std::ostringstream contacts;
    contacts << "id1,id2,normal_force\n1,2," << upper << "\n1,y-," << lower << "\n";
    write_text(file("pile_contacts.csv"), contacts.str());
    const Outcome made = run_floc(convert + "--contacts pile_contacts.csv", file(""));
    ASSERT_EQ(made.code, 0) << made.err;
    const Outcome o = forces("pile.h5 --contacts balanced.csv");
    ASSERT_EQ(o.code, 0) << upper << ", " << lower << ": " << o.err;
    std::istringstream in(content_of(file("balanced.csv")));
    const CsvTable table = CsvTable::parse("balanced.csv", in);
    EXPECT_NEAR(table.number(0, table.column("normal_force")), 1.0, 1e-9) << upper << ", " << lower;
    EXPECT_NEAR(table.number(1, table.column("normal_force")), 2.0, 1e-9) << upper << ", " << lower;
  }
}

TEST_F(ForcesCommand, RefuseInWordsWhatHasNone) {
  const std::pair<const char*, const char*> refusals[] = {
      {"rolling/state-0001.h5", "rolling/state-0001.h5: its contact law resists rolling or twisting"},
      {"slipping/state-0001.h5 --stress 1,2,3,4", "stress: there are 4 components: expected the pressure"},
      {"slipping/state-0001.h5 --contacts c.csv --range-of 100000",
       "contact 100000: this state has no contact with this number: expected a number from 0 to"},
  };
  for (const auto& [arguments, words] : refusals) {
    const Outcome o = forces(arguments);
    EXPECT_EQ(o.code, 4) << arguments;
    EXPECT_THAT(o.err, HasSubstr(words));
  }
}

TEST_F(ForcesCommand, EndWithThreeWhereNoForcesBalanceTheLoad) {
  // The shear stress exceeds the pressure, which is impossible without friction.
  const Outcome o = forces("frictionless/state-0001.h5 --stress 1,1,5");
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err,
              HasSubstr("no set of contact forces balances the load: this is not an equilibrium of rigid "
                        "grains; the load moves most grain"));
}

}  // namespace
}  // namespace floc::test
