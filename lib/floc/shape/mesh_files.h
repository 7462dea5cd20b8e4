#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "floc/shape/polytope.h"

namespace floc {

/// Points and faces of a surface as a file describes them.
template <int Dim>
struct Mesh {
  std::string name;  ///< name of the surface; empty if the format has no names
  std::vector<Vec<Dim>> vertices;
  std::vector<std::vector<int>> faces;  ///< vertices of each face; may be empty if the file has only vertices
  /// Whether all faces list their vertices in the same sense of rotation, as seen from outside.
  bool is_oriented = true;
  double rounding = 0.0;
};

/// Readers of mesh files. Their input is text or, for binary STL, bytes. `place` is the name of the file in
/// messages.
///
/// Memory is allocated only for items that are present in a file, not for the number of items that its header
/// claims. @throws InputError with file and line, the text found there and the text expected; also if there are
/// more than kMostHullPoints vertices.

/// Reads the Object File Format (OFF): "OFF", the numbers of vertices, faces and edges, the vertices, and the
/// faces, each as its number of corners and their indices from 0.
Mesh<3> parse_off(const std::string& place, std::string_view text);
/// Reads the Wavefront format (OBJ): lines "v x y z" and "f" with indices that count from 1, or from -1 back
/// from the last vertex. Normals, textures and groups are skipped.
Mesh<3> parse_obj(const std::string& place, std::string_view text);
/// Reads stereolithography files (STL), text or binary. Corners with equal coordinates become one vertex.
Mesh<3> parse_stl(const std::string& place, std::string_view bytes);
/// Reads a table with the columns x, y and, in 3D, z, below their names, separated by commas, semicolons or
/// white space.
template <int Dim>
Mesh<Dim> parse_points(const std::string& place, std::string_view text);
/// Reads the shapes of Rockable (.shp). Their vertices are the centres of the balls at the corners. Faces are
/// not oriented.
std::vector<Mesh<3>> parse_rockable(const std::string& place, std::string_view text);

}  // namespace floc
