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
#include "floc/io/listed_points.h"
#include "floc/io/rockable_shapes.h"
#include "floc/shape/mesh_files.h"

namespace floc {
namespace {

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
  std::string periodic_place;  ///< line of usePeriodicCell, for messages
  std::vector<std::vector<double>> cell;
  std::vector<RockableBody> bodies;
  std::vector<ListedContact> contacts;
};

RockableBody read_body(const KeyedLine& line) {
  constexpr double kLeastQuaternion = 1e-6;  // a shorter quaternion has no direction within rounding
  RockableBody body;
  body.place = line.file_line();
  body.shape = line.word(0);
  body.group = line.integer(1, "the group");
  body.scale = line.number(3, "the homothety");
  body.position = line.vector(4, "the position");
  const Eigen::Vector3d imaginary = line.vector(14, "the orientation");
  const Eigen::Quaterniond turn(line.number(13, "the orientation"), imaginary[0], imaginary[1], imaginary[2]);
  if (!(turn.norm() > kLeastQuaternion))
    throw InputError(
        line.place(),
        fmt::format("the orientation is the quaternion {} {} {} {}, expected a quaternion of length 1",
                    turn.w(), turn.x(), turn.y(), turn.z()));
  body.orientation = turn.normalized();
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
  if (type < 0 || type > kEdgeEdge)
    throw InputError(line.place(),
                     fmt::format("the type of the interaction is {}, expected 0 (two vertices), 1 (vertex and "
                                 "edge), 2 (vertex and face) or 3 (two edges)",
                                 type));
  const Eigen::Vector3d to_first = unit_normal(c.place, line.vector(5, "the normal"));
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
    if (key == "usePeriodicCell") {
      out.periodic = line->integer(1, "usePeriodicCell") != 0;
      out.periodic_place = line->place();
    }
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

/// Checks that a periodic configuration has a cell, and no walls, unless the user gives the cell or the walls.
/// @throws InputError naming the line of usePeriodicCell
void require_one_boundary(const Configuration& from, const ImportOptions& options) {
  if (!from.periodic) return;
  if (from.cell.empty() && options.cell.empty())
    throw InputError(
        from.periodic_place,
        "usePeriodicCell is 1, but the configuration has no cell: expected a line h with nine numbers, "
        "or --cell");
  if (from.n_driven > 0 && options.walls.empty())
    throw InputError(
        from.periodic_place,
        fmt::format("usePeriodicCell is 1, but {} bodies are driven (nDriven), which floc reads as "
                    "walls: a packing of Rockable is either periodic or between walls; give the walls "
                    "with --walls",
                    from.n_driven));
}

/// Says which grains have no mass, because the file gives no density of their group or no volume of their shape.
void add_remark_on_densities(const Configuration& from, ListedPacking& listed) {
  const auto without = std::ranges::count_if(listed.grains, [](const ListedGrain& g) { return !g.mass; });
  if (without == 0 || !from.gravity.isZero(0.0)) return;  // assemble() says so of grains with weights
  listed.remarks.push_back(fmt::format(
      "there is no mass for {} of {} grains, as the configuration gives no density of their group, or "
      "the file of shapes no volume: the mass of a ball of diameter d is taken as d^3",
      without, listed.grains.size()));
}

/// Makes the grains from the bodies that are not driven. If any of these bodies has corners, all grains get shapes,
/// including spheres.
void add_grains(const Configuration& from, RockableShapes& bodies, ListedPacking& listed) {
  const auto first = from.bodies.begin() + from.n_driven;
  const bool round = std::all_of(first, from.bodies.end(), [&](const RockableBody& body) {
    return is_sphere(bodies.mesh(body.place, body.shape));
  });
  for (auto body = first; body != from.bodies.end(); ++body) {
    const Mesh<3>& mesh = bodies.mesh(body->place, body->shape);
    if (!(body->scale > 0.0 && mesh.rounding > 0.0))
      throw InputError(body->place.text(), fmt::format("homothety = {} and radius = {}, must be positive",
                                                       body->scale, mesh.rounding));
    ListedGrain grain;
    grain.place = body->place;
    grain.id = body - from.bodies.begin();
    grain.position = body->position;
    grain.radius = body->scale * mesh.rounding;
    if (!round)
      set_shape(listed.shapes, bodies.index(body->place, body->shape, listed), body->scale, body->position,
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
  require_one_boundary(from, options);
  const std::string shape_path = (std::filesystem::path(path).parent_path() / from.shape_file).string();
  RockableShapes bodies(shape_path);
  ListedPacking listed = listed_packing(path, options);
  listed.space.place = path;
  listed.space.dimension = 3;
  listed.space.gravity = from.gravity;
  listed.space.cell = from.periodic ? from.cell : std::vector<std::vector<double>>{};
  listed.space.periodic.assign(3, from.periodic);
  listed.space.boundary = "the configuration has no periodic cell and no wall across this axis";
  add_grains(from, bodies, listed);
  add_remark_on_densities(from, listed);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const ListedGrain& grain : listed.grains)
    middle += grain.position / static_cast<double>(listed.grains.size());
  std::map<std::int64_t, WallSide> walls;
  for (std::int64_t k = 0; k < from.n_driven && options.walls.empty(); ++k) {
    const RockableBody& body = from.bodies[static_cast<std::size_t>(k)];
    walls.emplace(k, add_face(body, bodies.mesh(body.place, body.shape), middle, listed.space));
  }
  for (ListedContact& c : from.contacts) name_wall(walls, c);
  if (!from.contacts.empty()) {
    listed.contacts = std::move(from.contacts);
    split_moments(listed);
  }
  return assemble(std::move(listed), options);
}

}  // namespace floc
