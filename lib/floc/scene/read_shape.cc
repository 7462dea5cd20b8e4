#include "floc/scene/read_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <string_view>
#include <tuple>

#include "floc/assembly/draw_shapes.h"
#include "floc/assembly/random_streams.h"
#include "floc/assembly/shaped_gas.h"
#include "floc/base/error.h"
#include "floc/base/sha256.h"

namespace floc {
namespace {

using Need = TableReader::Need;

/// Kind of shape, with the keys of grains.shape that it has in addition to "kind".
struct ShapeKind {
  const char* name;
  std::vector<std::string> keys;
};

/// Kinds of shapes, in the order of the alternatives of ShapeOptions::kind.
const std::array<ShapeKind, 7>& shape_kinds() {
  static const std::array<ShapeKind, 7> kinds{{
      {"polygon", {"sides", "rounding"}},
      {"box", {"sides", "rounding"}},
      {"hull", {"vertices", "aspect", "rounding", "count"}},
      {"cut", {"faces", "spread", "rounding", "count"}},
      {"voronoi", {"cells", "relaxed", "rounding", "count"}},
      {"capsule", {"aspect"}},
      {"file", {"file", "vertices", "rounding", "sha256"}},
  }};
  return kinds;
}

bool has_key(const ShapeKind& kind, const std::string& key) {
  return std::find(kind.keys.begin(), kind.keys.end(), key) != kind.keys.end();
}

constexpr IntegerRule any_whole(const char* expectation) {
  return {std::numeric_limits<int>::min(), std::numeric_limits<int>::max(), expectation};
}
constexpr NumberRule any_number(const char* expectation) {
  return {[](double) { return true; }, expectation};
}

int read_whole(TableReader& t, const char* key, const char* expectation, int otherwise) {
  return static_cast<int>(t.integer(key, any_whole(expectation), Need::optional).value_or(otherwise));
}

HullOptions read_hull(TableReader& t) {
  HullOptions hull;
  if (const auto n = t.whole_interval("vertices",
                                      "the number of points of a shape, one whole number or the "
                                      "smallest and the largest, e.g. [12, 24]"))
    std::tie(hull.least_vertices, hull.most_vertices) = *n;
  hull.aspect =
      t.number("aspect", any_number("a number from 1 to 10 (factor by which the shapes are stretched)"),
               Need::optional)
          .value_or(hull.aspect);
  return hull;
}

CutOptions read_cut(TableReader& t) {
  CutOptions cut;
  if (const auto n = t.whole_interval("faces",
                                      "the number of planes that cut a shape, one whole number or the "
                                      "smallest and the largest, e.g. [10, 20]"))
    std::tie(cut.least_faces, cut.most_faces) = *n;
  cut.spread = t.number("spread",
                        any_number("a number from 0 to 1 (range of the distances of the planes from the "
                                   "centre, divided by their mean)"),
                        Need::optional)
                   .value_or(cut.spread);
  return cut;
}

VoronoiOptions read_voronoi(TableReader& t) {
  VoronoiOptions voronoi;
  voronoi.cells =
      read_whole(t, "cells", "the number of Voronoi cells, a whole number from 8 to 5000", voronoi.cells);
  voronoi.relaxed = read_whole(t, "relaxed",
                               "the number of times that each point is moved to the centre of mass of its "
                               "cell, a whole number from 0 to 100",
                               voronoi.relaxed);
  return voronoi;
}

FileShapeOptions read_file_options(TableReader& t, const std::string& directory) {
  FileShapeOptions file;
  if (const auto name = t.text("file", "the name of a file of shapes (.off, .obj, .stl, .shp or .csv)"))
    file.file = (std::filesystem::path(directory) / *name).string();
  file.vertices = read_whole(t, "vertices", "the number of vertices that each shape keeps, a whole number", 0);
  const char* expectation = "the SHA-256 of the file of shapes, which floc writes";
  file.sha256 = t.text("sha256", expectation, Need::optional).value_or("");
  return file;
}

/// Records a fault for each key of grains.shape that the chosen kind does not have but another kind has.
void refuse_keys_of_other_kinds(TableReader& t, const ShapeKind& chosen) {
  // for each key of grains.shape, the names of the kinds of shapes that have this key, as text
  std::map<std::string, std::string> kinds_with;
  for (const ShapeKind& other : shape_kinds())
    for (const std::string& key : other.keys) {
      std::string& words = kinds_with[key];
      words += fmt::format("{}\"{}\"", words.empty() ? "" : " or ", other.name);
    }
  for (const auto& [key, kinds] : kinds_with)
    if (!has_key(chosen, key))
      t.refuse(key,
               fmt::format("{} is not allowed here: shapes of kind = \"{}\" have no key {}; expected kind = "
                           "{}, or no key {}",
                           t.path_of(key), chosen.name, key, kinds, key));
}

/// Reads the options of the chosen kind of shape and returns them.
/// @param kind  index of the kind in shape_kinds()
auto read_kind(TableReader& t, std::size_t kind, const std::string& directory) -> decltype(ShapeOptions::kind) {
  switch (kind) {
    case 0:
      return PolygonOptions{
          static_cast<int>(t.integer("sides", any_whole("the number of sides, a whole number"))
                               .value_or(PolygonOptions{}.sides))};
    case 1: {
      const char* expectation = "an array with the proportions of the sides, e.g. [1, 1] or, in 3D, [1, 1, 1]";
      if (!t.has("sides"))
        t.fault("sides", fmt::format("{} is missing: expected {}", t.path_of("sides"), expectation));
      return BoxShapeOptions{t.numbers("sides", any_number(expectation))};
    }
    case 2:
      return read_hull(t);
    case 3:
      return read_cut(t);
    case 4:
      return read_voronoi(t);
    case 5:
      return CapsuleOptions{
          t.number("aspect", any_number("a number from 1 to 20 (ratio of length to thickness of the capsules)"))
              .value_or(CapsuleOptions{}.aspect)};
    default:
      return read_file_options(t, directory);
  }
}

/// Records a fault in the options of the shapes.
/// @param words  message; if it begins with a key of grains.shape, the fault is recorded at this key. The prefix
/// "grains.shape" is added if the message does not begin with it.
void record_shape_fault(TableReader& t, const std::string& words) {
  const std::string key = words.substr(0, words.find_first_of(" ["));
  const auto& kinds = shape_kinds();
  const bool is_key = key == "kind" || std::any_of(kinds.begin(), kinds.end(),
                                                   [&](const ShapeKind& kind) { return has_key(kind, key); });
  if (is_key)
    t.fault(key, t.path_of(words));
  else if (words.starts_with(t.path()))
    t.fault("", words);
  else
    t.fault("", fmt::format("{}: {}", t.path(), words));
}

std::vector<std::string> option_faults(const ShapeOptions& options, int dimension) {
  if (const auto* hull = std::get_if<HullOptions>(&options.kind)) return hull->validate(dimension);
  if (const auto* cut = std::get_if<CutOptions>(&options.kind)) return cut->validate(dimension);
  if (const auto* voronoi = std::get_if<VoronoiOptions>(&options.kind)) return voronoi->validate();
  return {};
}

/// Draws the shapes of a scene, and adds remarks about the file of shapes to the scene. Records a fault if the shapes
/// cannot be drawn.
/// @return whether the shapes could be drawn
template <int Dim>
bool draws_shapes(TableReader& t, Scene& scene) {
  ShapeOptions& options = *scene.grains.shape;
  auto* const file = std::get_if<FileShapeOptions>(&options.kind);
  try {
    const std::string sha256 = file ? sha256_of_file(file->file) : "";
    if (file && !file->sha256.empty() && file->sha256 != sha256) {
      t.fault("sha256", fmt::format("{} = {}: the file {} has the SHA-256 {}; expected the file with the given "
                                    "SHA-256, or remove the key",
                                    t.path_of("sha256"), file->sha256, file->file, sha256));
      return false;
    }
    scene.remarks = draw_shapes<Dim>(options, scene.seed).remarks;
    if (file) file->sha256 = sha256;
    return true;
  } catch (const InputError& error) {
    if (file && std::string_view(error.what()).starts_with(file->file))
      t.fault("file", fmt::format("{}: {}", t.path_of("file"), error.what()));
    else
      record_shape_fault(t, error.what());
  }
  return false;
}

/// Records a fault if the circumscribed circles or spheres of the grains cannot be placed without overlap at the solid
/// fraction of the scene.
template <int Dim>
void check_solid_fraction(TableReader& root, const Scene& scene) {
  RandomStream random(scene.seed, kAssemblyStream);
  const double densest =
      densest_gas(shaped_grains<Dim>(scene.grains, draw_diameters(scene.grains, random), scene.seed));
  TableReader t = root.table(scene.assembly.box ? "assembly" : "cell", "", Need::optional);
  if (scene.assembly.solid_fraction > densest)
    t.fault(
        "solid_fraction",
        fmt::format(
            "{} = {}: the gas is made of the circumscribed {} of the grains, which can be placed at random "
            "without overlap only up to the solid fraction {:.4g} of the grains; expected at most this number",
            t.path_of("solid_fraction"), scene.assembly.solid_fraction, Dim == 2 ? "circles" : "spheres",
            densest));
}

}  // namespace

std::optional<ShapeOptions> read_shape(TableReader& grains, const SceneSource& source,
                                       const std::string& directory) {
  const std::size_t n_faults_before = source.n_faults();
  TableReader t = grains.table("shape", "a table, e.g. {kind = \"polygon\", sides = 5}", Need::optional);
  if (!t) return std::nullopt;
  std::vector<std::string> names;
  for (const ShapeKind& kind : shape_kinds()) names.emplace_back(kind.name);
  const auto chosen = t.choice("kind", names);
  if (!chosen) return std::nullopt;
  const ShapeKind& kind = shape_kinds()[*chosen];
  ShapeOptions options;
  options.kind = read_kind(t, *chosen, directory);
  if (has_key(kind, "rounding"))
    options.rounding =
        t.number("rounding", any_number("a number from 0 to 0.45 (radius of rounding divided by the diameter)"),
                 Need::optional)
            .value_or(options.rounding);
  if (has_key(kind, "count"))
    options.count = read_whole(t, "count", "the number of different shapes, a whole number", options.count);
  refuse_keys_of_other_kinds(t, kind);
  t.refuse_other_keys();
  if (source.n_faults() > n_faults_before) return std::nullopt;
  return options;
}

const char* shape_kind_name(const ShapeOptions& options) {
  return shape_kinds()[options.kind.index()].name;
}

void check_shapes(TableReader& root, const SceneSource& source, Scene& scene) {
  if (!scene.grains.shape) return;
  TableReader grains = root.table("grains", "", Need::optional);
  TableReader t = grains.table("shape", "", Need::optional);
  const std::vector<std::string> faults = option_faults(*scene.grains.shape, scene.dimension);
  for (const std::string& words : faults) record_shape_fault(t, words);
  if (!faults.empty()) return;
  const bool drawn = scene.dimension == 2 ? draws_shapes<2>(t, scene) : draws_shapes<3>(t, scene);
  if (!drawn || source.n_faults() > 0) return;
  if (scene.dimension == 2)
    check_solid_fraction<2>(root, scene);
  else
    check_solid_fraction<3>(root, scene);
}

}  // namespace floc
