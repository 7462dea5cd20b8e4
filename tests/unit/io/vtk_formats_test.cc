#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "floc/base/error.h"
#include "floc/io/legacy_vtk.h"
#include "floc/io/vtu.h"
#include "support/foreign_packing.h"

/// Tests of points with radii in VTK formats that floc reads but does not write.
namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Expects two grains at (0, 1, 1) and (1.5, 2, 2.5) with radii 0.5 and 0.25.
void expect_grains(const std::string& name, const std::string& text) {
  SCOPED_TRACE(name);
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file(name), text);
  ImportOptions options;
  options.cell = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const Packing<3> p = test::read_packing<3>(scratch.file(name), options);
  ASSERT_EQ(p.grains.size(), 2);
  EXPECT_EQ(p.grains.position[0], Vec<3>(0, 1, 1));
  EXPECT_EQ(p.grains.position[1], Vec<3>(1.5, 2, 2.5));
  EXPECT_EQ(p.grains.radius, (std::vector<double>{0.5, 0.25}));
  EXPECT_EQ(p.grains.name(1), 9);
}

void expect_refusal(const std::string& text, const std::string& words) {
  const test::ScratchDirectory scratch;
  test::write_text(scratch.file("s.vtk"), text);
  ImportOptions options;
  options.cell = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  EXPECT_THAT([&] { test::read_packing<3>(scratch.file("s.vtk"), options); },
              ThrowsMessage<InputError>(HasSubstr(words)));
}

// [0, 1, 1, 1.5, 2, 2.5] as Float64, compressed by zlib 1.2.13 in blocks of 16 bytes.
const std::string kPoints =
    "AwAAABAAAAAAAAAADQAAABIAAAAQAAAAeJxjYEAGH+wBAi8BMHicY2AAgQ/2YIrhhz0ADdYCZ3icY2AAAwcIxeIAAAKYAIU=";
// [0.5, 0.25] as Float32, in one block.
const std::string kRadii = "AQAAAACAAAAIAAAAEAAAAA==eJxjYGCwZ2BosAMAAoEA/g==";

std::string xml(const std::string& kind, const std::string& points, const std::string& radii) {
  return fmt::format(
      "<VTKFile type=\"{0}\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
      "compressor=\"vtkZLibDataCompressor\"><{0}><Piece NumberOfPoints=\"2\"><Points><DataArray "
      "type=\"Float64\" NumberOfComponents=\"3\" format=\"binary\">\n {1}\n</DataArray></Points><PointData>"
      "<DataArray type=\"Float32\" Name=\"Radius\" format=\"binary\">{2}</DataArray><DataArray "
      "type=\"Int32\" Name=\"ID\" format=\"ascii\">4 9</DataArray></PointData></Piece></{0}></VTKFile>",
      kind, points, radii);
}

TEST(VtkXml, MayBeCompressedByZlibAndHoldPolygons) {
  expect_grains("s.vtu", xml("UnstructuredGrid", kPoints, kRadii));
  expect_grains("s.vtp", xml("PolyData", kPoints, kRadii));
  expect_refusal(xml("PolyData", kPoints, kRadii.substr(0, 30)), "the array is damaged");
  expect_refusal(xml("PolyData", kPoints, "AQAAAACAAAAIAAAAEAAAAA==eJxjYGCwZ2BosAMAAoEA/w=="),
                 "data are damaged");
  expect_refusal(xml("PolyData", "//////8=", kRadii), "is damaged");
}

/// Returns the bytes of numbers with the most significant byte first.
template <class T>
std::string big_endian(const std::vector<T>& values) {
  std::string bytes;
  for (const T value : values) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if constexpr (std::endian::native == std::endian::little) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
  }
  return bytes;
}

const std::string kAscii =
    "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 1 1 1.5\n2 2.5\nVERTICES 2 "
    "4\n1 0\n1 1\n"
    "POINT_DATA 2\nVECTORS v double\n0 0 0 1 2 3\nSCALARS radius float 1\nLOOKUP_TABLE default\n0.5 "
    "0.25\nFIELD data 1\n"
    "ID 1 2 int\n4 9\n";

TEST(LegacyVtk, IsAsciiOrBinary) {
  expect_grains("s.vtk", kAscii);
  expect_grains(
      "s.vtk",
      "# vtk DataFile Version 3.0\ntitle\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 double\n" +
          big_endian<double>({0, 1, 1, 1.5, 2, 2.5}) + "\nCELLS 2 4\n" +
          big_endian<std::int32_t>({1, 0, 1, 1}) + "\nCELL_TYPES 2\n" + big_endian<std::int32_t>({1, 1}) +
          "\nPOINT_DATA 2\nSCALARS Radius float\nLOOKUP_TABLE default\n" + big_endian<float>({0.5F, 0.25F}) +
          "\nFIELD data 1\nid 1 2 vtktypeint64\n" + big_endian<std::int64_t>({4, 9}) + "\n");
  expect_grains(
      "s.vtk",
      "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 1 1 1.5 2 2.5\nVERTICES 3 "
      "2\n"
      "OFFSETS vtktypeint64\n0 1 2\nCONNECTIVITY vtktypeint64\n0 1\n\nPOINT_DATA 2\nFIELD FieldData 2\n"
      "radius 1 2 double\n0.5 0.25\nMETADATA\nINFORMATION 0\n\nid 1 2 int\n4 9\n");
}

TEST(LegacyVtk, NamesWhatIsWrong) {
  const auto refusal = [&](const std::string& from, const std::string& to, const std::string& words) {
    std::string text = kAscii;
    expect_refusal(text.replace(text.find(from), from.size(), to), words);
  };
  refusal("ASCII", "TEXT", "the third line is neither ASCII nor BINARY");
  refusal("POLYDATA", "STRUCTURED_GRID", "the data set is STRUCTURED_GRID, expected POLYDATA");
  refusal("POINTS 2", "POINTS -2", "expected a count");
  refusal("POINTS 2", "POINTS 999999999", "the file ends within POINTS");
  refusal("1.5", "x", "POINTS has \"x\", expected a finite number");
  refusal("radius", "size", "the file has no point array radius or diameter; its point arrays are v, size, ID");
  refusal("0.5 0.25", "0.5", "radius has \"FIELD\", expected a finite number");
  refusal("0.25", "-0.25", "must be positive");
}

}  // namespace
}  // namespace floc
