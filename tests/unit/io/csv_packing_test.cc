#include "floc/io/csv_packing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <sstream>

#include "floc/base/error.h"
#include "floc/io/law_text.h"
#include "support/contact_laws.h"
#include "support/scratch_directory.h"
#include "support/springs.h"

namespace floc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

/// Fixture: three disks in a skewed cell. Its lattice vectors are (4, 0) and (1, 3). Disks 0 and 1 overlap by 0.1
/// across a side of the cell, and disks 1 and 2 by 0.2 inside the cell.
class CsvPacking : public testing::Test {
 protected:
  CsvPacking() {
    options_.law = parse_law("",
                             "normal.stiffness=10,friction.coefficient=0.5,friction.stiffness=4,"
                             "rolling.coefficient=0.1,rolling.stiffness=2");
    options_.cell = {{4, 0}, {1, 3}};
    grains("id,x,y,radius\n7,4.4,1,0.5\n3,3.5,1,0.5\n5,2.7,1,0.5\n");
  }

  void grains(const std::string& text) { std::ofstream(scratch_.file("g.csv")) << text; }
  void contacts(const std::string& text) {
    options_.contacts = scratch_.file("c.csv");
    std::ofstream(options_.contacts) << text;
  }
  template <int Dim = 2>
  Packing<Dim> read() {
    return std::get<State<Dim>>(read_csv_packing(scratch_.file("g.csv"), options_).state).packing;
  }
  auto refusal() {
    return [this] { read_csv_packing(scratch_.file("g.csv"), options_); };
  }

  test::ScratchDirectory scratch_;
  ImportOptions options_;
};

TEST_F(CsvPacking, PutsGrainsIntoTheCellWithUnitMassAtUnitDiameter) {
  const Packing<2> p = read();
  EXPECT_NEAR(p.grains.position[0][0], 0.4, 1e-15);
  EXPECT_EQ(p.grains.position[1], Vec<2>(3.5, 1.0));
  EXPECT_EQ(p.grains.mass[2], 1.0);
  EXPECT_TRUE(p.contacts.empty());
}

TEST_F(CsvPacking, ConvertsLengthsToTheUnitOfXOrToMetres) {
  grains("X (cm),Y (cm),diameter [mm]\n1,0.5,5\n2.5,0.5,2.5\n");
  EXPECT_EQ(read().grains.radius, (std::vector<double>{0.25, 0.125}));
  EXPECT_EQ(read().grains.position[1], Vec<2>(2.5, 0.5));
  options_.units = "SI";
  EXPECT_NEAR(read().grains.position[1][0], 0.025, 1e-17);
  EXPECT_NEAR(read().grains.radius[0], 0.0025, 1e-17);
  grains("x [cm],y,radius [cm]\n1,1,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("column y: found no unit here")));
  grains("x [m],y [m],radius [m],mass [g]\n1,1,1,1\n");
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("column \"mass [g]\" is in g: expected kg, the unit of SI")));
}

TEST_F(CsvPacking, SaysHowItsTablesAreWritten) {
  grains("id;x;y;radius\n7;4,4;1;0,5\n3;3,5;1;0,5\n5;2,7;1;0,5\n");
  contacts("# id1 id2 normal_force\n7 3 1\n");
  const std::vector<std::string> remarks = read_csv_packing(scratch_.file("g.csv"), options_).remarks;
  EXPECT_THAT(remarks,
              testing::IsSupersetOf({std::string("read 3 rows: separated by semicolons, decimal commas"),
                                     scratch_.file("c.csv") + ": read 1 row: separated by blanks"}));
}

TEST_F(CsvPacking, RefusesForcesInSeveralUnits) {
  contacts("id1,id2,force1 [N],force2 [kN]\n7,3,1,0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("column \"force2 [kN]\" is in kN: expected N")));
  options_.units = "SI";
  contacts("id1,id2,normal_force [kN]\n7,3,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("is in kN: expected N, the unit of SI")));
}

TEST_F(CsvPacking, TakesColumnsByTheNamesGiven) {
  grains("D;Y;X;M\n2;1;0.5;3\n");
  options_.columns = {{"x", "X"}, {"y", "Y"}, {"diameter", "D"}, {"mass", "M"}};
  const Packing<2> p = read();
  EXPECT_EQ(p.grains.position[0], Vec<2>(0.5, 1.0));
  EXPECT_EQ(p.grains.radius[0], 1.0);
  EXPECT_EQ(p.grains.mass[0], 3.0);
}

TEST_F(CsvPacking, HasThreeDimensionsWhenTheCellHasThreeVectors) {
  grains("x,y,z,radius\n0.5,0.6,4.7,1\n");
  options_.cell = {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}};
  const Packing<3> p = read<3>();
  EXPECT_NEAR((p.grains.position[0] - Vec<3>(0.5, 0.6, 0.7)).norm(), 0.0, 1e-15);
  EXPECT_EQ(p.grains.mass[0], 8.0);
}

TEST_F(CsvPacking, FindsTheNearestImageOfListedContacts) {
  contacts("id1,id2\n7,3\n3,5\n");
  const Packing<2> p = read();
  ASSERT_EQ(p.contacts.size(), 2u);
  EXPECT_EQ(std::tie(p.contacts[0].i, p.contacts[0].j), std::make_tuple(0, 1));
  EXPECT_EQ(p.contacts[0].image, (Vec<2, int>(-1, 0)));
  EXPECT_NEAR(p.contacts[0].gap, -0.1, 1e-15);
  EXPECT_NEAR(p.contacts[0].normal_force, 1.0, 1e-14);
  EXPECT_NEAR(p.contacts[1].gap, -0.2, 1e-15);
}

TEST_F(CsvPacking, TakesImagesThatReferToThePositionsOfTheFile) {
  contacts("id1,id2,image1,image2\n7,3,0,0\n");
  const Packing<2> p = read();
  EXPECT_EQ(p.contacts[0].image, (Vec<2, int>(-1, 0)));
  EXPECT_NEAR(p.contacts[0].gap, -0.1, 1e-15);
}

TEST_F(CsvPacking, KeepsForcesOfTheListAndStretchesTheSpringsToThem) {
  // The list names grain 5 first: the listed force of +0.3 acts on grain 5, and the opposite force on grain 3.
  contacts("id1,id2,normal_force,shear_force1,shear_force2,rolling_moment\n5,3,2.5,0,0.3,0.04\n");
  const Contact<2> c = read().contacts[0];
  EXPECT_EQ(std::tie(c.i, c.j), std::make_tuple(1, 2));
  EXPECT_NEAR(c.normal[0], -1.0, 1e-15);
  EXPECT_EQ(c.normal_force, 2.5);
  EXPECT_NEAR(c.shear_force[1], -0.3, 1e-15);
  // The normal is along -x, so the tangent is along -y. Along this tangent, the elongation of the spring is F/K_T =
  // 0.3/4.
  EXPECT_NEAR(test::shear_spring(c)[0], 0.075, 1e-15);
  EXPECT_NEAR(c.rolling_moment[0], -0.04, 1e-15);
  EXPECT_NEAR(test::rolling_spring(c)[0], 0.02, 1e-15);
  EXPECT_FALSE(c.sliding);
  EXPECT_EQ(std::tie(c.kn, c.kt, c.kr), std::make_tuple(10.0, 4.0, 2.0));
}

TEST_F(CsvPacking, StretchesTheTwistingSpringToTheMomentOfTheList) {
  grains("id,x,y,z,radius\n3,3.5,1,1,0.5\n5,2.6,1,1,0.5\n");
  contacts("id1,id2,normal_force,twisting_moment\n5,3,2.5,0.04\n");
  options_.cell = {{8, 0, 0}, {0, 8, 0}, {0, 0, 8}};
  *options_.law += test::twisting_spring(0.5, 4.0);
  const Contact<3> c = read<3>().contacts[0];
  EXPECT_EQ(std::tie(c.i, c.j, c.twisting_moment, c.ktw), std::make_tuple(0, 1, 0.04, 4.0));
  EXPECT_DOUBLE_EQ(c.history[HistoryLayout<3>::kTwisting], -0.01);
  *options_.law += test::without("twisting");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("the law has no twisting")));
}

std::string upper(std::string name) {
  for (char& c : name) c = static_cast<char>(std::toupper(c));
  return name;
}

/// Returns other spellings of the name of a column: in capitals, with a capital at the beginning of each word, and
/// without underscores.
std::vector<std::string> other_spellings(const std::string& name) {
  std::string words = name, joined = name;
  for (std::size_t k = 0; k < words.size(); ++k)
    if (k == 0 || words[k - 1] == '_') words[k] = static_cast<char>(std::toupper(words[k]));
  std::erase(joined, '_');
  return {upper(name), words, joined};
}

/// Other usual names of columns, for each of several dimensions.
const std::vector<std::pair<std::string, std::vector<std::string>>> kUsualNames = {
    {"id1", {"i", "id_1", "particle1"}},
    {"id2", {"j", "id_2", "particle2"}},
    {"image1", {"image_x", "image[1]", "Image(1)"}},
    {"image2", {"image_y", "image[2]"}},
    {"image3", {"image_z", "image[3]"}},
    {"normal_force", {"fn", "Fn", "FN", "f_n", "force", "Force", "contact_force", "N"}},
    {"shear_force1", {"ft1", "Ft_x", "fsx", "shear_force[1]", "tangential_force_x", "Shear_Force_X"}},
    {"shear_force2", {"ft2", "Ft_y", "fsy", "shear_force[2]", "tangential_force_y", "Shear_Force_Y"}},
    {"shear_force3", {"ft3", "Ft_z", "fsz", "shear_force[3]", "tangential_force_z", "Shear_Force_Z"}},
    {"kn", {"Kn", "KN", "k_n", "normal_stiffness"}},
    {"kt", {"Kt", "KT", "k_t", "ks", "Ks", "k_s", "tangential_stiffness"}},
    {"kr", {"Kr", "KR", "k_r"}},
};

template <int Dim>
std::string in_words(const Contact<Dim>& c) {
  std::ostringstream words;
  words << c.i << " " << c.j << " " << c.image.transpose() << " " << c.normal_force << " "
        << c.shear_force.transpose() << " " << c.rolling_moment.transpose() << " " << c.twisting_moment << " "
        << c.kn << " " << c.kt << " " << c.kr << " " << c.ktw;
  return words.str();
}

/// Reads a contact once for every other spelling of every name of a column, and expects the same contact each time.
template <int Dim, class Read, class Write>
void expect_any_spelling(const std::vector<std::string>& names, const std::string& row, const Write& write,
                         const Read& read) {
  const auto with = [&](std::size_t k, const std::string& name) {
    std::vector<std::string> header = names;
    if (k < header.size()) header[k] = name;
    write(fmt::format("{}\n{}\n", fmt::join(header, ","), row));
    return in_words<Dim>(read());
  };
  const std::string expected = with(names.size(), "");
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::vector<std::string> spellings = other_spellings(names[k]);
    for (const auto& [name, usual] : kUsualNames)
      if (name == names[k]) spellings.insert(spellings.end(), usual.begin(), usual.end());
    for (const std::string& spelling : spellings) EXPECT_EQ(with(k, spelling), expected) << spelling;
  }
}

TEST_F(CsvPacking, TakesColumnsOfContactsInAnyUsualSpelling) {
  const auto write = [&](const std::string& text) { contacts(text); };
  grains("id,x,y,radius\n3,3.5,1,0.5\n5,2.6,1,0.5\n");
  expect_any_spelling<2>({"id1", "id2", "image1", "image2", "normal_force", "shear_force1", "shear_force2",
                          "rolling_moment", "kn", "kt", "kr"},
                         "5,3,0,0,2.5,0,0.3,0.04,11,5,3", write, [&] { return read().contacts.at(0); });
  expect_any_spelling<2>({"id1", "id2", "force1", "force2"}, "5,3,-2.5,0.3", write,
                         [&] { return read().contacts.at(0); });
  grains("id,x,y,z,radius\n3,3.5,1,1,0.5\n5,2.6,1,1,0.5\n");
  options_.cell = {{8, 0, 0}, {0, 8, 0}, {0, 0, 8}};
  *options_.law += test::twisting_spring(0.5, 4.0);
  expect_any_spelling<3>({"id1", "id2", "image1", "image2", "image3", "normal_force", "shear_force1",
                          "shear_force2", "shear_force3", "rolling_moment1", "rolling_moment2",
                          "rolling_moment3", "twisting_moment", "kn", "kt", "kr", "ktw"},
                         "5,3,0,0,0,2.5,0,0.3,0.1,0,0.02,0.03,0.04,11,5,3,2", write,
                         [&] { return read<3>().contacts.at(0); });
  expect_any_spelling<3>({"id1", "id2", "force1", "force2", "force3"}, "5,3,-2.5,0.3,0.1", write,
                         [&] { return read<3>().contacts.at(0); });
}

TEST_F(CsvPacking, TakesForcesAsVectorsByAnyUsualName) {
  grains("id,x,y,radius\n3,3.5,1,0.5\n5,2.6,1,0.5\n");
  contacts("id1,id2,force1,force2\n5,3,-2.5,0.3\n");
  const std::string expected = in_words<2>(read().contacts.at(0));
  for (const std::string header : {"fx,fy", "Fx,Fy", "force_x,force_y", "force[1],force[2]", "Force1,Force2",
                                   "FORCE_X,FORCE_Y", "contact_force1,contact_force2", "F1,F2"}) {
    contacts("id1,id2," + header + "\n5,3,-2.5,0.3\n");
    EXPECT_EQ(in_words<2>(read().contacts.at(0)), expected) << header;
  }
  // Beside a vector, a scalar force is not read.
  contacts("id1,id2,force,fx,fy\n5,3,9,-2.5,0.3\n");
  EXPECT_EQ(in_words<2>(read().contacts.at(0)), expected);
}

TEST_F(CsvPacking, TakesColumnsOfGrainsInAnyUsualSpelling) {
  const std::vector<std::string> names = {"id", "x", "y", "radius", "mass"};
  for (std::size_t k = 0; k < names.size(); ++k)
    for (const std::string& spelling : other_spellings(names[k])) {
      std::vector<std::string> header = names;
      header[k] = spelling;
      grains(fmt::format("{}\n7,1.5,1,0.5,9\n", fmt::join(header, ",")));
      const Packing<2> p = read();
      EXPECT_EQ(std::tuple(p.grains.name(0), p.grains.position[0][0], p.grains.position[0][1],
                           p.grains.radius[0], p.grains.mass[0]),
                std::tuple(7, 1.5, 1.0, 0.5, 9.0))
          << spelling;
    }
}

TEST_F(CsvPacking, NamesColumnsThatAreNotRead) {
  const auto remarks = [&] { return read_csv_packing(scratch_.file("g.csv"), options_).remarks; };
  EXPECT_THAT(remarks(), testing::IsEmpty());
  contacts("id1,id2,Fn,colour,shear_force,force3,rolling_moment1\n5,3,1,red,7,8,9\n");
  EXPECT_THAT(remarks(),
              testing::Contains(HasSubstr(
                  "c.csv: these columns are not read: colour, shear_force, force3, rolling_moment1")));
  contacts("id1,id2,bonded,kn,kt,kr,ktw,tensile_strength,bridge_volume\n5,3,1,1,1,1,1,1,0\n");
  EXPECT_THAT(remarks(), testing::IsEmpty());
  options_.contacts.clear();
  grains("id,x,y,r,vx,Temperature\n7,4.4,1,0.5,3,4\n");
  EXPECT_THAT(remarks(), testing::Contains(HasSubstr("g.csv: these columns are not read: vx, Temperature")));
}

TEST_F(CsvPacking, RefusesForcesThatItWouldCut) {
  grains("id,x,y,radius\n3,3.5,1,0.5\n5,2.6,1,0.5\n");
  contacts("id1,id2,normal_force,shear_force1,shear_force2\n5,3,2,0.5,0.3\n");
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("c.csv:2: the tangential force has the component")));
  contacts("id1,id2,force1,force2,shear_force1,shear_force2\n5,3,-2,0.3,0,0.3\n");
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("c.csv:2: force1.. has the tangential part 0.3 that")));
  contacts("id1,id2,normal_force,shear_force1,shear_force2\n5,3,2,1e-6,0.3\n");
  EXPECT_EQ(read().contacts.at(0).normal_force, 2.0);
  for (const std::string vector : {"force", "shear_force", "image"}) {
    contacts(fmt::format("id1,id2,normal_force,{0}1,{0}2,{0}3\n5,3,0,0,0,1\n", vector));
    EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr(
                               "c.csv:2: " + vector + "3 = 1, expected 0 for disks in two dimensions")))
        << vector;
  }
}

TEST_F(CsvPacking, AsksForTheVolumeOfALiquidBridgeAcrossAGap) {
  grains("id,x,y,z,radius\n3,3.5,1,1,0.5\n5,2.48,1,1,0.5\n");
  contacts("id1,id2,normal_force,kn,kt\n5,3,-0.1,-2,0\n");
  options_.cell = {{8, 0, 0}, {0, 8, 0}, {0, 0, 8}};
  options_.law = parse_law("",
                           "normal.stiffness=1000,adhesion.law=capillary,adhesion.surface_tension=1,"
                           "adhesion.contact_angle=10,adhesion.water_content=0.01,adhesion.density_ratio=2.5");
  EXPECT_THAT([&] { read<3>(); }, ThrowsMessage<InputError>(
                                      HasSubstr("or this is a liquid bridge, whose volume has to be listed")));
}

TEST_F(CsvPacking, TakesBondsOfASurfaceThatTouches) {
  grains("id,x,y,radius\n3,3.5,1,0.5\n5,2.6,1,0.5\n");
  contacts("id1,id2,normal_force,kn,kt,bonded\n5,3,-2,7,5,1\n");
  const Contact<2> c = read().contacts.at(0);
  EXPECT_EQ(std::tuple(c.normal_force, c.kn, c.kt, c.bonded), std::tuple(-2.0, 7.0, 5.0, true));
  contacts("id1,id2,normal_force,kn,kt,bonded\n5,3,2,7,5,2\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("c.csv:2: bonded = 2, expected 1 for a bond")));
}

TEST_F(CsvPacking, TakesAForceAcrossTheSmallGapThatRigidGrainsLeave) {
  grains("id,x,y,radius\n3,3.5,1,0.5\n5,2.5,1,0.4999\n");
  contacts("id1,id2,normal_force\n3,5,0.7\n");
  const Contact<2> c = read().contacts[0];
  EXPECT_GT(c.gap, 0.0);
  EXPECT_EQ(std::tie(c.normal_force, c.elastic_force, c.kn, c.distant), std::make_tuple(0.7, 0.7, 10.0, false));
  contacts("id1,id2\n3,5\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("c.csv:2: the gap is")));
}

TEST_F(CsvPacking, NamesWhatIsMissingOrMalformed) {
  const ImportOptions good = options_;
  options_.law.reset();
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("give --law")));
  options_ = good;
  options_.cell.clear();
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("give --cell")));
  options_.cell = {{1, 2}, {2, 4}};
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("span no volume")));
  options_.cell = {{1, 2}, {2, 4, 5}};
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("vector 2 has 3 components, expected 2")));
  options_ = good;
  options_.columns = {{"r", "radius"}};
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("\"r\" is not the name of a grain column that floc reads")));
  options_ = good;
  options_.index = 1;
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("the file contains only one packing")));
  options_ = good;
  grains("x,y,radius\n1,1,0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("g.csv:2: radius = 0, must be positive")));
  grains("x,y\n1,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("has no column \"radius\"")));
  grains("id,x,y,radius\n1,1,1,1\n1,2,2,1\n");
  contacts("id1,id2\n1,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("g.csv:3: id = 1 is given twice")));
}

TEST_F(CsvPacking, NamesWhatIsWrongInAListOfContacts) {
  contacts("id1,id2\n7,4\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("c.csv:2: id2 = 4: no grain has this id")));
  contacts("id1,id2\n7,3\n3,7\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("listed twice")));
  contacts("id1,id2,image1,image2\n7,7,0,0\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("touch itself")));
  for (const char* walls : {"", "x=0:9,y=0:9"}) {
    const ImportOptions good = options_;
    options_.walls = walls;
    if (*walls != '\0') options_.cell.clear();
    contacts("id1,id2,normal_force\n7,7,1\n");
    EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("c.csv:2: the first and the second body of the "
                                                               "contact are grain 7")));
    options_ = good;
  }
  contacts("id1,id2,image1,image2\n7,3,0,-1000000001\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(
                             HasSubstr("c.csv:2: image2 = -1000000001, expected a number of cells up to 1e9")));
  grains("id,x,y,radius\n7,-3e9,1,0.5\n3,3e9,1,0.5\n");
  contacts("id1,id2,image1,image2,normal_force\n7,3,1000000000,0,1\n");
  EXPECT_THAT(refusal(),
              ThrowsMessage<InputError>(HasSubstr("g.csv:2: the grain is more than 1e9 cells away from")));
  grains("id,x,y,radius\n7,4.4,1,0.5\n3,3.5,1,0.5\n");
  contacts("id1,id2,shear_force1,shear_force2\n7,3,0,1\n");
  options_.law = parse_law("", "normal.stiffness=10");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("the law has no friction")));
  grains("x,y,radius\n1,1,0.5\n1,1,0.4\n");
  contacts("id1,id2\n0,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(HasSubstr("c.csv:2: the grains have the same centre")));
  grains("x,y,radius\n1,1,1\n");
  contacts("id1,id2\n0,1\n");
  EXPECT_THAT(refusal(), ThrowsMessage<InputError>(
                             HasSubstr("id2 = 1: no grain has this id; the ids of grains are from 0 to 0")));
}

}  // namespace
}  // namespace floc
