#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/base/error.h"
#include "floc/io/csv_packing.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/tile.h"
#include "floc/relaxation/static_solver.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/lattices.h"
#include "support/run_program.h"

/// Tests that positions keep all digits that matter for forces. Stiffnesses are up to 1e9 F0/a, and distances from the
/// origin up to a billion diameters.
namespace floc {
namespace {

constexpr double kStiff = 1e9;

/// A crystal of 1 400 disks with K_N = 1e9, in equilibrium under P = 1. The diameters of the disks differ by a few
/// times the overlap of a contact.
struct StiffCrystal {
  Packing<2> packing;
  StaticSolution<2> solution;
  Vec<2> target = Vec<2>::Constant(1.0);

  StiffCrystal() {
    Law law;
    law += test::linear(kStiff);
    law += test::coulomb(0.5, kStiff);
    Packing<2> start = tiled<2>(cell_of_two(law), {28, 25});
    RandomStream random(1, 1);
    for (double& radius : start.grains.radius) radius += 2e-11 * random.normal();
    find_contacts(start);
    solution = solve_statics(start, target, {});
    packing = solution.packing;
  }

  /// Two disks of a triangular lattice of unit spacing in a rectangular cell. The overlap of the disks gives P = 1.
  static Packing<2> cell_of_two(const Law& law) {
    Packing<2> two;
    two.law = law;
    two.cell.matrix << 1.0, 0.0, 0.0, std::sqrt(3.0);
    two.grains = Grains<2>::with_size(2);
    two.grains.position[1] = {0.5, std::sqrt(0.75)};
    // In a triangular lattice of spacing d, with the force F_N on every contact, P = sqrt(3) F_N/d.
    two.grains.radius.assign(2, 0.5 + 0.5 / (std::sqrt(3.0) * kStiff));
    two.grains.mass.assign(2, 1.0);
    return two;
  }
};

TEST(Positions, OfAStiffCrystalReachAnEquilibriumTheyCanHold) {
  const StiffCrystal crystal;
  ASSERT_TRUE(crystal.solution.converged) << crystal.solution.reason << " " << crystal.solution.residual;
  const Residuals r = residuals(crystal.packing, crystal.target);
  EXPECT_LT(r.force, 1e-6);
  EXPECT_LT(r.moment, 1e-6);
  EXPECT_LT(r.stress, 1e-6);
  // In a packing with positions rounded to doubles, the net forces are far above the tolerance of an equilibrium.
  Packing<2> rounded = crystal.packing;
  ASSERT_FALSE(rounded.grains.position_low.empty());
  rounded.grains.position_low.clear();
  refresh_contacts(rounded);
  EXPECT_GT(residuals(rounded, crystal.target).force, 1e-5);
}

TEST(Positions, OfAStiffCrystalAreWholeInItsFile) {
  const StiffCrystal crystal;
  State<2> state;
  state.packing = crystal.packing;
  state.target_stress = crystal.target;
  measure(state);
  const test::ScratchDirectory scratch;
  write_state(scratch.file("stiff.h5"), state);
  const State<2> read = std::get<State<2>>(read_state(scratch.file("stiff.h5")));
  EXPECT_EQ(read.packing.grains.position, state.packing.grains.position);
  EXPECT_EQ(read.packing.grains.position_low, state.packing.grains.position_low);
  const test::Outcome verified = test::run_floc("verify stiff.h5 --format csv", scratch.path());
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
}

/// Returns the decimal text of x + by, with up to 34 digits.
/// @param x  coordinate >= 0
std::string displaced_text(const DoubleDouble& x, std::int64_t by) {
  const double whole = std::floor(x.high) - (x.high == std::floor(x.high) && x.low < 0.0 ? 1.0 : 0.0);
  DoubleDouble rest = x - DoubleDouble{whole, 0.0};
  std::string digits;
  for (int k = 0; k < 24; ++k) {
    rest = rest * 10.0;
    const double digit = std::min(std::floor(rest.high), 9.0);
    rest = rest - DoubleDouble{digit, 0.0};
    digits += static_cast<char>('0' + static_cast<int>(digit));
  }
  return fmt::format("{}.{}", by + static_cast<std::int64_t>(whole), digits);
}

TEST(Positions, ABillionDiametersAwayAreReadWithTheDigitsTheyAreWrittenWith) {
  const StiffCrystal crystal;
  Packing<2> smooth = crystal.packing;
  smooth.law += test::without("friction");
  refresh_contacts(smooth);
  const test::ScratchDirectory scratch;
  for (const std::int64_t far : {std::int64_t{0}, std::int64_t{1'000'000'000}}) {
    std::string csv = "x,y,radius,mass\n";
    for (int i = 0; i < smooth.grains.size(); ++i) {
      const DoubleDoubleVec<2> x = smooth.grains.centre(i);
      csv += fmt::format("{},{},{},1\n", displaced_text(x[0], far), displaced_text(x[1], 2 * far),
                         smooth.grains.radius[i]);
    }
    test::write_text(scratch.file("far.csv"), csv);
    ImportOptions options;
    options.law = smooth.law;
    options.cell = {{smooth.cell.matrix(0, 0), 0.0}, {0.0, smooth.cell.matrix(1, 1)}};
    Packing<2> read = std::get<State<2>>(read_csv_packing(scratch.file("far.csv"), options).state).packing;
    find_contacts(read);
    ASSERT_EQ(read.contacts.size(), smooth.contacts.size()) << far;
    // With 24 decimals of the positions, forces have an error of 1e-24 K_N.
    const auto sum_of_forces = [](const Packing<2>& packing) {
      double sum = 0.0;
      for (const Contact<2>& c : packing.contacts) sum += c.normal_force;
      return sum;
    };
    EXPECT_NEAR(sum_of_forces(read), sum_of_forces(smooth), 1e-9) << far;
    EXPECT_NEAR(residuals(read, crystal.target).force, residuals(smooth, crystal.target).force, 1e-10) << far;
  }
}

TEST(Positions, FartherThanImagesCanCountAreRefused) {
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file("far.csv"), "x,y,radius\n0,0,0.5\n1e20,0,0.5\n");
  ImportOptions options;
  options.law = Law{};
  *options.law += test::linear(1.0);
  options.cell = {{4.0, 0.0}, {0.0, 4.0}};
  try {
    read_csv_packing(scratch.file("far.csv"), options);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()), scratch.file("far.csv") +
                                         ":3: a grain lies more than 1e9 cells away from the cell: --cell is "
                                         "too small, or a coordinate is wrong");
  }
}

}  // namespace
}  // namespace floc
