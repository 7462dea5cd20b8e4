#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "support/crystals.h"
#include "support/lattices.h"
#include "support/run_program.h"
#include "support/states.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// Fixture: three states: randomly placed disks, a square lattice of frames with a rattler in each frame, and spheres.
class Structure : public testing::Test {
 protected:
  void SetUp() override {
    State<2> disks_anywhere;
    disks_anywhere.packing = random_packing<2>(300, 7, elastic_law(1.0, 0.0, 0.0), 0.3);
    write_state(scratch_.file("gas.h5"), disks_anywhere);
    State<2> frames;
    frames.packing = square_frames_around({{2.0, 2.1}}, 5, 1.0, elastic_law(1.0, 0.5, 0.1));
    write_state(scratch_.file("frames.h5"), frames);
    write_state(scratch_.file("spheres.h5"), busy_state<3>());
  }

  Outcome structure(const std::string& arguments) const {
    return run_floc("structure " + arguments, scratch_.path());
  }
  CsvTable table(const std::string& name) const { return CsvTable::read(scratch_.file(name)); }

  ScratchDirectory scratch_;
};

TEST_F(Structure, GivesPoresAndWhatWasMeasuredHow) {
  const Outcome o = structure("frames.h5 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, HasSubstr("frames.h5: no law could be fitted to the scattered intensity I(k)"));
  const json row = json::parse(o.out).at(0);
  EXPECT_EQ(row.at("n_pores"), 1);
  EXPECT_NEAR(row.at("pore_mean_area").get<double>(), 16.0 - 8.0 * std::numbers::pi * 0.51 * 0.51, 1e-12);
  EXPECT_FALSE(row.at("pore_unbounded").get<bool>());
  EXPECT_TRUE(row.at("xi").is_null());
  EXPECT_NEAR(row.at("mesh_spacing").get<double>(), 1.02 / 16.0, 1e-12);
  EXPECT_EQ(row.at("mesh1"), 63);  // at least 4/0.06375 points, rounded up to a product of small primes
}

TEST_F(Structure, WritesSeriesOfEachState) {
  const Outcome o = structure(
      "frames.h5 gas.h5 --intensity I.csv --pair-correlation g.csv --gaps z.csv --pores p.csv --map m.csv "
      "--map-size 4,5");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(table("I.csv").columns(), ElementsAre("file", "k", "I", "n_vectors", "I_fit"));
  EXPECT_THAT(table("g.csv").columns(), ElementsAre("file", "r", "g", "n_pairs", "r_rescaled"));
  EXPECT_THAT(table("p.csv").columns(), ElementsAre("file", "x1", "x2", "area", "gyration_radius", "n_grains"));
  // The pore of the frames lies between seven grains and around one rattler. Its edge passes most of them twice.
  EXPECT_EQ(table("p.csv").number(0, 5), 8.0);
  const CsvTable map = table("m.csv");
  ASSERT_EQ(map.n_rows(), 40);
  double mean = 0.0;
  for (int r = 0; r < 20; ++r) mean += map.number(r, map.column("solid_fraction")) / 20.0;
  EXPECT_NEAR(mean, 8.0 * std::numbers::pi * 0.51 * 0.51 / 16.0, 1e-12);
  const CsvTable z = table("z.csv");
  EXPECT_THAT(z.columns(), ElementsAre("file", "gap", "z", "z_pushed", "gap_rescaled"));
  // A grain inside a frame, without force and adhesion, is a rattler. If this rattler is pushed against the other
  // grains, it touches two of them.
  EXPECT_EQ(z.number(0, 1), 0.0);
  EXPECT_NEAR(z.number(0, 2), 2.0, 1e-15);
  EXPECT_NEAR(z.number(1, 3) - z.number(1, 2), 2.0 * 2 / 8, 1e-12);
  const CsvTable p = table("p.csv");
  EXPECT_EQ(p.text(0, 0), "frames.h5");
}

TEST_F(Structure, AveragesStatesWhenAsked) {
  const Outcome alone = structure("gas.h5 --intensity one.csv --format json");
  const Outcome o = structure("gas.h5 gas.h5 --average --intensity I.csv --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json rows = json::parse(o.out);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows.at(2).at("file"), "average");
  EXPECT_EQ(rows.at(2).at("n_grains"), 600);
  const CsvTable one = table("one.csv"), all = table("I.csv");
  ASSERT_EQ(all.n_rows(), 3 * one.n_rows());
  for (int r = 0; r < one.n_rows(); ++r) {
    const int last = 2 * one.n_rows() + r;
    EXPECT_EQ(all.text(last, 0), "average");
    EXPECT_NEAR(all.number(last, 2), one.number(r, 2), 1e-12 * one.number(r, 2));
    EXPECT_EQ(all.integer(last, 3), 2 * one.integer(r, 3));
  }
}

TEST_F(Structure, OfSpheresHasVoronoiCellsAndVoids) {
  State<3> bcc;
  bcc.packing = crystal_of(body_centred_cubic(), 1.0, 1.0, elastic_law(3.0, 0.0, 0.0));
  write_state(scratch_.file("bcc.h5"), bcc);
  const Outcome o = structure(
      "bcc.h5 spheres.h5 --intensity I.csv --pair-correlation g.csv --gaps z.csv --pores p.csv --map m.csv "
      "--format "
      "json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json row = json::parse(o.out).at(0);
  EXPECT_TRUE(row.at("n_pores").is_null());
  EXPECT_NEAR(row.at("local_phi_mean").get<double>(), std::sqrt(3.0) * std::numbers::pi / 8.0, 1e-12);
  EXPECT_NEAR(row.at("local_phi_stddev").get<double>(), 0.0, 1e-9);
  EXPECT_EQ(row.at("n_voids"), 12);
  EXPECT_NEAR(row.at("void_radius_largest").get<double>(), 0.5 * (std::sqrt(5.0 / 3.0) - 1.0), 1e-9);
  EXPECT_THAT(table("p.csv").columns(), ElementsAre("file", "x1", "x2", "x3", "radius"));
  const CsvTable map = table("m.csv");
  EXPECT_THAT(map.columns(),
              ElementsAre("file", "grain", "x1", "x2", "x3", "voronoi_volume", "solid_fraction"));
  EXPECT_EQ(map.n_rows(), 2 + 3);
  EXPECT_NEAR(map.number(1, 5), 4.0 / (3.0 * std::sqrt(3.0)), 1e-9);
  for (const char* name : {"I.csv", "g.csv", "z.csv"}) EXPECT_GT(table(name).n_rows(), 0) << name;
}

TEST_F(Structure, OfBothDimensionsHasNeitherOneFileNorAnAverage) {
  for (const char* what : {"--pores p.csv", "--map m.csv", "--average"}) {
    const Outcome o = structure(std::string("frames.h5 spheres.h5 ") + what);
    EXPECT_EQ(o.code, 4) << what;
    EXPECT_THAT(o.err, HasSubstr("spheres.h5: this state differs in dimension from the states before it"))
        << what;
    EXPECT_EQ(structure(std::string("spheres.h5 frames.h5 ") + what).code, 4) << what;
  }
  EXPECT_EQ(structure("frames.h5 spheres.h5").code, 0);
}

TEST_F(Structure, ComparesStatesInRescaledDistance) {
  // One crystal at two densities. In the loose crystal, neighbours are farther away relative to the diameter. In
  // rescaled distances, the neighbours of the two crystals are at equal distances.
  for (const double r : {1.0, 0.8}) {
    State<3> bcc;
    bcc.packing = crystal_of(body_centred_cubic(), r, 1.0001, elastic_law(3.0, 0.0, 0.0));
    bcc.target_stress.setConstant(1.0);
    write_state(scratch_.file(r == 1.0 ? "loose.h5" : "dense.h5"), bcc);
  }
  const Outcome o =
      structure("loose.h5 dense.h5 --pair-correlation g.csv --gaps z.csv --prediction p.csv --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const CsvTable g = table("g.csv"), z = table("z.csv"), p = table("p.csv");
  const int r = g.column("r"), rescaled = g.column("r_rescaled");
  EXPECT_NEAR(g.number(0, rescaled), g.number(0, r), 1e-12);
  EXPECT_NEAR(g.number(g.n_rows() - 1, rescaled), g.number(g.n_rows() - 1, r) / 0.8, 1e-12);
  const int gap = z.column("gap_rescaled");
  EXPECT_NEAR(z.number(0, gap), 0.0, 1e-12);
  EXPECT_NEAR(z.number(z.n_rows() / 2, gap), 1.0001 / 0.8 - 1.0001, 1e-12);  // the dense crystal has no gaps
  ASSERT_EQ(p.n_rows(), 2);
  EXPECT_EQ(p.text(1, p.column("reference")), "loose.h5");
  for (int row : {0, 1})
    for (const char* what : {"P", "z"})
      EXPECT_NEAR(p.number(row, p.column(std::string(what) + "_predicted")), p.number(row, p.column(what)),
                  1e-12);
  EXPECT_EQ(structure("loose.h5 frames.h5 --prediction p.csv").code, 4);
}

TEST_F(Structure, PorosityAndProfilesGoToFiles) {
  State<3> bcc;
  bcc.packing = crystal_of(body_centred_cubic(), 1.0, 1.0, elastic_law(3.0, 0.0, 0.0));
  write_state(scratch_.file("bcc.h5"), bcc);
  const Outcome o =
      structure("bcc.h5 frames.h5 --porosity e.csv --probes 5 --profile p.csv --profile-axis y --slices 4");
  ASSERT_EQ(o.code, 0) << o.err;
  const CsvTable e = table("e.csv"), p = table("p.csv");
  EXPECT_THAT(e.columns(),
              ElementsAre("file", "half_side", "void_ratio", "porosity", "void_ratio_cell", "porosity_cell"));
  ASSERT_EQ(e.n_rows(), 10);
  // The largest probe is the whole cell. The smallest probe is a cube inside the sphere at the centre.
  const double phi = std::sqrt(3.0) * std::numbers::pi / 8.0;
  EXPECT_NEAR(e.number(4, 5), 1.0 - phi, 1e-12);
  EXPECT_NEAR(e.number(4, 2), 1.0 / phi - 1.0, 1e-12);
  EXPECT_NEAR(e.number(0, 3), 0.0, 1e-12);
  EXPECT_THAT(p.columns(), ElementsAre("file", "low", "high", "phi", "void_ratio", "n_grains", "z", "pressure",
                                       "sigma_1", "sigma_2", "sigma_3"));
  ASSERT_EQ(p.n_rows(), 8);
  double mean = 0.0;
  for (int r = 0; r < 4; ++r) mean += p.number(r, 3) / 4.0;
  EXPECT_NEAR(mean, phi, 1e-12);
  const Outcome along_z = structure("frames.h5 --profile p.csv --profile-axis z");
  EXPECT_EQ(along_z.code, 4);
  EXPECT_THAT(along_z.err,
              HasSubstr("frames.h5: this state is in 2D and has no axis z: give --profile-axis x or y"));
  // By default the profile is taken along the last axis.
  ASSERT_EQ(structure("frames.h5 --profile last.csv").code, 0);
  ASSERT_EQ(structure("frames.h5 --profile y.csv --profile-axis y").code, 0);
  EXPECT_EQ(content_of(scratch_.file("last.csv")), content_of(scratch_.file("y.csv")));
}

TEST_F(Structure, BadInputIsNamedAndTheOthersAreDone) {
  write_text(scratch_.file("bad.h5"), "no state");
  State<2> empty;
  write_state(scratch_.file("empty.h5"), empty);
  const Outcome o = structure("bad.h5 empty.h5 frames.h5 --format csv");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("bad.h5"));
  EXPECT_THAT(o.err, HasSubstr("empty.h5:/grains/radius: the dataset contains no grains"));
  EXPECT_THAT(o.out, HasSubstr("\nframes.h5,2,8,"));
  EXPECT_EQ(structure("frames.h5 --fit-range 1,0.5").code, 4);
  EXPECT_EQ(structure("frames.h5 --cells-per-wave 1").code, 2);
  EXPECT_EQ(structure("frames.h5 --intensity none/I.csv").code, 1);
}

}  // namespace
}  // namespace floc::test
