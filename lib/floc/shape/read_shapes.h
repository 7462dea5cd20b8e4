#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "floc/shape/mesh_files.h"
#include "floc/shape/shape.h"

namespace floc {

/// A shape that a file has.
template <int Dim>
struct NamedShape {
  std::string name;  ///< empty where the format has none
  Shape<Dim> shape;  ///< in the unit of length of the file
  std::vector<std::string> remarks;
};

struct ShapeFileOptions {
  /// Number of vertices to keep, the furthest from each other; 0 keeps all of the hull.
  int vertices = 0;
  /// Share of the diameter, from 0 to 0.45. Shapes of Rockable have their own.
  double rounding = 0.0;
};

/// Convex hulls of the shapes of a file: .off, .obj, .stl, .csv or .shp, the last with several. In 2D only
/// .csv.
///
/// @throws InputError as the readers of mesh_files.h and shape_of_mesh(), or if the file's name ends in none of
/// these
template <int Dim>
std::vector<NamedShape<Dim>> read_shapes(const std::string& path, const ShapeFileOptions& options = {});

/// Shapes of the content of a file. @param path  tells the format by its ending, and is named in messages
template <int Dim>
std::vector<NamedShape<Dim>> parse_shapes(const std::string& path, std::string_view content,
                                          const ShapeFileOptions& options = {});

/// Convex hull of a mesh, with remarks if vertices are left out, or if the surface encloses less than its hull.
///
/// @throws InputError as shape_of_points(), and if faces form no closed surface: an edge has one face, or more
/// than two, or two that go along it in one sense
template <int Dim>
NamedShape<Dim> shape_of_mesh(const std::string& place, const Mesh<Dim>& mesh, const ShapeFileOptions& options);

}  // namespace floc
