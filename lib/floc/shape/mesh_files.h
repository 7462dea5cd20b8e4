#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "floc/shape/polytope.h"

namespace floc {

/// Points and faces as a file has them.
template <int Dim>
struct Mesh {
  std::string name;  ///< empty where the format has none
  std::vector<Vec<Dim>> vertices;
  std::vector<std::vector<int>> faces;  ///< may be none: then the vertices are all there is
  bool is_oriented = true;  ///< faces go round counter-clockwise as seen from outside, all or none of them
  double rounding = 0.0;
};

/// Readers of text, and of bytes for binary STL. `place` is the name of the file.
///
/// Nothing is allocated on the word of a count in a file. @throws InputError naming file and line, what is
/// there and what was expected; also for more than kMostHullPoints vertices.

/// Object file format: "OFF", counts of vertices, faces and edges, vertices, faces as counts and indices from
/// 0.
Mesh<3> parse_off(const std::string& place, std::string_view text);
/// Wavefront: v x y z, f with indices from 1 or back from the last vertex; normals, textures and groups are
/// skipped.
Mesh<3> parse_obj(const std::string& place, std::string_view text);
/// Stereolithography, text or binary. Corners at equal coordinates are one vertex.
Mesh<3> parse_stl(const std::string& place, std::string_view bytes);
/// Columns x, y and, in 3D, z, under their names, separated by commas, semicolons or white space.
template <int Dim>
Mesh<Dim> parse_points(const std::string& place, std::string_view text);
/// Shapes of Rockable (.shp): vertices are the centres of the balls at the corners. Faces are not oriented.
std::vector<Mesh<3>> parse_rockable(const std::string& place, std::string_view text);

}  // namespace floc
