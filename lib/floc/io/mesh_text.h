#pragma once

#include <string>

#include "floc/io/state_file.h"

namespace floc {

/// Write the surfaces of the grains of a packing in 3D: write_obj() as a Wavefront OBJ file, with one object per grain,
/// and write_stl() as an STL file, with one solid per grain. Rounded surfaces and spheres are triangulated by
/// surface_of(). The files contain no contacts, forces, cell or walls.
/// @throws InputError for a packing in 2D
void write_obj(const std::string& path, const AnyState& state);
void write_stl(const std::string& path, const AnyState& state);

}  // namespace floc
