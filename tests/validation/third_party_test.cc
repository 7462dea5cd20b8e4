#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "floc/io/lammps_dump.h"
#include "floc/io/law_text.h"
#include "floc/io/yade_text.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "support/contact_laws.h"
#include "support/places.h"

/// Packings made by LAMMPS and YADE (data/packings). These programs printed the stress and the net force on every grain
/// with 17 digits. The stress and the net forces of floc must agree with them up to rounding errors.
namespace floc {
namespace {

const std::string kData = test::source_directory() + "/data/packings/";

/// Relative rounding error of a sum of a hundred products.
constexpr double kRounding = 1e-13;

/// Returns the rounding error of the net force on a grain with up to six contacts. For contacts across the cell
/// boundary, both programs shift positions by the size of the cell, so rounding errors are proportional to this size.
template <int Dim>
double force_rounding(const Packing<Dim>& packing) {
  double stiffest = 0.0;
  for (const Contact<Dim>& c : packing.contacts) stiffest = std::max(stiffest, c.kn);
  return 6.0 * std::numeric_limits<double>::epsilon() * stiffest * packing.cell.matrix.norm();
}

/// Returns the rows of numbers of a text file, without lines that begin with one of the characters in
/// `skipped`.
std::vector<std::vector<double>> rows_of(const std::string& path, const std::string& skipped) {
  std::ifstream in(path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || skipped.find(line[0]) != std::string::npos) continue;
    std::istringstream tokens(line);
    rows.emplace_back(std::istream_iterator<double>(tokens), std::istream_iterator<double>());
  }
  return rows;
}

/// Returns the numbers after the colon in the first line of a file.
std::vector<double> numbers_behind_colon(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  std::istringstream tokens(line.substr(line.find(':') + 1));
  return {std::istream_iterator<double>(tokens), std::istream_iterator<double>()};
}

Imported read_lammps() {
  ImportOptions options;
  options.law = parse_law("", "normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800");
  options.contacts = kData + "lammps/disks.contacts";
  options.contact_columns = {{"id1", "c_pair[1]"},           {"id2", "c_pair[2]"},
                             {"force1", "c_force[1]"},       {"force2", "c_force[2]"},
                             {"shear_force1", "c_force[4]"}, {"shear_force2", "c_force[5]"}};
  return read_lammps_dump(kData + "lammps/disks.dump", options);
}

TEST(Lammps, StressOfItsPackingIsItsOwn) {
  const Packing<2> packing = std::get<State<2>>(read_lammps().state).packing;
  const std::vector<double> own = numbers_behind_colon(kData + "lammps/disks.stress");  // mean, xx, yy, xy
  ASSERT_EQ(own.size(), 4u);
  const Mat<2> stress = static_stress(packing);
  EXPECT_NEAR(0.5 * stress.trace(), own[0], kRounding * own[0]);
  EXPECT_NEAR(stress(0, 0), own[1], kRounding * own[0]);
  EXPECT_NEAR(stress(1, 1), own[2], kRounding * own[0]);
  // floc computes the stress from force times branch. This stress is symmetric if the moments balance. Here they do not
  // balance exactly, because the lever arms of LAMMPS differ a little from those of floc.
  EXPECT_NEAR(stress(1, 0), own[3], kRounding * own[0]);
}

TEST(Lammps, NetForcesInItsPackingAreItsOwn) {
  const Packing<2> packing = std::get<State<2>>(read_lammps().state).packing;
  const Balance<2> net = net_forces(packing);
  // columns: id type x y z radius mass fx fy fz tqx tqy tqz, after nine header lines
  const auto rows = rows_of(kData + "lammps/disks.dump", "I");
  ASSERT_EQ(rows.size(), 5u + 60u);
  const double rounding = force_rounding(packing);
  for (int i = 0; i < 60; ++i) {
    const std::vector<double>& row = rows[5 + static_cast<std::size_t>(i)];
    EXPECT_NEAR(net.force[i][0], row[7], rounding) << i;
    EXPECT_NEAR(net.force[i][1], row[8], rounding) << i;
    EXPECT_EQ(packing.grains.mass[i], row[6]);
  }
}

/// LAMMPS and floc have the same normal law, so the forces computed from positions alone must equal the forces that
/// LAMMPS listed. Tangential springs are not compared.
TEST(Lammps, NormalForcesFollowFromItsGeometry) {
  const Packing<2> packing = std::get<State<2>>(read_lammps().state).packing;
  ASSERT_EQ(packing.contacts.size(), 87u);
  for (const Contact<2>& c : packing.contacts)
    EXPECT_NEAR(c.normal_force, -1000.0 * c.gap, force_rounding(packing));
}

Imported read_yade() {
  ImportOptions options;
  options.units = "SI";
  options.contacts = kData + "yade/spheres.interactions";
  return read_yade_text(kData + "yade/spheres.txt", options);
}

TEST(Yade, StressOfItsPackingIsItsOwn) {
  const Packing<3> packing = std::get<State<3>>(read_yade().state).packing;
  const std::vector<double> own = numbers_behind_colon(kData + "yade/spheres.forces");
  ASSERT_EQ(own.size(), 9u);
  const Mat<3> stress = static_stress(packing);
  const double pressure = stress.trace() / 3.0;
  EXPECT_NEAR(pressure, -(own[0] + own[4] + own[8]) / 3.0, kRounding * pressure);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) EXPECT_NEAR(stress(a, b), -own[3 * a + b], kRounding * pressure) << a << b;
}

TEST(Yade, NetForcesInItsPackingAreItsOwn) {
  const Packing<3> packing = std::get<State<3>>(read_yade().state).packing;
  const Balance<3> net = net_forces(packing);
  const auto rows = rows_of(kData + "yade/spheres.forces", "#");
  ASSERT_EQ(rows.size(), 40u);
  const double rounding = force_rounding(packing);
  for (int i = 0; i < 40; ++i)
    for (int a = 0; a < 3; ++a) EXPECT_NEAR(net.force[i][a], rows[i][1 + a], rounding) << i;
}

TEST(Yade, StiffnessesAreThoseOfEachContactAndTheLawHasTheirMeans) {
  const Imported imported = read_yade();
  const State<3>& state = std::get<State<3>>(imported.state);
  EXPECT_EQ(state.units, "SI");
  double kn = 0.0, kt = 0.0;
  for (const Contact<3>& c : state.packing.contacts) {
    // Tangential forces of YADE have a component along the branch of up to 1e-6, which the conversion adds to
    // the normal force.
    EXPECT_NEAR(c.normal_force, -c.kn * c.gap, 1e-6 * c.shear_force.norm() + force_rounding(state.packing));
    EXPECT_NEAR(c.kt / c.kn, 0.4, 1e-12);  // ratio of the moduli in spheres.py
    kn += c.kn / 92.0;
    kt += c.kt / 92.0;
  }
  EXPECT_NEAR(test::law_number(state.packing.law, "normal.stiffness"), kn, 1e-9 * kn);
  EXPECT_NEAR(test::law_number(state.packing.law, "friction.stiffness"), kt, 1e-9 * kt);
  EXPECT_NEAR(test::law_number(state.packing.law, "friction.coefficient"), std::tan(0.4), 1e-15);
}

/// The net moments are not exactly zero, because LAMMPS and YADE use other lever arms than floc. The lever arms of
/// LAMMPS are the whole radii, which are longer than the lever arms of floc by the factor 1 + overlap/branch.
TEST(ThirdParties, PackingsAreInEquilibriumToTheirConventionOfContactPoints) {
  const Packing<2> disks = std::get<State<2>>(read_lammps().state).packing;
  const Residuals of_disks = residuals<2>(disks, static_stress(disks).diagonal());
  EXPECT_LT(of_disks.force, 1e-10);
  EXPECT_LT(of_disks.moment, 1e-3);
  const Packing<3> spheres = std::get<State<3>>(read_yade().state).packing;
  const Residuals of_spheres = residuals<3>(spheres, static_stress(spheres).diagonal());
  EXPECT_LT(of_spheres.force, 1e-10);
  EXPECT_LT(of_spheres.moment, 1e-3);
}

}  // namespace
}  // namespace floc
