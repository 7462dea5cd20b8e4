#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "floc/packing/balance.h"
#include "floc/packing/tile.h"
#include "support/crystals.h"
#include "support/lattices.h"
#include "support/run_program.h"
#include "support/states.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Fixture: three states: a square lattice under pressure, a chain under tension and a packing of spheres.
class Network : public testing::Test {
 protected:
  void SetUp() override {
    State<2> square;
    square.packing = square_frames(2, 1.0, elastic_law(2.0, 0.6, 0.1));
    square.target_stress.setConstant(0.04);
    write_state(scratch_.file("square.h5"), square);
    State<2> chain;
    chain.packing = chain_across(4, 1.0, 3.0, elastic_law(1.0, 0.5, 0.1));
    for (Contact<2>& c : chain.packing.contacts) c.normal_force = -0.25;
    write_state(scratch_.file("chain.h5"), chain);
    write_state(scratch_.file("spheres.h5"), busy_state<3>());
  }

  Outcome network(const std::string& arguments) const {
    return run_floc("network " + arguments, scratch_.path());
  }
  CsvTable table(const std::string& name) const { return CsvTable::read(scratch_.file(name)); }

  ScratchDirectory scratch_;
};

/// Forces below the tolerance of equilibrium are what the balance leaves over. Their signs mean nothing.
TEST_F(Network, PressuresBelowTheToleranceHaveNoSign) {
  State<2> unloaded;
  unloaded.packing = square_frames(4, 1.0, elastic_law(2.0, 0.6, 0.1));
  unloaded.target_stress.setConstant(0.04);
  double sign = 1.0;
  for (Contact<2>& c : unloaded.packing.contacts) c.normal_force = c.elastic_force = 1e-9 * (sign = -sign);
  write_state(scratch_.file("noise.h5"), unloaded);
  const Outcome o = network("noise.h5 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json row = json::parse(o.out).at(0);
  for (const char* name :
       {"pressed_share", "pressed_largest", "pulled_share", "pulled_largest", "z_plus", "z_minus"})
    EXPECT_EQ(row.at(name), 0.0) << name;
}

TEST_F(Network, CountsAndWeighsContacts) {
  const Outcome o = network("square.h5 --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(o.err, IsEmpty());
  const json row = json::parse(o.out).at(0);
  EXPECT_EQ(row.at("z"), 4.0);
  EXPECT_EQ(row.at("z_plus"), 4.0);
  EXPECT_EQ(row.at("z_minus"), 0.0);
  EXPECT_EQ(row.at("z_star"), 4.0);
  EXPECT_EQ(row.at("x22"), 0.0);
  EXPECT_NEAR(row.at("mean_normal_force").get<double>(), 0.04, 1e-14);  // K_N times an overlap of 2 %
  EXPECT_NEAR(row.at("moment_2").get<double>(), 1.0, 1e-12);
  EXPECT_EQ(row.at("M1"), 0.0);
  EXPECT_EQ(row.at("pressed_share"), 1.0);
  EXPECT_NEAR(row.at("pressed_mean").get<double>(), 0.04, 1e-14);
  EXPECT_EQ(row.at("pressed_percolates"), 2);
  EXPECT_EQ(row.at("pulled_share"), 0.0);
  EXPECT_EQ(row.at("indeterminacy"), 3);
  EXPECT_EQ(row.at("energy_share_95"), 1.0);
  EXPECT_TRUE(row.at("correlation_normal").is_null());  // the correlation of equal forces is not defined
  EXPECT_NEAR(row.at("P").get<double>(), 0.04, 1e-14);
}

TEST_F(Network, WithoutMechanicsIsTheSameRowWithTheirColumnsEmpty) {
  const Outcome whole = network("spheres.h5 --format json");
  const Outcome part = network("spheres.h5 --without mechanics --format json");
  ASSERT_EQ(part.code, 0) << part.err;
  json expected = json::parse(whole.out).at(0), row = json::parse(part.out).at(0);
  for (const char* column : {"hyperstaticity", "n_null_modes", "indeterminacy", "n_dead_ends", "n_components",
                             "n_percolating", "energy_share_95", "energy_share_95_deviatoric", "backbone_share",
                             "scalar_backbone_share", "correlation_normal", "correlation_size"}) {
    EXPECT_TRUE(row.at(column).is_null()) << column;
    expected[column] = nullptr;
  }
  EXPECT_FALSE(json::parse(whole.out).at(0).at("indeterminacy").is_null());
  row["seconds"] = expected["seconds"] = nullptr;
  EXPECT_EQ(row, expected);
}

TEST_F(Network, OfManyStatesIsARowEachAndABadOneIsNamed) {
  write_text(scratch_.file("bad.h5"), "no state");
  const Outcome o = network("square.h5 bad.h5 none.h5 chain.h5 --format csv");
  EXPECT_EQ(o.code, 4);
  EXPECT_THAT(o.err, HasSubstr("bad.h5"));
  EXPECT_THAT(o.err, HasSubstr("none.h5"));
  EXPECT_THAT(o.err, HasSubstr("chain.h5: warning: this state is not in equilibrium"));
  EXPECT_THAT(o.err, HasSubstr("chain.h5: warning: mechanisms let the cell change its shape without elastic "
                               "energy, so these moduli are zero"));
  write_text(scratch_.file("out.csv"), o.out);
  const CsvTable rows = table("out.csv");
  ASSERT_EQ(rows.n_rows(), 2);
  EXPECT_EQ(rows.text(1, 0), "chain.h5");
  EXPECT_EQ(rows.number(1, rows.column("pulled_share")), 1.0);
  EXPECT_EQ(rows.number(1, rows.column("pulled_percolates")), 1.0);
  EXPECT_TRUE(rows.is_empty(1, rows.column("energy_share_95")));
}

TEST_F(Network, ReadsAPipe) {
  const Outcome o =
      run_floc("network - --format json", scratch_.path(), content_of(scratch_.file("square.h5")));
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(json::parse(o.out).at(0).at("n_contacts"), 2);
}

TEST_F(Network, WritesDistributionsOfEachStateAndOfAll) {
  ASSERT_EQ(network("square.h5 chain.h5 --pdf pdf.csv --unit mean --bin-width 0.5").code, 0);
  const CsvTable pdf = table("pdf.csv");
  EXPECT_THAT(pdf.columns(),
              ElementsAre("file", "kind", "unit_force", "low", "high", "count", "n", "density", "n_outside"));
  int n_pooled = 0;
  for (int r = 0; r < pdf.n_rows(); ++r) {
    if (pdf.text(r, 0) == "pooled" && pdf.text(r, 1) == "normal" && pdf.integer(r, 5) > 0) {
      ++n_pooled;
      EXPECT_EQ(pdf.integer(r, 6), 6);
      EXPECT_EQ(pdf.number(r, 3) < 0.0 ? 4 : 2, pdf.integer(r, 5));
      EXPECT_NEAR(pdf.number(r, 7), static_cast<double>(pdf.integer(r, 5)) / (6 * 0.5), 1e-14);
    }
  }
  EXPECT_EQ(n_pooled, 2);
  const Outcome none = network("square.h5 --pdf pdf.csv --unit F0");
  EXPECT_EQ(none.code, 0);
  EXPECT_THAT(none.err, HasSubstr("the pull-off force F0 is zero: give --unit mean"));
}

TEST_F(Network, WritesParticleStressesThatAddUp) {
  ASSERT_EQ(network("spheres.h5 --particle-stress p.csv").code, 0);
  const CsvTable p = table("p.csv");
  const Packing<3> packing = std::get<State<3>>(read_state(scratch_.file("spheres.h5"))).packing;
  ASSERT_EQ(p.n_rows(), packing.grains.size());
  double trace = 0.0;
  for (int r = 0; r < p.n_rows(); ++r) {
    const double R = p.number(r, p.column("radius"));
    trace += 4.0 / 3.0 * std::acos(-1.0) * R * R * R * p.number(r, p.column("pressure"));
  }
  const double whole = packing.cell.volume() * static_stress(packing).trace() / 3.0 * solid_fraction(packing);
  EXPECT_NEAR(trace, whole, 1e-12 * std::abs(whole));
  const Outcome mixed = network("square.h5 spheres.h5 --particle-stress p.csv");
  EXPECT_EQ(mixed.code, 4);
  EXPECT_THAT(mixed.err, HasSubstr("spheres.h5: this state differs in dimension"));
}

TEST_F(Network, TellsTheForceCarryingStructureOfSpheres) {
  // A face-centred cubic crystal of spheres under Hertz's law, with a = E = 1 and overlaps of h = 0.01. In the second
  // state, one of the 192 contacts of the crystal has no force.
  State<3> fcc;
  fcc.packing = tiled<3>(crystal_of(face_centred_cubic(), 0.99, 1.0, elastic_law(1.0, 0.5, 0.0)), {2, 2, 2});
  make_hertzian(1.0, 14.0 / 17.0, fcc.packing);
  const double P = static_stress(fcc.packing).trace() / 3.0;
  fcc.target_stress.setConstant(P);
  write_state(scratch_.file("fcc.h5"), fcc);
  const Outcome whole = network("fcc.h5 --format json");
  ASSERT_EQ(whole.code, 0) << whole.err;
  const json row = json::parse(whole.out).at(0);
  EXPECT_NEAR(row.at("P").get<double>(), 9.619519e-4, 1e-10);
  EXPECT_EQ(row.at("n_carrying"), 192);
  EXPECT_EQ(row.at("z_star_star"), 12.0);
  EXPECT_EQ(row.at("n_null_modes"), 3);
  EXPECT_EQ(row.at("hyperstaticity"), 3 * 192 - 6 * 32 - 3 + 3);
  EXPECT_NEAR(row.at("Z_1_3").get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(row.at("energy_per_grain").get<double>(), 8e-6, 1e-16);
  EXPECT_NEAR(row.at("p_max").get<double>(), 2.0 / std::acos(-1.0) * 0.1, 1e-12);
  EXPECT_NEAR(row.at("stress_spread").get<double>(), 0.0, 1e-14);
  EXPECT_NEAR(row.at("fabric33").get<double>(), 0.0, 1e-14);
  // The contact between (0, 0, 0) and (0, 1/2, 1/2) is opened. The sum of the dyadic products n n over all contacts (n:
  // normal) has the diagonal 192 (1, 1, 1)/3 before. The opened contact reduces it by (0, 1/2, 1/2).
  Contact<3>& open = fcc.packing.contacts[0];
  open.normal_force = open.elastic_force = 0.0;
  write_state(scratch_.file("open.h5"), fcc);
  const json other = json::parse(network("open.h5 --zero-force 1e-4 --format json").out).at(0);
  EXPECT_EQ(other.at("n_carrying"), 191);
  EXPECT_EQ(other.at("hyperstaticity"), 3 * 191 - 6 * 32);
  double largest = -1.0;
  for (const char* entry : {"fabric11", "fabric22", "fabric33"})
    largest = std::max(largest, other.at(entry).get<double>());
  EXPECT_NEAR(largest, 64.0 / 191.0 - 1.0 / 3.0, 1e-12);
  EXPECT_EQ(json::parse(network("fcc.h5 --least-contacts 13 --format json").out).at(0).at("x0_carrying"), 1.0);
  const json flat = json::parse(network("square.h5 --format json").out).at(0);
  EXPECT_TRUE(flat.at("z_star_star").is_null());
  EXPECT_TRUE(flat.at("fabric33").is_null());
  EXPECT_NEAR(flat.at("energy_per_grain").get<double>(), 2.0 * 0.5 * 0.02 * 0.04, 1e-15);
}

TEST_F(Network, RefusesWhatIsNoForceOrFile) {
  EXPECT_EQ(network("").code, 2);
  EXPECT_EQ(network("square.h5 --bin-width 0").code, 2);
  EXPECT_EQ(network("square.h5 --zero-force -1").code, 2);
  EXPECT_EQ(network("square.h5 --pdf none/pdf.csv").code, 1);
}

}  // namespace
}  // namespace floc::test
