#include "floc/io/lmgc90.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/io/keyed_line.h"
#include "floc/io/listed_bodies.h"
#include "floc/io/listed_packing.h"
#include "floc/packing/ball.h"
#include "floc/shape/convex_hull.h"
#include "floc/shape/read_shapes.h"

namespace floc {
namespace {

namespace fs = std::filesystem;

/// Reads a text file line by line. The current line is a view of the text.
class DatFile {
 public:
  explicit DatFile(const std::string& path)
      : before_number_(std::make_shared<const std::string>(path + ":")), text_(read_text(path)), rest_(text_) {}

  /// Advances to the next line that is neither empty nor a comment. @return whether there is one
  bool next() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number_;
      if (!trimmed(line_).empty() && !trimmed(line_).starts_with('!')) return true;
    }
    return false;
  }
  std::string_view line() const { return line_; }
  std::vector<std::string_view> words() const { return words_of(line_); }
  FileLine file_line() const { return {before_number_, number_}; }
  std::string place() const { return file_line().text(); }

  bool has(std::string_view key) const { return line_.find(key) != std::string_view::npos; }

  /// Returns the number that follows `key` and an optional equals sign. As in output of Fortran, the exponent may begin
  /// with D, and the blank before the number may be missing.
  double number(std::string_view key) const {
    const std::size_t at = line_.find(key);
    if (at == std::string_view::npos) throw InputError(place(), fmt::format("the line has no \"{}\"", key));
    const std::string_view after = line_.substr(at + key.size());
    const std::vector<std::string_view> rest =
        words_of(after.substr(std::min(after.find_first_not_of(" ="), after.size())));
    std::string text(rest.empty() ? "" : rest.front());
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
    if (const auto value = parse_number<double>(text)) return *value;
    throw InputError(place(), fmt::format("{} is \"{}\", expected a finite number", key,
                                          rest.empty() ? std::string_view("missing") : rest.front()));
  }

 private:
  std::shared_ptr<const std::string> before_number_;
  std::string text_;
  std::string_view rest_;
  std::string_view line_;
  int number_ = 0;
};

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

/// Adds the displacements in the file DOF.INI to the positions of the bodies.
void add_displacements(const std::string& path, std::vector<Body>& bodies) {
  if (!fs::exists(path)) return;
  std::map<std::int64_t, std::size_t> index;
  for (std::size_t b = 0; b < bodies.size(); ++b) index[bodies[b].id] = b;
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
    } else if (body && file.has("X(1)=")) {
      body->position.head<2>() += Eigen::Vector2d(file.number("X(1)="), file.number("X(2)="));
      (body->spatial ? body->position[2] : body->angle) += file.number("X(3)=");
    } else if (body) {
      read_axis(file, *body);
    }
  }
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

/// Reads the contacts in the file Vloc_Rloc.INI. LMGC90 lists all neighbouring pairs; pairs with a gap and without
/// force are left out.
std::vector<ListedContact> read_contacts(const std::string& path,
                                         const std::map<std::int64_t, WallSide>& walls) {
  std::vector<ListedContact> contacts;
  if (!fs::exists(path)) return contacts;
  DatFile file(path);
  ListedContact c;
  Eigen::Vector3d local =
      Eigen::Vector3d::Zero();  // components of the force along the tangent t, the normal n and the tangent s
  Eigen::Vector3d t = Eigen::Vector3d::Zero(), n = t, s = t;
  double gap = 0.0;
  bool open = false, spatial = false, framed = false, forced = false;
  const auto finish = [&] {
    if (!open) return;
    if (!framed)
      throw InputError(c.place.text(), "the contact has no normal, expected a line n(1)= n(2)= n(3)=");
    if (!forced)
      throw InputError(c.place.text(), "the contact has no force, expected a line rlt/H rln/H rls/H");
    open = false;
    if (local.isZero(0.0) && gap > 0.0) return;
    if (!spatial) t = Eigen::Vector3d(n[1], -n[0], 0.0);
    c.force = local[0] * t + local[1] * n + local[2] * s;
    c.normal = -n;  // n points to the candidate, the first body
    c.gap = gap;
    name_wall(walls, c);
    contacts.push_back(c);
  };
  while (file.next()) {
    const auto words = file.words();
    // No line marks the end of a contact. A contact is complete when the next contact begins, or when the file ends.
    if (words[0] == "$icdan") {
      finish();
      c = ListedContact{};
      t.setZero(), n.setZero(), s.setZero(), local.setZero();
      gap = 0.0;
      framed = forced = false;
      c.place = file.file_line();
    } else if (words[0] == "RBDY2" || words[0] == "RBDY3") {
      spatial = words[0] == "RBDY3";
      std::vector<std::int64_t> ids;
      for (std::size_t k = 0; k + 1 < words.size(); ++k)
        if (words[k] == words[0])
          if (const auto id = parse_number<std::int64_t>(words[k + 1])) ids.push_back(*id);
      if (ids.size() != 2)
        throw InputError(file.place(), fmt::format("the contact has {} bodies, expected two", ids.size()));
      c.id1 = ids[0], c.id2 = ids[1];
      open = true;
    } else if (file.has("rln/H")) {
      // LMGC90 computes impulses. Each number in this line is an impulse divided by the time step H, which is a force.
      forced = true;
      local = {file.number("rlt/H"), file.number("rln/H"), spatial ? file.number("rls/H") : 0.0};
    } else if (file.has("gapTT")) {
      gap = file.number("gapTT");
    } else if (file.has("coo1=")) {
      c.point = {file.number("coo1="), file.number("coo2="), spatial ? file.number("coo3=") : 0.0};
    } else {
      // In 3D, the tangents t and s must be read, because the normal n does not determine them. In 2D, finish()
      // computes t from n.
      for (const auto& [name, vector] : {std::pair{"t", &t}, std::pair{"n", &n}, std::pair{"s", &s}})
        if (file.has(fmt::format("{}(1)=", name)))
          for (int a = 0; a < 3; ++a) (*vector)[a] = file.number(fmt::format("{}({})=", name, a + 1));
      framed = framed || file.has("n(1)=");
    }
  }
  finish();
  return contacts;
}

/// Adds the shape of a body to the shapes of the packing. @return index of the shape
int add_shape(const Body& body, ListedPacking& listed) {
  const std::string place = body.place.text();
  if (!body.spatial) {
    if (body.is_round()) {
      listed.shapes.in_2d.push_back(round_shape<2>(body.radius));
    } else {
      Mesh<2> mesh;
      for (const Eigen::Vector3d& vertex : body.vertices) mesh.vertices.emplace_back(vertex.head<2>());
      listed.shapes.in_2d.push_back(shape_of_mesh<2>(place, mesh, {}).shape);
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
    listed.shapes.in_3d.push_back(shape_of_mesh<3>(place, mesh, {}).shape);
  }
  return static_cast<int>(listed.shapes.in_3d.size()) - 1;
}

/// Makes the grains from the disks, spheres, polygons and polyhedra. If any body is a polygon or polyhedron, all grains
/// get shapes, including disks and spheres.
void add_grains(const std::vector<Body>& bodies, const Bulk& bulk, ListedPacking& listed) {
  const bool round = std::none_of(bodies.begin(), bodies.end(), [](const Body& b) { return b.has_corners(); });
  for (const Body& body : bodies) {
    if (!body.is_round() && !body.has_corners()) continue;
    ListedGrain grain;
    grain.place = body.place;
    grain.id = body.id;
    grain.position = body.position;
    grain.radius = body.radius;
    if (body.is_round() && !(grain.radius > 0.0))
      throw InputError(body.place.text(), fmt::format("byrd = {}, must be positive", grain.radius));
    if (!round) set_shape(listed.shapes, add_shape(body, listed), 1.0, body.position, body.turn(), grain);
    const auto density = bulk.density.find(body.material);
    if (density != bulk.density.end())
      grain.mass = density->second *
                   (body.spatial ? Ball<3>{body.mean_radius}.volume() : Ball<2>{body.mean_radius}.volume());
    if (grain.mass && !(*grain.mass > 0.0))
      throw InputError(body.place.text(), fmt::format("the mass is {}, must be positive: avrd = {}, Umas = {}",
                                                      *grain.mass, body.mean_radius, density->second));
    listed.grains.push_back(std::move(grain));
  }
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
  const Bulk bulk = read_bulk((folder / "BULK_BEHAV.DAT").string());
  ListedPacking listed = listed_packing(bodies_path, options);
  listed.space.place = bodies_path;
  listed.space.dimension = bodies.front().spatial ? 3 : 2;
  listed.space.gravity = bulk.gravity;
  listed.space.periodic = {false, false, false};
  listed.space.boundary =
      "files of LMGC90 contain no periodic directions, and there is no wall across this axis";
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
  if (auto contacts = read_contacts((folder / "Vloc_Rloc.INI").string(), walls); !contacts.empty())
    listed.contacts = std::move(contacts);
  return assemble(std::move(listed), options);
}

}  // namespace floc
