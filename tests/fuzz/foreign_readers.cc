#include <filesystem>
#include <fstream>
#include <sstream>

#include "floc/base/read_file.h"
#include "floc/io/csv_packing.h"
#include "floc/io/lammps_dump.h"
#include "floc/io/legacy_vtk.h"
#include "floc/io/lmgc90.h"
#include "floc/io/mercurydpm.h"
#include "floc/io/rockable.h"
#include "floc/io/vtu.h"
#include "read_packing.h"
#include "readers.h"

namespace floc::fuzz {
namespace {

/// Temporary directory with files, which is removed at the end.
class Directory {
 public:
  Directory() : path_(std::filesystem::temp_directory_path() / ("floc-fuzz-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Directory() { std::filesystem::remove_all(path_); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// Splits the input at the lines "@@" into the contents of several files.
std::vector<std::string> parts_of(const std::string& bytes) {
  std::vector<std::string> parts(1);
  std::istringstream in(bytes);
  for (std::string line; std::getline(in, line);) {
    if (line == "@@")
      parts.emplace_back();
    else
      parts.back() += line + "\n";
  }
  return parts;
}

const std::string kRestart =
    "MercuryDPM 1.0 name box\nxMin 0 xMax 2 yMin 0 yMax 2 zMin 0 zMax 2\nsystemDimensions 3 particleDimensions "
    "3 gravity 0 "
    "0 -1\nSpecies 1\nX id 0 density 1\nWalls 1\nInfiniteWall id 0 position 0 0 0 orientation "
    "0.7071067811865476 0 "
    "0.7071067811865476 0\nBoundaries 2\nPeriodicBoundary id 0 normal 1 0 0 distanceLeft 0 distanceRight 2 "
    "shift 2 0 "
    "0\nPeriodicBoundary normal 0 1 0 position_left 0 position_right 2 shift 0 2 0\nParticles 2\nP id 0 "
    "position 0.5 0.5 "
    "0.49 radius 0.5 invMass 1\nP id 1 position 1.48 0.5 0.49 radius 0.5 invMass 0\nInteractions 2\nI "
    "particleIds 0 1 "
    "force -3 0.1 0 torque 0 0 0\nI particleWallIds 1 0 force 0 0.2 4\n";

void read_restart_bytes(const std::string& bytes) {
  read_packing(read_mercurydpm, bytes);
}
void read_fstat_bytes(const std::string& bytes) {
  const MemoryFile contacts(bytes);
  read_packing(read_mercurydpm, kRestart, [&](ImportOptions& options) {
    options.contacts = contacts.path();
    options.pairs_twice = true;
    options.wall_ids[-1] = {2, -1};
  });
}
void read_datbox_bytes(const std::string& bytes) {
  const Directory directory;
  const std::vector<std::string> parts = parts_of(bytes);
  const char* names[] = {"BODIES.DAT", "DOF.INI", "BULK_BEHAV.DAT", "Vloc_Rloc.INI"};
  for (std::size_t k = 0; k < parts.size() && k < 4; ++k) directory.write(names[k], parts[k]);
  read_packing_at(read_lmgc90, directory.file(""));
}
void read_rockable_bytes(const std::string& bytes) {
  const Directory directory;
  const std::vector<std::string> parts = parts_of(bytes);
  directory.write("conf", parts[0]);
  if (parts.size() > 1) directory.write("shapes.txt", parts[1]);
  read_packing_at(read_rockable, directory.file("conf"));
}
void read_vtp_bytes(const std::string& bytes) {
  read_packing(read_vtu, bytes);
}
void read_vtk_bytes(const std::string& bytes) {
  read_packing(read_legacy_vtk, bytes, [](ImportOptions& options) { options.walls = "x=:,y=:,z=:"; });
}
void read_gzip_bytes(const std::string& bytes) {
  const MemoryFile file(bytes);
  try {
    read_file(file.path());
  } catch (const InputError&) {
  }
}
/// Reads a file of contacts with walls. The option that gives the positions of the walls is read too.
void read_wall_bytes(const std::string& bytes) {
  const std::vector<std::string> parts = parts_of(bytes);
  const MemoryFile contacts(parts[0]);
  read_packing(read_csv_packing, "x,y,r\n0.49,0.49,0.5\n1.47,0.49,0.5\n", [&](ImportOptions& options) {
    options.contacts = contacts.path();
    if (parts.size() > 1) options.walls = parts[1].substr(0, parts[1].find('\n'));
    options.cell = {{2.0, 0.0}, {0.0, 2.0}};
    options.wall_ids[9] = {1, -1};
  });
}

/// Reads an input script of LAMMPS or LIGGGHTS that defines the walls around two spheres.
void read_script_bytes(const std::string& bytes) {
  const MemoryFile script(bytes);
  read_packing(read_csv_packing, "x,y,z,r\n0.49,0.49,0.5,0.5\n1.47,0.49,0.5,0.5\n",
               [&](ImportOptions& options) { options.walls = script.path(); });
}

/// Reads a dump that has columns for contacts with walls. There are no contacts between grains.
void read_wall_column_bytes(const std::string& bytes) {
  const MemoryFile contacts("id1,id2\n");
  read_packing(read_lammps_dump, bytes, [&](ImportOptions& options) {
    options.contacts = contacts.path();
    options.walls = "x=0:2";
    options.columns = {{"x-", "f_w"}, {"x+", "f_w"}};
  });
}

std::vector<std::string> script_seeds() {
  return {
      "region box block 0 2 0 1 0 INF # words\nvariable h equal 2.0\nfix a all wall/gran hooke 1 2 3 xplane 0 "
      "${h}\n"
      "fix b all wall/gran/region hooke 1 2 region box\nfix c all gravity 9.81 vector 0 0 -1\n",
      "fix m all mesh/surface file none.stl type 1 scale 2 move 0 0 1\nfix w all wall/gran model hertz &\n "
      "mesh "
      "n_meshes 1 meshes m\nfix f all wall/gran model hertz primitive type 1 zplane 0.0\nunfix w\n"};
}

std::vector<std::string> wall_column_seeds() {
  return {
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff pp pp\n0 2\n0 2\n0 2\nITEM: ATOMS id x "
      "y z "
      "radius f_w[1] f_w[2] f_w[3] f_w[4] f_w[5] f_w[6] f_w[7]\n1 0.49 1 1 0.5 1 3 0 0 0 1 1\n2 1.2 1 0.9 0.4 "
      "0 0 0 0 "
      "0 0 0\n"};
}

std::vector<std::string> datbox_seeds() {
  return {
      "$bdyty\n RBDY2 1\n$blmty\n PLAIN 1 behav PLEXx avrd= 0.5D+00 gyrd= 1.0D+00\n$nodty\n NO3xx 1 coo1= "
      "0.5D+00 coo2= "
      "0.49D+00 coo3= 0.0D+00\n$tacty\n DISKx 1 color BLEUx byrd= 0.5D+00\n$$$$$$\n$bdyty\n RBDY2 2\n$blmty\n "
      "PLAIN 1 "
      "behav PLEXx avrd= 0.5D+00\n$nodty\n NO3xx 1 coo1= 0.5D+00 coo2=-0.01D+00 coo3= 0.0D+00\n$tacty\n JONCx "
      "1 color "
      "DOWNx ax1 = 0.1D+01 ax2 = 0.1D-01\n$$$$$$\n@@\n$bdyty\n RBDY2 1\n$nodty\n NO3xx 1 X(1)= 0.1D+00 X(2)= "
      "0.0D+00 X(3)= 0.0D+00\n$$$$$$\n@@\n$gravy\n grv1= 0.0D+00 grv2=-0.981D+01 grv3= 0.0D+00\n$behav lawty\n "
      "PLEXx "
      "RIGID Umas= 0.1D+01\n@@\n$icdan DKJCx 1\n cdbdy numbr\n RBDY2 1 DISKx 1 iqsc0 RBDY2 2 JONCx 1 stick\n "
      "rlt/H "
      "0.1D+00 rln/H 0.7D+01 rls/H 0.0D+00\n gapTT-0.1D-01\n n(1)= 0.0D+00 n(2)= 0.1D+01 n(3)= 0.0D+00\n",
      // a square on a bar (2D), then a tetrahedron on a plate (3D)
      "$bdyty\n RBDY2 1\n$blmty\n PLAIN 1 behav A avrd= 1.0D+00\n$nodty\n NO3xx 1 coo1= 0.0D+00 coo2= 0.5D+00 "
      "coo3= "
      "0.0D+00\n$tacty\n POLYG 1 color B nb_vertex= 4 byrd= 1.0D+00\n coo1=-0.5D+00 coo2=-0.5D+00\n coo1= "
      "0.5D+00 "
      "coo2=-0.5D+00\n coo1= 0.5D+00 coo2= 0.5D+00\n coo1=-0.5D+00 coo2= 0.5D+00\n$$$$$$\n$bdyty\n RBDY2 "
      "2\n$blmty\n "
      "PLAIN 1 behav A avrd= 1.0D+00\n$nodty\n NO3xx 1 coo1= 0.0D+00 coo2=-0.1D+00 coo3= 0.0D+00\n$tacty\n "
      "JONCx 1 "
      "color D ax1= 1.0D+00 ax2= 0.1D+00\n$$$$$$\n@@\n@@\n@@\n$icdan PLJCx 1\n h\n RBDY2 1 POLYG 1 RBDY2 2 "
      "JONCx 1\n "
      "rlt/H 0.1D+00 rln/H 0.7D+01 rls/H 0.0D+00\n gapTT-0.1D-01\n n(1)= 0.0D+00 n(2)= 0.1D+01 n(3)= 0.0D+00\n "
      "coo1= "
      "0.5D+00 coo2= 0.0D+00 coo3= 0.0D+00\n",
      "$bdyty\n RBDY3 1\n$blmty\n PLAIN 1 behav A avrd= 1.0D+00\n I1  = 1.0D+00 I2  = 1.0D+00 I3  = "
      "1.0D+00\n$nodty\n "
      "NO6xx 1 coo1= 0.0D+00 coo2= 0.0D+00 coo3= 0.5D+00\n coo4= 0.0D+00 coo5= 0.0D+00 coo6= 0.0D+00\n$tacty\n "
      "POLYR 1 "
      "color B nb_vertex= 4 nb_faces= 4\n coo1= 0.5D+00 coo2= 0.5D+00 coo3=-0.5D+00\n coo1=-0.5D+00 "
      "coo2=-0.5D+00 "
      "coo3=-0.5D+00\n coo1= 0.5D+00 coo2=-0.5D+00 coo3= 0.5D+00\n coo1=-0.5D+00 coo2= 0.5D+00 coo3= 0.5D+00\n "
      "ver1= 1 "
      "ver2= 2 ver3= 3\n ver1= 1 ver2= 4 ver3= 2\n ver1= 1 ver2= 3 ver3= 4\n ver1= 2 ver2= 4 ver3= "
      "3\n$$$$$$\n@@\n$bdyty\n RBDY3 1\n$nodty\n NO6xx 1 X(1)= 0.0D+00 X(2)= 0.0D+00 X(3)= 0.1D+00\n a(1)= "
      "1.0D+00 a(2)= "
      "0.0D+00 a(3)= 0.0D+00\n b(1)= 0.0D+00 b(2)= 0.0D+00 b(3)= 1.0D+00\n g(1)= 0.0D+00 g(2)=-1.0D+00 g(3)= "
      "0.0D+00\n$$$$$$\n"};
}
std::vector<std::string> rockable_seeds() {
  return {
      "Rockable 29-11-2018\nshapeFile shapes.txt\ngravity 0 0 -1\ndensity 1 2\nnDriven 1\nParticles 3\nPlate 0 "
      "0 1 0 0 "
      "-0.1 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\nSphere 1 0 1 0 0 0.49 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\nSphere 1 0 "
      "1 0.98 0 "
      "0.49 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\nInteractions 2\n1 2 0 0 0 -1 0 0 -0.02 0 0 0 0 0 0 5 0 0.1 0 0 0 "
      "0 0\n1 0 0 0 0 "
      "0 0 1 -0.01 0 0 0 0 0 0 4 0 0 0 0 0 0 0\n@@\n<\nname Sphere\nradius 0.5\nnv 1\n0 0 0\nvolume "
      "0.5\n>\n<\nname "
      "Plate\nradius 0.1\nnv 4\n9 9 0\n9 -9 0\n-9 -9 0\n-9 9 0\nvolume 1\n>\n",
      "Rockable 1\nshapeFile shapes.txt\nusePeriodicCell 1\nh 2 0 0 0 2 0 0 0 2\nnDriven 0\nParticles "
      "1\nSphere 1 0 1 0 0 "
      "0.49 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\n@@\n<\nname Sphere\nradius 0.5\nnv 1\n0 0 0\n>\n",
      "Rockable 1\nshapeFile shapes.txt\nusePeriodicCell 1\nh 4 0 0 0 4 0 0 0 4\nnDriven 0\nParticles 2\nCube "
      "0 0 1 0 0 0 0 "
      "0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\nRod 0 0 2 0 0 1.2 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0\nInteractions 2\n0 1 2 "
      "0 0 0 0 -1 "
      "-0.01 0.4 0.4 0.5 0 0 0 2 0.5 0 0 0 0 0 0\n1 0 3 0 0 0 0 1 -0.01 -0.4 0.4 0.5 0 0 0 1 0 0 0 0 0 0 "
      "0\n@@\n<\nname "
      "Cube\nradius 0.1\npreCompDone y\nvolume 0.9\nnv 8\n-0.4 -0.4 -0.4\n0.4 -0.4 -0.4\n0.4 0.4 -0.4\n-0.4 "
      "0.4 "
      "-0.4\n-0.4 -0.4 0.4\n0.4 -0.4 0.4\n0.4 0.4 0.4\n-0.4 0.4 0.4\nne 0\nnf 0\n>\n<\nname Rod\nradius "
      "0.3\npreCompDone y\nnv 2\n0 0.2 0\n0 -0.2 0\n>\n"};
}
std::vector<std::string> vtp_seeds() {
  return {
      "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
      "compressor=\"vtkZLibDataCompressor\"><PolyData><FieldData><DataArray type=\"Float64\" Name=\"cell\" "
      "format=\"ascii\">4 0 0 0 4 0 0 0 4</DataArray><DataArray type=\"Float64\" Name=\"walls\" "
      "format=\"ascii\">0 -1 "
      "-0.5</DataArray><DataArray type=\"Int32\" Name=\"periodic\" format=\"ascii\">0 1 "
      "1</DataArray></FieldData><Piece "
      "NumberOfPoints=\"2\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"binary\">AwAAABAAAAAAAAAADQAAABIAAAAQAAAAeJxjYEAGH+wBAi8BMHicY2AAgQ/"
      "2YIrhhz0ADdYCZ3icY2AAAwcIxeIAAAKYAIU="
      "</DataArray></Points><PointData><DataArray type=\"Float32\" Name=\"Radius\" "
      "format=\"binary\">AQAAAACAAAAIAAAAEAAAAA==eJxjYGCwZ2BosAMAAoEA/g==</DataArray></PointData></Piece></"
      "PolyData></"
      "VTKFile>"};
}
std::vector<std::string> vtk_seeds() {
  return {
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 1 1 1.5\n2 2.5\nVERTICES 2 "
      "4\n1 0\n1 "
      "1\nPOINT_DATA 2\nVECTORS v double\n0 0 0 1 2 3\nSCALARS radius float 1\nLOOKUP_TABLE default\n0.5 "
      "0.25\nFIELD d "
      "1\nID 1 2 int\n4 9\n",
      "# vtk DataFile Version 5.1\nt\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n0 1 1 1.5 2 2.5\nVERTICES 3 "
      "2\nOFFSETS "
      "vtktypeint64\n0 1 2\nCONNECTIVITY vtktypeint64\n0 1\nPOINT_DATA 2\nFIELD F 1\nradius 1 2 double\n0.5 "
      "0.25\n",
      std::string("# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 float\n") +
          std::string(12, '\0') + "\nPOINT_DATA 1\nSCALARS radius float\nLOOKUP_TABLE default\n" +
          std::string("\x3f\x80\0\0\n", 5)};
}

}  // namespace

std::vector<Reader> foreign_readers() {
  return {
      {"mercurydpm", read_restart_bytes, [] { return std::vector<std::string>{kRestart}; }},
      {"mercurydpm_fstat", read_fstat_bytes,
       [] {
         return std::vector<std::string>{
             "# 0\n1 0 1 1 0.5 0.49 0.02 0 3 0.1 -1 0 0 0 1 0\n1 1 0 1 0.5 0.49 0.02 0 3 0.1 1 0 0 0 -1 "
             "0\n1 0 -1 0.5 0.5 0 0.01 0 4 0 0 0 -1 0 0 0\n"};
       }},
      {"lmgc90", read_datbox_bytes, datbox_seeds},
      {"rockable", read_rockable_bytes, rockable_seeds},
      {"vtp", read_vtp_bytes, vtp_seeds},
      {"legacy_vtk", read_vtk_bytes, vtk_seeds},
      // "floc" and a newline, compressed
      {"gzip", read_gzip_bytes,
       [] {
         return std::vector<std::string>{std::string(
             "\x1f\x8b\x08\0\0\0\0\0\x02\x03\x4b\xcb\xc9\x4f\xe6\x02\0\xd1\x1d\xf5\x95\x05\0\0\0", 25)};
       }},
      {"wall_script", read_script_bytes, script_seeds},
      {"wall_columns", read_wall_column_bytes, wall_column_seeds},
      {"walls", read_wall_bytes,
       [] {
         return std::vector<std::string>{
             "id1,id2,image1,force1,force2,kn\n0,x-,0,3,0.1,1e3\n0,1,0,-3,0,1e3\n9,1,0,0,-4,1e3\n@@\nx,y-\n",
             "id1,id2,normal_force\n0,x-,3\n@@\nx=0:,y=-1:2\n"};
       }},
  };
}

}  // namespace floc::fuzz
