#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "floc/base/error.h"
#include "floc/shape/manifold.h"
#include "floc/shape/read_shapes.h"
#include "readers.h"

namespace floc::fuzz {
namespace {

/// Throws if the mass properties of a shape are not finite positive numbers. Otherwise brings the shape into contact
/// with a copy of itself, so that the sanitizers check all indices of the shape.
template <int Dim>
void use(const Shape<Dim>& shape) {
  bool is_sound = shape.centre.allFinite();
  for (const double value : {shape.volume, shape.inertia.minCoeff(), shape.inertia.maxCoeff(),
                             shape.outer_radius, shape.inner_radius})
    is_sound = is_sound && value > 0.0 && std::isfinite(value);
  if (!is_sound) throw std::runtime_error("the mass properties of a shape are not positive finite numbers");
  const PlacedShape<Dim> one{&shape};
  PlacedShape<Dim> other = one;
  for (const double share : {0.0, 0.5, 1.9}) {
    other.position[0] = share * shape.outer_radius;
    contact_manifold<Dim>(one, other, 0.1 * shape.outer_radius);
  }
}

/// Reads a file twice: first without options, then with a limit of the number of vertices and a radius of rounding. The
/// extension of `path` determines the format of the file.
template <int Dim>
void read_shape_bytes(const char* path, const std::string& bytes) {
  for (const ShapeFileOptions& options :
       {ShapeFileOptions{}, ShapeFileOptions{.vertices = Dim + 3, .rounding = 0.1}})
    try {
      for (const NamedShape<Dim>& found : parse_shapes<Dim>(path, bytes, options)) use(found.shape);
    } catch (const InputError&) {
    }
}

// A tetrahedron with an additional point inside, as OFF text.
const char* const kOff =
    "OFF\n# stone\n5 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.1 0.1 0.1\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const char* const kObj =
    "o stone\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nvn 0 0 1\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1//1 2//1 4//1\nf -4 -1 -2\nf 2 3 4\n";
const char* const kPoints =
    "x,y,z\n0,0,0\n1,0,0\n0,1,0\n0,0,1\n1,1,0\n1,0,1\n0,1,1\n1,1,1\n0.5,0.5,1.5\n1.5,0.5,0.5\n";
const char* const kCorners = "\"x\";\"y\"\n0;0\n3;0\n0;4\n2.5;2.5\n1;-0.5\n-0.5;2\n";

/// Two shapes in the format of Rockable: a tetrahedron and a ball.
const char* const kRockable =
    "<\nname Stone\nradius 0.05\npreCompDone y\nnv 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "ne 6\n0 1\n0 2\n0 3\n1 2\n1 3\n2 3\nnf 4\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n"
    "obb.extent 1 1 1\nvolume 1\nI/m 1 1 1\n>\n<\nname Ball\nradius 0.2\nnv 1\n0 0 0\nne 0\nnf 0\n>\n"
    "<\nname Rod\nradius 0.1\nnv 2\n0 0 0\n1 0 0\nne 1\n0 1\nnf 0\n>\n";

const Vec<3>& corner(int k) {
  static const Vec<3> corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return corners[k];
}
constexpr int kTriangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string stl_text() {
  std::string text = "solid stone\n";
  for (const auto& triangle : kTriangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int k : triangle) {
      text += "vertex";
      for (const double x : corner(k)) text += x == 0.0 ? " 0" : " 1.0e0";
      text += "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid stone\n";
}

std::string stl_bytes() {
  std::string bytes(80, ' ');
  const std::uint32_t n = 4;
  bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
  for (const auto& triangle : kTriangles) {
    float numbers[12] = {};
    for (int k = 0; k < 3; ++k)
      for (int a = 0; a < 3; ++a) numbers[3 + 3 * k + a] = static_cast<float>(corner(triangle[k])[a]);
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace

std::vector<Reader> shape_readers() {
  using Seeds = std::vector<std::string>;
  return {
      {"shape_off", [](const std::string& bytes) { read_shape_bytes<3>("fuzz.off", bytes); },
       [] { return Seeds{kOff}; }},
      {"shape_obj", [](const std::string& bytes) { read_shape_bytes<3>("fuzz.obj", bytes); },
       [] { return Seeds{kObj}; }},
      {"shape_stl", [](const std::string& bytes) { read_shape_bytes<3>("fuzz.stl", bytes); },
       [] {
         return Seeds{stl_text(), stl_bytes()};
       }},
      {"shape_csv", [](const std::string& bytes) { read_shape_bytes<3>("fuzz.csv", bytes); },
       [] { return Seeds{kPoints}; }},
      {"shape_csv_2d", [](const std::string& bytes) { read_shape_bytes<2>("fuzz.csv", bytes); },
       [] { return Seeds{kCorners}; }},
      {"shape_shp", [](const std::string& bytes) { read_shape_bytes<3>("fuzz.shp", bytes); },
       [] { return Seeds{kRockable}; }},
  };
}

}  // namespace floc::fuzz
