#include "floc/io/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "floc/base/error.h"
#include "floc/io/extended_xyz.h"
#include "floc/io/import.h"
#include "floc/io/lammps_data.h"
#include "floc/io/vtk_arrays.h"
#include "floc/io/vtu.h"
#include "support/contact_laws.h"
#include "support/foreign_packing.h"
#include "support/run_program.h"
#include "support/states.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Writes a state in a format, given by its keyword, and reads it back.
template <int Dim>
Packing<Dim> written_and_read(const std::string& keyword, const State<Dim>& state) {
  const test::ScratchDirectory scratch;
  const ExportFormat& format = find_export_format(keyword, "");
  const std::string path = scratch.file("s" + format.extension);
  format.write(path, state);
  const ImportFormat& reader = find_import_format("", path);
  EXPECT_EQ(reader.keyword, keyword);
  ImportOptions options;
  options.law = state.packing.law;
  options.dimension = Dim;  // in busy_state() the grains lie on a line, so the dimension cannot be detected
  return std::get<State<Dim>>(reader.read(path, options).state).packing;
}

template <int Dim>
void expect_written_grains(const Packing<Dim>& read, const Packing<Dim>& written) {
  ASSERT_EQ(read.grains.size(), written.grains.size());
  EXPECT_EQ(read.cell.matrix, written.cell.matrix);
  for (int i = 0; i < read.grains.size(); ++i) {
    EXPECT_EQ(read.grains.position[i], written.cell.wrapped(written.grains.position[i])) << i;
    EXPECT_EQ(read.grains.radius[i], written.grains.radius[i]) << i;
    EXPECT_EQ(read.grains.mass[i], written.grains.mass[i]) << i;
  }
}

TEST(Vtu, ReadsWhatItWroteToTheLastDigit) {
  expect_written_grains(written_and_read("vtu", test::busy_state<2>()), test::busy_state<2>().packing);
  expect_written_grains(written_and_read("vtu", test::busy_state<3>()), test::busy_state<3>().packing);
}

TEST(ExtendedXyz, ReadsWhatItWroteToTheLastDigit) {
  expect_written_grains(written_and_read("extended-xyz", test::busy_state<2>()), test::busy_state<2>().packing);
  expect_written_grains(written_and_read("extended-xyz", test::busy_state<3>()), test::busy_state<3>().packing);
}

/// LAMMPS requires the first lattice vector along x, and small tilts. For LAMMPS, a packing may therefore be rotated
/// and get other vectors of the same lattice. All distances must stay the same.
template <int Dim>
void expect_same_lattice_and_distances() {
  State<Dim> state = test::busy_state<Dim>();
  // after this, the first lattice vector is not along x, so the export has to rotate the packing
  state.packing.cell.matrix(0, 1) = 0.3;
  state.packing.cell.matrix.row(1) += 2.0 * state.packing.cell.matrix.row(0);
  const Packing<Dim>& written = state.packing;
  const Packing<Dim> read = written_and_read("lammps-data", state);
  EXPECT_TRUE(read.cell.matrix.isLowerTriangular(0.0));
  EXPECT_NEAR(read.cell.volume(), written.cell.volume(), 1e-13 * written.cell.volume());
  const auto nearest = [](const Packing<Dim>& p, int i, int j) {
    double best = 1e9;
    for (int a = -3; a <= 3; ++a)
      for (int b = -3; b <= 3; ++b) {
        Vec<Dim, int> image = Vec<Dim, int>::Zero();
        image[0] = a, image[1] = b;
        best = std::min(best, (p.grains.position[j] - p.grains.position[i] + p.cell.shift(image)).norm());
      }
    return best;
  };
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(read.grains.radius[i], written.grains.radius[i]);
    EXPECT_NEAR(read.grains.mass[i], written.grains.mass[i], 1e-15);
    for (int j = 0; j < i; ++j) EXPECT_NEAR(nearest(read, i, j), nearest(written, i, j), 1e-13) << i << j;
  }
}

TEST(LammpsData, KeepsDistancesMassesAndTheLattice) {
  expect_same_lattice_and_distances<2>();
  expect_same_lattice_and_distances<3>();
}

TEST(LammpsData, LeavesABoxThatIsOneAsItIs) {
  State<2> state = test::busy_state<2>();
  state.packing.cell.matrix(0, 0) = 2.5;
  const Packing<2> read = written_and_read("lammps-data", state);
  EXPECT_EQ(read.cell.matrix, state.packing.cell.matrix);
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(read.grains.position[i], state.packing.cell.wrapped(state.packing.grains.position[i]));
}

/// Grain 0 touches its own image across the cell boundary, grains 0 and 1 touch inside the cell, and grains 1
/// and 2 attract each other at a distance.
TEST(Vtu, DrawsContactsAndCutsThoseAcrossTheSide) {
  const State<2> state = test::busy_state<2>();
  const VtkArrays arrays("drawing", vtu_text(state));
  const std::vector<double> x = arrays.read("Points", "");
  const std::vector<double> types = arrays.read("Cells", "types");
  const std::vector<double> ends = arrays.read("Cells", "connectivity");
  EXPECT_EQ(types, (std::vector<double>{1, 1, 1, 3, 3, 3, 3}));
  EXPECT_EQ(arrays.read("PointData", "id"), (std::vector<double>{0, 1, 2, -1, -1}));
  ASSERT_EQ(ends.size(), 3u + 8u);
  const double across = state.packing.cell.matrix.row(0).norm();
  for (std::size_t line = 0; line < 4; ++line) {
    const auto a = static_cast<std::size_t>(ends[3 + 2 * line]),
               b = static_cast<std::size_t>(ends[4 + 2 * line]);
    const double length = std::hypot(x[3 * a] - x[3 * b], x[3 * a + 1] - x[3 * b + 1]);
    if (line < 2)
      EXPECT_NEAR(length, 0.5 * across, 1e-15);
    else
      EXPECT_LT(length, 1.0);
  }
}

/// Fixture: a file with two points, in each encoding of VTK: as text and as binary data (base64 or raw). Binary data
/// follow a number that gives their length.
class VtuEncodings : public testing::Test {
 protected:
  static std::string bytes_of(const std::vector<double>& values) {
    std::string bytes(4 + 8 * values.size(), '\0');
    const auto length = static_cast<std::uint32_t>(8 * values.size());
    std::memcpy(bytes.data(), &length, 4);
    std::memcpy(bytes.data() + 4, values.data(), 8 * values.size());
    return bytes;
  }
  static std::string base64(const std::string& bytes) {
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
      std::uint32_t bits = 0;
      for (std::size_t b = 0; b < 3; ++b)
        bits = bits << 8 | (k + b < bytes.size() ? static_cast<unsigned char>(bytes[k + b]) : 0u);
      for (std::size_t c = 0; c < 4; ++c)
        text += k * 8 + c * 6 < bytes.size() * 8 ? alphabet[bits >> (18 - 6 * c) & 63] : '=';
    }
    return text;
  }
  static std::string file(const std::string& points, const std::string& radii,
                          const std::string& appended = "") {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" "
           "byte_order=\"LittleEndian\"><UnstructuredGrid>"
           "<Piece NumberOfPoints=\"2\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" " +
           points + "</DataArray></Points><PointData><DataArray type=\"Float64\" Name=\"radius\" " + radii +
           "</DataArray></PointData></Piece></UnstructuredGrid>" + appended + "</VTKFile>";
  }
  void expect_read(const std::string& text) {
    test::write_text(scratch_.file("p.vtu"), text);
    ImportOptions options;
    options.law.emplace() += test::linear(1.0);
    options.cell = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    const Imported read = read_vtu(scratch_.file("p.vtu"), options);
    const Packing<3>& p = std::get<State<3>>(read.state).packing;
    EXPECT_EQ(p.grains.position[1], Vec<3>(1.5, 2, 2.5));
    EXPECT_EQ(p.grains.radius, radius_);
  }
  void expect_refusal(const std::string& text, const std::string& message) {
    test::write_text(scratch_.file("p.vtu"), text);
    ImportOptions options;
    options.law.emplace() += test::linear(1.0);
    options.cell = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
    EXPECT_THAT([&] { read_vtu(scratch_.file("p.vtu"), options); },
                ThrowsMessage<InputError>(HasSubstr(message)));
  }

  const std::vector<double> x_ = {0, 1, 1, 1.5, 2, 2.5};
  const std::vector<double> radius_ = {0.5, 1.0 / 3.0};
  const std::string ascii_points_ = "format=\"ascii\">0 1 1 1.5 2 2.5";
  test::ScratchDirectory scratch_;
};

TEST_F(VtuEncodings, AllGiveTheSameGrains) {
  expect_read(file(ascii_points_, "format=\"ascii\">0.5 0.3333333333333333"));
  expect_read(file("format=\"binary\">\n" + base64(bytes_of(x_)),
                   "format=\"binary\">" + base64(bytes_of(radius_)) + "\n"));
  const std::string raw = bytes_of(x_) + bytes_of(radius_);
  expect_read(file("format=\"appended\" offset=\"0\">", "format=\"appended\" offset=\"52\">",
                   "<AppendedData encoding=\"raw\">\n_" + raw + "\n</AppendedData>"));
  // VTK encodes the length separately from the data.
  const auto apart = [](const std::string& block) {
    return base64(block.substr(0, 4)) + base64(block.substr(4));
  };
  expect_read(
      file("format=\"binary\">" + apart(bytes_of(x_)), "format=\"binary\">" + apart(bytes_of(radius_))));
  expect_read(file("format=\"appended\" offset=\"0\">", "format=\"appended\" offset=\"72\">",
                   "<AppendedData encoding=\"base64\">_" + apart(bytes_of(x_)) + apart(bytes_of(radius_)) +
                       "</AppendedData>"));
  const std::string first = base64(bytes_of(x_));
  expect_read(
      file("format=\"appended\" offset=\"0\">",
           "format=\"appended\" offset=\"" + std::to_string(first.size()) + "\">",
           "<AppendedData encoding=\"base64\">_" + first + base64(bytes_of(radius_)) + "</AppendedData>"));
}

TEST_F(VtuEncodings, NameWhatIsWrong) {
  expect_refusal(file(ascii_points_, "format=\"ascii\">0.5 0"),
                 "array PointData/radius, point 1: this entry of the array is 0, must be positive");
  expect_refusal(file(ascii_points_, "format=\"ascii\">0.5 nan"), "\"nan\", expected a finite number");
  expect_refusal(file(ascii_points_, "format=\"ascii\">0.5"),
                 "has 1 numbers, expected one for each of 2 points");
  expect_refusal(file("format=\"ascii\">1 2 3", "format=\"ascii\">1"),
                 "has 3 numbers, expected three for each of 2");
  const std::string damaged = base64(bytes_of(radius_)).substr(0, 12);
  expect_refusal(file(ascii_points_, "format=\"binary\">" + damaged),
                 "the array is damaged: it has 9 bytes, but its header says 16");
  const std::string radii = "format=\"ascii\">0.5 1</DataArray><DataArray type=\"Float64\" Name=\"id\" ";
  expect_refusal(file(ascii_points_, radii + "format=\"ascii\">1 2.5"),
                 "array PointData/id, point 1: this entry of the array is 2.5, expected a whole number");
  std::string nameless = file(ascii_points_, "format=\"ascii\">0.5 1");
  nameless.replace(nameless.find("\"radius\""), 8, "\"colour\"");
  expect_refusal(nameless, "no point array radius or diameter; its point arrays are colour");
  std::string compressed = file(ascii_points_, "format=\"ascii\">0.5 1");
  compressed.insert(compressed.find(" byte_order"), " compressor=\"vtkLZ4DataCompressor\"");
  expect_refusal(compressed, "save it without compression");
  expect_refusal("<VTKFile type=\"UnstructuredGrid\"><Piece>", "is not XML");
  expect_refusal("<VTKFile type=\"ImageData\"/>", "is not a VTKFile with an UnstructuredGrid");
}

void expect_refusal(Imported (*read)(const std::string&, const ImportOptions&), const std::string& text,
                    const std::string& message) {
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file("p"), text);
  ImportOptions options;
  options.law.emplace() += test::linear(1.0);
  EXPECT_THAT([&] { read(scratch.file("p"), options); }, ThrowsMessage<InputError>(HasSubstr(message)));
}

TEST(ExtendedXyz, NamesWhatIsWrong) {
  const std::string lattice = "Lattice=\"4 0 0 0 4 0 0 0 4\" ";
  const std::string properties = "Properties=species:S:1:pos:R:3:radius:R:1\n";
  expect_refusal(read_extended_xyz, "one\n", "p:1: a frame begins with \"one\", expected the number of grains");
  expect_refusal(read_extended_xyz, "1\n" + lattice + "\nX 1 1 1 1\n",
                 "p:2: the comment line of the frame has no Properties=");
  expect_refusal(read_extended_xyz, "1\nProperties=species:S:1:pos:R:3\nX 1 1 1\n", "has no column \"radius\"");
  expect_refusal(read_extended_xyz, "2\n" + lattice + properties + "X 1 1 1 1\n", "ends after 1 of 2 grains");
  expect_refusal(read_extended_xyz, "1\n" + lattice + properties + "X 1 1 nan 1\n", "p:3: z = \"nan\"");
  expect_refusal(read_extended_xyz, "1\n" + lattice + properties + "X 1 1 1 0\n",
                 "p:3: radius = 0, must be positive");
  expect_refusal(read_extended_xyz, "1\n" + properties + "X 1 1 1 1\n", "give --cell");
  expect_refusal(read_extended_xyz, "2\nLattice=\"4 0 0 8 0 0 0 0 4\" " + properties + "X 1 1 1 1\nX 2 2 2 1\n",
                 "p:2: the cell is degenerate");
}

TEST(LammpsData, NamesWhatIsWrong) {
  const std::string box = "title\n\n1 atoms\n0 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n";
  const std::string atoms = "\nAtoms # sphere\n\n";
  expect_refusal(read_lammps_data, box + atoms + "1 1 0 1 1 1 1\n", "p:10: diameter = 0, must be positive");
  expect_refusal(read_lammps_data, box + atoms + "1 1 1 1 1 x 1\n",
                 "p:10: y = \"x\", expected a finite number");
  expect_refusal(read_lammps_data, box + atoms + "1 1 1 1 1\n",
                 "p:10: the line has 5 cells, expected id type diameter");
  expect_refusal(read_lammps_data, box + atoms + "1.5 1 1 1 1 1 1\n",
                 "p:10: id = \"1.5\", expected an integer");
  expect_refusal(read_lammps_data, "title\n\n1.5 atoms\n",
                 "p:3: the header says 1.5 atoms, expected a whole number");
  expect_refusal(read_lammps_data, box + "\nAtoms # atomic\n\n1 1 1 1 1\n",
                 "p:8: atom_style atomic has no radii");
  expect_refusal(read_lammps_data, box + atoms, "has 0 atoms in its section Atoms, but its header says 1");
  expect_refusal(read_lammps_data, "title\n\n1 atoms\n" + atoms + "1 1 1 1 1 1 1\n", "has no box");
  expect_refusal(read_lammps_data,
                 "title\n1 atoms\n4 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo zhi\n" + atoms + "1 1 1 1 1 1 1\n",
                 "the cell is degenerate: its side along x is 0");
}

TEST(VtkHdf, SaysThatItDoesNotHoldVelocities) {
  State<2> state = test::packing_with_forces<2>({"p", "p"});
  const auto lost = [&] { return find_export_format("vtkhdf", "").lost(state); };
  EXPECT_TRUE(lost().empty());
  state.packing.grains.velocity[1] = Vec<2>(0.0, 1e-3);
  EXPECT_THAT(lost(), testing::ElementsAre(testing::StartsWith("velocities")));
}

}  // namespace
}  // namespace floc
