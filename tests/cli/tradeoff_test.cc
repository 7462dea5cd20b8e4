#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <vector>

#include "support/places.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Arguments for a scene so small that a sample takes a fraction of a second.
const std::string kSmall = source_directory() +
                           "/data/scenes/type1_rolling_small.toml --set grains.count=40 --set load.0.to=0.1 "
                           "--set load.0.steps_per_decade=2 ";

TEST(TradeoffCommand, MeasuresEverySettingAgainstTheStrictest) {
  const ScratchDirectory scratch;
  const Outcome o =
      run_floc("tradeoff " + kSmall + "--samples 2 --budget 60 --format json --plot t.svg", scratch.path());
  ASSERT_EQ(o.code, 0) << o.err;
  bool strict = false, bounds = false;
  for (const auto& row : nlohmann::json::parse(o.out)) {
    EXPECT_GT(row["core_seconds"], 0.0);
    if (row["knob"] == "strict" && row["observable"] == "phi") {
      strict = true;
      EXPECT_EQ(row["cost_ratio"], 1.0);
      EXPECT_EQ(row["error_before"], 0.0);
      EXPECT_EQ(row["mean_difference"], 0.0);
      EXPECT_EQ(row["n_samples"], 2);
      EXPECT_EQ(row["tolerance"], 1e-8);
    }
    if (row["knob"] == "moduli" && row["value"] == "bounds" && row["observable"] == "B") {
      bounds = true;
      EXPECT_GT(row["error_before"], 0.01);
    }
    if (row["knob"] == "moduli" && row["value"] == "factor 1e-10" && row["observable"] == "B") {
      EXPECT_LT(row["error_before_high"], 1e-10);
    }
  }
  EXPECT_TRUE(strict);
  EXPECT_TRUE(bounds);
  EXPECT_THAT(o.err, HasSubstr("the precision in which forces are computed, which is always double"));
  for (const char* file : {"t.svg", "t.dat", "t.gp"})
    EXPECT_TRUE(std::filesystem::exists(scratch.file(file))) << file;
}

TEST(TradeoffCommand, FirstColumnIsTheParameterAndObservablesCanBeChosen) {
  const Outcome o = run_floc("tradeoff " + kSmall + "--samples 1 --budget 60 --observables phi,B --format csv");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.out, StartsWith("knob,value,observable,"));
  EXPECT_THAT(o.out, HasSubstr("\nstrict,all,phi,"));
  EXPECT_THAT(o.out, testing::Not(HasSubstr(",z_plus,")));
}

/// Shipped scenes of other kinds, with changes after which a sample takes a fraction of a second, and with one
/// observable each.
const std::vector<std::tuple<std::string, std::string, std::string>> kOtherKinds = {
    {"beads-hertz", "spheres_demo.toml --set grains.count=50 --set load.0.to=1e5", "B"},
    {"spheres-cohesive-walls", "compaction_demo.toml --set grains.count=50", "n_wall_contacts"},
    {"disks-cohesionless-biaxial",
     "biaxial_dense.toml --set grains.count=50 --set load.0.strain=0.04 --set load.0.strain_step=4e-3",
     "peak_ratio"},
    {"rigid-polygons", "pentagons_demo.toml --set grains.count=20", "force_freedom"},
    {"disks-cemented",
     "cemented2d.toml --set grains.count=20 --set 'grains.diameter={distribution=\"uniform\", min=0.5, max=1}' "
     "--lattice 0.1",
     "E_lattice"},
};

TEST(TradeoffCommand, StudiesEveryKindOfSceneInTheSameTable) {
  for (const auto& [kind, scene, observable] : kOtherKinds) {
    const Outcome o = run_floc("tradeoff " + source_directory() + "/data/scenes/" + scene +
                               " --samples 1 --budget 5 --format json");
    ASSERT_EQ(o.code, 0) << kind << ": " << o.err;
    int n_strict = 0, n_scene = 0;
    bool has_observable = false;
    for (const auto& row : nlohmann::json::parse(o.out)) {
      EXPECT_EQ(row["kind"], kind);
      EXPECT_GT(row["n_states"], 0) << kind;
      // A small sample may have too few forces to fit a tail.
      const bool is_tail = std::string(row["observable"]).starts_with("tail_");
      EXPECT_TRUE(is_tail || row["reference_value"].is_number()) << kind << " " << row["observable"];
      EXPECT_FALSE(row["unit"].is_null()) << kind;
      EXPECT_TRUE(row["sample_scatter"].is_null()) << "a single sample has no scatter";
      has_observable = has_observable || row["observable"] == observable;
      n_scene += row["knob"] == "scene";
      if (row["knob"] != "strict") continue;
      ++n_strict;
      for (const char* error : {"error_before_high", "error_after_high", "mean_difference"})
        EXPECT_TRUE(row[error].is_null() || row[error] == 0.0)
            << kind << " " << row["observable"] << " " << error;
    }
    EXPECT_GT(n_strict, 4) << kind;
    EXPECT_GE(n_scene, n_strict) << kind;
    EXPECT_TRUE(has_observable) << kind << " " << observable;
  }
}

TEST(TradeoffCommand, RefusesObservablesThatTheSceneDoesNotHave) {
  const std::string scenes = "tradeoff " + source_directory() + "/data/scenes/";
  const auto refusal = [&](const std::string& arguments) {
    const Outcome o = run_floc(scenes + arguments);
    EXPECT_EQ(o.code, 4) << arguments;
    EXPECT_EQ(o.out, "") << arguments;
    return o.err;
  };
  EXPECT_THAT(refusal("demo.toml --observables phi,K0"),
              HasSubstr("--observables K0: a study of the kind \"disks-cohesive\" does not have this "
                        "observable; the most similar name is "));
  EXPECT_THAT(refusal("rigid_disks_demo.toml --observables B"), HasSubstr("\"rigid-disks\""));
  EXPECT_THAT(refusal("cohesionless_cycle.toml --observables tail_minus"), HasSubstr("is tail_plus"));
  EXPECT_THAT(refusal("demo.toml --lattice 0.1 --observables phi"), HasSubstr("\"disks-cemented\""));
  EXPECT_THAT(refusal("demo.toml --observables E_lattice"), HasSubstr("\"disks-cohesive\""));
  EXPECT_THAT(refusal("rigid_disks_demo.toml --lattice 0.1"),
              HasSubstr("elastic disks or spheres in a periodic cell"));
}

TEST(TradeoffCommand, ComparesTheParametersThatAreNamed) {
  const Outcome o =
      run_floc("tradeoff " + kSmall +
               "--samples 2 --budget 1min --knobs softening,masses,patience --observables phi --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  std::set<std::string> knobs;
  for (const auto& row : nlohmann::json::parse(o.out)) {
    knobs.insert(row["knob"]);
    const bool soft = row["knob"] == "softening";
    const bool heavy = row["knob"] == "masses";
    EXPECT_EQ(row["softening"] > 1.0, soft) << row["knob"];
    EXPECT_EQ(row["masses"], heavy ? "equal" : "own") << row["knob"];
    // If the springs are softened or the masses changed during the assembly, the samples are different packings, so
    // only mean values are compared.
    if (soft || heavy) {
      EXPECT_TRUE(row["error_before_high"].is_null() && row["mean_difference"].is_number());
    }
  }
  EXPECT_EQ(knobs, (std::set<std::string>{"strict", "scene", "softening", "masses", "patience", "samples"}));
  const Outcome refused = run_floc("tradeoff " + kSmall + "--knobs colour");
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err, HasSubstr("--knobs colour: a study of this scene does not vary this parameter"));
}

TEST(TradeoffCommand, StudiesScenesThatStartFromASavedState) {
  const ScratchDirectory scratch;
  ASSERT_EQ(run_floc("run " + kSmall + "-o saved --until 2", scratch.path()).code, 0);
  const std::string scene = source_directory() + "/data/scenes/type1_rolling_small.toml";
  std::string text = content_of(scene);
  const std::size_t assembly = text.find("[assembly]"), load = text.find("[[load]]");
  ASSERT_NE(assembly, std::string::npos);
  ASSERT_LT(assembly, load);
  text.replace(assembly, load - assembly,
               "[assembly]\nprotocol = \"state\"\nstate = \"saved/state-0002.h5\"\npressure = 0.1\n\n");
  for (const char* table : {"[grains]", "[cell]"}) {
    const std::size_t begin = text.find(table), end = text.find("\n[", begin);
    if (begin != std::string::npos) text.erase(begin, end + 1 - begin);
  }
  write_text(scratch.file("from_state.toml"), text);
  const Outcome o = run_floc(
      "tradeoff from_state.toml --set load.0.to=0.2 --set load.0.steps_per_decade=3 --samples 2 --budget 60 "
      "--format "
      "json",
      scratch.path());
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err,
              HasSubstr("all samples beyond the first, because the run starts from a saved packing at rest"));
  bool has_states = false;
  for (const auto& row : nlohmann::json::parse(o.out)) {
    EXPECT_EQ(row["n_grains"], 40);
    EXPECT_EQ(row["n_samples"], 1);
    EXPECT_NE(row["knob"], "count");
    has_states = has_states || (row["knob"] == "scene" && row["error_before"].is_number());
  }
  EXPECT_TRUE(has_states);
}

TEST(TradeoffCommand, SaysWhatABudgetDidNotAllow) {
  const Outcome o =
      run_floc("tradeoff " + source_directory() + "/data/scenes/demo.toml --budget 0.2 --format csv");
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("the run was stopped because the budget was used up"));
  EXPECT_THAT(o.err, HasSubstr("give a larger --budget"));
}

TEST(TradeoffCommand, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(run_floc("tradeoff " + kSmall + "--observables colour").code, 2);
  for (const char* budget : {"0", "-1s", "2m", "inf", "soon"}) {
    const Outcome refused = run_floc("tradeoff " + kSmall + "--budget " + budget);
    EXPECT_EQ(refused.code, 2) << budget;
    EXPECT_THAT(refused.err, HasSubstr("expected a positive number with one of the units s, min, h, d and y"))
        << budget;
  }
  const Outcome o = run_floc("tradeoff nowhere.toml");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("nowhere.toml: there is no such file"));
}

TEST(AccuracyOfARun, IsSaidAndKeptWithTheStates) {
  const ScratchDirectory scratch;
  const std::string scene = kSmall + "--set accuracy.phi=0.01 --set accuracy.moduli=0.05 ";
  const Outcome check = run_floc("scene check " + scene);
  ASSERT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(check.err, HasSubstr("numerical settings chosen for the accuracy that the scene requires: "));
  EXPECT_THAT(check.err, HasSubstr("of the processor time of the strictest settings. Measured errors: phi "));
  const Outcome run = run_floc("run " + scene + "-o out --until 0", scratch.path());
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("numerical settings chosen for the accuracy that the scene requires: "));
  const Outcome text = run_floc("info out/state-0000.h5 --scene", scratch.path());
  EXPECT_THAT(text.out, HasSubstr("chosen = "));
  EXPECT_THAT(text.out, HasSubstr("time_step = "));
  EXPECT_EQ(run_floc("run " + scene + "-o out --until 1 --resume", scratch.path()).code, 0);
}

TEST(AccuracyOfARun, IsRefusedBeyondTheTable) {
  const Outcome o = run_floc("scene check " + kSmall + "--set accuracy.phi=1e-14");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("expected at least"));
}

TEST(ModuliMethods, CheaperOnesLeaveOutWhatTheyDoNotTell) {
  const ScratchDirectory scratch;
  ASSERT_EQ(run_floc("run " + kSmall + "-o out", scratch.path()).code, 0);
  const auto rows = [&](const std::string& method) {
    const Outcome o = run_floc("moduli out/state-*.h5 --format json --method " + method, scratch.path());
    EXPECT_EQ(o.code, 0) << o.err;
    return nlohmann::json::parse(o.out);
  };
  const auto exact = rows("factor"), single = rows("single-factor --tolerance 1e-6"), bounds = rows("bounds"),
             iterative = rows("iterative --tolerance 1e-3");
  for (std::size_t k = 0; k < exact.size(); ++k) {
    for (const auto& other : {single, bounds, iterative})
      EXPECT_LE(std::abs(double(other[k]["B"]) - double(exact[k]["B"])),
                double(other[k]["error_B"]) + double(exact[k]["error_B"]))
          << k;
    EXPECT_TRUE(single[k]["n_negative"].is_null());
    EXPECT_TRUE(bounds[k]["C11"].is_null());
    EXPECT_FALSE(exact[k]["n_negative"].is_null());
  }
  const Outcome o = run_floc("moduli out/state-0000.h5 --method bounds --increments i.csv", scratch.path());
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("needs --method factor"));
}

TEST(ModuliWithinAnAccuracy, AreThoseOfTheCheapestMethodThatKeepsIt) {
  const ScratchDirectory scratch;
  ASSERT_EQ(run_floc("run " + kSmall + "--set load.0.to=30 -o out", scratch.path()).code, 0);
  const auto rows = [&](const std::string& options) {
    const Outcome o = run_floc("moduli out/state-*.h5 --format json " + options, scratch.path());
    EXPECT_EQ(o.code, 0) << o.err;
    return nlohmann::json::parse(o.out);
  };
  const auto exact = rows("");
  std::map<std::string, int> used;
  for (const char* accuracy : {"B=0.6", "0.05", "1e-6", "B=1e-8,G=0.5"}) {
    const bool bulk_only = std::string(accuracy) == "B=0.6";
    const double B = accuracy[0] == 'B' ? std::stod(accuracy + 2) : std::stod(accuracy),
                 G = bulk_only ? 1e300 : 0.5;
    const auto found = rows(std::string("--accuracy ") + accuracy);
    ASSERT_EQ(found.size(), exact.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      ++used[found[k]["method"]];
      EXPECT_LE(std::abs(double(found[k]["B"]) - double(exact[k]["B"])),
                B * double(exact[k]["B"]) + double(exact[k]["error_B"]));
      EXPECT_LE(std::abs(double(found[k]["G"]) - double(exact[k]["G"])),
                G * double(exact[k]["G"]) + double(exact[k]["error_G"]));
      EXPECT_TRUE(found[k]["indeterminacy"].is_null());
    }
  }
  EXPECT_GT(used["bounds"], 0);
  EXPECT_GT(used["single-factor"], 0);
  EXPECT_EQ(exact[0]["method"], "factor");
}

/// For packings of disks and spheres from other programs, the moduli must have the requested accuracy.
TEST(ModuliWithinAnAccuracy, AreKeptOnShippedPackings) {
  const ScratchDirectory scratch;
  const std::string packings = source_directory() + "/data/packings/";
  ASSERT_EQ(run_floc("convert '" + packings + "disks/disks16.txt' bulk.h5", scratch.path()).code, 0);
  ASSERT_EQ(
      run_floc("convert " + packings + "lammps/disks.dump disks.h5 --contacts " + packings +
                   "lammps/disks.contacts --law normal.stiffness=1000,friction.coefficient=0.5,"
                   "friction.stiffness=800 --contact-columns 'id1=c_pair[1],id2=c_pair[2],force1=c_force[1],"
                   "force2=c_force[2],shear_force1=c_force[4],shear_force2=c_force[5]'",
               scratch.path())
          .code,
      0);
  const auto row = [&](const std::string& file, const std::string& options) {
    const Outcome o = run_floc("moduli " + file + " --format json " + options, scratch.path());
    EXPECT_EQ(o.code, 0) << o.err;
    return nlohmann::json::parse(o.out)[0];
  };
  for (const char* file : {"bulk.h5", "disks.h5"})
    for (const double asked : {0.3, 0.01, 1e-6}) {
      const auto exact = row(file, ""), found = row(file, "--accuracy " + std::to_string(asked));
      EXPECT_LE(std::abs(double(found["B"]) - double(exact["B"])), asked * double(exact["B"])) << file;
      EXPECT_LE(std::abs(double(found["G"]) - double(exact["G"])), asked * double(exact["G"])) << file;
    }
}

TEST(ModuliWithinAnAccuracy, AreRefusedInWordsWhereTheyCannotBe) {
  const ScratchDirectory scratch;
  ASSERT_EQ(run_floc("run " + kSmall + "-o out --until 1", scratch.path()).code, 0);
  const auto refusal = [&](const std::string& options) {
    return run_floc("moduli out/state-0001.h5 --format csv --accuracy " + options, scratch.path());
  };
  EXPECT_EQ(refusal("1e-15").code, 4);
  EXPECT_THAT(refusal("1e-15").err, HasSubstr("must be at least 1e-14, the rounding error"));
  EXPECT_EQ(refusal("C=0.1").code, 4);
  EXPECT_THAT(refusal("C=0.1").err,
              HasSubstr("--accuracy C=0.1: expected X, B=X or G=X, where X is a relative error"));
  EXPECT_THAT(refusal("little").err, HasSubstr("--accuracy little: expected X"));
  EXPECT_THAT(refusal("0.1 --increments i.csv").err,
              HasSubstr("needs --method factor; give it instead of --accuracy"));
  EXPECT_EQ(refusal("0.1 --method bounds").code, 2);
  EXPECT_EQ(refusal("0.1 --rolling-stiffness 1").code, 2);
  // Although the accuracy is not reached, the numbers are printed with their errors.
  const Outcome beyond = refusal("1.1e-14");
  EXPECT_EQ(beyond.code, 3);
  EXPECT_THAT(
      beyond.err,
      HasSubstr(
          "no method computes B and G with the accuracy that --accuracy requires: even with --method factor"));
  EXPECT_THAT(beyond.out, HasSubstr(",factor,"));
}

}  // namespace
}  // namespace floc::test
