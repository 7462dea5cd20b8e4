#include "floc/io/mesh_text.h"

#include <fmt/format.h>

#include <variant>
#include <vector>

#include "floc/base/error.h"
#include "floc/io/atomic_file.h"
#include "floc/shape/surface.h"

namespace floc {
namespace {

/// Surfaces of the grains of a packing; each surface consists of flat faces.
class GrainSurfaces {
 public:
  explicit GrainSurfaces(const Grains<3>& grains) : grains_(grains) {
    if (grains.are_round())
      shapes_.push_back(surface_of(round_shape<3>(1.0)));
    else
      for (const Shape<3>& shape : *grains.shapes) shapes_.push_back(surface_of(shape));
  }

  /// Returns the surface of a grain in space.
  Polytope<3> placed(int i) const {
    const bool round = grains_.are_round();
    Polytope<3> out = shapes_[round ? 0 : static_cast<std::size_t>(grains_.shape[i])];
    const double scale = round ? grains_.radius[i] : grains_.scale[i];
    const Mat<3> turn = rotation_matrix(grains_.orientation[i]);
    for (Vec<3>& vertex : out.vertices) vertex = grains_.position[i] + scale * (turn * vertex);
    return out;
  }

 private:
  const Grains<3>& grains_;
  std::vector<Polytope<3>> shapes_;
};

const Grains<3>& grains_in_space(const std::string& path, const AnyState& state) {
  if (const auto* in_space = std::get_if<State<3>>(&state)) return in_space->packing.grains;
  throw InputError(
      path, "the packing is two-dimensional, but files of this format contain surfaces in three dimensions");
}

}  // namespace

void write_obj(const std::string& path, const AnyState& state) {
  const Grains<3>& grains = grains_in_space(path, state);
  const GrainSurfaces surfaces(grains);
  std::string text = "# grains of a packing, written by floc\n";
  std::size_t n_before = 1;  // OBJ counts the vertices of a file from 1
  for (int i = 0; i < grains.size(); ++i) {
    const Polytope<3> surface = surfaces.placed(i);
    text += fmt::format("o grain_{}\n", grains.name(i));
    for (const Vec<3>& v : surface.vertices) text += fmt::format("v {} {} {}\n", v[0], v[1], v[2]);
    for (const std::vector<int>& face : surface.faces) {
      text += "f";
      for (const int vertex : face) text += fmt::format(" {}", n_before + static_cast<std::size_t>(vertex));
      text += "\n";
    }
    n_before += surface.vertices.size();
  }
  write_bytes_atomically(path, text);
}

void write_stl(const std::string& path, const AnyState& state) {
  const Grains<3>& grains = grains_in_space(path, state);
  const GrainSurfaces surfaces(grains);
  std::string text;
  for (int i = 0; i < grains.size(); ++i) {
    const Polytope<3> surface = surfaces.placed(i);
    const std::string name = fmt::format("grain_{}", grains.name(i));
    text += fmt::format("solid {}\n", name);
    for (const std::vector<int>& face : surface.faces)
      for (std::size_t k = 2; k < face.size(); ++k) {
        const Vec<3> corners[] = {surface.vertices[face[0]], surface.vertices[face[k - 1]],
                                  surface.vertices[face[k]]};
        const Vec<3> normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
        text += fmt::format("facet normal {} {} {}\nouter loop\n", normal[0], normal[1], normal[2]);
        for (const Vec<3>& v : corners) text += fmt::format("vertex {} {} {}\n", v[0], v[1], v[2]);
        text += "endloop\nendfacet\n";
      }
    text += fmt::format("endsolid {}\n", name);
  }
  write_bytes_atomically(path, text);
}

}  // namespace floc
