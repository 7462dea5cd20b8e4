#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file is probably a configuration of Rockable: it begins with "Rockable ".
bool is_rockable(const std::string& path);

/// Reads a packing of spheres or rounded polyhedra from a configuration of Rockable, and from the file of shapes that
/// the configuration names. The data are particles, interactions with their forces, the periodic cell (usePeriodicCell,
/// h) or walls, densities and gravity. Walls are driven bodies whose shape is a flat face perpendicular to an axis. The
/// normal n of an interaction points from j to i, the force on i is fn n + ft, and mom is the moment on i; moments that
/// the law does not have are left out. `options.law` is required; the parameters of the force law in the file are not
/// read.
/// @throws InputError naming file and line for a malformed file, or for a shape with corners whose coordinates do not
/// have their origin at the centre of mass and their axes along the principal axes of inertia
Imported read_rockable(const std::string& path, const ImportOptions& options);

}  // namespace floc
