#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "floc/shape/mesh_files.h"
#include "floc/shape/shape.h"

namespace floc {

/// Shape of a grain read from a file.
template <int Dim>
struct NamedShape {
  std::string name;  ///< name of the shape; empty if the format has no names
  Shape<Dim> shape;  ///< shape in the unit of length of the file
  std::vector<std::string> remarks;
};

struct ShapeFileOptions {
  /// Number of vertices of the convex hull that are kept; the kept vertices are far from each other. If the number is
  /// 0, all vertices are kept.
  int vertices = 0;
  /// Radius of rounding divided by the diameter, from 0 to 0.45. The value has to be 0 for files of the program
  /// Rockable (.shp), because they give a radius for each shape.
  double rounding = 0.0;
};

/// Reads the shapes in a file and returns their convex hulls. The formats are .off, .obj, .stl, .csv and .shp. Only
/// .shp files may have several shapes. In 2D only .csv is allowed.
///
/// @throws InputError if the functions of mesh_files.h or shape_of_mesh() throw it, or if the name of the file has
/// another ending
template <int Dim>
std::vector<NamedShape<Dim>> read_shapes(const std::string& path, const ShapeFileOptions& options = {});

/// Returns the shapes described by the content of a file.
/// @param path  name of the file, for messages; its ending determines the format of `content`
template <int Dim>
std::vector<NamedShape<Dim>> parse_shapes(const std::string& path, std::string_view content,
                                          const ShapeFileOptions& options = {});

/// Returns the convex hull of a mesh. Remarks are added if vertices are left out, or if the surface of the mesh
/// encloses less volume than the hull.
///
/// @throws InputError if shape_of_points() throws it, or if the faces do not form a closed surface, because an edge
/// belongs to only one face, to more than two faces, or to two faces that list the ends of the edge in the same order
template <int Dim>
NamedShape<Dim> shape_of_mesh(const std::string& place, const Mesh<Dim>& mesh, const ShapeFileOptions& options);

}  // namespace floc
