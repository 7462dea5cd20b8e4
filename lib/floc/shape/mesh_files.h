#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "floc/shape/polytope.h"

namespace floc {

/// Points and faces of a surface that is described by a file.
template <int Dim>
struct Mesh {
  std::string name;  ///< name of the surface; empty if the format has no names
  std::vector<Vec<Dim>> vertices;
  /// Indices of the vertices of each face; empty if the file has only vertices.
  std::vector<std::vector<int>> faces;
  /// Whether the vertices of all faces are listed in the same sense of rotation, as seen from outside.
  bool is_oriented = true;
  double rounding = 0.0;
  double volume = 0.0;  ///< volume of the body if the file gives it, else 0 (length^3)
  /// Principal moments of inertia, divided by the mass, if the file gives them, else 0 (length^2).
  Vec<Dim> inertia_over_mass = Vec<Dim>::Zero();
  /// Whether the file says that the coordinates are relative to the centre of mass, along the principal axes of
  /// inertia.
  bool is_principal = false;
};

/// Functions that read mesh files. Their input is the text of the file or, for binary STL, its bytes. The argument
/// `place` is the name of the file, for messages.
///
/// Memory is allocated only for the items that a file really contains; a number of items in the header of the file is
/// not trusted.
/// @throws InputError if the file does not have the expected format, or if there are more than kMostHullPoints
/// vertices. The message names the file and the line, and gives the text found there and the text expected.

/// Reads the Object File Format (OFF): the word OFF, the numbers of vertices, faces and edges, then the vertices, then
/// the faces. A face is given by the number of its corners and the indices of its vertices, counted from 0.
Mesh<3> parse_off(const std::string& place, std::string_view text);
/// Reads the Wavefront format (OBJ): lines "v x y z" for vertices, and lines "f ..." for faces. A face is given by the
/// indices of its vertices: 1, 2, ... from the first vertex, or -1, -2, ... backwards from the last vertex. Normals,
/// textures and groups are skipped.
Mesh<3> parse_obj(const std::string& place, std::string_view text);
/// Reads stereolithography files (STL), text or binary. Corners with equal coordinates become one vertex.
Mesh<3> parse_stl(const std::string& place, std::string_view bytes);
/// Reads a table of points with the columns x, y and, in 3D, z. The first line gives the names of the columns. Columns
/// are separated by commas, semicolons or white space.
template <int Dim>
Mesh<Dim> parse_points(const std::string& place, std::string_view text);
/// Reads the shapes in a file of the program Rockable (.shp). The vertices of a shape are the centres of the balls at
/// its rounded corners. The faces are not oriented. Two shapes must not have the same name.
std::vector<Mesh<3>> parse_rockable(const std::string& place, std::string_view text);

}  // namespace floc
