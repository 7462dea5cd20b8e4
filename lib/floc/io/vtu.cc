#include "floc/io/vtu.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <pugixml.hpp>
#include <sstream>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "floc/io/field_space.h"
#include "floc/io/point_cloud.h"
#include "floc/io/vtk_arrays.h"
#include "floc/io/vtk_cells.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

/// Returns the indices of the points that are grains: the points that are cells of VTK's type vertex. If the file has
/// no cells of this type, all points are grains, and the result is empty.
std::vector<std::size_t> grain_points(const VtkArrays& arrays, std::size_t n_points) {
  std::vector<std::size_t> points;
  if (arrays.has("Cells", "types")) {
    const std::vector<double> types = arrays.read("Cells", "types");
    const std::vector<double> offsets = arrays.read("Cells", "offsets");
    const std::vector<double> connectivity = arrays.read("Cells", "connectivity");
    for (std::size_t k = 0; k < types.size(); ++k) {
      if (types[k] != kVertexCell) continue;
      const double at = k < offsets.size() ? offsets[k] - 1.0 : -1.0;
      const bool listed = at >= 0.0 && at < static_cast<double>(connectivity.size());
      const double point = listed ? connectivity[static_cast<std::size_t>(at)] : -1.0;
      if (!(point >= 0.0 && point < static_cast<double>(n_points)))
        throw InputError(arrays.place("Cells", "connectivity"),
                         fmt::format("cell {} of the grid is a vertex at a point that does not exist", k));
      points.push_back(static_cast<std::size_t>(point));
    }
  }
  return points;
}

/// Whether a file is in VTK's XML format and has a data set of a given kind.
bool has_data_set(const std::string& path, const char* kind) {
  const std::string text = read_beginning(path, 1000);
  return text.find("<VTKFile") != std::string::npos && text.find(kind) != std::string::npos;
}

}  // namespace

bool is_vtu(const std::string& path) {
  return has_data_set(path, "UnstructuredGrid");
}

bool is_vtp(const std::string& path) {
  return has_data_set(path, "PolyData");
}

Imported read_vtu(const std::string& path, const ImportOptions& options) {
  const VtkArrays arrays(path, read_file(path));
  if (arrays.has("FieldData", "corners"))
    throw InputError(
        arrays.place("FieldData", "corners"),
        "the grains of this file have corners; floc writes such files for pictures only and cannot read them: "
        "convert the state file or a configuration of Rockable instead");
  PointCloud cloud;
  cloud.path = path;
  cloud.x = arrays.read("Points", "");
  if (static_cast<std::int64_t>(cloud.x.size()) != 3 * arrays.n_points())
    throw InputError(arrays.place("Points", ""),
                     fmt::format("the array has {} numbers, expected three for each of {} points",
                                 cloud.x.size(), arrays.n_points()));
  cloud.grains = grain_points(arrays, cloud.x.size() / 3);
  cloud.arrays = arrays.names("PointData");
  cloud.place = [&](const std::string& name) { return arrays.place("PointData", name); };
  cloud.read = [&](const std::string& name) { return arrays.read("PointData", name); };
  if (options.cell.empty())
    cloud.space = space_of_fields({[&](const std::string& name) { return arrays.has("FieldData", name); },
                                   [&](const std::string& name) { return arrays.read("FieldData", name); },
                                   [&](const std::string& name) { return arrays.place("FieldData", name); }});
  return read_points(cloud, options);
}

namespace {

/// One array of a VTU file: its type, name, number of components, and its numbers as ASCII text.
struct ArrayText {
  std::string type;
  std::string name;
  int components = 1;
  std::string numbers;

  template <class T>
  void add(T value) {
    numbers += fmt::format("{} ", value);
  }
  void add(const Eigen::Vector3d& v) { numbers += fmt::format("{} {} {}\n", v[0], v[1], v[2]); }
};

void append(pugi::xml_node section, const ArrayText& array) {
  pugi::xml_node node = section.append_child("DataArray");
  node.append_attribute("type") = array.type.c_str();
  node.append_attribute("Name") = array.name.c_str();
  if (array.components > 1) node.append_attribute("NumberOfComponents") = array.components;
  node.append_attribute("format") = "ascii";
  node.text().set(array.numbers.c_str());
}

/// Returns the corners of the outline of a two-dimensional shape, counter-clockwise. The arc of a rounded corner
/// becomes straight segments; the angle of the arc that a segment replaces is at most 1/16 of a full turn.
std::vector<Vec<2>> outline(const Shape<2>& shape) {
  constexpr double kArc = 0.125 * std::numbers::pi;
  std::vector<Vec<2>> points;
  for (int f = 0; f < shape.n_faces(); ++f) {
    const Vec<2>&n = shape.normals[f], &next = shape.normals[(f + 1) % shape.n_faces()];
    const Vec<2>& corner = shape.vertices[shape.loop(f)[1]];
    const double turn = std::atan2(n[0] * next[1] - n[1] * next[0], n.dot(next));
    const double angle = turn > 0.0 ? turn : turn + 2.0 * std::numbers::pi;
    const int n_arcs = shape.rounding > 0.0 ? static_cast<int>(std::ceil(angle / kArc)) : 0;
    for (int k = 0; k <= n_arcs; ++k)
      points.push_back(corner +
                       shape.rounding *
                           (Eigen::Rotation2Dd(n_arcs > 0 ? angle * k / n_arcs : 0.0).toRotationMatrix() * n));
  }
  return points;
}

/// Points, VTK cells and data arrays of the VTU file of a packing. Each grain is a point and a vertex, and each contact
/// is one or two lines. A grain with corners is drawn, in addition, as a polygon (2D) or as the polyhedron of its core
/// (3D), which is the shape without the rounding. The contacts of a grain with corners are drawn as lines through the
/// contact point.
class Drawing {
 public:
  template <int Dim>
  explicit Drawing(const Packing<Dim>& packing)
      : has_twisting_(packing.law.has_twisting()), has_corners_(!packing.grains.are_round()) {
    const Grains<Dim>& grains = packing.grains;
    if (!grains.id.empty()) id_.type = "Int64";
    for (int i = 0; i < grains.size(); ++i) {
      add_point(in_space<Dim>(grains.position[i]), grains.radius[i], grains.mass[i], grains.name(i));
      add_cell(kVertexCell, {i});
      add_contact_data(Contact<Dim>());
    }
    for (int i = 0; i < grains.size() && has_corners_; ++i) add_shape(grains, i);
    for (const Contact<Dim>& c : packing.contacts) add_contact(packing, c);
  }

  void write(pugi::xml_node piece) const {
    piece.append_attribute("NumberOfPoints") = n_points_;
    piece.append_attribute("NumberOfCells") = n_cells_;
    append(piece.append_child("Points"), points_);
    pugi::xml_node cells = piece.append_child("Cells");
    for (const ArrayText* array : {&connectivity_, &offsets_, &types_}) append(cells, *array);
    if (face_offset_ > 0)
      for (const ArrayText* array : {&faces_, &face_offsets_}) append(cells, *array);
    pugi::xml_node point_data = piece.append_child("PointData");
    for (const ArrayText* array : {&radius_, &mass_, &id_}) append(point_data, *array);
    pugi::xml_node cell_data = piece.append_child("CellData");
    for (const ArrayText* array : {&normal_force_, &shear_force_, &gap_, &kn_, &kt_, &kr_, &distant_})
      append(cell_data, *array);
    if (has_twisting_) append(cell_data, ktw_);
  }

 private:
  int add_point(const Eigen::Vector3d& x, double radius, double mass, std::int64_t id) {
    points_.add(x);
    radius_.add(radius);
    mass_.add(mass);
    id_.add(id);
    return n_points_++;
  }

  void add_cell(int type, const std::vector<int>& points) {
    for (const int point : points) connectivity_.add(point);
    offset_ += static_cast<int>(points.size());
    offsets_.add(offset_);
    types_.add(type);
    face_offsets_.add(type == kPolyhedronCell ? face_offset_ : -1);
    ++n_cells_;
  }

  /// Adds the points of a polygon or polyhedron.
  /// @param points  the points, in the coordinate system of the shape of grain i
  /// @return indices of the added points
  template <int Dim>
  std::vector<int> add_placed(const Grains<Dim>& grains, int i, const std::vector<Vec<Dim>>& points) {
    const PlacedShape<Dim> placed = grains.placed(i);
    std::vector<int> indices;
    for (const Vec<Dim>& own : points)
      indices.push_back(add_point(in_space<Dim>(placed.position + placed.scale * (placed.rotation * own)), 0.0,
                                  0.0, grains.name(i)));
    return indices;
  }

  void add_shape(const Grains<2>& grains, int i) {
    const std::vector<Vec<2>> points = outline(*grains.placed(i).shape);
    if (points.size() < 3) return;  // a disk
    add_cell(kPolygonCell, add_placed(grains, i, points));
    add_contact_data(Contact<2>());
  }

  void add_shape(const Grains<3>& grains, int i) {
    const Shape<3>& shape = *grains.placed(i).shape;
    if (shape.n_faces() == 0) return;  // a sphere or capsule
    const std::vector<int> indices = add_placed(grains, i, shape.vertices);
    const auto add_to_faces = [&](int value) { faces_.add(value), ++face_offset_; };
    add_to_faces(shape.n_faces());
    for (int f = 0; f < shape.n_faces(); ++f) {
      add_to_faces(static_cast<int>(shape.loop(f).size()));
      for (const int vertex : shape.loop(f)) add_to_faces(indices[static_cast<std::size_t>(vertex)]);
    }
    add_cell(kPolyhedronCell, indices);
    add_contact_data(Contact<3>());
  }

  template <int Dim>
  void add_contact_data(const Contact<Dim>& c) {
    normal_force_.add(c.normal_force);
    shear_force_.add(in_space<Dim>(c.shear_force));
    gap_.add(c.gap);
    kn_.add(c.kn);
    kt_.add(c.kt);
    kr_.add(c.kr);
    if (has_twisting_) ktw_.add(c.ktw);
    distant_.add(static_cast<int>(c.distant));
  }

  template <int Dim>
  void add_contact(const Packing<Dim>& packing, const Contact<Dim>& c) {
    const auto add_half = [&](int grain, const Vec<Dim>& end) {
      add_cell(kLineCell, {grain, add_point(in_space<Dim>(end), 0.0, 0.0, -1)});
      add_contact_data(c);
    };
    if (has_corners_) {
      add_half(c.i, packing.grains.position[c.i] + c.arm_i);
      if (!packing.is_wall(c.j)) add_half(c.j, packing.grains.position[c.j] + c.arm_j);
      return;
    }
    if (packing.is_wall(c.j)) {
      const Vec<Dim> foot = packing.grains.position[c.i] + branch(packing, c);
      add_cell(kLineCell, {c.i, add_point(in_space<Dim>(foot), 0.0, 0.0, -1)});
      add_contact_data(c);
      return;
    }
    if (c.image.isZero()) {
      add_cell(kLineCell, {c.i, c.j});
      add_contact_data(c);
      return;
    }
    const Vec<Dim> half = 0.5 * branch(packing, c);
    add_half(c.i, packing.grains.position[c.i] + half);
    add_half(c.j, packing.grains.position[c.j] - half);
  }

  bool has_twisting_, has_corners_;
  int n_points_ = 0;
  int n_cells_ = 0;
  int offset_ = 0;
  int face_offset_ = 0;  ///< number of entries of faces_
  ArrayText points_{"Float64", "Points", 3, ""};
  ArrayText connectivity_{"Int32", "connectivity", 1, ""};
  ArrayText offsets_{"Int32", "offsets", 1, ""};
  ArrayText types_{"UInt8", "types", 1, ""};
  ArrayText faces_{"Int32", "faces", 1, ""};
  ArrayText face_offsets_{"Int32", "faceoffsets", 1, ""};
  ArrayText radius_{"Float64", "radius", 1, ""};
  ArrayText mass_{"Float64", "mass", 1, ""};
  ArrayText id_{"Int32", "id", 1, ""};
  ArrayText normal_force_{"Float64", "normal_force", 1, ""};
  ArrayText shear_force_{"Float64", "shear_force", 3, ""};
  ArrayText gap_{"Float64", "gap", 1, ""};
  ArrayText kn_{"Float64", "kn", 1, ""};
  ArrayText kt_{"Float64", "kt", 1, ""};
  ArrayText kr_{"Float64", "kr", 1, ""};
  ArrayText ktw_{"Float64", "ktw", 1, ""};
  ArrayText distant_{"UInt8", "distant", 1, ""};
};

template <int Dim>
std::string vtu_text(const State<Dim>& state) {
  pugi::xml_document document;
  pugi::xml_node file = document.append_child("VTKFile");
  file.append_attribute("type") = "UnstructuredGrid";
  file.append_attribute("version") = "1.0";
  file.append_attribute("byte_order") = "LittleEndian";
  pugi::xml_node grid = file.append_child("UnstructuredGrid");
  ArrayText cell{"Float64", "cell", 3, ""};
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();
  lattice.topLeftCorner<Dim, Dim>() = state.packing.cell.matrix;
  for (int a = 0; a < 3; ++a) cell.add(Eigen::Vector3d(lattice.row(a)));
  pugi::xml_node fields = grid.append_child("FieldData");
  append(fields, cell);
  fields.child("DataArray").append_attribute("NumberOfTuples") = 3;
  ArrayText dimension{"Int32", "dimension", 1, ""};
  dimension.add(Dim);
  append(fields, dimension);
  fields.last_child().append_attribute("NumberOfTuples") = 1;
  if (!state.packing.grains.are_round()) {
    ArrayText corners{"Int32", "corners", 1, ""};  // 1: grains have corners
    corners.add(1);
    append(fields, corners);
    fields.last_child().append_attribute("NumberOfTuples") = 1;
  }
  const Packing<Dim> packing = with_walls_at_cell(state.packing);
  if (!packing.walls.empty()) {
    ArrayText walls{"Float64", "walls", 3, ""};  // three numbers per wall: axis, side, position
    for (const Wall<Dim>& wall : packing.walls)
      if (!wall.open)
        walls.add(
            Eigen::Vector3d(static_cast<double>(wall.axis), static_cast<double>(wall.side), wall.position));
    const auto n_walls = std::count_if(packing.walls.begin(), packing.walls.end(),
                                       [](const Wall<Dim>& wall) { return !wall.open; });
    if (n_walls > 0) {
      append(fields, walls);
      fields.last_child().append_attribute("NumberOfTuples") = static_cast<unsigned>(n_walls);
    }
    ArrayText periodic{"Int32", "periodic", 1, ""};
    for (int a = 0; a < 3; ++a) periodic.add(a < Dim && between_walls(packing.walls, a) ? 0 : 1);
    append(fields, periodic);
    fields.last_child().append_attribute("NumberOfTuples") = 3;
  }
  Drawing(packing).write(grid.append_child("Piece"));
  std::ostringstream text;
  document.save(text, " ", pugi::format_default | pugi::format_save_file_text);
  return text.str();
}

}  // namespace

std::string vtu_text(const AnyState& any) {
  return std::visit([](const auto& state) { return vtu_text(state); }, any);
}

}  // namespace floc
