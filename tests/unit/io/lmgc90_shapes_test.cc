#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "floc/base/error.h"
#include "floc/base/read_text.h"
#include "floc/io/law_text.h"
#include "floc/io/lmgc90.h"
#include "support/angular_packing.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Writes the three components of a vector, each after its key: "coo{}=" gives coo1=, coo2= and coo3=.
std::string keyed(const std::string& key, const Eigen::Vector3d& v) {
  std::string text;
  for (int a = 0; a < 3; ++a) text += " " + fmt::format(fmt::runtime(key), a + 1) + test::fortran_number(v[a]);
  return text + "\n";
}

std::string contactor(const Shape<2>& shape, double scale) {
  if (shape.is_round())
    return fmt::format(" DISKx 1 color BLEUx byrd={}\n", test::fortran_number(scale * shape.rounding));
  std::string text = fmt::format(" POLYG 1 color BLEUx nb_vertex= {} byrd= 1.0D+00\n", shape.n_vertices());
  for (const Vec<2>& v : shape.vertices) text += keyed("coo{}=", scale * test::in_space<2>(v));
  return text;
}

std::string contactor(const Shape<3>& shape, double scale) {
  if (shape.is_round())
    return fmt::format(" SPHER 1 color BLEUx byrd={}\n", test::fortran_number(scale * shape.rounding));
  std::string faces;
  int n_faces = 0;
  for (int f = 0; f < shape.n_faces(); ++f)
    for (std::size_t k = 2; k < shape.loop(f).size(); ++k, ++n_faces)
      faces += fmt::format(" ver1= {} ver2= {} ver3= {}\n", shape.loop(f)[0] + 1, shape.loop(f)[k - 1] + 1,
                           shape.loop(f)[k] + 1);
  std::string text =
      fmt::format(" POLYR 1 color BLEUx nb_vertex= {} nb_faces= {}\n", shape.n_vertices(), n_faces);
  for (const Vec<3>& v : shape.vertices) text += keyed("coo{}=", scale * v);
  return text + faces;
}

/// Writes a packing of disks and polygons, or of spheres and polyhedra, as a directory DATBOX. The file DOF.INI
/// contains the displacements and axes of the bodies. Walls are written as bars or plates.
template <int Dim>
void write_datbox_of_shapes(const std::string& folder, const Packing<Dim>& p) {
  std::filesystem::create_directory(folder);
  const char* kind = Dim == 2 ? "RBDY2" : "RBDY3";
  const double density = 2.0;
  std::string bodies, dof, contacts;
  const auto body = [&](int id, double mean_radius, Eigen::Vector3d x, const Eigen::Matrix3d& axes,
                        const std::string& text) {
    Eigen::Vector3d moved(0.25, -0.125, 0.5);
    if (Dim == 2) moved[2] = x[2], x[2] = 0.0, x.head<2>() -= moved.head<2>();
    if (Dim == 3) x -= moved;
    bodies += fmt::format(
        "$bdyty\n {} {}\n$blmty\n PLAIN 1 behav PLEXx avrd= {}\n{}$nodty\n NO3xx 1{}$tacty\n{}$$$$$$\n", kind,
        id, test::fortran_number(mean_radius), Dim == 3 ? keyed("I{}  =", Eigen::Vector3d::Ones()) : "",
        keyed("coo{}=", x), text);
    dof += fmt::format("$bdyty\n {} {}\n$nodty\n NO3xx 1{}", kind, id, keyed("X({})=", moved));
    if (Dim == 3)
      dof += keyed("a({})=", axes.col(0)) + keyed("b({})=", axes.col(1)) + keyed("g({})=", axes.col(2));
    dof += "$$$$$$\n";
  };
  for (int i = 0; i < p.grains.size(); ++i) {
    const double mean_radius = std::pow(p.grains.mass[i] / density / Ball<Dim>{1.0}.volume(), 1.0 / Dim);
    Eigen::Vector3d x = test::in_space<Dim>(p.grains.position[i]);
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    if constexpr (Dim == 2)
      x[2] = p.grains.orientation[i];
    else
      axes = p.grains.orientation[i].toRotationMatrix();
    body(i + 1, mean_radius, x, axes, contactor((*p.grains.shapes)[p.grains.shape[i]], p.grains.scale[i]));
  }
  for (std::size_t w = 0; w < p.walls.size(); ++w) {
    if (p.walls[w].open) continue;
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x[p.walls[w].axis] = p.walls[w].position + p.walls[w].side * 0.125;
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    if (Dim == 2)
      x[2] = p.walls[w].axis == 0 ? -0.5 * std::numbers::pi : std::numbers::pi;
    else
      for (int a = 0; a < 3; ++a) axes.col(a) = Eigen::Vector3d::Unit((p.walls[w].axis + a + 1) % 3);
    body(p.grains.size() + 1 + static_cast<int>(w), 1.0, x, axes,
         Dim == 2 ? " JONCx 1 color WALLx ax1= 1.0D+01 ax2= 0.125D+00\n"
                  : " PLANx 1 color WALLx axe1= 1.0D+01 axe2= 1.0D+01 axe3= 0.125D+00\n");
  }
  for (const Contact<Dim>& c : p.contacts) {
    const Eigen::Vector3d n = -test::in_space<Dim>(c.normal);
    Eigen::Vector3d t(n[1], -n[0], 0.0), s = Eigen::Vector3d::Zero();
    if (Dim == 3) t = n.unitOrthogonal(), s = t.cross(n);
    const Eigen::Vector3d f = test::in_space<Dim>(test::force_on_first(c));
    contacts += fmt::format(
        "$icdan PLPLx 1\n cdbdy numbr\n {0} {1} POLYG 1 iqsc0 {0} {2} POLYG 1 stick\n rlt/H{3} rln/H{4} "
        "rls/H{5}\n "
        "gapTT{6}\n",
        kind, c.i + 1, c.j + 1, test::fortran_number(f.dot(t)), test::fortran_number(f.dot(n)),
        test::fortran_number(f.dot(s)), test::fortran_number(c.gap));
    contacts += keyed("n({})=", n);
    if (Dim == 3) contacts += keyed("t({})=", t) + keyed("s({})=", s);
    contacts += keyed("coo{}=", test::in_space<Dim>(p.grains.position[c.i] + c.arm_i));
  }
  test::write_text(folder + "/BODIES.DAT", bodies);
  test::write_text(folder + "/DOF.INI", dof);
  test::write_text(folder + "/Vloc_Rloc.INI", contacts);
  test::write_text(folder + "/BULK_BEHAV.DAT", "$behav lawty\n PLEXx RIGID Umas= 2.0D+00\n");
}

/// Returns shapes without rounding, and a disk or sphere.
template <int Dim>
std::vector<Shape<Dim>> sharp_shapes() {
  std::vector<Shape<Dim>> shapes = cut_shapes<Dim>({}, 3, 0.0, 7);
  shapes.push_back(round_shape<Dim>(0.5));
  return shapes;
}

template <int Dim>
void expect_shapes_read(const test::Ends<Dim>& ends) {
  SCOPED_TRACE(testing::PrintToString(ends));
  const Packing<Dim> written = test::angular_packing_with_forces<Dim>(ends, sharp_shapes<Dim>()).packing;
  ASSERT_GT(written.contacts.size(), 5u);
  const test::ScratchDirectory scratch;
  write_datbox_of_shapes(scratch.file("DATBOX"), written);
  ImportOptions options;
  for (int a = 0; a < Dim && ends[0] == "p"; ++a) {
    options.cell.emplace_back(Dim, 0.0);
    options.cell.back()[static_cast<std::size_t>(a)] = written.cell.matrix(a, a);
  }
  Packing<Dim> expected = written;
  for (Contact<Dim>& c : expected.contacts)  // files of LMGC90 do not distinguish edges from vertices
    if (c.type == ContactType::kEdgeEdge) c.type = ContactType::kVertexFace;
  test::expect_same_angular_packing(test::read_packing<Dim>(scratch.file("DATBOX"), options), expected, 1e-12);
}

TEST(Lmgc90Shapes, GivePolygonsContactsAndForces) {
  expect_shapes_read<2>({"p", "p"});
  expect_shapes_read<2>({"ww", "ww"});
  expect_shapes_read<2>({"oo", "wo"});
}

TEST(Lmgc90Shapes, GivePolyhedraContactsAndForces) {
  expect_shapes_read<3>({"p", "p", "p"});
  expect_shapes_read<3>({"ww", "ww", "ww"});
}

TEST(Lmgc90Shapes, NameWhatIsWrong) {
  const test::ScratchDirectory scratch;
  const std::string folder = scratch.file("DATBOX");
  const Packing<3> p = test::angular_packing_with_forces<3>({"ww", "ww", "ww"}, sharp_shapes<3>()).packing;
  const auto refusal = [&](const std::string& file, const std::string& from, const std::string& to,
                           const std::string& words) {
    write_datbox_of_shapes(folder, p);
    test::change_file(folder + "/" + file, from, to);
    EXPECT_THAT([&] { test::read_packing<3>(folder); }, ThrowsMessage<InputError>(HasSubstr(words))) << from;
  };
  refusal("BODIES.DAT", "nb_vertex= ", "nb_vertex= 9", "BODIES.DAT:2: body 1 has ");
  refusal("BODIES.DAT", "nb_vertex= ", "nb_vertex= -", "expected a whole number from 0");
  refusal("BODIES.DAT", "nb_faces= ", "nb_faces= 1", "faces, expected");
  refusal("BODIES.DAT", "ver1= 1", "ver1= 0", "expected the number of a vertex, from 1");
  refusal("BODIES.DAT", "ver2= 2", "ver2= 999", "expected a whole number from 0");
  refusal("BODIES.DAT", "I1  =1", "I1  =0", "has no moments of inertia");
  refusal("BODIES.DAT", "POLYR", "CYLND", "body 1 has the contactor CYLND, expected a disk");
  refusal("DOF.INI", "a(1)=", "a(1)= 7", "the axes of body 1 are not orthonormal");
  refusal("Vloc_Rloc.INI", " coo1=", " xxx1=", "the contact has no contact point");
  refusal("Vloc_Rloc.INI", " coo1=", " coo1= 9", "");
}

TEST(Lmgc90Shapes, OfCutFilesAreRefused) {
  const test::ScratchDirectory scratch;
  const std::string folder = scratch.file("DATBOX");
  const Packing<3> p = test::angular_packing_with_forces<3>({"ww", "ww", "ww"}, sharp_shapes<3>()).packing;
  const auto refusal = [&](const std::string& file, std::size_t n_left_out, const std::string& words) {
    write_datbox_of_shapes(folder, p);
    const std::string text = read_text(folder + "/" + file);
    test::write_text(folder + "/" + file, text.substr(0, text.size() - n_left_out));
    EXPECT_THAT([&] { test::read_packing<3>(folder); }, ThrowsMessage<InputError>(HasSubstr(words))) << words;
  };
  refusal("Vloc_Rloc.INI", 3, "the file ends within a contact: expected a line feed after the last line");
  write_datbox_of_shapes(folder, p);
  const std::string contacts = read_text(folder + "/Vloc_Rloc.INI");
  refusal("Vloc_Rloc.INI", contacts.size() - contacts.rfind(" coo1="),
          "the file ends within a contact, which begins at ");
  refusal("DOF.INI", 8, "the file ends within a body: expected a line $$$$$$");
  const auto changed = [&](const std::string& text, const std::string& words) {
    write_datbox_of_shapes(folder, p);
    test::write_text(folder + "/DOF.INI", text);
    EXPECT_THAT([&] { test::read_packing<3>(folder); }, ThrowsMessage<InputError>(HasSubstr(words))) << words;
  };
  write_datbox_of_shapes(folder, p);
  const std::string whole = read_text(folder + "/DOF.INI");
  const std::size_t second = whole.find("$bdyty", 1);
  changed(whole.substr(second), "DOF.INI: the file gives no displacement (X(1)=) of body 1");
  changed(whole + whole.substr(0, second), "body 1 is displaced a second time, expected each body once");
}

TEST(Lmgc90Shapes, HaveNormalsOfLengthOneInTheRightDirection) {
  const test::ScratchDirectory scratch;
  const std::string folder = scratch.file("DATBOX");
  const Packing<2> p = test::angular_packing_with_forces<2>({"ww", "ww"}, sharp_shapes<2>()).packing;
  const auto refusal = [&](double factor, const std::string& words) {
    write_datbox_of_shapes(folder, p);
    const std::string line = keyed("n({})=", -test::in_space<2>(p.contacts[0].normal));
    test::change_file(folder + "/Vloc_Rloc.INI", line,
                      keyed("n({})=", -factor * test::in_space<2>(p.contacts[0].normal)));
    EXPECT_THAT([&] { test::read_packing<2>(folder); }, ThrowsMessage<InputError>(HasSubstr(words))) << factor;
  };
  refusal(1.5, "Vloc_Rloc.INI:1: the normal of the contact has the length 1.5, expected a unit vector");
  refusal(-1.0, "Vloc_Rloc.INI:1: the normal of the contact of grain");
}

TEST(Lmgc90Shapes, SayThatTheConvexHullIsTakenAndMassesAreMissing) {
  const test::ScratchDirectory scratch;
  const std::string folder = scratch.file("DATBOX");
  write_datbox_of_shapes(folder, test::angular_packing_with_forces<2>({"ww", "ww"}, sharp_shapes<2>()).packing);
  ImportOptions options;
  options.law = parse_law("law", test::kForeignLaw);
  EXPECT_THAT(read_lmgc90(folder, options).remarks, testing::IsEmpty());
  std::string text = read_text(folder + "/BODIES.DAT");
  const std::size_t at = text.find("nb_vertex= ") + 11, end = text.find(' ', at),
                    line = text.find('\n', at) + 1;
  const int n = std::stoi(text.substr(at, end - at));
  text.insert(line, " coo1= 0.0D+00 coo2= 0.0D+00\n");
  text.replace(at, end - at, std::to_string(n + 1));
  test::write_text(folder + "/BODIES.DAT", text);
  std::filesystem::remove(folder + "/BULK_BEHAV.DAT");
  EXPECT_THAT(
      read_lmgc90(folder, options).remarks,
      testing::IsSupersetOf({HasSubstr(fmt::format("BODIES.DAT:2: 1 of {} points are not vertices", n + 1)),
                             HasSubstr("BULK_BEHAV.DAT, which gives densities and gravity")}));
}

}  // namespace
}  // namespace floc
