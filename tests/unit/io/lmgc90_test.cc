#include "floc/io/lmgc90.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "floc/base/error.h"
#include "floc/packing/ball.h"
#include "support/foreign_packing.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::string three(const char* format, const Eigen::Vector3d& v) {
  return fmt::format(fmt::runtime(format), test::fortran_number(v[0]), test::fortran_number(v[1]),
                     test::fortran_number(v[2]));
}

/// Writes a packing as a directory DATBOX. The bodies are numbered from 1 and have no displacements. Walls are
/// written as bars. The force of a contact acts on its candidate body.
template <int Dim>
void write_datbox(const std::string& folder, const Packing<Dim>& p) {
  std::filesystem::create_directory(folder);
  const char* kind = Dim == 2 ? "RBDY2" : "RBDY3";
  const double density = 2.0;
  std::string bodies = "! File BODIES\n", dof = "! DOF\n\n", contacts = "! Vloc_Rloc\n\n";
  const auto body = [&](int id, double mean_radius, const Eigen::Vector3d& x, const std::string& contactor) {
    const Eigen::Vector3d displacement(0.25, -0.125, Dim == 3 ? 0.5 : 0.0);
    bodies += fmt::format(
        "$bdyty\n {}  {}\n$blmty\n PLAIN      1  behav  PLEXx  avrd= {}  gyrd= 1.0D+00\n$nodty\n NO3xx      1"
        "                {}\n$tacty\n {}\n$$$$$$\n\n",
        kind, id, test::fortran_number(mean_radius), three("coo1={}  coo2={}  coo3={}", x - displacement),
        contactor);
    dof += fmt::format(
        "$bdyty\n {}  {}\n$nodty\n NO3xx      1                {}\n                V(1)= 0.0D+00\n$$$$$$\n",
        kind, id, three("X(1)={}  X(2)={}  X(3)={}", displacement));
  };
  for (int i = 0; i < p.grains.size(); ++i) {
    // radius of a ball with the mass of the grain
    const double mean_radius = std::pow(p.grains.mass[i] / density / Ball<Dim>{1.0}.volume(), 1.0 / Dim);
    body(i + 1, mean_radius, test::in_space<Dim>(p.grains.position[i]),
         fmt::format("{}  1  color  BLEUx  byrd= {}", Dim == 2 ? "DISKx" : "SPHER",
                     test::fortran_number(p.grains.radius[i])));
  }
  for (std::size_t w = 0; w < p.walls.size(); ++w) {
    if (p.walls[w].open) continue;
    const double half = 0.125;
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x[p.walls[w].axis] = p.walls[w].position + p.walls[w].side * half;
    x[2] = p.walls[w].axis == 0 ? 1.5707963267948966 : 0.0;  // a bar across x is rotated by a right angle
    body(p.grains.size() + 1 + static_cast<int>(w), 1.0, x,
         fmt::format("JONCx  1  color  WALLx  ax1 = 1.0D+01  ax2 = {}", test::fortran_number(half)));
  }
  for (const Contact<Dim>& c : p.contacts) {
    const Eigen::Vector3d n = -test::in_space<Dim>(c.normal);
    Eigen::Vector3d t(n[1], -n[0], 0.0), s = Eigen::Vector3d::Zero();
    if (Dim == 3) t = n.unitOrthogonal(), s = t.cross(n);
    const Eigen::Vector3d f = test::in_space<Dim>(test::force_on_first(c));
    contacts += fmt::format(
        "$icdan  DKDKx        1\n cdbdy  numbr  cdtac  numbr\n {0} {1}  DISKx  1  iqsc0  {0} {2}  DISKx  1  "
        "stick\n rlt/H{3} rln/H{4} rls/H{5}\n gapTT{6}\n {7}\n",
        kind, c.i + 1, c.j + 1, test::fortran_number(f.dot(t)), test::fortran_number(f.dot(n)),
        test::fortran_number(f.dot(s)), test::fortran_number(c.gap), three("n(1)={} n(2)={} n(3)={}", n));
    if (Dim == 3) contacts += three(" t(1)={} t(2)={} t(3)={}\n", t) + three(" s(1)={} s(2)={} s(3)={}\n", s);
  }
  // a neighbouring pair without contact; the reader must skip it
  contacts += fmt::format(
      "$icdan  DKDKx        1\n {0} 1  DISKx  1  iqsc0  {0} 3  DISKx  1  noctc\n rlt/H 0.0D+00 rln/H 0.0D+00 "
      "rls/H 0.0D+00\n gapTT 0.1D+00\n n(1)= 1.0D+00 n(2)= 0.0D+00 n(3)= 0.0D+00\n",
      kind);
  test::write_text(folder + "/BODIES.DAT", bodies + "!---\n$bdyty\n");
  test::write_text(folder + "/DOF.INI", dof);
  test::write_text(folder + "/Vloc_Rloc.INI", contacts);
  test::write_text(folder + "/BULK_BEHAV.DAT",
                   three("$gravy\n grv1= {}  grv2={}  grv3= {}\n", test::in_space<Dim>(p.gravity)) +
                       "$behav  lawty\n PLEXx  RIGID   Umas= 2.0D+00\n");
}

template <int Dim>
void expect_read(const test::Ends<Dim>& ends, bool in_cell) {
  SCOPED_TRACE(testing::PrintToString(ends));
  Packing<Dim> written = test::packing_with_forces<Dim>(ends).packing;
  if (!in_cell) written.gravity[1] = -9.81;
  const test::ScratchDirectory scratch;
  write_datbox(scratch.file("DATBOX"), written);
  ImportOptions options;
  if (in_cell)
    for (int a = 0; a < Dim; ++a) {
      options.cell.emplace_back(Dim, 0.0);
      options.cell.back()[static_cast<std::size_t>(a)] = written.cell.matrix(a, a);
    }
  if (in_cell) options.gravity.assign(Dim, 0.0);
  const auto read = test::read_packing<Dim>(scratch.file("DATBOX"), options);
  test::expect_same_packing(read, written, 1e-12);
  EXPECT_EQ(read.gravity, written.gravity);
  test::expect_same_packing(test::read_packing<Dim>(scratch.file("DATBOX/BODIES.DAT"), options), written,
                            1e-12);
}

TEST(Lmgc90, GivesContactsForcesAndBalance) {
  expect_read<2>({"ww", "ww"}, false);
  expect_read<2>({"ww", "wo"}, false);
  expect_read<2>({"oo", "ww"}, false);
  expect_read<2>({"p", "p"}, true);
  expect_read<3>({"p", "p", "p"}, true);
  expect_read<3>({"oo", "oo", "oo"}, false);
}

TEST(Lmgc90, NamesWhatIsWrong) {
  const test::ScratchDirectory scratch;
  const std::string folder = scratch.file("DATBOX");
  const Packing<2> p = test::packing_with_forces<2>({"ww", "ww"}).packing;
  const auto refusal = [&](const std::string& file, const std::string& from, const std::string& to,
                           const std::string& words) {
    write_datbox(folder, p);
    test::change_file(folder + "/" + file, from, to);
    EXPECT_THAT([&] { test::read_packing<2>(folder); }, ThrowsMessage<InputError>(HasSubstr(words))) << from;
  };
  refusal("BODIES.DAT", "DISKx", "POLYG", "BODIES.DAT:9: the line has no \"nb_vertex=\"");
  refusal("BODIES.DAT", "byrd= 5", "byrd= -5", "must be positive");
  refusal("BODIES.DAT", "coo1=", "coo9=", "the line has no \"coo1=\"");
  refusal("BODIES.DAT", "$$$$$$\n\n!---\n$bdyty\n", "", "the file ends within a body");
  refusal("DOF.INI", "RBDY2  1", "RBDY2  77", "DOF.INI:4: body 77 is not in BODIES.DAT");
  refusal("BULK_BEHAV.DAT", "Umas= 2", "Umas=-2", "must be positive");
  refusal("Vloc_Rloc.INI", "rln/H", "rnl/H", "the contact has no force");
  refusal("Vloc_Rloc.INI", "n(1)=", "m(1)=", "the contact has no normal");
}

}  // namespace
}  // namespace floc
