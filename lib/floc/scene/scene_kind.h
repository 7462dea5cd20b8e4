#pragma once

#include <string>

#include "floc/scene/scene.h"

namespace floc {

/// Returns the name of the kind of a scene, in lower case with hyphens. Scenes of one kind have the same dimension,
/// family of contact laws, cohesion, boundary and kinds of loads. Errors and costs of numerical settings that were
/// measured in one scene are therefore a guide for all scenes of the same kind. The name consists of
/// 1. the grains: "disks", "spheres", "polygons" or "polyhedra", preceded by "rigid-" if the contacts are rigid.
/// Spheres with a nonlinear normal law are "beads", followed by the keyword of the law: "beads-hertz";
/// 2. their cohesion: "wet" if the contact law has liquid bridges, otherwise "cohesive" if the law attracts anywhere on
/// the load path, otherwise "cohesionless", which is written only for linear contacts;
/// 3. "walls" if the grains are in a box with walls, followed by "gravity" if gravity acts on the grains;
/// 4. each control of the load path that loads the axes differently, once, in the order of this list: "oedometer",
/// "biaxial" ("triaxial" in 3D), "constant-volume", "axes", "simple-shear".
///
/// Examples: "disks-cohesive", "beads-hertz", "spheres-cohesive-walls", "disks-cohesionless-biaxial", "rigid-disks".
std::string scene_kind(const Scene& scene);

}  // namespace floc
