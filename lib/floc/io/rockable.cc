#include "floc/io/rockable.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/io/keyed_line.h"
#include "floc/io/listed_bodies.h"
#include "floc/io/listed_packing.h"
#include "floc/shape/mesh_files.h"
#include "floc/shape/read_shapes.h"

namespace floc {
namespace {

/// The shapes in the file of shapes; the key is the name of the shape. A shape consists of all points whose distance
/// from a vertex, edge or face of the mesh is at most the member `rounding` of the mesh.
using RockableShapes = std::map<std::string, Mesh<3>>;

/// Whether a shape is a sphere, that is, its only vertex is at its centre.
bool is_sphere(const Mesh<3>& shape) {
  return shape.vertices.size() == 1 && shape.vertices.front().isZero(0.0);
}

/// Lines of a text file, without comments and empty lines.
class ConfigurationLines {
 public:
  explicit ConfigurationLines(const std::string& path)
      : path_(path), before_number_(std::make_shared<const std::string>(path + ":")), in_(read_text(path)) {}

  /// Returns the next line, or nothing at the end of the file. The line is valid until the next call.
  std::optional<KeyedLine> next() {
    while (std::getline(in_, text_)) {
      ++number_;
      text_.resize(std::min(text_.find('#'), text_.size()));
      if (KeyedLine line(before_number_, number_, text_); !line.empty()) return line;
    }
    return std::nullopt;
  }
  /// Returns the next line. @param what  contents of the line in messages @throws InputError at the end of the file
  KeyedLine require(const std::string& what) {
    if (std::optional<KeyedLine> line = next()) return *std::move(line);
    throw InputError(path_, "the file ends before " + what);
  }

 private:
  std::string path_;
  std::shared_ptr<const std::string> before_number_;
  std::istringstream in_;
  std::string text_;
  int number_ = 0;
};

RockableShapes read_rockable_shapes(const std::string& path) {
  RockableShapes shapes;
  for (Mesh<3>& mesh : parse_rockable(path, read_text(path))) {
    const std::string name = mesh.name;
    shapes.insert_or_assign(name, std::move(mesh));
  }
  return shapes;
}

/// One body of a configuration.
struct RockableBody {
  FileLine place;
  std::string shape;
  std::int64_t group = 0;
  double scale = 1.0;
  Eigen::Vector3d position;
  Eigen::Quaterniond orientation;
};

/// A configuration: its parameters, bodies and contacts.
struct Configuration {
  std::string shape_file;
  std::int64_t n_driven = 0;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::map<std::int64_t, double> density;  ///< density of each group of bodies
  bool periodic = false;
  std::vector<std::vector<double>> cell;
  std::vector<RockableBody> bodies;
  std::vector<ListedContact> contacts;
};

RockableBody read_body(const KeyedLine& line) {
  RockableBody body;
  body.place = line.file_line();
  body.shape = line.word(0);
  body.group = line.integer(1, "the group");
  body.scale = line.number(3, "the homothety");
  body.position = line.vector(4, "the position");
  const Eigen::Vector3d imaginary = line.vector(14, "the orientation");
  body.orientation =
      Eigen::Quaterniond(line.number(13, "the orientation"), imaginary[0], imaginary[1], imaginary[2])
          .normalized();
  return body;
}

/// Reads an interaction. Its words are i, j, type, two sub-elements, normal (3 numbers), distance, position (3),
/// velocity (3), normal force, tangential force (3), moment on i (3), damping. Older files end with the tangential
/// force. The member rolling_moment of the result is the whole moment.
ListedContact read_interaction(const KeyedLine& line) {
  ListedContact c;
  c.place = line.file_line();
  c.id1 = line.integer(0, "the first body");
  c.id2 = line.integer(1, "the second body");
  constexpr std::int64_t kEdgeEdge = 3;
  const std::int64_t type = line.integer(2, "the type");
  const Eigen::Vector3d to_first = line.vector(5, "the normal");
  c.normal = -to_first;
  c.kind = type == kEdgeEdge ? ContactType::kEdgeEdge : ContactType::kVertexFace;
  c.gap = line.number(8, "dn");
  c.point = line.vector(9, "the position");
  c.force = line.number(15, "fn") * to_first + line.vector(16, "ft");
  constexpr std::size_t kMoment = 19;
  if (line.size() >= kMoment + 3) c.rolling_moment = line.vector(kMoment, "mom");
  return c;
}

Configuration read_configuration(const std::string& path) {
  Configuration out;
  ConfigurationLines lines(path);
  // Number of rows of the section Interactions, if it has just ended.
  std::optional<std::int64_t> n_interactions;
  while (const std::optional<KeyedLine> line = lines.next()) {
    const std::string_view key = line->word(0);
    if (n_interactions && key.find_first_not_of("0123456789") == std::string_view::npos)
      throw InputError(line->file_line().text(),
                       fmt::format("the section Interactions has more than the {} rows that its head states",
                                   *n_interactions));
    n_interactions.reset();
    if (key == "shapeFile" && line->size() > 1) out.shape_file = line->word(1);
    if (key == "nDriven") out.n_driven = line->integer(1, "nDriven");
    if (key == "gravity") out.gravity = line->vector(1, "gravity");
    if (key == "density") out.density[line->integer(1, "the group")] = line->number(2, "density");
    if (key == "usePeriodicCell") out.periodic = line->integer(1, "usePeriodicCell") != 0;
    if (key == "h") {  // the lattice vectors are the columns of the matrix h
      out.cell.assign(3, std::vector<double>(3));
      for (std::size_t k = 0; k < 9; ++k) out.cell[k % 3][k / 3] = line->number(k + 1, "the cell h");
    }
    if (key == "Particles" || key == "Interactions") {
      const bool of_bodies = key == "Particles";
      const std::int64_t n = line->integer(1, std::string(key));
      for (std::int64_t k = 0; k < n; ++k) {
        const KeyedLine row = lines.require(fmt::format("row {} of {}", k + 1, n));
        if (of_bodies)
          out.bodies.push_back(read_body(row));
        else
          out.contacts.push_back(read_interaction(row));
      }
      if (!of_bodies) n_interactions = n;
    }
  }
  if (out.bodies.empty()) throw InputError(path, "the file has no section Particles");
  if (out.n_driven < 0 || out.n_driven > std::ssize(out.bodies))
    throw InputError(path, fmt::format("nDriven is {}, expected a number of bodies from 0 to {}", out.n_driven,
                                       out.bodies.size()));
  return out;
}

/// Adds a wall in place of a driven body whose shape is a flat face perpendicular to an axis. The position of the wall
/// is that of the surface on the side of the point `middle`.
WallSide add_face(const RockableBody& body, const Mesh<3>& shape, const Eigen::Vector3d& middle,
                  ListedSpace& space) {
  constexpr double kThin = 1e-9;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Eigen::Vector3d& vertex : shape.vertices) {
    const Eigen::Vector3d x = body.position + body.scale * (body.orientation * vertex);
    low = low.cwiseMin(x), high = high.cwiseMax(x);
  }
  int axis = 0;
  const double thickness = (high - low).minCoeff(&axis);
  if (shape.vertices.size() < 3 || thickness > kThin * (high - low).maxCoeff())
    throw InputError(body.place.text(), fmt::format("the driven body {} is not a flat face perpendicular to an "
                                                    "axis, expected a wall; or give the walls with --walls",
                                                    body.shape));
  const WallSide wall{axis, body.position[axis] < middle[axis] ? -1 : 1};
  add_wall(wall, low[axis] - wall.side * body.scale * shape.rounding, space);
  return wall;
}

/// Shapes of the bodies in a configuration. A shape is added to the table of shapes of the packing when the first grain
/// with this shape is made.
class Bodies {
 public:
  explicit Bodies(const std::string& path) : path_(path), meshes_(read_rockable_shapes(path)) {}

  const Mesh<3>& mesh(const RockableBody& body) const {
    const auto found = meshes_.find(body.shape);
    if (found != meshes_.end()) return found->second;
    throw InputError(body.place.text(),
                     fmt::format("the shape {} is not in the file of shapes, {}", body.shape, path_));
  }

  /// Returns the index of the shape of a body in the table of shapes of the packing. Adds the shape to the table if it
  /// is new.
  int index(const RockableBody& body, ListedPacking& listed) {
    const auto [at, is_new] = indices_.try_emplace(body.shape, static_cast<int>(listed.shapes.in_3d.size()));
    if (is_new) listed.shapes.in_3d.push_back(make_shape(mesh(body), listed.remarks));
    return at->second;
  }

 private:
  Shape<3> make_shape(const Mesh<3>& mesh, std::vector<std::string>& remarks) const {
    if (is_sphere(mesh)) return round_shape<3>(mesh.rounding);
    const std::string place = fmt::format("{}, shape \"{}\"", path_, mesh.name);
    if (!mesh.is_principal)
      throw InputError(
          place,
          "the shape has no line \"preCompDone y\": expected vertices in coordinates about the centre of "
          "mass and along the principal axes of inertia, as Rockable computes them");
    NamedShape<3> made = shape_of_mesh<3>(place, mesh, {});
    for (const std::string& remark : made.remarks) remarks.push_back(place + ": " + remark);
    return std::move(made.shape);
  }

  std::string path_;
  RockableShapes meshes_;
  std::map<std::string, int> indices_;
};

/// Makes the grains from the bodies that are not driven. If any of these bodies has corners, all grains get shapes,
/// including spheres.
void add_grains(const Configuration& from, Bodies& bodies, ListedPacking& listed) {
  const auto first = from.bodies.begin() + from.n_driven;
  const bool round = std::all_of(first, from.bodies.end(),
                                 [&](const RockableBody& body) { return is_sphere(bodies.mesh(body)); });
  for (auto body = first; body != from.bodies.end(); ++body) {
    const Mesh<3>& mesh = bodies.mesh(*body);
    if (!(body->scale > 0.0 && mesh.rounding > 0.0))
      throw InputError(body->place.text(), fmt::format("homothety = {} and radius = {}, must be positive",
                                                       body->scale, mesh.rounding));
    ListedGrain grain;
    grain.place = body->place;
    grain.id = body - from.bodies.begin();
    grain.position = body->position;
    grain.radius = body->scale * mesh.rounding;
    if (!round)
      set_shape(listed.shapes, bodies.index(*body, listed), body->scale, body->position,
                body->orientation.toRotationMatrix(), grain);
    const auto density = from.density.find(body->group);
    if (density != from.density.end() && mesh.volume > 0.0)
      grain.mass = density->second * mesh.volume * body->scale * body->scale * body->scale;
    listed.grains.push_back(std::move(grain));
  }
}

/// Splits the moment of each contact into a rolling moment and a twisting moment. Moments that the law of a contact
/// does not have are left out, and a sentence says so.
void split_moments(ListedPacking& listed) {
  constexpr double kNoMoment = 1e-9;  // share of the whole moment that counts as rounding
  int n_left_out = 0;
  for (ListedContact& c : *listed.contacts) {
    if (!c.rolling_moment) continue;
    const Law& law = c.wall ? listed.wall_law.value_or(listed.law) : listed.law;
    const Eigen::Vector3d moment = *c.rolling_moment;
    const double twisting = moment.dot(*c.normal);
    const Eigen::Vector3d rolling = moment - twisting * *c.normal;
    c.rolling_moment.reset();
    if (law.has_rolling()) c.rolling_moment = rolling;
    if (law.has_twisting()) c.twisting_moment = twisting;
    const double least = kNoMoment * moment.norm();
    n_left_out +=
        (!law.has_rolling() && rolling.norm() > least) || (!law.has_twisting() && std::abs(twisting) > least);
  }
  if (n_left_out > 0)
    listed.inconsistencies.push_back(fmt::format(
        "{} interactions have moments (mom) that the law does not have, and that are left out: give "
        "rolling and twisting resistance in --law",
        n_left_out));
}

}  // namespace

bool is_rockable(const std::string& path) {
  return begins_with(path, "Rockable ");
}

Imported read_rockable(const std::string& path, const ImportOptions& options) {
  Configuration from = read_configuration(path);
  const std::string shape_path = (std::filesystem::path(path).parent_path() / from.shape_file).string();
  Bodies bodies(shape_path);
  ListedPacking listed = listed_packing(path, options);
  listed.space.place = path;
  listed.space.dimension = 3;
  listed.space.gravity = from.gravity;
  listed.space.cell = from.periodic ? from.cell : std::vector<std::vector<double>>{};
  listed.space.periodic.assign(3, from.periodic);
  listed.space.boundary = "the configuration has no periodic cell and no wall across this axis";
  add_grains(from, bodies, listed);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const ListedGrain& grain : listed.grains)
    middle += grain.position / static_cast<double>(listed.grains.size());
  std::map<std::int64_t, WallSide> walls;
  for (std::int64_t k = 0; k < from.n_driven && options.walls.empty(); ++k) {
    const RockableBody& body = from.bodies[static_cast<std::size_t>(k)];
    walls.emplace(k, add_face(body, bodies.mesh(body), middle, listed.space));
  }
  for (ListedContact& c : from.contacts) name_wall(walls, c);
  if (!from.contacts.empty()) {
    listed.contacts = std::move(from.contacts);
    split_moments(listed);
  }
  return assemble(std::move(listed), options);
}

}  // namespace floc
