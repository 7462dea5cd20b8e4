#include "floc/io/mercurydpm.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_text.h"
#include "floc/io/keyed_line.h"
#include "floc/packing/ball.h"

namespace floc {
namespace {

/// Components of a unit normal or of a lattice vector below this value count as rounding errors.
constexpr double kAligned = 1e-9;

/// Content of a restart file: the header lines, and the lines of each section. A section begins with a line that
/// contains its name and its number of lines.
class RestartFile {
 public:
  explicit RestartFile(const std::string& path)
      : path_(path),
        file_(std::make_shared<const std::string>(path + ":")),
        text_(read_text(path)),
        rest_(text_) {
    for (std::optional<Line> line; (line = next());) {
      if (section_name(*line).empty())
        header_.push_back(*line);
      else
        read_section(*line);
    }
  }

  bool has(const std::string& section) const { return sections_.contains(section); }

  /// Calls a function with each line of a section; does nothing if the file does not have the section.
  template <class Function>
  void for_each(const std::string& section, const Function& function) const {
    const auto found = sections_.find(section);
    if (found == sections_.end()) return;
    for (const Line& line : found->second) function(keyed(line));
  }

  /// Returns the first header line that contains a key, or nothing.
  std::optional<KeyedLine> header(const std::string& key) const {
    for (const Line& line : header_)
      if (KeyedLine words = keyed(line); words.has(key)) return words;
    return std::nullopt;
  }

 private:
  struct Line {
    int number;
    std::string_view text;
  };

  KeyedLine keyed(const Line& line) const { return {file_, line.number, line.text}; }

  std::optional<Line> next() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const Line line{++number_, rest_.substr(0, end)};
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return line;
  }

  /// Returns the name of the section that begins in a line; empty if no section begins there.
  static std::string_view section_name(const Line& line) {
    constexpr std::array<std::string_view, 5> kNames = {"Species", "Walls", "Boundaries", "Particles",
                                                        "Interactions"};
    const std::string_view text = trimmed(line.text);
    const std::size_t end = text.find(' ');
    if (end == std::string_view::npos ||
        std::find(kNames.begin(), kNames.end(), text.substr(0, end)) == kNames.end())
      return "";
    return text.substr(0, end);
  }

  void read_section(const Line& head) {
    const KeyedLine words = keyed(head);
    const std::string name(section_name(head));
    const std::int64_t n = words.integer(1, "the number of " + name);
    if (sections_.contains(name))
      throw InputError(words.place(), fmt::format("the section {} occurs twice", name));
    std::vector<Line>& lines = sections_[name];
    for (std::int64_t k = 0; k < n; ++k) {
      const std::optional<Line> line = next();
      if (!line || trimmed(line->text).empty() || !section_name(*line).empty())
        throw InputError(line ? keyed(*line).place() : path_,
                         fmt::format("the section {} ends after {} of {} lines", name, k, n));
      lines.push_back(*line);
    }
  }

  std::string path_;
  std::shared_ptr<const std::string> file_;
  std::string text_;
  std::string_view rest_;  ///< part of the text that has not been split into lines
  int number_ = 0;
  std::vector<Line> header_;
  std::map<std::string, std::vector<Line>> sections_;
};

/// Returns the axis that is parallel to a vector; nothing if no axis is parallel to it.
std::optional<int> axis_of(const Eigen::Vector3d& v) {
  for (int a = 0; a < 3; ++a) {
    Eigen::Vector3d rest = v;
    rest[a] = 0.0;
    if (rest.norm() <= kAligned * v.norm() && v[a] != 0.0) return a;
  }
  return std::nullopt;
}

/// Returns the normal of a wall, which points away from the grains. Recent files contain the rotation from the x axis
/// to the normal; older files contain the vector of the normal.
Eigen::Vector3d wall_normal(const KeyedLine& line) {
  if (line.has("normal")) return line.vector("normal");
  const Eigen::Vector3d imaginary = line.vector(line.position("orientation") + 2, "orientation");
  const Eigen::Quaterniond q(line.number("orientation"), imaginary[0], imaginary[1], imaginary[2]);
  return q.normalized() * Eigen::Vector3d::UnitX();
}

/// Reads the walls of a file.
/// @return for each wall of the file, the end of the axis at which the wall lies; absent if the wall is left out. For
/// example, a wall across z is left out in a packing of disks
std::vector<std::optional<WallSide>> read_walls(const RestartFile& file, bool replaced, int dimension,
                                                ListedSpace& space) {
  std::vector<std::optional<WallSide>> walls;
  file.for_each("Walls", [&](const KeyedLine& line) {
    walls.emplace_back();
    const bool plane = line.word(0) == "InfiniteWall" && (line.has("orientation") || line.has("normal"));
    const Eigen::Vector3d normal = plane ? wall_normal(line) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    const auto axis = axis_of(normal);
    if (!axis && replaced) return;
    if (!axis)
      throw InputError(line.place(),
                       fmt::format("the wall {} is not a plane perpendicular to an axis, expected an "
                                   "InfiniteWall along x, y or z; or give the walls with --walls",
                                   line.word(0)));
    if (*axis >= dimension) return;
    const WallSide side{*axis, normal[*axis] > 0.0 ? 1 : -1};
    walls.back() = side;
    if (replaced) return;
    // A recent file contains a point on the plane; an older file contains the distance of the plane from the origin,
    // along the normal.
    const double position =
        line.has("normal") ? side.side * line.number("position") : line.vector("position")[*axis];
    ListedEnds& ends = ends_along(*axis, space);
    std::optional<double>& end = side.side < 0 ? ends.low : ends.high;
    if (end)
      throw InputError(line.place(),
                       fmt::format("the wall {} at {:.6g} is the second wall with this name, after "
                                   "the wall at {:.6g}: expected one wall at each end of an axis",
                                   side.name(), position, *end));
    end = position;
  });
  return walls;
}

Eigen::Vector3d shift_of(const KeyedLine& line, const Eigen::Vector3d& normal) {
  if (line.has("shift")) return line.vector("shift");
  const bool recent = line.has("distanceLeft");
  return (line.number(recent ? "distanceRight" : "position_right") -
          line.number(recent ? "distanceLeft" : "position_left")) *
         normal;
}

void add_periodic_boundary(const KeyedLine& line, ListedSpace& space) {
  const Eigen::Vector3d normal = line.vector("normal");
  const auto axis = axis_of(normal);
  if (!axis)
    throw InputError(line.place(), fmt::format("the normal of the boundary is ({}, {}, {}), expected an axis",
                                               normal[0], normal[1], normal[2]));
  const Eigen::Vector3d shift = shift_of(line, normal);
  space.cell[static_cast<std::size_t>(*axis)] = {shift[0], shift[1], shift[2]};
  space.periodic[static_cast<std::size_t>(*axis)] = true;
  space.origin[*axis] =
      line.number(line.has("distanceLeft") ? "distanceLeft" : "position_left") * normal[*axis];
}

/// Sets the cell from a Lees-Edwards boundary. The second lattice vector is displaced along x by the shift of the
/// boundary.
void add_lees_edwards(const KeyedLine& line, ListedSpace& space) {
  const double left = line.number("left"), down = line.number("down");
  const double length = line.number("right") - left;
  space.cell[0] = {length, 0.0, 0.0};
  space.cell[1] = {std::remainder(line.number("shift"), length), line.number("up") - down, 0.0};
  space.periodic[0] = space.periodic[1] = true;
  space.origin.head<2>() << left, down;
}

void read_boundaries(const RestartFile& file, ListedPacking& listed) {
  ListedSpace& space = listed.space;
  file.for_each("Boundaries", [&](const KeyedLine& line) {
    const std::string_view kind = line.word(0);
    if (kind == "PeriodicBoundary") {
      add_periodic_boundary(line, space);
    } else if (kind == "LeesEdwardsBoundary") {
      add_lees_edwards(line, space);
    } else if (kind == "AngledPeriodicBoundary") {
      listed.remarks.push_back(fmt::format(
          "the boundary {} rotates the grains that cross it, which a cell of floc cannot represent: "
          "the packing is read with open ends and with the contacts that the file lists",
          kind));
    } else {
      listed.remarks.push_back(fmt::format("the boundary {} has no counterpart in floc and is left out", kind));
    }
  });
}

bool has_angled_boundary(const RestartFile& file) {
  bool found = false;
  file.for_each("Boundaries",
                [&](const KeyedLine& line) { found = found || line.word(0) == "AngledPeriodicBoundary"; });
  return found;
}

/// The densities of the species of a file, from which the masses of fixed particles follow. The file lists no mass for
/// a fixed particle: its inverse mass is zero.
class Densities {
 public:
  explicit Densities(const RestartFile& file, int dimension) : dimension_(dimension) {
    file.for_each("Species", [&](const KeyedLine& line) {
      const std::string_view key = line.has("density") ? "density" : "rho";
      if (!line.has(key)) return;
      const std::int64_t id = line.has("id") ? line.integer("id") : std::ssize(densities_);
      densities_[id] = line.number(key);
      if (line.has("dim_particle")) dimension_ = line.number("dim_particle") == 2.0 ? 2 : 3;
    });
    if (const auto line = file.header("particleDimensions"))
      dimension_ = line->number("particleDimensions") == 2.0 ? 2 : 3;
  }

  /// Returns the mass of a particle; nothing if its species or the density of the species is not known. Older files do
  /// not name the species of a particle: it is known only if all particles have the same.
  std::optional<double> mass(const KeyedLine& line, double radius) const {
    auto found = densities_.end();
    if (line.has("indSpecies"))
      found = densities_.find(line.integer("indSpecies"));
    else if (densities_.size() == 1)
      found = densities_.begin();
    if (found == densities_.end() || !(found->second > 0.0)) return std::nullopt;
    return found->second * (dimension_ == 2 ? Ball<2>{radius}.volume() : Ball<3>{radius}.volume());
  }

 private:
  int dimension_;  ///< dimension of the particles: 2 for disks, 3 for spheres
  std::map<std::int64_t, double> densities_;
};

/// Reads one particle. Recent files name every value; in older files the values have fixed positions after "BP".
ListedGrain read_particle(const KeyedLine& line, std::int64_t index, const Densities& densities, int& n_fixed) {
  ListedGrain grain;
  grain.id = index;
  double inverse_mass = 0.0;
  if (line.has("position")) {
    if (line.has("id")) grain.id = line.integer("id");
    grain.position = line.vector("position");
    grain.radius = line.number("radius");
    inverse_mass = line.number("invMass");
  } else {
    std::size_t first = 0;
    while (first < line.size() && !parse_number<double>(line.word(first))) ++first;
    grain.position = line.vector(first, "the position");
    grain.radius = line.number(first + 6, "the radius");
    inverse_mass = line.number(first + 13, "the inverse mass");
  }
  if (!(grain.radius > 0.0))
    throw InputError(line.place(), fmt::format("radius = {}, must be positive", grain.radius));
  if (inverse_mass < 0.0)
    throw InputError(line.place(), fmt::format("invMass = {}, must be 0 or more", inverse_mass));
  if (inverse_mass > 0.0) grain.mass = 1.0 / inverse_mass;
  if (inverse_mass == 0.0) grain.mass = densities.mass(line, grain.radius);
  n_fixed += inverse_mass == 0.0;
  return grain;
}

/// Reads one interaction. The force acts on the first grain of the interaction.
ListedContact read_interaction(const KeyedLine& line, const std::vector<std::optional<WallSide>>& walls,
                               bool with_liquid, int dimension) {
  ListedContact c;
  const bool on_wall = line.has("particleWallIds");
  const std::size_t ids = line.position(on_wall ? "particleWallIds" : "particleIds");
  c.id1 = line.integer(ids + 1, "the first body");
  c.id2 = line.integer(ids + 2, "the second body");
  if (on_wall) {
    if (c.id2 < 0 || c.id2 >= std::ssize(walls))
      throw InputError(line.place(), fmt::format("wall = {}, but the file has the walls 0 to {}", c.id2,
                                                 std::ssize(walls) - 1));
    c.wall = walls[static_cast<std::size_t>(c.id2)];
    if (!c.wall)
      throw InputError(
          line.place(),
          fmt::format(
              "the contact is with wall {}, which is not read: expected a contact with a wall across x, y or z",
              c.id2));
  }
  c.force = line.vector("force");
  if (dimension == 2 && line.has("torque") && line.vector("torque")[2] != 0.0)
    c.rolling_moment = Eigen::Vector3d(0.0, 0.0, line.vector("torque")[2]);
  if (with_liquid && line.has("liquidBridgeVolume")) c.bridge_volume = line.number("liquidBridgeVolume");
  return c;
}

/// Returns the dimension of the packing: 2 if the system or the particles are two-dimensional, else 3.
int dimension_of(const RestartFile& file) {
  const char* key = file.header("systemDimensions") ? "systemDimensions" : "dim";
  const std::optional<KeyedLine> line = file.header(key);
  if (!line) return 3;
  if (line->number(key) == 2.0) return 2;
  return line->has("particleDimensions") && line->number("particleDimensions") == 2.0 ? 2 : 3;
}

/// Returns the time of a restart file; nothing if the file does not contain it.
std::optional<double> time_of(const RestartFile& file) {
  for (const auto& [beside, key] : {std::pair{"timeStep", "time"}, {"dt", "t"}})
    if (const std::optional<KeyedLine> line = file.header(beside); line && line->has(key))
      return line->number(key);
  return std::nullopt;
}

/// Sets the corner and the sides of the box from the header, and marks all axes as not periodic.
void set_box(const RestartFile& file, ListedSpace& space) {
  space.cell.assign(3, std::vector<double>(3, 0.0));
  space.periodic = {false, false, false};
  space.boundary = "the restart file has no periodic boundary and no wall across this axis";
  const bool recent = file.header("xMin").has_value();
  for (int a = 0; a < 3; ++a) {
    const std::string low = std::string(1, "xyz"[a]) + (recent ? "Min" : "min");
    const std::string high = std::string(1, "xyz"[a]) + (recent ? "Max" : "max");
    const std::optional<KeyedLine> line = file.header(low);
    space.origin[a] = line ? line->number(low) : 0.0;
    space.cell[static_cast<std::size_t>(a)][static_cast<std::size_t>(a)] =
        line ? line->number(high) - space.origin[a] : 1.0;
  }
}

}  // namespace

bool is_mercurydpm(const std::string& path) {
  return begins_with(path, "MercuryDPM ") || begins_with(path, "restart_version");
}

Imported read_mercurydpm(const std::string& path, const ImportOptions& options) {
  const RestartFile file(path);
  if (!file.has("Particles")) throw InputError(path, "the file has no section Particles");
  ListedPacking listed = listed_packing(path, options);
  const int dimension = options.dimension.value_or(dimension_of(file));
  listed.space.place = path;
  listed.space.dimension = dimension;
  // The order of these calls matters: set_box() marks every axis as not periodic, and each periodic boundary then
  // replaces the lattice vector and the mark of its axis.
  set_box(file, listed.space);
  read_boundaries(file, listed);
  const auto walls = read_walls(file, !options.walls.empty(), dimension, listed.space);
  if (const auto line = file.header("gravity")) listed.space.gravity = line->vector("gravity");
  listed.time = time_of(file);
  listed.in_order_of_fstat = true;
  int n_fixed = 0;
  const Densities densities(file, dimension);
  file.for_each("Particles", [&](const KeyedLine& line) {
    listed.grains.push_back(read_particle(line, std::ssize(listed.grains), densities, n_fixed));
    listed.grains.back().place = line.file_line();
  });
  if (n_fixed > 0)
    listed.remarks.push_back(
        fmt::format("{} grains are fixed in the file; they are free to move in floc", n_fixed));
  // The file may list volumes of liquid bridges although the user chose a law without liquid. assemble() would refuse
  // these volumes, so they are then not read.
  const bool with_liquid = options.law && options.law->liquid() != nullptr;
  const bool angled = has_angled_boundary(file);
  if (file.has("Interactions")) {
    // A section without lines means that no grains touch. Only if the section is missing, `listed.contacts` remains
    // absent, and the contacts are found from the geometry.
    listed.contacts.emplace();
    file.for_each("Interactions", [&](const KeyedLine& line) {
      listed.contacts->push_back(read_interaction(line, walls, with_liquid, dimension));
      listed.contacts->back().place = line.file_line();
      listed.contacts->back().across_no_lattice = angled;
    });
  }
  return assemble(std::move(listed), options);
}

}  // namespace floc
