#pragma once

#include <string>

#include "floc/scene/scene.h"

namespace floc {

/// Returns the name of the kind of a scene, in lower case with hyphens. Scenes of one kind have the same dimension, the
/// same family of contact laws, the same kind of cohesion, the same boundary and loads of the same kind, so that the
/// errors and costs that numerical settings have in one of them say something about the others. The name consists of
/// 1. the grains: "disks", "spheres", "polygons" or "polyhedra", with "rigid-" before it if contacts are rigid. Spheres
/// with another normal law than the linear one are "beads", and the keyword of that law follows: "beads-hertz";
/// 2. their cohesion: "wet" if the contact law has liquid bridges, otherwise "cohesive" if the law attracts anywhere on
/// the load path. "cohesionless" is said only of linear contacts;
/// 3. "walls" if the grains are in a box with walls;
/// 4. each control of the load path that has a direction, once, in order: "oedometer", "biaxial" ("triaxial" in 3D),
/// "constant-volume", "axes", "simple-shear".
///
/// Examples: "disks-cohesive", "beads-hertz", "spheres-cohesive-walls", "disks-cohesionless-biaxial", "rigid-disks".
std::string scene_kind(const Scene& scene);

}  // namespace floc
