#pragma once

#include <string>

namespace floc::test {

/// Tables [contact] of rigid contacts and of elastic contacts, with equal friction.
inline const std::string kRigidContacts =
    "[contact]\nnormal = {law = \"rigid\"}\nfriction = {coefficient = 0.5}\n";
inline const std::string kElasticContacts =
    "[contact]\nnormal = {law = \"linear\", stiffness = 1e4}\n"
    "friction = {coefficient = 0.5, stiffness = 1e4}\n";

/// Lines of a scene with the shape of the grains.
inline const char* const kCutStones = R"(shape = {kind = "cut", count = 5})";
inline const char* const kPentagons = R"(shape = {kind = "polygon", sides = 5})";
inline const char* const kRoundedPentagons = R"(shape = {kind = "polygon", sides = 5, rounding = 0.05})";
inline const char* const kCapsules = R"(shape = {kind = "capsule", aspect = 2})";

/// Scene of 40 rigid grains in 2D or 20 in 3D that are compressed from a gas, loaded to twice the pressure and sheared
/// (in 3D triaxially): four states in a few seconds.
/// @param shape  line of the scene with the shape of the grains; empty for disks and spheres
inline std::string rigid_scene(const std::string& shape, int dimension = 2) {
  const bool plane = dimension == 2;
  return R"([scene]
name = "rigid"
units = "reduced"
dimension = )" +
         std::string(plane ? "2" : "3") + "\n[grains]\ncount = " + (plane ? "40" : "20") + R"(
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
)" + shape +
         "\n" + kRigidContacts + "[cell]\nsolid_fraction = " + (plane ? "0.25" : "0.1") + R"(
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
strain = 0.06
steps = 2
control = ")" +
         std::string(plane ? "simple_shear" : "triaxial") + R"("
[dynamics]
method = "contact_dynamics"
[run]
seed = 1
checkpoint_every = 0.02
)";
}

/// Scene of grains, rigid by default, that fall onto a floor between walls and are then pressed by a lid: two states in
/// about a second.
/// @param shape  line of the scene with the shape of the grains; empty for disks and spheres
/// @param contacts  table [contact]
inline std::string rigid_box_scene(const std::string& shape, int dimension = 2,
                                   const std::string& contacts = kRigidContacts) {
  const bool plane = dimension == 2;
  return R"([scene]
name = "rigid-box"
units = "reduced"
dimension = )" +
         std::string(plane ? "2" : "3") + "\n[grains]\ncount = " + (plane ? "25" : "12") + R"(
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
)" + shape +
         "\n" + contacts + R"([assembly]
protocol = "direct"
[box]
)" +
         (plane ? "sides = [5, 10]\nboundary = {x = \"fixed\", y = \"lid\"}\ngravity = [0, -1]\n"
                : "sides = [3, 3, 6]\nboundary = {x = \"fixed\", y = \"walls\", z = \"lid\"}\ngravity = [0, 0, "
                  "-1]\n") +
         R"(friction = 0.3
adhesion = 0
pressure = 2.0
mass = 5
[[load]]
name = "load"
to = 4.0
steps = 1
[run]
seed = 1
checkpoint_every = 0.02
)";
}

/// Scene of grains with rounded corners (pentagons in 2D, capsules in 3D), elastic by default, compressed from a gas and
/// loaded to twice the pressure: two states in one to two seconds.
/// @param contacts  table [contact]
inline std::string elastic_scene(int dimension, const std::string& contacts = kElasticContacts) {
  const bool plane = dimension == 2;
  return "[scene]\nname = \"elastic\"\nunits = \"reduced\"\ndimension = " + std::string(plane ? "2" : "3") +
         "\n[grains]\ncount = " + (plane ? "40" : "16") + R"(
diameter = {distribution = "uniform", min = 0.5, max = 1.0}
)" + (plane ? kRoundedPentagons : kCapsules) +
         "\n" + contacts +
         R"([assembly]
protocol = "direct"
pressure = 1.0
[cell]
solid_fraction = )" +
         (plane ? "0.25" : "0.1") + R"(
[[load]]
name = "load"
to = 2.0
steps = 1
[[load]]
name = "strain"
control = "triaxial"
strain = 1e-3
steps = 1
[[load]]
name = "shear"
control = "simple_shear"
strain = 1e-3
steps = 1
[run]
seed = 1
checkpoint_every = 0.02
)";
}

}  // namespace floc::test
