#pragma once

#include <string>

namespace floc::test {

/// Scene of 40 rigid grains that are compressed from a gas, loaded to twice the pressure and sheared: four
/// states in a few seconds.
/// @param shape  line of the scene with the shape of the grains; empty for disks
inline std::string rigid_scene(const std::string& shape) {
  return R"([scene]
name = "rigid"
dimension = 2
units = "reduced"
[grains]
count = 40
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
)" + shape +
         R"(
[contact]
normal = {law = "rigid"}
friction = {coefficient = 0.5}
[cell]
solid_fraction = 0.25
inertial_number_cap = 0.02
[assembly]
protocol = "direct"
pressure = 1.0
[[load]]
name = "load"
to = 2.0
steps = 1
[[load]]
name = "shear"
control = "simple_shear"
strain = 0.06
steps = 2
[dynamics]
method = "contact_dynamics"
[run]
seed = 1
checkpoint_every = 0.02
)";
}

inline const char* const kPentagons = R"(shape = {kind = "polygon", sides = 5})";

}  // namespace floc::test
