#pragma once

#include <string>

namespace floc::test {

/// Sticky grains pressed together by walls on all sides, then under twice the pressure, in a second or so.
inline std::string box_scene(int dimension) {
  const std::string sides = dimension == 2 ? "[1, 1.3]" : "[1, 1, 1.3]";
  return R"([scene]
name = "box"
dimension = )" +
         std::to_string(dimension) + R"(
units = "reduced"
[grains]
count = 60
diameter = {distribution = "uniform", min = 0.8, max = 1.0}
[contact]
normal = {law = "linear", stiffness = 1e3}
adhesion = {law = "constant", force = 0.2}
damping = {restitution = 0.4472136}
friction = {coefficient = 0.4, stiffness = 1.5e3}
[box]
sides = )" +
         sides +
         R"(
mass = 20
pressure = 0.1
friction = 0.4
adhesion = 0
[assembly]
protocol = "direct"
solid_fraction = 0.35
kinetic_pressure = 0.02
[[load]]
name = "load"
to = 0.2
steps = 1
[equilibrium]
stop_time = 200
[run]
seed = 3
checkpoint_every = 0.02
)";
}

}  // namespace floc::test
