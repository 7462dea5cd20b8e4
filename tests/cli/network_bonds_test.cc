#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "floc/packing/tile.h"
#include "support/contact_laws.h"
#include "support/crystals.h"
#include "support/lattices.h"
#include "support/run_program.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

/// Gives normal forces to the contacts along the first axis: f in the lower half of the cell (along the last axis), -f
/// in the upper half. All other contacts get no force.
template <int Dim>
void load_in_two_layers(double f, Packing<Dim>& packing) {
  const double middle = 0.5 * packing.cell.matrix(Dim - 1, Dim - 1) - 1e-6;
  for (Contact<Dim>& c : packing.contacts) {
    const bool below = packing.cell.wrapped(packing.grains.position[c.i])[Dim - 1] < middle;
    c.normal_force = std::abs(c.normal[0]) < 0.5 ? 0.0 : below ? f : -f;
    c.elastic_force = c.normal_force + 1.0;
  }
}

/// Fixture: a square lattice of 6 x 4 disks and a cubic lattice of 4 x 4 x 4 spheres. In each lattice, one half is
/// under pressure and the other half under tension.
class Bonds : public testing::Test {
 protected:
  void SetUp() override {
    Law law = elastic_law(100.0, 50.0, 0.0);
    law += test::constant_adhesion(1.0);
    State<2> layers;
    layers.packing = tiled<2>(square_frames(2, 1.0, law), {6, 4});
    load_in_two_layers(0.5, layers.packing);
    write_state(scratch_.file("layers.h5"), layers);
    State<3> spheres;
    spheres.packing = tiled<3>(crystal_of(simple_cubic(), 0.99, 1.0, law), {4, 4, 4});
    load_in_two_layers(0.25, spheres.packing);
    write_state(scratch_.file("spheres.h5"), spheres);
  }

  Outcome floc(const std::string& arguments) const { return run_floc(arguments, scratch_.path()); }
  CsvTable table(const std::string& name) const { return CsvTable::read(scratch_.file(name)); }

  ScratchDirectory scratch_;
};

TEST_F(Bonds, ColumnsComeWhenAskedFor) {
  const json plain = json::parse(floc("network layers.h5 --format json").out).at(0);
  EXPECT_FALSE(plain.contains("z_bonds"));
  EXPECT_FALSE(plain.contains("like_share"));
  const Outcome o = floc("network layers.h5 spheres.h5 --with bonds,phases --format json");
  ASSERT_EQ(o.code, 0) << o.err;
  const json flat = json::parse(o.out).at(0), solid = json::parse(o.out).at(1);
  // --with adds columns, and does not remove columns of the plain table.
  EXPECT_EQ(std::distance(plain.begin(), plain.end()) + 10 + 5 + 14, std::distance(flat.begin(), flat.end()));
  EXPECT_EQ(flat.at("n_bonds"), 48);
  EXPECT_EQ(flat.at("z_bonds"), 4.0);
  EXPECT_EQ(flat.at("z_bonds_plus"), 1.0);
  EXPECT_EQ(flat.at("z_bonds_minus"), 1.0);
  EXPECT_EQ(flat.at("z_bonds_near_zero"), 2.0);
  EXPECT_EQ(flat.at("minus_share"), 0.5);
  EXPECT_EQ(flat.at("mean_plus"), 0.5);
  // Diameters are 1.02 times the lattice spacing.
  const double phi = std::acos(-1.0) / 4.0 * 1.02 * 1.02;
  EXPECT_NEAR(flat.at("virial_strength").get<double>(), 4.0 * phi / std::acos(-1.0) / 1.02, 1e-12);
  EXPECT_NEAR(flat.at("rumpf_strength").get<double>(), phi / (1.0 - phi) / 1.02, 1e-12);
  EXPECT_NEAR(flat.at("p0").get<double>(), 1.0 / 1.02, 1e-12);
  // All 24 bonds along the layers join grains of the same sign. Of the 24 bonds across the layers, 12 join grains of
  // opposite signs.
  EXPECT_EQ(flat.at("n_signed_bonds"), 48);
  EXPECT_EQ(flat.at("like_share"), 0.75);
  EXPECT_NEAR(flat.at("like_share_shuffled").get<double>(), 2.0 * 12 * 11 / (24.0 * 23.0), 1e-12);
  EXPECT_EQ(flat.at("positive_along"), "x");
  EXPECT_EQ(flat.at("negative_along"), "x");
  EXPECT_EQ(flat.at("negative_clusters"), 1);
  EXPECT_EQ(flat.at("negative_largest_cluster"), 12);
  EXPECT_EQ(solid.at("positive_along"), "xy");
  EXPECT_EQ(solid.at("positive_directions"), 2);
  EXPECT_EQ(solid.at("like_share"), 1.0 - 32.0 / 192.0);
}

TEST_F(Bonds, TheClassNearZeroIsChosen) {
  const json row = json::parse(floc("network layers.h5 --with bonds --near-zero 0.6 --format json").out).at(0);
  EXPECT_EQ(row.at("z_bonds_near_zero"), 4.0);
  EXPECT_EQ(row.at("minus_share"), 0.0);
}

TEST_F(Bonds, ExponentsOfEitherSideAndOfBoth) {
  ASSERT_EQ(floc("network layers.h5 spheres.h5 --exponents e.csv").code, 0);
  const CsvTable e = table("e.csv");
  EXPECT_THAT(e.columns(), ElementsAre("file", "quantity", "unit", "unit_size", "side", "from", "to", "n",
                                       "exponent", "stderr"));
  const auto find = [&](const std::string& file, const std::string& side, double from, bool is_tail) {
    for (int r = 0; r < e.n_rows(); ++r)
      if (e.text(r, 0) == file && e.text(r, 1) == "force" && e.text(r, 2) == "F0" && e.text(r, 4) == side &&
          e.number(r, 5) == from && e.is_empty(r, 6) == is_tail)
        return r;
    return -1;
  };
  // All forces have the magnitude 0.5. For compressive forces, the fitted exponent is 1/(mean force - lower limit),
  // with the lower limit 0 or 0.1. Tensile forces are fitted in the window from 0 to 1. Their mean is the middle of
  // this window, so the exponent is 0.
  const int tail = find("layers.h5", "+", 0.0, true), from = find("layers.h5", "+", 0.1, true);
  ASSERT_GE(tail, 0);
  ASSERT_GE(from, 0);
  EXPECT_NEAR(e.number(tail, 8), 2.0, 1e-9);
  EXPECT_NEAR(e.number(tail, 9), 2.0 / std::sqrt(12.0), 1e-9);
  EXPECT_NEAR(e.number(from, 8), 2.5, 1e-9);
  const int minus = find("layers.h5", "-", 0.0, false);
  ASSERT_GE(minus, 0);
  EXPECT_EQ(e.number(minus, 6), 1.0);
  EXPECT_NEAR(e.number(minus, 8), 0.0, 1e-6);
  EXPECT_EQ(e.integer(find("layers.h5", "both", 0.0, true), 7), 24);
  EXPECT_EQ(e.integer(find("pooled", "+", 0.0, true), 7), 12 + 32);
  EXPECT_TRUE(e.is_empty(find("pooled", "+", 0.0, true), 3));
}

TEST_F(Bonds, PhasesAndPressuresGoToFiles) {
  ASSERT_EQ(floc("network layers.h5 --pressure-pdf p.csv --like-neighbours l.csv --clusters c.csv").code, 0);
  const CsvTable p = table("p.csv"), l = table("l.csv"), c = table("c.csv");
  EXPECT_THAT(p.columns(),
              ElementsAre("file", "unit_stress", "low", "high", "count", "n", "density", "n_outside"));
  int n = 0;
  for (int r = 0; r < p.n_rows(); ++r) n += static_cast<int>(p.integer(r, 4));
  EXPECT_EQ(n, 24);
  // Every grain has four neighbours, of which three have the same sign.
  ASSERT_EQ(l.n_rows(), 2);
  EXPECT_EQ(l.text(0, 1), "positive");
  EXPECT_NEAR(l.number(0, 2), 0.7, 1e-12);
  EXPECT_EQ(l.integer(0, 4), 12);
  ASSERT_EQ(c.n_rows(), 2);
  EXPECT_EQ(c.integer(1, 2), 12);
  EXPECT_EQ(c.integer(1, 3), 1);
}

TEST_F(Bonds, ForcesAreMeasuredInThePressureToo) {
  // The mean stress is zero, so the command cannot give forces in units of P.
  const Outcome none = floc("network layers.h5 --pdf f.csv --unit P");
  EXPECT_THAT(none.err, HasSubstr("P cannot be distinguished from zero, because of rounding or the tolerance "
                                  "of equilibrium: give --unit mean"));
  State<2> square;
  square.packing = square_frames(2, 1.0, elastic_law(2.0, 0.6, 0.1));
  square.target_stress.setConstant(0.04);
  write_state(scratch_.file("square.h5"), square);
  ASSERT_EQ(floc("network square.h5 --pdf f.csv --unit P").code, 0);
  EXPECT_NEAR(table("f.csv").number(0, 2), 0.04 * 1.02, 1e-12);  // P a, with the diameter a
}

TEST_F(Bonds, AreDrawnAndPlotted) {
  for (const std::string name : {"layers", "spheres"}) {
    ASSERT_EQ(floc("draw " + name + ".h5 --forces phases -o " + name + ".svg").code, 0);
    const std::string svg = content_of(scratch_.file(name + ".svg"));
    EXPECT_THAT(svg, HasSubstr("</svg>"));
    const Outcome o = floc("plot " + name + ".h5 --show pressures -o p.svg --format json");
    ASSERT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(json::parse(o.out).at(0).at("shows"), "pressures");
    EXPECT_THAT(content_of(scratch_.file("p.gp")), HasSubstr("pressure of a grain / p_0"));
  }
  // Of the bonds, 36 join grains of the same sign and are drawn in blue or orange; the others are not drawn.
  const Outcome o = floc("draw layers.h5 --forces phases -o l.svg --format json");
  EXPECT_EQ(json::parse(o.out).at(0).at("n_compression"), 18);
  EXPECT_EQ(json::parse(o.out).at(0).at("n_tension"), 18);
}

TEST_F(Bonds, BadInputIsRefused) {
  EXPECT_EQ(floc("network layers.h5 --with everything").code, 2);
  EXPECT_EQ(floc("network layers.h5 --near-zero -1").code, 2);
  EXPECT_EQ(floc("network layers.h5 --exponents none/e.csv").code, 1);
}

}  // namespace
}  // namespace floc::test
