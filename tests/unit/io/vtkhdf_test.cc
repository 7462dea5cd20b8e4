#include "floc/io/vtkhdf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floc/base/error.h"
#include "floc/io/hdf5_file.h"
#include "floc/packing/liquid/liquid.h"
#include "support/angular_packing.h"
#include "support/rigid_states.h"
#include "support/states.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

template <int Dim>
void expect_round_trip(const test::Ends<Dim>& ends) {
  SCOPED_TRACE(testing::PrintToString(ends));
  State<Dim> state = test::packing_with_forces<Dim>(ends);
  if (ends[Dim - 1] != "p") state.packing.gravity[Dim - 1] = -9.81;
  const test::ScratchDirectory scratch;
  write_vtkhdf(scratch.file("p.vtkhdf"), state);
  EXPECT_TRUE(is_vtkhdf(scratch.file("p.vtkhdf")));
  const Packing<Dim> read = test::read_packing<Dim>(scratch.file("p.vtkhdf"));
  test::expect_same_packing(read, state.packing, 1e-12);
  EXPECT_EQ(read.gravity, state.packing.gravity);
  EXPECT_EQ(read.cell.matrix, state.packing.cell.matrix);
}

TEST(VtkHdf, GoesOutAndComesBackAsItWas) {
  expect_round_trip<2>({"p", "p"});
  expect_round_trip<2>({"ww", "p"});
  expect_round_trip<2>({"oo", "wo"});
  expect_round_trip<3>({"p", "p", "p"});
  expect_round_trip<3>({"ww", "p", "wo"});
  expect_round_trip<3>({"ww", "ww", "ww"});
}

TEST(VtkHdf, KeepsRigidContactsAndBonds) {
  const State<2> rigid = test::triangular_crystal(2.0, 0.3);
  const test::ScratchDirectory scratch;
  write_vtkhdf(scratch.file("r.vtkhdf"), rigid);
  ImportOptions options;
  options.law = rigid.packing.law;
  test::expect_same_packing(test::read_packing<2>(scratch.file("r.vtkhdf"), options), rigid.packing, 1e-12);
  State<3> bonded = test::packing_with_forces<3>({"p", "p", "p"});
  Contact<3>& c = bonded.packing.contacts[3];
  c.bonded = true;
  c.kn = 7.0, c.kr = 0.25, c.ktw = 0.5;
  c.normal_force = -2.0;
  write_vtkhdf(scratch.file("b.vtkhdf"), bonded);
  const Contact<3> read = test::read_packing<3>(scratch.file("b.vtkhdf")).contacts[3];
  EXPECT_TRUE(read.bonded);
  EXPECT_EQ(std::tuple(read.kn, read.kt, read.kr, read.ktw), std::tuple(7.0, c.kt, 0.25, 0.5));
  EXPECT_NEAR(read.normal_force, -2.0, 1e-14);
}

template <int Dim>
void expect_masses_of_walls(const test::Ends<Dim>& ends) {
  SCOPED_TRACE(testing::PrintToString(ends));
  State<Dim> state = test::packing_with_forces<Dim>(ends);
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("p.vtkhdf");
  for (std::size_t moving = 0; moving < state.packing.walls.size(); ++moving) {
    if (state.packing.walls[moving].open) continue;
    state.packing.walls[moving].mass = 2.5 + static_cast<double>(moving);
    write_vtkhdf(path, state);
    const std::vector<Wall<Dim>> read = test::read_packing<Dim>(path).walls;
    ASSERT_EQ(read.size(), state.packing.walls.size());
    for (std::size_t w = 0; w < read.size(); ++w)
      EXPECT_EQ(read[w].mass, state.packing.walls[w].mass) << moving << " " << w;
  }
}

TEST(VtkHdf, KeepsTheMassesOfWallsThatForcesMove) {
  expect_masses_of_walls<2>({"ww", "ww"});
  expect_masses_of_walls<2>({"p", "wo"});
  expect_masses_of_walls<3>({"ww", "p", "ow"});
}

TEST(VtkHdf, KeepsTheVolumesOfLiquidBridges) {
  State<3> wet = test::packing_with_forces<3>({"p", "p", "p"});
  Packing<3>& p = wet.packing;
  p.law = parse_law("law", test::kForeignLaw +
                               ",adhesion.law=capillary,adhesion.surface_tension=1,adhesion.contact_angle=10,"
                               "adhesion.water_content=0.01,adhesion.density_ratio=2.5");
  double volume = 1e-4;
  for (Contact<3>& c : p.contacts) set_bridge_volume(volume *= -1.01, c);
  const test::ScratchDirectory scratch;
  write_vtkhdf(scratch.file("w.vtkhdf"), wet);
  ImportOptions options;
  options.law = p.law;
  const Packing<3> read = test::read_packing<3>(scratch.file("w.vtkhdf"), options);
  ASSERT_EQ(read.contacts.size(), p.contacts.size());
  for (std::size_t k = 0; k < p.contacts.size(); ++k)
    EXPECT_EQ(bridge_volume(read, read.contacts[k]), bridge_volume(p, p.contacts[k])) << k;
}

TEST(VtkHdf, HasVtksLayoutAndTensionPositive) {
  const State<3> state = test::packing_with_forces<3>({"p", "p", "ww"});
  const Packing<3>& p = state.packing;
  const test::ScratchDirectory scratch;
  write_vtkhdf(scratch.file("p.vtkhdf"), state);
  const Hdf5Reader file("p", scratch.file("p.vtkhdf"));
  std::string type;
  file.attribute("VTKHDF", "Type", type);
  EXPECT_EQ(type, "UnstructuredGrid");
  const auto numbers = [&](const std::string& path) { return file.numbers("VTKHDF/" + path); };
  const double n = p.grains.size(), n_lines = static_cast<double>(p.contacts.size());
  EXPECT_EQ(numbers("NumberOfCells"), std::vector{n + n_lines});
  EXPECT_EQ(numbers("NumberOfConnectivityIds"), std::vector{n + 2.0 * n_lines});
  const std::vector<double> x = numbers("Points"), line = numbers("Connectivity"),
                            force = numbers("CellData/normal_force"), radius = numbers("PointData/radius");
  EXPECT_EQ(numbers("NumberOfPoints"), std::vector{static_cast<double>(radius.size())});
  EXPECT_EQ(x.size(), 3 * radius.size());
  EXPECT_EQ(file.shape("VTKHDF/CellData/shear_force"), (ArrayShape{force.size(), 3}));
  const auto n_grains = static_cast<std::size_t>(p.grains.size());
  for (std::size_t k = 0; k < p.contacts.size(); ++k) {
    const auto from = static_cast<std::size_t>(line[n_grains + 2 * k]),
               to = static_cast<std::size_t>(line[n_grains + 2 * k + 1]);
    EXPECT_EQ(force[n_grains + k], -p.contacts[k].normal_force);
    const Vec<3> along = Eigen::Map<const Vec<3>>(&x[3 * to]) - Eigen::Map<const Vec<3>>(&x[3 * from]);
    EXPECT_NEAR((along - branch(p, p.contacts[k])).norm(), 0.0, 1e-14);
  }
}

/// Writes a file as another program might: without identifiers, in single precision, and with a line for each contact.
void write_foreign(const std::string& path, const std::vector<double>& connectivity,
                   const std::string& type = "PolyData") {
  Hdf5Writer file(path);
  const auto whole = [&](const std::string& name, std::vector<double> values) {
    file.rows<std::int64_t>(name, {values.size()}, [&](std::uint64_t, std::span<std::int64_t> block) {
      for (std::size_t k = 0; k < block.size(); ++k) block[k] = static_cast<std::int64_t>(values[k]);
    });
  };
  file.group("VTKHDF");
  file.attribute("VTKHDF", "Version", std::vector<std::int64_t>{2, 0});
  file.fixed_text_attribute("VTKHDF", "Type", type);
  file.array("VTKHDF/Points", {2, 3}, std::vector<double>{0.5, 0.5, 0.5, 1.48, 0.5, 0.5});
  file.group("VTKHDF/Lines");
  whole("VTKHDF/Lines/Connectivity", connectivity);
  whole("VTKHDF/Lines/Offsets", {0, 2});
  file.group("VTKHDF/PointData");
  file.array("VTKHDF/PointData/Radius", {2}, std::vector<double>{0.5, 0.5});
  file.group("VTKHDF/CellData");
  file.array("VTKHDF/CellData/normal_force", {1}, std::vector<double>{-3.0});
  file.close();
}

TEST(VtkHdf, ReadsFilesOfOtherProgramsAndNamesWhatIsWrong) {
  const test::ScratchDirectory scratch;
  const std::string path = scratch.file("f.vtkhdf");
  const auto read = [&] {
    ImportOptions options;
    options.dimension = 3;
    options.walls = "x=:,y=:,z=:";
    return test::read_packing<3>(path, options);
  };
  write_foreign(path, {0, 1});
  const Packing<3> p = read();
  ASSERT_EQ(p.contacts.size(), 1u);
  EXPECT_DOUBLE_EQ(p.contacts[0].normal_force, 3.0);
  const auto refusal = [&](const std::string& words) {
    EXPECT_THAT(read, ThrowsMessage<InputError>(HasSubstr(words)));
  };
  write_foreign(path, {0, 2});
  refusal("Lines/Connectivity: entry 1 is 2, expected a point from 0 to 1");
  write_foreign(path, {0});
  refusal("Lines/Offsets: entries 0 and 1 are 0 and 2, expected ascending numbers");
  write_foreign(path, {0, 1}, "ImageData");
  refusal("the type is \"ImageData\", expected UnstructuredGrid or PolyData");
  {
    Hdf5Writer file(path);
    file.group("other");
    file.close();
  }
  refusal("has no group VTKHDF");
  const std::string whole = test::content_of(path);
  test::write_text(path, whole.substr(0, whole.size() / 2));
  refusal("f.vtkhdf");
  EXPECT_THAT(
      [&] {
        write_vtkhdf(path, test::angular_packing_with_forces<2>({"p", "p"}));
      },
      ThrowsMessage<InputError>(HasSubstr("corners")));
}

}  // namespace
}  // namespace floc
