#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "floc/io/state_file.h"
#include "support/places.h"
#include "support/run_program.h"

/// Tests of rejected input: each message must name the place (file, line, array or option), the value, and the
/// values that are allowed.
namespace floc::test {
namespace {

using ::testing::HasSubstr;

const std::string kDemo = source_directory() + "/data/scenes/demo.toml";
const std::string kGrains = "x,y,r\n0,0,0.5\n0.9,0,0.5\n";
const std::string kLaw = "--law normal.stiffness=1000";
const std::string kConvert = "convert g.csv p.h5 --columns radius=r --cell '5,0;0,5' " + kLaw;
const std::string kSpheres = "convert h.csv q.h5 --columns radius=r --cell '5,0,0;0,5,0;0,0,5' " + kLaw;
const std::string kXyz =
    "1\nLattice=\"5 0 0 0 5 0 0 0 5\" Properties=species:S:1:pos:R:3:radius:R:1\nA 0 0 0 0.5\n";
const std::string kJam = "N = 1 ,L1= { 1 , 0 } ,L2= { 0 , 1 } ,P0= 1e-3 ,P= { 0 }\n";
const std::string kData =
    "title\n\n1 atoms\n0 5 xlo xhi\n0 5 ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms # sphere\n\n1 1 1 1 0 0 0\n";
const std::string kYade = "# x y z r\n0 0 0 0.5\n0.9 0 0 0.5\n";

const std::string kDump =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n0 5\n0 5\n-0.5 0.5\nITEM: ATOMS "
    "id x y z radius\n1 0 0 0 0.5\n";
const std::string kVtu =
    "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"1\"><Points><DataArray "
    "type=\"Float64\" NumberOfComponents=\"3\">0 0 0</DataArray></Points><PointData><DataArray "
    "type=\"Float64\" Name=\"radius\">0.5</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

struct Refusal {
  const char* name;
  std::vector<std::pair<std::string, std::string>> files;  ///< names and contents of input files
  std::vector<std::string> commands;                       ///< commands to run; the last command must fail
  const char* message;
};
void PrintTo(const Refusal& refusal, std::ostream* out) {
  *out << refusal.name;
}

class Refused : public ::testing::TestWithParam<Refusal> {};

TEST_P(Refused, InWordsThatSayWhereAndWhat) {
  const ScratchDirectory scratch;
  for (const auto& [name, content] : GetParam().files) {
    std::filesystem::create_directories(std::filesystem::path(scratch.file(name)).parent_path());
    write_text(scratch.file(name), content);
  }
  Outcome last{.code = 0, .out = {}, .err = {}};
  for (const std::string& command : GetParam().commands) {
    EXPECT_EQ(last.code, 0) << last.err;
    last = run_floc(command, scratch.path());
  }
  EXPECT_EQ(last.code, 4) << last.err;
  EXPECT_THAT(last.err, HasSubstr(GetParam().message));
}

const Refusal kOfPackings[] = {
    {"columns_without_a_name",
     {{"g.csv", kGrains}},
     {"convert g.csv p.h5 --columns radius --cell '5,0;0,5' " + kLaw},
     "--columns: \"radius\" does not assign a column to a name: expected name=column, for example "
     "x=X,y=Y,radius=R"},
    {"dimension_beside_a_cell",
     {{"g.csv", kGrains}},
     {kConvert + " --dimension 3"},
     "--dimension: the dimension of the packing is 3, but --cell has 2 lattice vectors"},
    {"several_into_one_file",
     {{"g.csv", kGrains}, {"h.csv", kGrains}},
     {"convert g.csv h.csv p.h5 --columns radius=r --cell '5,0;0,5' " + kLaw},
     "p.h5: this is not a directory, but the 2 input files need one output file each: give an existing "
     "directory"},
    {"contacts_of_several",
     {{"g.csv", kGrains}, {"h.csv", kGrains}, {"d/x", ""}},
     {"convert g.csv h.csv d --columns radius=r --cell '5,0;0,5' " + kLaw + " --contacts c.csv"},
     "--contacts: the file of contacts belongs to a single packing, but several packings are to be converted: "
     "convert them one by one"},
    {"contact_with_itself",
     {{"g.csv", kGrains}, {"c.csv", "id1,id2,image1,image2\n0,0,0,0\n"}},
     {kConvert + " --contacts c.csv"},
     "c.csv:2: id1 and id2 are equal and the image is zero: the grain would touch itself"},
    {"stiffness_without_force",
     {{"g.csv", kGrains}, {"c.csv", "id1,id2,kn\n0,1,100\n"}},
     {kConvert + " --contacts c.csv"},
     "c.csv:2: a stiffness is listed for the contact, but no normal force"},
    {"no_law",
     {{"g.csv", kGrains}},
     {"convert g.csv p.h5 --columns radius=r --cell '5,0;0,5' "},
     "g.csv: the file contains no contact law: give --law"},
    {"no_cell",
     {{"g.csv", kGrains}},
     {"convert g.csv p.h5 --columns radius=r " + kLaw},
     "g.csv: the file contains no cell: give --cell"},
    {"no_grains", {{"g.csv", "x,y,r\n"}}, {kConvert}, "g.csv: the file has no grains"},
    {"cell_of_one_vector",
     {{"g.csv", kGrains}},
     {"convert g.csv p.h5 --columns radius=r --cell '5' " + kLaw},
     "the cell must have two lattice vectors in 2D, or three in 3D"},
    {"quotes_that_do_not_end",
     {{"g.csv", kGrains + "\"0,0,0.5\n"}},
     {kConvert},
     "g.csv:4: a quoted cell has no closing quotation mark"},
    {"law_without_a_part",
     {{"g.csv", kGrains}},
     {kConvert + ",friction.coefficient=0.5"},
     "--law: friction.stiffness is missing; give all parameters of each component of the contact law"},
    {"law_without_a_value",
     {{"g.csv", kGrains}},
     {kConvert + ",friction.coefficient"},
     "--law: friction.coefficient has no value, expected friction.coefficient=..."},
    {"unknown_format",
     {{"g.csv", kGrains}},
     {kConvert + " --from abacus"},
     "--from: \"abacus\" is not a format; the formats are "},
    {"unknown_format_to",
     {{"g.csv", kGrains}},
     {kConvert + " --to abacus"},
     "--to: \"abacus\" is not a format; the formats are "},
    {"slanted_beyond_images",
     {{"g.csv", "x,y,r\n0,0,0.5005\n"}},
     {"convert g.csv p.h5 --columns radius=r --cell '1,0;1e10,1' " + kLaw},
     "cell: the lattice vectors are so oblique that neighbouring grains are more than 1e9 lattice vectors "
     "apart"},
    {"state_with_a_law",
     {{"g.csv", kGrains}},
     {kConvert, "convert p.h5 q.h5 " + kLaw},
     "p.h5: a state file of floc describes its packing completely: leave out --law"}};
INSTANTIATE_TEST_SUITE_P(Packings, Refused, ::testing::ValuesIn(kOfPackings),
                         [](const auto& test) { return std::string(test.param.name); });

const Refusal kOfFormats[] = {
    {"xyz_cut_short",
     {{"g.xyz", "1\n"}},
     {"convert g.xyz --from extended-xyz p.h5 " + kLaw},
     "g.xyz: the file ends before the comment line of a frame: expected a comment line with Properties="},
    {"xyz_empty",
     {{"g.xyz", "\n"}},
     {"convert g.xyz --from extended-xyz p.h5 " + kLaw},
     "g.xyz: the file has no grains"},
    {"xyz_quotes",
     {{"g.xyz", replaced(kXyz, "0 5\" ", "0 5 ")}},
     {"convert g.xyz p.h5 " + kLaw},
     "the value of this key begins with a quotation mark but has no closing one"},
    {"xyz_lattice",
     {{"g.xyz", replaced(kXyz, "0 0 0 5\" ", "0 0\" ")}},
     {"convert g.xyz p.h5 " + kLaw},
     "g.xyz:2: Lattice has 7 numbers, expected 9"},
    {"jam_numbers",
     {{"g.txt", kJam + "0.1 , 0.2 ,\n}\n"}},
     {"convert g.txt --from jambashbulk p.h5 "},
     "has 2 numbers, expected x, y and the radius"},
    {"jam_options",
     {{"g.txt", kJam + "0.1 , 0.2 , 0.5 ,\n}\n"}},
     {"convert g.txt --from jambashbulk p.h5 " + kLaw},
     "the format jamBashbulk determines the law, the cell, the columns and the contacts: leave out --law"},
    {"jam_3d",
     {{"g.txt", kJam}},
     {"convert g.txt --from jambashbulk p.h5 --dimension 3"},
     "g.txt: packings of jamBashbulk are two-dimensional: leave out --dimension"},
    {"jam_units",
     {{"g.txt", kJam}},
     {"convert g.txt --from jambashbulk p.h5 --units SI"},
     "g.txt: files of jamBashbulk are in reduced units: leave out --units"},
    {"data_axis",
     {{"g.data", replaced(kData, "zlo zhi", "wlo whi")}},
     {"convert g.data --from lammps-data p.h5 " + kLaw},
     "g.data:6: the header line has the words \"wlo whi\", expected two finite numbers and xlo xhi, ylo yhi or "
     "zlo zhi"},
    {"data_no_box",
     {{"g.data", "title\n\n1 atoms\n"}},
     {"convert g.data --from lammps-data p.h5 " + kLaw},
     "g.data: the file has no box: it lacks a line \"... xlo xhi\""},
    {"data_columns",
     {{"g.data", kData}},
     {"convert g.data p.h5 " + kLaw + " --columns radius=r"},
     "--columns: the columns of a LAMMPS data file are fixed"},
    {"data_no_grains",
     {{"g.data", replaced(replaced(kData, "1 atoms", "0 atoms"), "\n1 1 1 1 0 0 0", "")}},
     {"convert g.data p.h5 " + kLaw},
     "g.data: the file has no grains"},
    {"dump_box",
     {{"g.dump", replaced(kDump, "pp pp pp", "pp pp")}},
     {"convert g.dump p.h5 " + kLaw},
     "g.dump:5: the line is \"ITEM: BOX BOUNDS pp pp\", expected BOX BOUNDS [xy xz yz] and three boundary "
     "styles such as pp"},
    {"dump_item",
     {{"g.dump", replaced(kDump, "ITEM: NUMBER OF ATOMS", "ITEM: NUMBERS")}},
     {"convert g.dump p.h5 " + kLaw},
     "g.dump:3: the line is \"ITEM: NUMBERS\", expected ITEM: ATOMS"},
    {"dump_no_number",
     {{"g.dump", replaced(kDump, "ITEM: NUMBER OF ATOMS\n1\n", "")}},
     {"convert g.dump p.h5 " + kLaw},
     "the frame gives no number of rows (ITEM: NUMBER OF ...) or no box (ITEM: BOX BOUNDS ...)"},
    {"vtu_no_xml",
     {{"g.vtu", "<VTKFile>"}},
     {"convert g.vtu --from vtu p.h5 " + kLaw},
     "g.vtu: the file is not XML: "},
    {"vtu_big_endian",
     {{"g.vtu", replaced(kVtu, "type=\"Un", "byte_order=\"BigEndian\" type=\"Un")}},
     {"convert g.vtu p.h5 " + kLaw},
     "g.vtu: byte_order = BigEndian, expected LittleEndian"},
    {"vtu_pieces",
     {{"g.vtu", replaced(kVtu, "</Piece>", "</Piece><Piece/>")}},
     {"convert g.vtu p.h5 " + kLaw},
     "g.vtu: the file has 2 pieces, expected one"},
    {"vtu_type",
     {{"g.vtu", replaced(kVtu, "Float64\" Name", "String\" Name")}},
     {"convert g.vtu p.h5 " + kLaw},
     "array PointData/radius: type = \"String\", expected a type of numbers such as Float64"},
    {"vtu_offset",
     {{"g.vtu", replaced(kVtu, "Name=\"radius\">0.5", "Name=\"radius\" format=\"appended\" offset=\"99\">")}},
     {"convert g.vtu p.h5 " + kLaw},
     "array PointData/radius: offset = 99 lies beyond the end of the appended data"},
    {"vtu_appended",
     {{"g.vtu", replaced(kVtu, "</UnstructuredGrid>", "</UnstructuredGrid><AppendedData encoding=\"raw\">")}},
     {"convert g.vtu p.h5 " + kLaw},
     "g.vtu: the element AppendedData of the file has no end"},
    {"vtu_vertex",
     {{"g.vtu", replaced(kVtu, "</Piece>",
                         "<Cells><DataArray type=\"Int64\" Name=\"connectivity\">7</DataArray><DataArray "
                         "type=\"Int64\" Name=\"offsets\">1</DataArray><DataArray type=\"UInt8\" "
                         "Name=\"types\">1</DataArray></Cells></Piece>")}},
     {"convert g.vtu p.h5 " + kLaw},
     "array Cells/connectivity: cell 0 of the grid is a vertex at a point that does not exist"},
    {"vtu_cell",
     {{"g.vtu",
       replaced(kVtu, "<Piece",
                "<FieldData><DataArray type=\"Float64\" Name=\"cell\">1 0</DataArray></FieldData><Piece")}},
     {"convert g.vtu p.h5 " + kLaw},
     "array FieldData/cell: the array has 2 numbers, expected 9"},
    {"yade_no_law",
     {{"g.txt", kYade}},
     {"convert g.txt p.h5 --cell '5,0;0,5'"},
     "g.txt: the file contains no contact law: give --law"},
    {"yade_interactions_without_a_law",
     {{"g.txt", kYade}, {"i.txt", "# id1 id2 fnx fny fnz\n0 1 1 0 0\n"}},
     {"convert g.txt p.h5 --cell '5,0;0,5' --contacts i.txt"},
     "i.txt: the list of interactions does not have all of the columns kn, ks and tan_phi: give --law"},
    {"yade_contact_columns",
     {{"g.txt", kYade}},
     {"convert g.txt p.h5 " + kLaw + " --contact-columns id1=a"},
     "--contact-columns: the file of interactions of YADE contains the names of its columns; leave this option "
     "out"}};
INSTANTIATE_TEST_SUITE_P(FilesOfOtherPrograms, Refused, ::testing::ValuesIn(kOfFormats),
                         [](const auto& test) { return std::string(test.param.name); });

const Refusal kOfCommands[] = {
    {"compare_2d_3d",
     {{"g.csv", kGrains}, {"h.csv", "x,y,z,r\n0,0,0,0.5\n"}},
     {kConvert, "convert h.csv q.h5 --columns radius=r --cell '5,0,0;0,5,0;0,0,5' " + kLaw,
      "compare p.h5 q.h5"},
     "q.h5: this is a state in 3D, but p.h5 is in 2D"},
    {"compare_others",
     {{"g.csv", kGrains}, {"h.csv", kGrains + "3,3,0.5\n"}},
     {kConvert, "convert h.csv q.h5 --columns radius=r --cell '5,0;0,5' " + kLaw, "compare p.h5 q.h5"},
     "q.h5: this state cannot be compared with p.h5: there are 2 grains in one state, but 3 in the other: both "
     "must be states of the same "
     "grains"},
    {"draw_others",
     {{"g.csv", kGrains}, {"h.csv", kGrains + "3,3,0.5\n"}},
     {kConvert, "convert h.csv q.h5 --columns radius=r --cell '5,0;0,5' " + kLaw,
      "draw p.h5 -o p.svg --compare q.h5"},
     "q.h5: this state cannot be compared with p.h5: there are 2 grains in one state, but 3 in the other: both "
     "must be states of the same grains"},
    {"draw_spheres",
     {{"h.csv", "x,y,z,r\n0,0,0,0.5\n"}},
     {"convert h.csv q.h5 --columns radius=r --cell '5,0,0;0,5,0;0,0,5' " + kLaw,
      "draw q.h5 -o p.svg --slab z,0.5,1"},
     "q.h5: this state has no grain whose centre lies in --slab z,0.5,1: choose a slab that contains at least "
     "one "
     "grain"},
    {"draw_width",
     {{"g.csv", kGrains}},
     {kConvert, "draw p.h5 -o p.png --resolution 0.001"},
     "floc draw: resolution = 0.001 pixels per inch: must be between 10 and 2400"},
    {"draw_steps_of_files",
     {{"g.csv", kGrains}},
     {kConvert, "draw p.h5 -o p.svg --steps 1"},
     "--steps: this option chooses states of a directory that floc run wrote, but only files are given"},
    {"draw_no_run",
     {{"d/x", ""}},
     {"draw d -o p.svg"},
     "d: this directory holds no state-0000.h5: expected state files or a directory that floc run wrote"},
    {"report_of_an_ensemble",
     {{"d/seed-1/path.csv", "P_star,phi\n1,0.5\n"}, {"d/seed-2/path.csv", "P_star,phi\n1,0.5\n"}},
     {"report d -o r.html"},
     "d: this directory holds 2 samples of a scene: expected the directory of one sample, such as d/seed-1"},
    {"fit_no_table",
     {{"d/x", ""}},
     {"fit consolidation d"},
     "d: this directory contains neither path.csv nor seed-N/path.csv"},
    {"plot_no_forces",
     {{"g.csv", "x,y,r\n0,0,0.1\n2,2,0.1\n"}},
     {kConvert, "plot p.h5 -o p.svg --show forces"},
     "p.h5: this state has no normal contact forces, or their unit in this plot is zero: expected a state with "
     "contact forces of this kind and with a unit that is not zero"},
    {"structure_range",
     {{"g.csv", kGrains}},
     {kConvert, "structure p.h5 --fit-range 2,1"},
     "--fit-range: expected LOW,HIGH with LOW < HIGH"},
    {"increments_of_bounds",
     {{"g.csv", kGrains}},
     {kConvert, "moduli p.h5 --method bounds --increments i.csv"},
     "--increments: needs --method factor, because other methods compute only approximate forces"},
    {"tolerance_of_zero",
     {{"g.csv", kGrains}},
     {kConvert, "moduli p.h5 --tolerance 0"},
     "--tolerance = 0: must be > 0 and finite"},
    {"chain_of_one",
     {},
     {"chain --n 1 --R 0.5 --kn 1 --kt 1 --kr 1"},
     "chain: n = 1: the number of disks must be from 2 to 1000000"},
    {"chain_without_stiffness",
     {},
     {"chain --n 3 --R 0.5 --kn 0 --kt 1 --kr 1"},
     "chain: K_N = 0: must be > 0 and finite"},
    {"chain_that_bites_its_tail",
     {},
     {"chain --n 9 --R 0.5 --kn 1 --kt 1 --kr 1 --bend 45"},
     "chain: the last disk lies on the first, so their centres do not define the chord of the chain"},
    {"run_into_a_file", {{"f", "x"}}, {"run " + kDemo + " -o f"}, "f: this is a file: expected a directory"},
    {"run_into_another",
     {{"d/x", ""}},
     {"run " + kDemo + " -o d"},
     "d: this directory is not empty: give --resume to continue the run in it, or --overwrite to replace it"},
    {"ensemble_into_another",
     {{"d/x", ""}},
     {"run " + kDemo + " -o d --seeds 1..2"},
     "d: this directory is not empty: give --resume to continue the runs in it, or --overwrite to replace "
     "them"},
    {"seeds",
     {},
     {"run " + kDemo + " -o d --seeds 2..1"},
     "this is not a range of seeds: expected A..B with two whole numbers, A <= B, and at most 1000000 seeds"},
    {"rolling_without_friction",
     {{"s.toml",
       "[scene]\ndimension = 2\n[contact]\nnormal = {law = \"linear\", stiffness = 1e5}\nrolling = "
       "{coefficient = 0.005, stiffness = 10.0}\n"}},
     {"scene check s.toml"},
     "contact.rolling: rolling resistance needs friction, because grains without friction do not rotate; give "
     "contact.friction or leave out contact.rolling"},
    {"aggregation_without_inertia",
     {{"s.toml",
       "[scene]\ndimension = 2\nunits = \"reduced\"\n[grains]\ncount = 40\ndiameter = {distribution = "
       "\"uniform\", min "
       "= 0.5, max = 1.0}\n[contact]\nnormal = {law = \"linear\", stiffness = 1e5}\nadhesion = {law = "
       "\"tail\", force = "
       "1.0, range = 1e-3}\ndamping = {restitution = 0.015, mass = \"effective\"}\n[cell]\nsolid_fraction = "
       "0.4\nmass = "
       "1.0\ninertial_number_cap = 1e-3\n[assembly]\nprotocol = \"aggregation\"\nagitation = 9.5\npressure = "
       "0.01\n"}},
     {"scene check s.toml"},
     "cell.inertial_number_cap: the protocol \"aggregation\" makes an equilibrium at zero pressure, where a "
     "cap on the "
     "inertial number allows no motion"},
    {"two_caps",
     {},
     {"scene check " + kDemo + " --set cell.strain_rate_cap=0.05 --set cell.inertial_number_cap=1"},
     "cell.inertial_number_cap is given together with strain_rate_cap: expected only one of them"},
    {"nothing_to_set_in",
     {},
     {"scene check " + kDemo + " --set grains.count.x=1"},
     "the scene has no table or array item 'count' in which this override could set a key"},
    {"no_room",
     {},
     {"run " + kDemo + " -o d --set cell.solid_fraction=0.85 --set grains.count=50"},
     "cell.solid_fraction = 0.85: expected the solid fraction of the gas in (0, 0.6]"},
    {"law_that_a_turn_breaks",
     {},
     {"scene check " + kDemo + " --set load.1.set.adhesion.force=-1"},
     "load.1.set: contact.adhesion.force = -1: must be >= 0 and finite"}};
INSTANTIATE_TEST_SUITE_P(Commands, Refused, ::testing::ValuesIn(kOfCommands),
                         [](const auto& test) { return std::string(test.param.name); });

/// A run cannot be resumed with another seed, or if its tables do not have the columns that this version writes.
TEST(RefusedRun, FindsWhatIsNotItsOwn) {
  const ScratchDirectory scratch;
  const std::string run = "run " + source_directory() +
                          "/data/scenes/type1_rolling_small.toml --set grains.count=40 --until 0 -o d ";
  ASSERT_EQ(run_floc(run + "--track-contacts 10", scratch.path()).code, 0);
  const auto refusal = [&](const std::string& options) {
    const Outcome o = run_floc(run + "--resume " + options, scratch.path());
    EXPECT_EQ(o.code, 4) << o.err;
    return o.err;
  };
  EXPECT_THAT(
      refusal("--seed 9"),
      HasSubstr(
          "d/state-0000.h5: this state was made with another scene or seed (the given seed is 9, and the seed "
          "of the state is 1): a run can only be continued with the scene, settings and seed with which it "
          "began"));
  write_text(scratch.file("d/contacts.csv"), "step,colour\n");
  EXPECT_THAT(refusal("--track-contacts 10"),
              HasSubstr("d/contacts.csv:1: the columns of this table differ "
                        "from those that this version of floc writes: step,colour"));
  write_text(scratch.file("d/path.csv"), "step,colour\n");
  EXPECT_THAT(refusal(""), HasSubstr("d/path.csv:1: the columns of this table differ from those that this "
                                     "version of floc writes: step,colour"));
}

TEST(RefusedRun, GoesOnFromNoCheckpointOfAnotherVersion) {
  const ScratchDirectory scratch;
  const std::string run = "run " + source_directory() +
                          "/data/scenes/type1_rolling_small.toml --set grains.count=40 -o d --resume --until ";
  ASSERT_EQ(run_floc(run + "0", scratch.path()).code, 0);
  const auto state = std::get<State<2>>(read_state(scratch.file("d/state-0000.h5")));
  write_state(scratch.file("d/checkpoint/checkpoint.h5"), state, R"({"colour": 1})");
  const Outcome o = run_floc(run + "1", scratch.path());
  EXPECT_EQ(o.code, 4) << o.err;
  EXPECT_THAT(o.err,
              HasSubstr("d/checkpoint/checkpoint.h5: this is not a checkpoint of this version of floc: "));
}

/// If a scene starts from a saved state at rest, all samples of the scene are equal. An ensemble needs different
/// samples, so the command refuses the scene.
TEST(RefusedRun, OfSamplesFromAStateAtRest) {
  const ScratchDirectory scratch;
  ASSERT_EQ(run_floc("run " + source_directory() +
                         "/data/scenes/type1_rolling_small.toml --set grains.count=40 --until 0 -o d",
                     scratch.path())
                .code,
            0);
  write_text(scratch.file("s.toml"), R"([scene]
dimension = 2
units = "reduced"
[contact]
normal = {law = "linear", stiffness = 1e5}
adhesion = {law = "tail", force = 1.0, range = 1e-3}
damping = {restitution = 0.015, mass = "effective"}
friction = {coefficient = 0.5, stiffness = 1e5}
[cell]
mass = 1.0
strain_rate_cap = 0.05
[assembly]
protocol = "state"
state = "d/state-0000.h5"
pressure = 0.01
)");
  const Outcome seeds = run_floc("run s.toml --seeds 1..2 -o e", scratch.path());
  EXPECT_EQ(seeds.code, 4);
  EXPECT_THAT(seeds.err, HasSubstr("--seeds 1..2: all samples would be equal, because the scene starts from a "
                                   "saved state at rest, without random velocities: set assembly.agitation in "
                                   "the scene, or omit --seeds"));
}

}  // namespace
}  // namespace floc::test
