#include "floc/io/lmgc90.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/io/dat_file.h"
#include "floc/io/listed_bodies.h"
#include "floc/io/listed_packing.h"
#include "floc/io/lmgc90_contacts.h"
#include "floc/packing/ball.h"
#include "floc/shape/convex_hull.h"
#include "floc/shape/read_shapes.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// A body in the file BODIES.DAT.
struct Body {
  FileLine place;
  std::int64_t id = 0;
  bool spatial = false;  ///< whether the body is three-dimensional (RBDY3)
  std::string material;
  double mean_radius = 0.0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double angle = 0.0;  ///< rotation angle of a two-dimensional body (radians)
  /// Axes of a three-dimensional body, one per column.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  bool has_inertia = false;     ///< whether the file gives moments of inertia about these axes
  std::string contactor;        ///< type of the contactor: DISKx, SPHER, POLYG, POLYR, JONCx, PLANx, ...
  double radius = 0.0;          ///< radius of a disk or sphere
  double half_thickness = 0.0;  ///< half the thickness of a bar or plate
  std::int64_t n_vertices = 0, n_faces = 0;
  std::vector<Eigen::Vector3d> vertices;  ///< vertices of a polygon or polyhedron, relative to `position`
  std::vector<std::vector<int>> faces;    ///< triangles of a polyhedron

  bool is_round() const { return contactor == "DISKx" || contactor == "SPHER"; }
  bool has_corners() const { return contactor == "POLYG" || contactor == "POLYR"; }
  /// Returns the rotation from the coordinates of the body to the coordinates of space.
  Eigen::Matrix3d turn() const {
    return spatial ? axes : Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
};

/// Reads a count from a line. @param most  largest allowed count
std::int64_t count_of(const DatFile& file, std::string_view key, std::int64_t most) {
  const double value = file.number(key);
  if (value >= 0.0 && value <= static_cast<double>(most) && value == std::floor(value))
    return static_cast<std::int64_t>(value);
  throw InputError(file.place(),
                   fmt::format("the line says {} {}, expected a whole number from 0 to {}", key, value, most));
}

/// Reads a line that contains a vertex of a polygon or polyhedron, or a triangle of a polyhedron.
void read_corner(const DatFile& file, Body& body) {
  if (file.has("ver1=") && body.contactor == "POLYR") {
    std::vector<int> face;
    for (const char* key : {"ver1=", "ver2=", "ver3="}) {
      const std::int64_t vertex = count_of(file, key, body.n_vertices);
      if (vertex == 0)
        throw InputError(file.place(),
                         fmt::format("the line says {} 0, expected the number of a vertex, from 1", key));
      face.push_back(static_cast<int>(vertex) - 1);
    }
    body.faces.push_back(std::move(face));
  } else if (file.has("coo1=") && body.has_corners()) {
    body.vertices.emplace_back(file.number("coo1="), file.number("coo2="),
                               body.spatial ? file.number("coo3=") : 0.0);
  }
}

void read_contactor(const DatFile& file, Body& body) {
  const std::string kind(file.words()[0]);
  if (kind == "NO3xx" || kind == "NO6xx") {
    body.position.head<2>() << file.number("coo1="), file.number("coo2=");
    (body.spatial ? body.position[2] : body.angle) = file.number("coo3=");
  } else if (file.has("avrd=")) {
    body.mean_radius = file.number("avrd=");
    const auto words = file.words();
    const auto behav = std::find(words.begin(), words.end(), "behav");
    if (behav != words.end() && behav + 1 != words.end()) body.material = *(behav + 1);
  } else if (file.has("color")) {
    if (!body.contactor.empty())
      throw InputError(file.place(), fmt::format("body {} has the contactors {} and {}, expected one", body.id,
                                                 body.contactor, kind));
    body.contactor = kind;
    if (body.is_round()) body.radius = file.number("byrd=");
    if (body.has_corners()) body.n_vertices = count_of(file, "nb_vertex=", kMostHullPoints);
    if (kind == "POLYR") body.n_faces = count_of(file, "nb_faces=", 2 * std::int64_t{kMostHullPoints});
    if (kind == "JONCx") body.half_thickness = file.number("ax2");
    if (kind == "PLANx") body.half_thickness = file.number("axe3=");
  } else if (file.has("I1  =")) {
    body.has_inertia = file.number("I1  =") != 0.0;
  } else {
    read_corner(file, body);
  }
}

/// Checks the numbers of vertices and faces of a polygon or polyhedron: they must be those in its first line.
void require_whole(const Body& body) {
  if (body.has_corners() &&
      (std::ssize(body.vertices) != body.n_vertices || std::ssize(body.faces) != body.n_faces))
    throw InputError(body.place.text(),
                     fmt::format("body {} has {} vertices and {} faces, expected {} and {}", body.id,
                                 body.vertices.size(), body.faces.size(), body.n_vertices, body.n_faces));
}

std::vector<Body> read_bodies(const std::string& path) {
  DatFile file(path);
  std::vector<Body> bodies;
  bool open = false;
  while (file.next()) {
    const auto words = file.words();
    if (words[0] == "$bdyty") {
      bodies.emplace_back();
      open = true;
    } else if (words[0] == "$$$$$$") {
      open = false;
    } else if (open && (words[0] == "RBDY2" || words[0] == "RBDY3")) {
      Body& body = bodies.back();
      body.place = file.file_line();
      body.spatial = words[0] == "RBDY3";
      const auto id = words.size() > 1 ? parse_number<std::int64_t>(words[1]) : std::nullopt;
      if (!id) throw InputError(file.place(), "the body has no number");
      body.id = *id;
    } else if (open && words[0][0] != '$') {
      read_contactor(file, bodies.back());
    }
  }
  // In some files, a last body begins, but its data are missing.
  if (!bodies.empty() && bodies.back().id == 0) {
    bodies.pop_back();
    open = false;
  }
  if (open) throw InputError(file.place(), "the file ends within a body: expected a line $$$$$$");
  if (bodies.empty()) throw InputError(path, "the file has no bodies");
  for (const Body& body : bodies) require_whole(body);
  return bodies;
}

/// Reads one of the three lines that give the axes of a three-dimensional body.
void read_axis(const DatFile& file, Body& body) {
  constexpr double kDigits = 1e-5;  // files have seven digits
  int axis = 0;
  for (const char* name : {"a", "b", "g"}) {
    if (file.has(fmt::format("{}(1)=", name)))
      for (int k = 0; k < 3; ++k) body.axes(k, axis) = file.number(fmt::format("{}({})=", name, k + 1));
    ++axis;
  }
  if (!file.has("g(1)=")) return;
  const bool orthonormal =
      (body.axes.transpose() * body.axes).isIdentity(kDigits) && body.axes.determinant() > 0.0;
  if (!orthonormal)
    throw InputError(file.place(), fmt::format("the axes of body {} are not orthonormal: expected the three "
                                               "unit vectors a, b and g, right-handed",
                                               body.id));
  body.axes = Eigen::Quaterniond(body.axes).normalized().toRotationMatrix();
}

/// Checks that the file DOF.INI gives the displacement of each body, and of each polyhedron the axes. A file without
/// bodies, as LMGC90 writes it before the first step, gives no displacements.
/// @param displaced, turned  bodies whose displacements and axes have been read
void require_all_displaced(const std::string& path, const std::vector<Body>& bodies,
                           const std::set<std::int64_t>& displaced, const std::set<std::int64_t>& turned) {
  if (displaced.empty()) return;
  for (const Body& body : bodies) {
    if (!displaced.contains(body.id))
      throw InputError(path, fmt::format("the file gives no displacement (X(1)=) of body {}, which is at {}: "
                                         "expected each body of BODIES.DAT once",
                                         body.id, body.place.text()));
    if (body.spatial && body.has_corners() && !turned.contains(body.id))
      throw InputError(path, fmt::format("the file gives no axes (a, b and g) of body {}, which is at {}",
                                         body.id, body.place.text()));
  }
}

/// Adds the displacements in the file DOF.INI to the positions of the bodies.
void add_displacements(const std::string& path, std::vector<Body>& bodies) {
  if (!fs::exists(path)) return;
  std::map<std::int64_t, std::size_t> index;
  for (std::size_t b = 0; b < bodies.size(); ++b) index[bodies[b].id] = b;
  std::set<std::int64_t> displaced, turned;
  DatFile file(path);
  Body* body = nullptr;
  while (file.next()) {
    const auto words = file.words();
    if ((words[0] == "RBDY2" || words[0] == "RBDY3") && words.size() > 1) {
      const auto id = parse_number<std::int64_t>(words[1]);
      const auto found = id ? index.find(*id) : index.end();
      if (found == index.end())
        throw InputError(file.place(), fmt::format("body {} is not in BODIES.DAT", words[1]));
      body = &bodies[found->second];
    } else if (words[0] == "$$$$$$") {
      body = nullptr;
    } else if (body && file.has("X(1)=")) {
      if (!displaced.insert(body->id).second)
        throw InputError(file.place(),
                         fmt::format("body {} is displaced a second time, expected each body once", body->id));
      body->position.head<2>() += Eigen::Vector2d(file.number("X(1)="), file.number("X(2)="));
      (body->spatial ? body->position[2] : body->angle) += file.number("X(3)=");
    } else if (body) {
      read_axis(file, *body);
      if (file.has("g(1)=")) turned.insert(body->id);
    }
  }
  if (body != nullptr) throw InputError(file.place(), "the file ends within a body: expected a line $$$$$$");
  require_all_displaced(path, bodies, displaced, turned);
}

/// Density of each material, and gravity, from the file BULK_BEHAV.DAT.
struct Bulk {
  std::map<std::string, double> density;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

Bulk read_bulk(const std::string& path) {
  Bulk bulk;
  if (!fs::exists(path)) return bulk;
  DatFile file(path);
  while (file.next()) {
    if (file.has("grv1=")) bulk.gravity << file.number("grv1="), file.number("grv2="), file.number("grv3=");
    if (file.has("Umas=")) bulk.density[std::string(file.words()[0])] = file.number("Umas=");
  }
  return bulk;
}

/// Adds a wall in place of a bar or plate. The wall is at the face of the bar or plate that is nearer to the middle of
/// the grains.
WallSide add_bar(const Body& bar, const Eigen::Vector3d& middle, ListedSpace& space) {
  constexpr double kAligned = 1e-4;  // the files have seven digits, with angles such as 1.570800 for pi/2
  const Eigen::Vector3d across = bar.turn().col(bar.spatial ? 2 : 1).cwiseAbs();
  int axis = 0;
  if (across.maxCoeff(&axis) < std::cos(kAligned))
    throw InputError(bar.place.text(),
                     fmt::format("the {} of body {} is rotated, so its face is not perpendicular to an axis "
                                 "(normal {:.6g}, {:.6g}, {:.6g}); give the walls with --walls",
                                 bar.contactor, bar.id, across[0], across[1], across[2]));
  const WallSide wall{axis, bar.position[axis] < middle[axis] ? -1 : 1};
  add_wall(wall, bar.position[axis] - wall.side * bar.half_thickness, space);
  return wall;
}

/// Returns the shape of the convex hull of a body. If the body is not convex, adds its place to `dented`.
template <int Dim>
Shape<Dim> convex_shape(const std::string& place, const Mesh<Dim>& mesh, std::vector<std::string>& dented) {
  NamedShape<Dim> made = shape_of_mesh<Dim>(place, mesh, {});
  for (const std::string& remark : made.remarks) dented.push_back(place + ": " + remark);
  return std::move(made.shape);
}

/// Adds the shape of a body to the shapes of the packing. @return index of the shape
int add_shape(const Body& body, ListedPacking& listed, std::vector<std::string>& dented) {
  const std::string place = body.place.text();
  if (!body.spatial) {
    if (body.is_round()) {
      listed.shapes.in_2d.push_back(round_shape<2>(body.radius));
    } else {
      Mesh<2> mesh;
      for (const Eigen::Vector3d& vertex : body.vertices) mesh.vertices.emplace_back(vertex.head<2>());
      listed.shapes.in_2d.push_back(convex_shape<2>(place, mesh, dented));
    }
    return static_cast<int>(listed.shapes.in_2d.size()) - 1;
  }
  if (body.is_round()) {
    listed.shapes.in_3d.push_back(round_shape<3>(body.radius));
  } else {
    // If the file contains no moments of inertia, LMGC90 computes them and rotates the vertices to the principal axes.
    // The axes in DOF.INI then refer to these principal axes.
    if (!body.has_inertia && !body.axes.isIdentity(0.0))
      throw InputError(place,
                       fmt::format("body {} is rotated in DOF.INI, but BODIES.DAT has no moments of "
                                   "inertia (I1 = 0), so the axes of the vertex coordinates are not known",
                                   body.id));
    Mesh<3> mesh;
    mesh.vertices = body.vertices;
    mesh.faces = body.faces;
    mesh.is_oriented = false;
    listed.shapes.in_3d.push_back(convex_shape<3>(place, mesh, dented));
  }
  return static_cast<int>(listed.shapes.in_3d.size()) - 1;
}

/// Makes the grains from the disks, spheres, polygons and polyhedra. If any body is a polygon or polyhedron, all grains
/// get shapes, including disks and spheres.
void add_grains(const std::vector<Body>& bodies, const Bulk& bulk, ListedPacking& listed) {
  const bool round = std::none_of(bodies.begin(), bodies.end(), [](const Body& b) { return b.has_corners(); });
  std::vector<std::string> dented;
  for (const Body& body : bodies) {
    if (!body.is_round() && !body.has_corners()) continue;
    ListedGrain grain;
    grain.place = body.place;
    grain.id = body.id;
    grain.position = body.position;
    grain.radius = body.radius;
    if (body.is_round() && !(grain.radius > 0.0))
      throw InputError(body.place.text(), fmt::format("byrd = {}, must be positive", grain.radius));
    if (!round)
      set_shape(listed.shapes, add_shape(body, listed, dented), 1.0, body.position, body.turn(), grain);
    const auto density = bulk.density.find(body.material);
    if (density != bulk.density.end())
      grain.mass = density->second *
                   (body.spatial ? Ball<3>{body.mean_radius}.volume() : Ball<2>{body.mean_radius}.volume());
    if (grain.mass && !(*grain.mass > 0.0))
      throw InputError(body.place.text(), fmt::format("the mass is {}, must be positive: avrd = {}, Umas = {}",
                                                      *grain.mass, body.mean_radius, density->second));
    listed.grains.push_back(std::move(grain));
  }
  if (dented.empty()) return;
  listed.remarks.push_back(dented.front());
  if (dented.size() > 1)
    listed.remarks.push_back(
        fmt::format("of {} bodies in all, the convex hull leaves out vertices or volume", dented.size()));
}

}  // namespace

bool is_lmgc90(const std::string& path) {
  std::error_code none;
  return fs::path(path).filename() == "BODIES.DAT" ||
         (fs::is_directory(path, none) && fs::exists(fs::path(path) / "BODIES.DAT", none));
}

std::string lmgc90_bodies(const std::string& path) {
  return fs::is_directory(path) ? (fs::path(path) / "BODIES.DAT").string() : path;
}

Imported read_lmgc90(const std::string& path, const ImportOptions& options) {
  const std::string bodies_path = lmgc90_bodies(path);
  const fs::path folder = fs::path(bodies_path).parent_path();
  std::vector<Body> bodies = read_bodies(bodies_path);
  add_displacements((folder / "DOF.INI").string(), bodies);
  const std::string bulk_path = (folder / "BULK_BEHAV.DAT").string();
  const Bulk bulk = read_bulk(bulk_path);
  ListedPacking listed = listed_packing(bodies_path, options);
  listed.space.place = bodies_path;
  listed.space.dimension = bodies.front().spatial ? 3 : 2;
  listed.space.gravity = bulk.gravity;
  listed.space.periodic = {false, false, false};
  listed.space.boundary =
      "files of LMGC90 contain no periodic directions, and there is no wall across this axis";
  if (!fs::exists(bulk_path))
    listed.remarks.push_back(fmt::format(
        "there is no file {}, which gives densities and gravity: gravity is left out, and the mass of a "
        "ball of diameter d is taken as d^{}",
        bulk_path, *listed.space.dimension));
  add_grains(bodies, bulk, listed);
  // The file does not say on which side of a bar or plate the grains lie. The mean position of the grains determines
  // this side, so the grains must be known before the walls are added.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const ListedGrain& grain : listed.grains)
    middle += grain.position / static_cast<double>(listed.grains.size());
  std::map<std::int64_t, WallSide> walls;
  for (const Body& body : bodies) {
    if (body.is_round() || body.has_corners()) continue;
    if (body.contactor != "JONCx" && body.contactor != "PLANx")
      throw InputError(
          body.place.text(),
          fmt::format("body {} has the contactor {}, expected a disk (DISKx), a sphere "
                      "(SPHER), a polygon (POLYG), a polyhedron (POLYR), a bar (JONCx) or a plate (PLANx)",
                      body.id, body.contactor));
    // Walls that the user gives replace the bars and plates of the file.
    if (options.walls.empty()) walls.emplace(body.id, add_bar(body, middle, listed.space));
  }
  // If no contacts are listed, `listed.contacts` remains absent, and the contacts are found from the geometry. An empty
  // list would mean that no grains touch.
  if (auto contacts = read_lmgc90_contacts((folder / "Vloc_Rloc.INI").string(), walls); !contacts.empty())
    listed.contacts = std::move(contacts);
  return assemble(std::move(listed), options);
}

}  // namespace floc
