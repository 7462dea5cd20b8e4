#include "floc/io/rockable_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <variant>

#include "floc/base/error.h"
#include "floc/io/atomic_file.h"
#include "floc/packing/ball.h"
#include "floc/packing/locate.h"
#include "floc/shape/placed_shape.h"

namespace floc {
namespace {

std::string words(const Vec<3>& v) {
  return fmt::format("{} {} {}", v[0], v[1], v[2]);
}

/// Returns the name, without the folder, of the file of shapes that belongs to a configuration.
std::string shape_file(const std::string& path) {
  return std::filesystem::path(path).filename().replace_extension(".shp").string();
}

/// Checks the name of a configuration, whose file of shapes has the same name with the extension .shp.
/// @throws InputError if the configuration cannot refer to this file, or if both files would be the same
void require_two_files(const std::string& path) {
  const std::string shapes = shape_file(path);
  if (path == "-")
    throw InputError(
        path,
        "a packing of Rockable consists of a configuration and a file of shapes, but standard output is "
        "one file: give the name of a file that ends in .conf");
  if (std::filesystem::path(path).filename() == shapes)
    throw InputError(
        path,
        "the file of shapes, which belongs to the configuration, would have the same name: give the "
        "configuration another extension, such as .conf");
  if (shapes.find_first_of(" \t\n\r\f\v#") != std::string::npos)
    throw InputError(
        path, fmt::format("the configuration names its file of shapes, \"{}\", in one word, but this name has "
                          "a blank or #: give a name without them",
                          shapes));
}

/// Text of one shape: name, radius of rounding, mass properties, vertices, edges and faces.
struct ShapeText {
  std::string name;
  double radius = 0.0, volume = 0.0;
  Vec<3> inertia_over_mass = Vec<3>::Zero();
  std::vector<Vec<3>> vertices;
  std::string edges, faces;
  int n_edges = 0, n_faces = 0;

  std::string text() const {
    Vec<3> low = vertices.front(), high = low;
    for (const Vec<3>& v : vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    std::string out = fmt::format("<\nname {}\nradius {}\npreCompDone y\nvolume {}\nI/m {}\n", name, radius,
                                  volume, words(inertia_over_mass));
    out += fmt::format("obb.extent {}\nobb.center {}\nobb.e1 1 0 0\nobb.e2 0 1 0\nobb.e3 0 0 1\n",
                       words(0.5 * (high - low) + Vec<3>::Constant(radius)), words(0.5 * (low + high)));
    out += fmt::format("OBBtreeLevel 0\nposition 0 0 0\norientation 1 0 0 0\nMCnstep 10000\nnv {}\n",
                       vertices.size());
    for (const Vec<3>& v : vertices) out += words(v) + "\n";
    return out + fmt::format("ne {}\n{}nf {}\n{}>\n", n_edges, edges, n_faces, faces);
  }
};

ShapeText text_of_ball() {
  const double volume = Ball<3>{1.0}.volume();
  return {"Sphere", 1.0, volume, Vec<3>::Constant(0.4), {Vec<3>::Zero()}, "", "", 0, 0};
}

ShapeText text_of(const Shape<3>& shape, std::size_t index, const std::string& path) {
  if (!(shape.rounding > 0.0))
    throw InputError(path, fmt::format("shape {} has sharp corners, but the shapes of Rockable are rounded; "
                                       "use a scene with grains.shape.rounding",
                                       index));
  ShapeText out{fmt::format("Shape{}", index),
                shape.rounding,
                shape.volume,
                shape.inertia / shape.volume,
                shape.vertices,
                "",
                "",
                shape.n_edges(),
                shape.n_faces()};
  if (shape.is_round()) out.vertices = {Vec<3>::Zero()};
  if (shape.n_vertices() == 2) out.edges = "0 1\n", out.n_edges = 1;
  for (const ShapeEdge& edge : shape.edges) out.edges += fmt::format("{} {}\n", edge.from, edge.to);
  for (int f = 0; f < shape.n_faces(); ++f)
    out.faces += fmt::format("{} {}\n", shape.loop(f).size(), fmt::join(shape.loop(f), " "));
  return out;
}

/// Returns the shape of a plate perpendicular to an axis: a rectangle that covers the cell.
ShapeText text_of_plate(const Packing<3>& packing, int axis, double radius) {
  const Vec<3> sides = packing.cell.matrix.diagonal();
  const Vec<3> one = sides[(axis + 1) % 3] * Vec<3>::Unit((axis + 1) % 3),
               other = sides[(axis + 2) % 3] * Vec<3>::Unit((axis + 2) % 3);
  return {fmt::format("Plate{}", "XYZ"[axis]),
          radius,
          1.0,
          Vec<3>::Ones(),
          {one + other, other - one, -one - other, one - other},
          "0 1\n1 2\n2 3\n3 0\n",
          "4 0 1 2 3\n",
          4,
          1};
}

/// Groups of bodies whose densities are equal within rounding. In Rockable, each group has one density.
class DensityGroups {
 public:
  int group(double density) {
    constexpr double kSameDensity = 1e-14;
    const auto at = groups_.lower_bound(density * (1.0 - kSameDensity));
    if (at != groups_.end() && at->first <= density * (1.0 + kSameDensity)) return at->second;
    const int next = static_cast<int>(groups_.size()) + 1;
    return groups_.emplace(density, next).first->second;
  }
  std::string text() const {
    std::string out = "density 0 1\n";
    for (const auto& [density, group] : groups_) out += fmt::format("density {} {}\n", group, density);
    return out;
  }

 private:
  std::map<double, int> groups_;
};

/// Features of a body nearest to a point of its core (the body without its rounding).
struct NearestFeatures {
  int vertex = 0, edge = 0, face = 0;
  double to_vertex = 0.0, to_edge = std::numeric_limits<double>::infinity();  ///< distances (length)
};

double distance_to_segment(const Vec<3>& x, const Vec<3>& from, const Vec<3>& to) {
  const Vec<3> along = to - from;
  const double share = std::clamp((x - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - from - share * along).norm();
}

NearestFeatures nearest_features(const PlacedShape<3>& body, const Vec<3>& point) {
  const Shape<3>& shape = *body.shape;
  const Vec<3> x = body.rotation.transpose() * (point - body.position) / body.scale;
  NearestFeatures out;
  out.to_vertex = (x - core_vertex<3>(shape, 0)).norm();
  for (int v = 1; v < shape.n_vertices(); ++v)
    if (const double far = (x - shape.vertices[v]).norm(); far < out.to_vertex)
      out.to_vertex = far, out.vertex = v;
  const auto try_edge = [&](int edge, int from, int to) {
    const double far = distance_to_segment(x, shape.vertices[from], shape.vertices[to]);
    if (far < out.to_edge) out.to_edge = far, out.edge = edge;
  };
  for (int e = 0; e < shape.n_edges(); ++e) try_edge(e, shape.edges[e].from, shape.edges[e].to);
  if (shape.n_vertices() == 2) try_edge(0, 0, 1);
  double most = -std::numeric_limits<double>::infinity();
  for (int f = 0; f < shape.n_faces(); ++f)
    if (const double height = shape.normals[f].dot(x) - shape.offsets[f]; height > most)
      most = height, out.face = f;
  out.to_vertex *= body.scale;
  out.to_edge *= body.scale;
  return out;
}

/// Types of interactions of Rockable. In types 1 and 2, the vertex belongs to the first body.
enum class RockableType { kVertexVertex, kVertexEdge, kVertexFace, kEdgeEdge };

/// Two features that meet at a contact point. Rockable computes the point anew from these features.
struct MeetingFeatures {
  RockableType type = RockableType::kVertexVertex;
  int of_first = 0, of_second = 0;
  bool swapped = false;  ///< whether the second grain of the contact is the first body of the interaction
};

/// Returns the features of two bodies that meet at a contact point.
/// @param on_first  core point of the first body at the contact  @param on_second  that of the second body
MeetingFeatures meeting_features(const PlacedShape<3>& first, const Vec<3>& on_first,
                                 const PlacedShape<3>& second, const Vec<3>& on_second) {
  /// A core point counts as a point of a vertex or edge if its distance from it, divided by the smaller radius, is at
  /// most this number. Normals of contacts are accurate to 1e-4 radians.
  constexpr double kOnFeature = 1e-3;
  const double near = kOnFeature * std::min(first.outer_radius(), second.outer_radius());
  const NearestFeatures a = nearest_features(first, on_first), b = nearest_features(second, on_second);
  if (a.to_vertex <= near && b.to_vertex <= near)
    return {RockableType::kVertexVertex, a.vertex, b.vertex, false};
  if (a.to_vertex <= near && b.to_edge <= near) return {RockableType::kVertexEdge, a.vertex, b.edge, false};
  if (b.to_vertex <= near && a.to_edge <= near) return {RockableType::kVertexEdge, b.vertex, a.edge, true};
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double first_on_face = second.shape->n_faces() > 0 ? a.to_vertex : kNone,
               second_on_face = first.shape->n_faces() > 0 ? b.to_vertex : kNone,
               crossed = std::max(a.to_edge, b.to_edge);
  if (crossed < std::min(first_on_face, second_on_face))
    return {RockableType::kEdgeEdge, a.edge, b.edge, false};
  if (first_on_face <= second_on_face && first_on_face < kNone)
    return {RockableType::kVertexFace, a.vertex, b.face, false};
  if (second_on_face < kNone) return {RockableType::kVertexFace, b.vertex, a.face, true};
  return {RockableType::kVertexVertex, a.vertex, b.vertex, false};
}

/// Text of the configuration of Rockable for a packing: the bodies and the interactions.
class ConfigurationText {
 public:
  ConfigurationText(const Packing<3>& packing, std::string path) : packing_(packing), path_(std::move(path)) {
    require_expressible();
    for (std::size_t w = 0; w < packing.walls.size(); ++w)
      if (!packing.walls[w].open) plates_.push_back(packing.grains.size() + static_cast<int>(w));
    const std::vector<double>& radius = packing.grains.radius;
    plate_radius_ = 0.1 * *std::min_element(radius.begin(), radius.end());
  }

  std::string shapes() const {
    std::string out;
    if (packing_.grains.are_round()) out += text_of_ball().text();
    for (std::size_t s = 0; !packing_.grains.are_round() && s < packing_.grains.shapes->size(); ++s)
      out += text_of((*packing_.grains.shapes)[s], s, path_).text();
    for (int axis = 0; axis < 3; ++axis)
      if (std::ranges::any_of(plates_, [&](int body) { return packing_.wall(body).axis == axis; }))
        out += text_of_plate(packing_, axis, plate_radius_).text();
    return out;
  }

  std::string configuration() const {
    DensityGroups groups;
    std::string bodies;
    for (const int body : plates_) bodies += plate(packing_.wall(body));
    for (int i = 0; i < packing_.grains.size(); ++i) bodies += grain(i, groups);
    std::string out = "Rockable 29-11-2018\nt 0\n" + groups.text();
    out += fmt::format("gravity {}\n", words(packing_.gravity));
    if (packing_.walls.empty()) {
      out += "usePeriodicCell 1\nh";  // the lattice vectors are the columns of h
      for (int a = 0; a < 3; ++a) out += " " + words(packing_.cell.matrix.col(a));
      out += "\n";
    }
    out += fmt::format("nDriven {}\nshapeFile {}\nprecision 17\nParticles {}\n", plates_.size(),
                       shape_file(path_), plates_.size() + packing_.grains.radius.size());
    out += bodies + fmt::format("Interactions {}\n", packing_.contacts.size());
    for (const Contact<3>& c : packing_.contacts) out += interaction(c);
    return out;
  }

 private:
  void require_expressible() const {
    const std::vector<Wall<3>>& walls = packing_.walls;
    for (int axis = 0; axis < 3 && !walls.empty(); ++axis)
      if (!between_walls(walls, axis))
        throw InputError(path_,
                         fmt::format("the packing is periodic along {} and not along other axes: a "
                                     "configuration of Rockable is periodic along all axes or along none",
                                     "xyz"[axis]));
    for (const Contact<3>& c : packing_.contacts)
      if (c.bonded || c.distant)
        throw InputError(
            path_,
            "the packing has contacts that act across gaps, which a configuration of Rockable cannot contain");
    if (!walls.empty()) return;
    for (const Contact<3>& c : packing_.contacts)
      if (!(packing_.cell.reduced(branch(packing_, c)).cwiseAbs().maxCoeff() < 0.5))
        throw InputError(
            path_, fmt::format("grain {} touches an image of grain {} that is not the nearest one, which a "
                               "configuration of Rockable cannot contain: the cell is too small",
                               packing_.grains.name(c.i), packing_.grains.name(c.j)));
  }

  /// Returns the line of a body: name of the shape, group, cluster, homothety (scale), position, velocity,
  /// acceleration, orientation, angular velocity, angular acceleration.
  static std::string body(const std::string& shape, int group, double scale, const Vec<3>& position,
                          const Vec<3>& velocity, const Eigen::Quaterniond& q, const Vec<3>& spin) {
    return fmt::format("{} {} 0 {} {} {} 0 0 0 {} {} {} {} {} 0 0 0\n", shape, group, scale, words(position),
                       words(velocity), q.w(), q.x(), q.y(), q.z(), words(spin));
  }

  std::string plate(const Wall<3>& wall) const {
    Vec<3> at = Vec<3>::Zero();
    for (const Wall<3>& other : packing_.walls) at[other.axis] += 0.5 * other.position;
    at[wall.axis] = wall.position + wall.side * plate_radius_;
    return body(fmt::format("Plate{}", "XYZ"[wall.axis]), 0, 1.0, at, wall.velocity * Vec<3>::Unit(wall.axis),
                Eigen::Quaterniond::Identity(), Vec<3>::Zero());
  }

  std::string grain(int i, DensityGroups& groups) const {
    const Grains<3>& g = packing_.grains;
    const double scale = g.are_round() ? g.radius[i] : g.scale[i];
    const std::string shape = g.are_round() ? "Sphere" : fmt::format("Shape{}", g.shape[i]);
    const double volume = g.are_round() ? Ball<3>{1.0}.volume() : (*g.shapes)[g.shape[i]].volume;
    return body(shape, groups.group(g.mass[i] / (volume * scale * scale * scale)), scale, g.position[i],
                g.velocity[i], g.orientation[i], g.angular_velocity[i]);
  }

  int body_of(int index) const {
    if (!packing_.is_wall(index)) return index + static_cast<int>(plates_.size());
    return static_cast<int>(std::ranges::find(plates_, index) - plates_.begin());
  }

  /// Returns the features that meet at a contact. A grain touches the face of a plate with a vertex. The contact point
  /// lies midway between the surfaces, and the core points below the surfaces by the radii of rounding.
  MeetingFeatures features(const Contact<3>& c) const {
    const Grains<3>& g = packing_.grains;
    const bool on_plate = packing_.is_wall(c.j);
    if (g.are_round()) return {on_plate ? RockableType::kVertexFace : RockableType::kVertexVertex, 0, 0, false};
    const PlacedShape<3> first = g.placed(c.i);
    const Vec<3> point = g.position[c.i] + c.arm_i;
    const Vec<3> on_first = point - (0.5 * c.gap + first.rounding()) * c.normal;
    if (on_plate) return {RockableType::kVertexFace, nearest_features(first, on_first).vertex, 0, false};
    PlacedShape<3> second = g.placed(c.j);
    second.position = point - c.arm_j;
    return meeting_features(first, on_first, second, point + (0.5 * c.gap + second.rounding()) * c.normal);
  }

  /// Returns the line of an interaction: i, j, type, feature of i, feature of j, normal from j to i, gap, position,
  /// velocity, normal force, tangential force on i, moment, damping.
  std::string interaction(const Contact<3>& c) const {
    const MeetingFeatures meet = features(c);
    const double sign = meet.swapped ? -1.0 : 1.0;
    const int i = meet.swapped ? c.j : c.i, j = meet.swapped ? c.i : c.j;
    const Vec<3> point = packing_.grains.position[i] + (meet.swapped ? c.arm_j : c.arm_i);
    return fmt::format("{} {} {} {} {} {} {} {} 0 0 0 {} {} {} 0\n", body_of(i), body_of(j),
                       static_cast<int>(meet.type), meet.of_first, meet.of_second, words(-sign * c.normal),
                       c.gap, words(point), c.normal_force, words(sign * c.shear_force),
                       words(sign * spring_moment(c)));
  }

  const Packing<3>& packing_;
  std::string path_;
  std::vector<int>
      plates_;  ///< for each wall that is not an open end, the index by which contacts refer to the wall
  double plate_radius_ = 0.0;
};

}  // namespace

void write_rockable(const std::string& path, const AnyState& any) {
  require_two_files(path);
  const auto* state = std::get_if<State<3>>(&any);
  if (state == nullptr)
    throw InputError(path, "the packing is two-dimensional, but the bodies of Rockable are three-dimensional");
  const ConfigurationText text(state->packing, path);
  const std::string shapes = text.shapes(), configuration = text.configuration();
  write_bytes_atomically((std::filesystem::path(path).parent_path() / shape_file(path)).string(), shapes);
  write_bytes_atomically(path, configuration);
}

}  // namespace floc
