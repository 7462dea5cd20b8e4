#pragma once

#include <string>

#include "floc/scene/scene.h"

namespace floc {

/// Returns whether the states or the load path of a scene have an observable, such as "z_minus" or "K0". Most
/// observables exist in every scene. The others need a property of the scene: cohesion, friction, walls, liquid, rigid
/// or elastic contacts, or a stage of the load path that drives an axis or raises the pressure.
/// @param name  name of an observable, as in tables of prices; observables that this function does not know count as
/// observables of every scene
bool has_observable(const Scene& scene, const std::string& name);

}  // namespace floc
