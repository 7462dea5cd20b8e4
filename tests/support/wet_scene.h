#pragma once

namespace floc::test {

/// 40 beads of 1 to 2 mm, compressed dry, wetted and left to themselves, then compressed again. f0/a^2 is 200 Pa.
inline constexpr const char* kWetScene = R"([scene]
dimension = 3
units = "SI"
[grains]
count = 40
density = 2600
diameter = {distribution = "uniform", min = 1e-3, max = 2e-3}
[contact]
normal = {law = "linear", stiffness = 1e3}
damping = {restitution = 0.1, mass = "effective"}
friction = {coefficient = 0.4, stiffness = 1e3}
[contact.adhesion]
law = "capillary"
surface_tension = 0.072
contact_angle = 0
water_content = 0
density_ratio = 2.6
[cell]
solid_fraction = 0.45
mass = 1.0
strain_rate_cap = 0.05
[assembly]
protocol = "direct"
pressure = 100
inertial_number_cap = 1e-2
[[load]]
to = 0
steps = 1
set = {adhesion.water_content = 0.007}
[[load]]
to = 100
steps = 1
)";

}  // namespace floc::test
