#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file is in the legacy format of VTK: it begins with "# vtk DataFile".
bool is_legacy_vtk(const std::string& path);

/// Reads grains from a file in the legacy format of VTK, ASCII or binary. The grains are the points of a data set of
/// the kind POLYDATA or UNSTRUCTURED_GRID, with the arrays SCALARS, VECTORS and FIELD of its POINT_DATA. read_points()
/// documents the names of the arrays. Cells of the data set are not read. The format contains neither the periodic cell
/// nor the boundary of the packing.
/// @throws InputError naming the file for malformed content
Imported read_legacy_vtk(const std::string& path, const ImportOptions& options);

}  // namespace floc
