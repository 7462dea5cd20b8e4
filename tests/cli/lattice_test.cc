#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "floc/base/random.h"
#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "floc/packing/balance.h"
#include "support/lattice_samples.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

/// Fixture: states of slightly overlapping disks and spheres.
class LatticeCommand : public testing::Test {
 protected:
  void SetUp() override {
    State<2> disks;
    disks.packing = grid_of_grains<2>(3, -0.01);
    write_state(scratch_.file("disks.h5"), disks);
    State<3> spheres;
    spheres.packing = grid_of_grains<3>(2, -0.01);
    write_state(scratch_.file("spheres.h5"), spheres);
    State<2> apart;
    apart.packing = grid_of_grains<2>(3, 0.3);
    write_state(scratch_.file("apart.h5"), apart);
  }

  Outcome lattice(const std::string& arguments) const {
    return run_floc("lattice " + arguments, scratch_.path());
  }
  json row_of(const std::string& arguments) const {
    const Outcome o = lattice(arguments + " --format json");
    EXPECT_EQ(o.code, 0) << o.err;
    return o.code == 0 ? json::parse(o.out).at(0) : json();
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(scratch_.file(name)); }

  ScratchDirectory scratch_;
};

constexpr const char* kDisks = "disks.h5 --bridge-gap 0.1 --stiffness grain=20,matrix=1 --matrix 0.08 ";

TEST_F(LatticeCommand, SaysWhatTheSampleIsAndHowItResponds) {
  const json row = row_of(std::string(kDisks) + "--load compression");
  EXPECT_NEAR(row.at("rho_m").get<double>(), 0.08, 1e-3);
  EXPECT_NEAR(row.at("nodes_a_diameter").get<double>(), 15.0, 1.0);
  EXPECT_NEAR(row.at("stress22").get<double>(), 1.0, 1e-8);
  EXPECT_NEAR(row.at("stress11").get<double>(), 0.0, 1e-8);
  EXPECT_NEAR(row.at("E").get<double>() * row.at("strain22").get<double>(), 1.0, 1e-8);
  EXPECT_NEAR(
      row.at("mean_nodes").get<double>() * (row.at("rho_m").get<double>() + row.at("rho_p").get<double>()), 1.0,
      0.01);
  EXPECT_GT(row.at("beta1_nodes").get<double>(), 0.5);
  EXPECT_GT(row.at("n_open").get<int>(), 0);
  EXPECT_EQ(row.at("holds"), true);
}

TEST_F(LatticeCommand, SavesALatticeWhoseModuliAreThoseOfTheDirectSolution) {
  for (const std::string beams : {"", "--shear 0.4 --bending 0.05 "}) {
    const json row = row_of(std::string(kDisks) + beams + "--moduli --per-diameter 10 -o lattice.h5");
    const Outcome o = run_floc("moduli lattice.h5 --strains full --format json", scratch_.path());
    ASSERT_EQ(o.code, 0) << o.err;
    const json moduli = json::parse(o.out).at(0);
    for (const char* name : {"C11", "C22", "C12", "C33", "C13", "C23"})
      EXPECT_NEAR(row.at(name).get<double>(), moduli.at(name).get<double>(),
                  1e-10 * row.at("C11").get<double>())
          << name << beams;
    // The strain must equal C^-1 times the stress of the load; C is the matrix of the printed moduli.
    Eigen::Matrix3d C;
    const auto entry = [&](const char* name) { return row.at(name).get<double>(); };
    C << entry("C11"), entry("C12"), entry("C13"), entry("C12"), entry("C22"), entry("C23"), entry("C13"),
        entry("C23"), entry("C33");
    const Eigen::Vector3d strain = C.inverse() * Eigen::Vector3d(0.0, 1.0, 0.0);
    EXPECT_NEAR(strain[1], entry("strain22"), 1e-9 * strain[1]);
    EXPECT_GT(entry("B"), 0.0);
    EXPECT_LT(entry("B"), entry("B_hs_upper"));
    EXPECT_LT(entry("B_hs_upper"), entry("B_voigt"));
    EXPECT_EQ(entry("B_hs_lower"), 0.0);  // zero, since the material contains voids
  }
}

TEST_F(LatticeCommand, GivesForcesThatEveryNetworkCommandReads) {
  row_of(std::string(kDisks) + "--forces forces.h5 --stress nodes.csv --pdf pdf.csv -o lattice.h5");
  const AnyState any = read_state(scratch_.file("forces.h5"));
  const State<2>& state = std::get<State<2>>(any);
  EXPECT_NEAR(state.stress(1, 1), 1.0, 1e-8);
  EXPECT_LT(state.residuals.force, 1e-8);
  EXPECT_LT(state.residuals.moment, 1e-8);
  const Outcome network = run_floc("network forces.h5 --format json", scratch_.path());
  ASSERT_EQ(network.code, 0) << network.err;
  EXPECT_THAT(network.err, Not(HasSubstr("not in equilibrium")));
  for (const char* command :
       {"draw lattice.h5 -o a.svg", "draw forces.h5 -o b.png", "network lattice.h5", "info lattice.h5"})
    EXPECT_EQ(run_floc(command, scratch_.path()).code, 0) << command;
  const CsvTable nodes = CsvTable::read(scratch_.file("nodes.csv"));
  double sum = 0.0, volume = 0.0;
  for (int r = 0; r < nodes.n_rows(); ++r) {
    sum += nodes.number(r, nodes.column("volume")) * nodes.number(r, nodes.column("stress22"));
    volume = state.packing.cell.volume();
  }
  EXPECT_NEAR(sum / volume, 1.0, 1e-8);
  const CsvTable pdf = CsvTable::read(scratch_.file("pdf.csv"));
  double whole = 0.0;
  for (int r = 0; r < pdf.n_rows(); ++r)
    if (pdf.text(r, pdf.column("of")) == "nodes") whole += pdf.number(r, pdf.column("density")) * 0.1;
  EXPECT_NEAR(whole, 1.0, 1e-9);
}

TEST_F(LatticeCommand, DrawsStressPhasesCracksAndDistributions) {
  const Outcome o =
      lattice(std::string(kDisks) +
              "--per-diameter 9 --load tension --map map.png --phases phases.svg --plot pdf.svg --strength "
              "matrix=1,interface=1 --curve curve.csv --cracks cracks.pdf");
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* name : {"map.png", "phases.svg", "pdf.svg", "pdf.dat", "curve.csv", "cracks.pdf"})
    EXPECT_TRUE(exists(name)) << name;
  EXPECT_THAT(o.err, HasSubstr("elements broke"));
  const CsvTable curve = CsvTable::read(scratch_.file("curve.csv"));
  ASSERT_GT(curve.n_rows(), 3);
  for (int r = 0; r < curve.n_rows(); ++r) EXPECT_LT(curve.number(r, curve.column("stress")), 0.0);
}

TEST_F(LatticeCommand, TakesSpheres) {
  const json row = row_of(
      "spheres.h5 --bridge-gap 0.1 --matrix 0.2 --stiffness grain=50,matrix=1 --map cut.png --cut x,0.25 "
      "--phases p.svg");
  EXPECT_EQ(row.at("dimension"), 3);
  EXPECT_NEAR(row.at("stress33").get<double>(), 1.0, 1e-7);
  EXPECT_NEAR(row.at("stress23").get<double>(), 0.0, 1e-7);
  EXPECT_TRUE(exists("cut.png") && exists("p.svg"));
  row_of("spheres.h5 --bridge-gap 0.1 --matrix 0.2 --per-diameter 5 --forces forces.h5 -o lattice.h5");
  const AnyState any = read_state(scratch_.file("forces.h5"));
  EXPECT_LT(std::get<State<3>>(any).residuals.moment, 1e-7);
  for (const char* state : {"forces.h5", "lattice.h5"})
    EXPECT_EQ(run_floc(std::string("network ") + state, scratch_.path()).code, 0) << state;
}

TEST_F(LatticeCommand, DrawsSkewedCellsButNoneThatAreTurned) {
  State<3> state;
  state.packing = grid_of_grains<3>(2, -0.01);
  state.packing.cell.matrix(2, 0) = 0.3;
  write_state(scratch_.file("skewed.h5"), state);
  state.packing.cell.matrix(0, 2) = 0.3;
  write_state(scratch_.file("turned.h5"), state);
  const std::string pictures =
      " --bridge-gap 0.1 --matrix 0.2 --per-diameter 5 --load tension --strength matrix=1,interface=1 --yes "
      "--map m.svg --phases p.svg --cracks c.svg";
  row_of("skewed.h5" + pictures);
  for (const char* name : {"m.svg", "p.svg", "c.svg"}) EXPECT_TRUE(exists(name)) << name;
  const Outcome o = lattice("turned.h5" + pictures);
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err,
              HasSubstr("turned.h5: the cell of this state cannot be drawn by --map, --phases and --cracks"));
}

TEST_F(LatticeCommand, TakesPlatesAndImposedStrains) {
  const json plates = row_of(std::string(kDisks) + "--boundary plates");
  EXPECT_NEAR(plates.at("stress22").get<double>(), 1.0, 1e-8);
  const json strain = row_of(std::string(kDisks) + "--load strain:0,0.01,0 --boundary uniform-strain");
  EXPECT_EQ(strain.at("strain22"), 0.01);
  const json sheared = row_of(std::string(kDisks) + "--load stress:0,1,0.5");
  EXPECT_NEAR(sheared.at("stress12").get<double>(), 0.5, 1e-8);
}

TEST_F(LatticeCommand, RefusesInWordsWhatCannotBe) {
  struct Case {
    std::string arguments, words;
    int code;
  };
  const Case cases[] = {
      {"disks.h5 --matrix 0.5", "cannot be reached", 4},
      {"disks.h5 --matrix 1.5", "", 2},
      {"apart.h5 --matrix 0", "the sample cannot carry a load, because its grains and matrix", 4},
      {"disks.h5 --matrix 0.05 --stiffness grain=10,glue=1", "'glue=1'", 4},
      {"disks.h5 --matrix 0.05 --stiffness grain=-1", "must be > 0", 4},
      {"disks.h5 --matrix 0.05 --load sideways", "expected compression", 4},
      {"disks.h5 --matrix 0.05 --load stress:1,2", "3 numbers", 4},
      {"disks.h5 --matrix 0.05 --load stress:0,0,0", "all components of this load are zero", 4},
      {"disks.h5 --matrix 0.05 --load stress:0,1e-165,0", "from 1e-60 to 1e+60", 4},
      {"disks.h5 --matrix 0.05 --load strain:0,1e155,0", "from 1e-60 to 1e+60", 4},
      {"disks.h5 --matrix 0.05 --stiffness grain=1e155", "from 1e-60 to 1e+60", 4},
      {"disks.h5 --matrix 0.05 --stiffness grain=1e12", "1e+12 times as stiff as the softest", 4},
      {"disks.h5 --matrix 0.05 --tolerance 1e300", "0.001", 2},
      {"disks.h5 --matrix 0.05 --boundary plates --load stress:0,1,0.5", "only along their axis, y", 4},
      {"disks.h5 --matrix 0.05 --boundary bonded-plates --load strain:1,0,0", "only along their axis, y", 4},
      {"disks.h5 --matrix 0.05 --boundary plates --moduli", "only one modulus", 4},
      {"disks.h5 --matrix 0.05 --axis z", "expected x or y", 4},
      {"disks.h5 --matrix 0.05 --map map.gif", ".svg, .pdf or .png", 4},
      {"disks.h5 --matrix 0.05 --curve c.csv", "--strength", 4},
      {"disks.h5 --matrix 0.05 --spacing 1e-5", "GB", 4},
      {"disks.h5 --matrix 0.05 --bending 0.1", "shear > 0", 4},
      {"disks.h5 --matrix 0.05 --per-diameter 60 --bridge-gap 0.1 --strength matrix=1", "--yes", 4},
      {"nowhere.h5 --matrix 0.05", "nowhere.h5", 4},
  };
  for (const Case& c : cases) {
    const Outcome o = lattice(c.arguments + " -o left.h5");
    EXPECT_EQ(o.code, c.code) << c.arguments << '\n' << o.err;
    EXPECT_THAT(o.err, HasSubstr(c.words)) << c.arguments;
    EXPECT_THAT(o.out, IsEmpty()) << c.arguments;
    EXPECT_FALSE(exists("left.h5")) << c.arguments;
  }
  const Outcome coarse = lattice("disks.h5 --matrix 0.05 --bridge-gap 0.1 --per-diameter 6");
  EXPECT_THAT(coarse.err, HasSubstr("coarse"));
}

TEST_F(LatticeCommand, MeasuresTheStrengthUnderShearByTheShearStress) {
  const json row = row_of(std::string(kDisks) +
                          "--per-diameter 8 --contacts bilateral --load stress:0,0,1 --strength "
                          "matrix=1,interface=1 --end-at 0.9");
  EXPECT_GT(row.at("strength").get<double>(), 1e-3);
  EXPECT_GT(row.at("strain_at_strength").get<double>(), 1e-3);
  for (const char* name : {"E", "spread_nodes"}) EXPECT_TRUE(row.at(name).is_null()) << name;
  EXPECT_NEAR(row.at("mean_nodes").get<double>(), 0.0, 1e-8);
}

TEST_F(LatticeCommand, HasTheSameDistributionsForEveryMagnitudeOfTheLoad) {
  const auto statistics = [&](const std::string& stress) {
    json row = row_of(std::string(kDisks) + "--per-diameter 8 --load stress:0," + stress +
                      ",0 --columns '*share*,*beta*,largest*,spread*'");
    return row;
  };
  const json one = statistics("1");
  for (const char* stress : {"3", "7", "1e-12", "1e5"}) {
    const json other = statistics(stress);
    for (const auto& [name, value] : one.items()) {
      ASSERT_EQ(value.is_null(), other.at(name).is_null()) << name;
      if (value.is_null()) continue;
      EXPECT_NEAR(other.at(name).get<double>(), value.get<double>(), 1e-6 * std::abs(value.get<double>()))
          << stress << ' ' << name;
    }
  }
}

/// Breaks a sample in which some nodes of grains have no element, so that nodes of the lattice and nodes with elements
/// have different numbers.
TEST_F(LatticeCommand, NumbersBrokenElementsByTheNodesOfItsOtherFiles) {
  const json row = row_of(std::string(kDisks) +
                          "--per-diameter 8 --load tension --strength matrix=1,interface=1 --end-at 0.9 "
                          "--curve curve.csv --stress nodes.csv");
  const CsvTable nodes = CsvTable::read(scratch_.file("nodes.csv"));
  const CsvTable curve = CsvTable::read(scratch_.file("curve.csv"));
  ASSERT_GT(curve.n_rows(), 0);
  const double side = 3 * 0.99;
  for (int r = 0; r < curve.n_rows(); ++r) {
    const int a = static_cast<int>(curve.number(r, curve.column("node1"))),
              b = static_cast<int>(curve.number(r, curve.column("node2")));
    double square = 0.0;
    for (const char* x : {"x1", "x2"}) {
      double d = nodes.number(b, nodes.column(x)) - nodes.number(a, nodes.column(x));
      d -= side * std::round(d / side);
      square += d * d;
    }
    EXPECT_NEAR(std::sqrt(square) / row.at("spacing").get<double>(), 1.0, 0.1) << r;
  }
}

TEST_F(LatticeCommand, ComparesWithStatesOfTheSameGrainsAlone) {
  row_of(std::string(kDisks) + "--per-diameter 8 --forces forces.h5");
  const json same = row_of(std::string(kDisks) + "--per-diameter 8 --compare forces.h5");
  EXPECT_NEAR(same.at("pearson_state").get<double>(), 1.0, 1e-9);
  EXPECT_EQ(same.at("n_compared"), same.at("n_pairs"));
  State<2> other = std::get<State<2>>(read_state(scratch_.file("forces.h5")));
  std::swap(other.packing.grains.radius[0], other.packing.grains.radius[1]);
  write_state(scratch_.file("other.h5"), other);
  const Outcome o = lattice(std::string(kDisks) + "--per-diameter 8 --compare other.h5");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("with the same radii"));
}

TEST_F(LatticeCommand, TakesCellsWithLatticeVectorsAgainstTheAxes) {
  State<2> state;
  state.packing = grid_of_grains<2>(3, -0.01);
  state.packing.cell.matrix.row(1) *= -1.0;
  write_state(scratch_.file("against.h5"), state);
  const std::string options =
      " --bridge-gap 0.1 --matrix 0.08 --per-diameter 8 --load stress:0,1,0.5 --map m.png --phases p.svg "
      "--columns strain??";
  const json along = row_of("disks.h5" + options), against = row_of("against.h5" + options);
  for (const auto& [name, value] : along.items())
    EXPECT_NEAR(against.at(name).get<double>(), value.get<double>(), 1e-6) << name;
}

TEST_F(LatticeCommand, LeavesBoundsEmptyThatDoNotHold) {
  const std::string options = std::string(kDisks) + "--per-diameter 8 --moduli --contacts bilateral ";
  const json stiff = row_of(
      "disks.h5 --bridge-gap 0.1 --matrix 0.08 --per-diameter 8 --moduli --stiffness "
      "grain=20,matrix=1,interface=500");
  EXPECT_TRUE(stiff.at("B_voigt").is_null() && stiff.at("G_hs_upper").is_null());
  EXPECT_EQ(stiff.at("B_reuss"), 0.0);  // the material contains voids
  EXPECT_TRUE(row_of(options).at("B_voigt").is_number());
}

TEST_F(LatticeCommand, SaysThatBareContactsHaveNoStrengthInTension) {
  const Outcome o = lattice("disks.h5 --matrix 0 --per-diameter 8 --load tension --format json");
  EXPECT_EQ(o.code, 3);
  EXPECT_THAT(o.err, HasSubstr("the sample cannot carry this load"));
  EXPECT_EQ(json::parse(o.out).at(0).at("holds"), false);
}

/// For every combination of options, the command prints finite numbers or an error message.
TEST_F(LatticeCommand, SurvivesAnyMixtureOfOptions) {
  RandomStream random(4, 0);
  const auto one_of = [&](std::vector<std::string> choices) { return choices[random.below(choices.size())]; };
  for (int trial = 0; trial < 40; ++trial) {
    const std::string arguments =
        one_of({"disks.h5 --per-diameter 8", "disks.h5 --per-diameter 3", "spheres.h5 --per-diameter 5",
                "apart.h5"}) +
        " --matrix " + one_of({"0", "0.02", "0.1", "0.2"}) +
        one_of({"", " --bridge-gap 0.4", " --bridge-gap 0"}) +
        one_of(
            {"", " --stiffness grain=1e4", " --stiffness matrix=1e3,interface=0", " --stiffness contact=0"}) +
        one_of({"", " --contacts none", " --contacts bilateral", " --patch 0.1"}) +
        one_of({"", " --shear 1", " --shear 0.5 --bending 0.1"}) + one_of({"", " --by-facet"}) +
        one_of({"", " --load tension", " --load strain:0,1,0", " --load stress:1,1,0,0,0,0"}) +
        one_of({"", " --axis x", " --axis z"}) +
        one_of({"", " --boundary plates", " --boundary bonded-plates", " --boundary uniform-strain"});
    const Outcome o = lattice(arguments + " --format json");
    EXPECT_THAT((std::vector<int>{0, 3, 4}), testing::Contains(o.code)) << arguments << '\n' << o.err;
    if (o.code != 0) {
      EXPECT_THAT(o.err, HasSubstr("floc: ")) << arguments;
      continue;
    }
    const json row = json::parse(o.out).at(0);
    for (const char* name : {"strain11", "stress22", "rho_p", "mean_nodes"})
      EXPECT_TRUE(row.at(name).is_number()) << arguments << ' ' << name;
  }
}

TEST_F(LatticeCommand, ReplacesNeitherItsPackingNorItsOtherOutputs) {
  const std::string before = content_of(scratch_.file("disks.h5"));
  for (const std::string option : {"-o", "--forces", "--stress", "--pdf"}) {
    const Outcome o = lattice(kDisks + (option + " disks.h5"));
    EXPECT_EQ(o.code, 4) << option << o.err;
    EXPECT_THAT(o.err, HasSubstr("disks.h5: this file is an input of the command")) << option;
    EXPECT_TRUE(content_of(scratch_.file("disks.h5")) == before) << option;
  }
  for (const std::string options :
       {"-o one --forces one", "--forces one --stress ./one", "--stress one --pdf one"}) {
    std::filesystem::remove(scratch_.file("one"));
    const Outcome o = lattice(kDisks + options);
    EXPECT_EQ(o.code, 4) << options << o.err;
    EXPECT_THAT(o.err, HasSubstr("one: the command has already written another of its outputs to this file"))
        << options;
  }
}

}  // namespace
}  // namespace floc::test
