#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "floc/io/csv.h"
#include "floc/io/state_file.h"
#include "floc/packing/equilibrium.h"
#include "support/foreign_packing.h"
#include "support/places.h"
#include "support/small_run.h"
#include "support/states.h"

namespace floc::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Export : public SmallRun {
 protected:
  /// Exports the tables of a state, then recreates the state with the command that `floc export` prints.
  static void round_trip(const std::string& state, const std::string& again) {
    const Outcome out = floc("export " + state + " --grains g.csv --contacts c.csv");
    ASSERT_EQ(out.code, 0) << out.err;
    const std::size_t at = out.err.find("convert g.csv");
    ASSERT_NE(at, std::string::npos) << out.err;
    std::string command = out.err.substr(at, out.err.find('\n', at) - at);
    command.replace(command.find("STATE.h5"), 8, again);
    const Outcome in = floc(command + " --overwrite");
    ASSERT_EQ(in.code, 0) << command << "\n" << in.err;
  }
};

template <int Dim>
void expect_equal(const Packing<Dim>& a, const Packing<Dim>& b) {
  EXPECT_EQ(a.cell.matrix, b.cell.matrix);
  EXPECT_EQ(a.grains.radius, b.grains.radius);
  EXPECT_EQ(a.grains.mass, b.grains.mass);
  EXPECT_EQ(a.grains.position_low.empty(), b.grains.position_low.empty());
  for (int i = 0; i < a.grains.size(); ++i) {
    EXPECT_EQ(a.grains.position[i], b.grains.position[i]) << i;
    if (a.grains.position_low.empty()) continue;
    EXPECT_EQ(a.grains.position_low[i], b.grains.position_low[i]) << i;
  }
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t k = 0; k < a.contacts.size(); ++k) {
    const Contact<Dim>&p = a.contacts[k], &q = b.contacts[k];
    EXPECT_EQ(p.i, q.i);
    EXPECT_EQ(p.j, q.j);
    EXPECT_EQ(p.image, q.image);
    EXPECT_EQ(p.gap, q.gap);
    EXPECT_EQ(p.distant, q.distant);
    EXPECT_EQ(p.normal_force, q.normal_force);
    EXPECT_EQ(p.shear_force, q.shear_force);
    EXPECT_EQ(p.rolling_moment, q.rolling_moment);
    EXPECT_EQ(p.kn, q.kn);
    EXPECT_EQ(p.kt, q.kt);
    EXPECT_EQ(p.kr, q.kr);
    EXPECT_EQ(p.ktw, q.ktw);
    EXPECT_EQ(p.bonded, q.bonded);
  }
  EXPECT_EQ(a.walls, b.walls);
}

TEST_F(Export, AndConvertGiveEveryNumberBack) {
  for (const std::string state : {"run/state-0001.h5", "run/state-0005.h5", "run/state-0008.h5"}) {
    round_trip(state, "again.h5");
    expect_equal(std::get<State<2>>(read_state(file(state))).packing,
                 std::get<State<2>>(read_state(file("again.h5"))).packing);
    for (const char* command : {"moduli ", "network "}) {
      const std::string columns =
          " --columns n_contacts,n_distant,P,phi,z,B,B_S,G,n_at_cap,moment_2,indeterminacy";
      EXPECT_EQ(floc(command + std::string("again.h5") + columns).out, floc(command + state + columns).out)
          << state;
    }
  }
}

TEST_F(Export, OfSpheresGivesThemBackToo) {
  write_state(file("spheres.h5"), busy_state<3>());
  round_trip("spheres.h5", "again.h5");
  expect_equal(std::get<State<3>>(read_state(file("spheres.h5"))).packing,
               std::get<State<3>>(read_state(file("again.h5"))).packing);
}

/// Bonds hold surfaces that touch, in tension and in compression, and keep the stiffnesses and strengths of their own.
TEST_F(Export, OfBondsThatTouchAndPullGivesThemBack) {
  for (const int dim : {2, 3}) {
    write_text(file("g.csv"), dim == 3 ? "x,y,z,radius\n0,0,0,0.5\n0.99,0,0,0.5\n1.98,0,0,0.5\n3.1,0,0,0.5\n"
                                       : "x,y,radius\n0,0,0.5\n0.99,0,0.5\n1.98,0,0.5\n3.1,0,0.5\n");
    write_text(file("b.csv"),
               "id1,id2,normal_force,kn,kt,kr,ktw,tensile_strength\n0,1,-2,70,50,3,2,30\n"
               "1,2,4,70,50,3,2,0\n2,3,-1,70,50,3,2,20\n");
    const std::string cell = dim == 3 ? "--cell '9,0,0;0,9,0;0,0,9'" : "--cell '9,0;0,9'";
    const Outcome made = floc(
        "convert g.csv bonds.h5 --overwrite --bonds b.csv --law normal.stiffness=1000 "
        "--tolerance 1e9 " +
        cell);
    ASSERT_EQ(made.code, 0) << made.err;
    round_trip("bonds.h5", "again.h5");
    const AnyState before = read_state(file("bonds.h5")), after = read_state(file("again.h5"));
    std::visit(
        [&](const auto& state) {
          using State = std::decay_t<decltype(state)>;
          expect_equal(state.packing, std::get<State>(after).packing);
          EXPECT_EQ(state.bond_strengths.size(), std::get<State>(after).bond_strengths.size());
        },
        before);
  }
}

/// Forces move a lid or the walls under a load. The moduli depend on which walls are free to move.
template <int Dim>
State<Dim> with_moving_walls(const Ends<Dim>& ends, const std::vector<std::size_t>& moving) {
  State<Dim> state = packing_with_forces<Dim>(ends);
  for (const std::size_t w : moving) state.packing.walls[w].mass = 2.5 + static_cast<double>(w) / 3.0;
  state.tolerance.force = 1e9;
  state.target_stress.setConstant(1.0);
  measure(state);
  return state;
}

TEST_F(Export, GivesBackTheMassesOfWallsThatForcesMove) {
  for (const std::vector<std::size_t>& moving : {std::vector<std::size_t>{}, {0}, {3}, {1, 2}, {0, 1, 2, 3}}) {
    SCOPED_TRACE(testing::PrintToString(moving));
    const State<2> disks = with_moving_walls<2>({"ww", "ww"}, moving);
    write_state(file("walls.h5"), disks);
    round_trip("walls.h5", "again.h5");
    EXPECT_EQ(std::get<State<2>>(read_state(file("again.h5"))).packing.walls, disks.packing.walls);
    const State<3> spheres = with_moving_walls<3>({"ww", "p", "ww"}, moving);
    write_state(file("walls.h5"), spheres);
    round_trip("walls.h5", "again.h5");
    EXPECT_EQ(std::get<State<3>>(read_state(file("again.h5"))).packing.walls, spheres.packing.walls);
  }
}

TEST_F(Export, NeedsAFileToWriteAndAState) {
  EXPECT_THAT(floc("export run/state-0001.h5").err,
              HasSubstr("no output file is named: give --grains FILE, --contacts FILE or both"));
  const Outcome directory = floc("export run --grains g.csv");
  EXPECT_EQ(directory.code, 4);
  EXPECT_THAT(directory.err, HasSubstr("run: this is a directory, but a file is expected"));
}

TEST_F(Export, RollingStiffnessesOfAContactAreThoseListed) {
  const std::string kLaw =
      "--law normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800,rolling.coefficient=0.1,"
      "rolling.stiffness=3";
  write_text(file("two.csv"), "x,y,radius\n0,0,0.5\n0.9,0,0.5\n");
  write_text(file("one.csv"), "id1,id2,normal_force,rolling_moment,kn,kt,kr\n0,1,100,0.5,900,700,2\n");
  const Outcome o = floc("convert two.csv two.h5 --overwrite --cell '5,0;0,5' --contacts one.csv " + kLaw);
  ASSERT_EQ(o.code, 0) << o.err;
  const auto contact = std::get<State<2>>(read_state(file("two.h5"))).packing.contacts.at(0);
  EXPECT_EQ(contact.kr, 2.0);
  EXPECT_EQ(contact.rolling_moment[0], 0.5);
  const Outcome none = floc(
      "convert two.csv two.h5 --overwrite --cell '5,0;0,5' --contacts one.csv --law normal.stiffness=1000");
  EXPECT_EQ(none.code, 4);
  EXPECT_THAT(none.err, HasSubstr("one.csv:2"));
}

/// Contacts in the format of LAMMPS can be read with grains in another format, and contacts in another format with
/// grains in the format of LAMMPS.
TEST_F(Export, AnyContactFileGoesWithAnyGrainFile) {
  const std::string lammps = source_directory() + "/data/packings/lammps/";
  const std::string law = " --law normal.stiffness=1000,friction.coefficient=0.5,friction.stiffness=800";
  const std::string columns =
      " --contact-columns "
      "'id1=c_pair[1],id2=c_pair[2],force1=c_force[1],force2=c_force[2],shear_force1=c_force[4],"
      "shear_force2=c_force[5]'";
  ASSERT_EQ(
      floc("convert " + lammps + "disks.dump l.h5" + law + " --contacts " + lammps + "disks.contacts" + columns)
          .code,
      0);
  ASSERT_EQ(floc("export l.h5 --grains lg.csv --contacts lc.csv").code, 0);
  const std::string cell = json::parse(floc("info l.h5 --format json").out).at(0).at("cell");
  const std::string wanted = " --columns n_contacts,B,G";
  const std::string moduli = floc("moduli l.h5" + wanted).out;
  // Grains keep the ids of the dump.
  ASSERT_EQ(floc("convert " + lammps + "disks.dump a.h5" + law + " --contacts lc.csv").code, 0);
  EXPECT_EQ(floc("moduli a.h5" + wanted).out, floc("moduli l.h5" + wanted).out);
  // The image indices in lc.csv refer to positions inside the cell, but positions in the dump may be outside. The list
  // made here has no image indices, so that the reader takes the nearest images.
  std::string shifted = "id1,id2,normal_force,shear_force1,shear_force2\n";
  const CsvTable contacts = CsvTable::read(file("lc.csv"));
  for (int r = 0; r < contacts.n_rows(); ++r) {
    const auto text = [&](const char* name) { return contacts.text(r, contacts.column(name)); };
    shifted += fmt::format("{},{},{},{},{}\n", contacts.integer(r, 0), contacts.integer(r, 1),
                           text("normal_force"), text("shear_force1"), text("shear_force2"));
  }
  write_text(file("ids.csv"), shifted);
  ASSERT_EQ(floc("convert " + lammps + "disks.dump b.h5" + law + " --contacts ids.csv").code, 0);
  EXPECT_EQ(floc("moduli b.h5" + wanted).out, moduli);
  std::string grains = "id,x,y,radius,mass\n";
  const CsvTable of_export = CsvTable::read(file("lg.csv"));
  for (int r = 0; r < of_export.n_rows(); ++r)
    grains +=
        fmt::format("{},{},{},{},{}\n", r + 1, of_export.text(r, of_export.column("x")),
                    of_export.text(r, of_export.column("y")), of_export.text(r, of_export.column("radius")),
                    of_export.text(r, of_export.column("mass")));
  write_text(file("grains.csv"), grains);
  const Outcome dump_beside_csv = floc("convert grains.csv c.h5 --cell '" + cell + "'" + law + " --contacts " +
                                       lammps + "disks.contacts" + columns);
  ASSERT_EQ(dump_beside_csv.code, 0) << dump_beside_csv.err;
  EXPECT_EQ(floc("moduli c.h5" + wanted).out, moduli);
}

}  // namespace
}  // namespace floc::test
