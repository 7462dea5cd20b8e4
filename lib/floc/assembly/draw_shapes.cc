#include "floc/assembly/draw_shapes.h"

#include <fmt/format.h>

#include "floc/base/error.h"
#include "floc/base/sha256.h"
#include "floc/shape/read_shapes.h"

namespace floc {
namespace {

/// Function object that makes the shapes, with one overload for each kind of options. Remarks about the file of the
/// shapes are added to `remarks`.
template <int Dim>
struct Drawing {
  using Shapes = std::vector<Shape<Dim>>;

  double rounding;
  int count;
  std::uint64_t seed;
  std::vector<std::string>& remarks;

  Shapes operator()(const PolygonOptions& polygon) const {
    if constexpr (Dim == 2)
      return {regular_polygon(polygon.sides, rounding)};
    else
      throw InputError("", "kind = \"polygon\": polygons exist in two dimensions only; expected another kind");
  }

  Shapes operator()(const BoxShapeOptions& options) const {
    if (options.sides.size() != static_cast<std::size_t>(Dim))
      throw InputError("", fmt::format("sides has {} numbers: expected {}, one for each dimension",
                                       options.sides.size(), Dim));
    return {box<Dim>(Vec<Dim>(Eigen::Map<const Vec<Dim>>(options.sides.data())), rounding)};
  }

  Shapes operator()(const HullOptions& options) const {
    return hull_shapes<Dim>(options, count, rounding, seed);
  }
  Shapes operator()(const CutOptions& options) const { return cut_shapes<Dim>(options, count, rounding, seed); }
  Shapes operator()(const VoronoiOptions& options) const {
    return voronoi_shapes<Dim>(options, count, rounding, seed);
  }
  Shapes operator()(const CapsuleOptions& options) const { return {capsule<Dim>(options.aspect)}; }

  Shapes operator()(const FileShapeOptions& options) const {
    if (!options.sha256.empty() && sha256_of_file(options.file) != options.sha256)
      throw InputError(
          options.file,
          "the file has changed since the scene was read: restore the file with the shapes of the grains");
    Shapes shapes;
    for (const NamedShape<Dim>& read : read_shapes<Dim>(options.file, {options.vertices, rounding})) {
      shapes.push_back(scaled(read.shape, 1.0 / read.shape.diameter()));
      const std::string name = read.name.empty() ? "" : fmt::format(", shape \"{}\"", read.name);
      for (const std::string& remark : read.remarks)
        remarks.push_back(fmt::format("{}{}: {}", options.file, name, remark));
    }
    if (shapes.empty()) throw InputError(options.file, "the file has no shapes: expected at least one");
    return shapes;
  }
};

}  // namespace

template <int Dim>
DrawnShapes<Dim> draw_shapes(const ShapeOptions& options, std::uint64_t seed) {
  DrawnShapes<Dim> drawn;
  drawn.shapes = std::visit(Drawing<Dim>{options.rounding, options.count, seed, drawn.remarks}, options.kind);
  return drawn;
}

template DrawnShapes<2> draw_shapes(const ShapeOptions&, std::uint64_t);
template DrawnShapes<3> draw_shapes(const ShapeOptions&, std::uint64_t);

}  // namespace floc
