#include "floc/io/vtkhdf.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "floc/base/error.h"
#include "floc/base/parse_number.h"
#include "floc/base/read_file.h"
#include "floc/io/atomic_file.h"
#include "floc/io/field_space.h"
#include "floc/io/hdf5_file.h"
#include "floc/io/point_cloud.h"
#include "floc/io/stdin_copy.h"
#include "floc/io/vtk_cells.h"
#include "floc/packing/liquid/liquid.h"
#include "floc/packing/require_elastic.h"
#include "floc/packing/wall_forces.h"

namespace floc {
namespace {

const std::string kRoot = "VTKHDF";

/// Returns the moment of a rolling spring as a vector in space. In 2D the vector is along z.
Eigen::Vector3d moment_in_space(const RotationVector<2>& m) {
  return {0.0, 0.0, m[0]};
}
Eigen::Vector3d moment_in_space(const RotationVector<3>& m) {
  return m;
}

/// An array of numbers, with the name of the array and the number of components.
struct Column {
  std::string name;
  std::uint64_t components = 1;
  std::vector<double> values;

  void add(double value) { values.push_back(value); }
  void add(const Eigen::Vector3d& v) { values.insert(values.end(), v.begin(), v.end()); }
};

/// Points, cells and data arrays of the file that is written for a packing.
class Grid {
 public:
  template <int Dim>
  explicit Grid(const State<Dim>& state) {
    const Packing<Dim>& packing = state.packing;
    const Grains<Dim>& g = packing.grains;
    n_grains_ = g.size();
    for (int i = 0; i < g.size(); ++i)
      add_point(in_space<Dim>(g.position[i]), g.radius[i], g.mass[i], g.name(i));
    for (int i = 0; i < g.size(); ++i) add_cell_data(packing, Contact<Dim>(), i);
    for (const Contact<Dim>& c : packing.contacts) add_contact(packing, c);
    if (holds_liquid(packing)) {
      bridge_volume_.values.resize(static_cast<std::size_t>(n_grains_));
      for (const Contact<Dim>& c : packing.contacts) bridge_volume_.add(bridge_volume(packing, c));
    }
    const std::vector<Strengths> strengths = strengths_by_contact(packing.contacts, state.bond_strengths);
    for (std::size_t k = 0; k < strengths_.size() && !strengths.empty(); ++k) {
      strengths_[k].values.resize(static_cast<std::size_t>(n_grains_));
      for (const Strengths& of_contact : strengths) strengths_[k].add(of_contact[k]);
    }
  }

  void write(Hdf5Writer& file) const {
    const auto n_points = static_cast<std::uint64_t>(radius_.values.size());
    file.array(kRoot + "/Points", {n_points, 3}, points_);
    std::vector<std::int64_t> connectivity, offsets = {0};
    std::vector<std::uint8_t> types;
    const auto end_cell = [&](int type) {
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      types.push_back(static_cast<std::uint8_t>(type));
    };
    for (int i = 0; i < n_grains_; ++i) connectivity.push_back(i), end_cell(kVertexCell);
    for (std::size_t k = 0; k < lines_.size(); k += 2) {
      connectivity.insert(connectivity.end(), {lines_[k], lines_[k + 1]});
      end_cell(kLineCell);
    }
    // The format allows several parts. The file written here has one part, so the counts of this part are the counts of
    // the whole file.
    integers(file, kRoot + "/NumberOfPoints", {static_cast<std::int64_t>(n_points)});
    integers(file, kRoot + "/NumberOfCells", {static_cast<std::int64_t>(types.size())});
    integers(file, kRoot + "/NumberOfConnectivityIds", {static_cast<std::int64_t>(connectivity.size())});
    integers(file, kRoot + "/Connectivity", connectivity);
    integers(file, kRoot + "/Offsets", offsets);
    file.array(kRoot + "/Types", {types.size()}, types);
    file.group(kRoot + "/PointData");
    for (const Column* column : {&radius_, &mass_}) write_column(file, "PointData", *column);
    integers(file, kRoot + "/PointData/id", id_);
    file.group(kRoot + "/CellData");
    for (const Column* column :
         {&normal_force_, &shear_force_, &rolling_moment_, &twisting_moment_, &gap_, &image_, &wall_, &bonded_})
      write_column(file, "CellData", *column);
    // A stiffness that the contact law does not have (rigid contacts have none) is left out. A strength that is not
    // given is left out, too, and so are the volumes of liquid bridges of a dry packing.
    for (const Column* column : {&kn_, &kt_, &kr_, &ktw_, &bridge_volume_, &strengths_[0], &strengths_[1],
                                 &strengths_[2], &strengths_[3]})
      if (std::any_of(column->values.begin(), column->values.end(), [](double k) { return k != 0.0; }))
        write_column(file, "CellData", *column);
    integers(file, kRoot + "/CellData/id2", id2_);
  }

  static void write_column(Hdf5Writer& file, const std::string& group, const Column& column) {
    const std::uint64_t n = column.values.size() / column.components;
    file.array(kRoot + "/" + group + "/" + column.name,
               column.components == 1 ? ArrayShape{n} : ArrayShape{n, column.components}, column.values);
  }

 private:
  static void integers(Hdf5Writer& file, const std::string& path, const std::vector<std::int64_t>& values) {
    file.rows<std::int64_t>(path, {values.size()}, [&](std::uint64_t first, std::span<std::int64_t> block) {
      std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first), block.size(), block.begin());
    });
  }
  std::int64_t add_point(const Eigen::Vector3d& x, double radius, double mass, std::int64_t id) {
    points_.insert(points_.end(), x.begin(), x.end());
    radius_.add(radius);
    mass_.add(mass);
    id_.push_back(id);
    return static_cast<std::int64_t>(id_.size()) - 1;
  }

  template <int Dim>
  void add_contact(const Packing<Dim>& packing, const Contact<Dim>& c) {
    const bool inside = !packing.is_wall(c.j) && c.image.isZero();
    const Vec<Dim> end = packing.grains.position[c.i] + branch(packing, c);
    lines_.push_back(c.i);
    lines_.push_back(inside ? c.j : add_point(in_space<Dim>(end), 0.0, 0.0, -1));
    add_cell_data(packing, c, packing.is_wall(c.j) ? -1 : c.j);
  }

  template <int Dim>
  void add_cell_data(const Packing<Dim>& packing, const Contact<Dim>& c, int second) {
    normal_force_.add(-c.normal_force);
    shear_force_.add(in_space<Dim>(c.shear_force));
    rolling_moment_.add(moment_in_space(c.rolling_moment));
    twisting_moment_.add(c.twisting_moment);
    gap_.add(c.gap);
    kn_.add(c.kn);
    kt_.add(c.kt);
    kr_.add(c.kr);
    ktw_.add(c.ktw);
    image_.add(in_space<Dim>(c.image.template cast<double>()));
    wall_.add(second >= 0 ? -1.0 : 2.0 * packing.wall(c.j).axis + (packing.wall(c.j).side > 0 ? 1.0 : 0.0));
    bonded_.add(c.bonded ? 1.0 : 0.0);
    id2_.push_back(second >= 0 ? packing.grains.name(second) : -1);
  }

  int n_grains_ = 0;
  std::vector<double> points_;
  std::vector<std::int64_t> id_, id2_, lines_;
  Column radius_{"radius", 1, {}}, mass_{"mass", 1, {}}, normal_force_{"normal_force", 1, {}},
      shear_force_{"shear_force", 3, {}}, rolling_moment_{"rolling_moment", 3, {}},
      twisting_moment_{"twisting_moment", 1, {}}, gap_{"gap", 1, {}}, kn_{"kn", 1, {}}, kt_{"kt", 1, {}},
      kr_{"kr", 1, {}}, ktw_{"ktw", 1, {}}, bridge_volume_{"bridge_volume", 1, {}}, image_{"image", 3, {}},
      wall_{"wall", 1, {}}, bonded_{"bonded", 1, {}};
  std::array<Column, 4> strengths_{{{kStrengthNames[0], 1, {}},
                                    {kStrengthNames[1], 1, {}},
                                    {kStrengthNames[2], 1, {}},
                                    {kStrengthNames[3], 1, {}}}};
};

template <int Dim>
void encode_vtkhdf(const State<Dim>& state, const std::string& path) {
  const Packing<Dim>& packing = state.packing;
  Hdf5Writer file(path);
  file.group(kRoot);
  file.attribute(kRoot, "Version", std::vector<std::int64_t>{1, 0});
  file.fixed_text_attribute(kRoot, "Type", "UnstructuredGrid");
  Grid(state).write(file);
  file.group(kRoot + "/FieldData");
  Column cell{"cell", 3, {}}, dimension{"dimension", 1, {Dim}}, walls{"walls", 3, {}},
      wall_masses{"wall_masses", 1, {}}, periodic{"periodic", 1, {}}, gravity{"gravity", 3, {}};
  Eigen::Matrix3d lattice = Eigen::Matrix3d::Identity();
  lattice.topLeftCorner<Dim, Dim>() = packing.cell.matrix;
  for (int a = 0; a < 3; ++a) {
    cell.add(Eigen::Vector3d(lattice.row(a)));
    periodic.add(a < Dim && between_walls(packing.walls, a) ? 0.0 : 1.0);
  }
  for (const Wall<Dim>& wall : packing.walls) {
    if (wall.open) continue;
    walls.add({static_cast<double>(wall.axis), static_cast<double>(wall.side), wall.position});
    wall_masses.add(follows_forces(wall) ? wall.mass : 0.0);
  }
  gravity.add(in_space<Dim>(packing.gravity));
  for (const Column* column : {&cell, &dimension, &periodic, &gravity})
    Grid::write_column(file, "FieldData", *column);
  if (!walls.values.empty()) Grid::write_column(file, "FieldData", walls);
  if (std::any_of(packing.walls.begin(), packing.walls.end(), follows_forces<Dim>))
    Grid::write_column(file, "FieldData", wall_masses);
  file.close();
}

/// The cells of a file that are vertices or lines.
struct VtkCells {
  struct Line {
    std::size_t cell;  ///< number of the cell, and row in the arrays of cell data
    std::size_t from, to;
  };
  std::size_t n = 0;  ///< number of all cells
  std::vector<std::size_t> vertices;
  std::vector<Line> lines;
};

/// Reads the arrays of a file.
class VtkHdf {
 public:
  /// @param place  name of the file in messages
  VtkHdf(const std::string& place, const std::string& path) : file_(place, path) {
    if (!file_.has(kRoot)) throw InputError(place, "the HDF5 file has no group VTKHDF");
    std::string type;
    file_.attribute(kRoot, "Type", type);
    is_grid_ = type == "UnstructuredGrid";
    if (!is_grid_ && type != "PolyData")
      throw InputError(file_.place(kRoot),
                       fmt::format("the type is \"{}\", expected UnstructuredGrid or PolyData", type));
    if (file_.has(kRoot + "/Steps"))
      throw InputError(file_.place(kRoot + "/Steps"), "the file contains several time steps, expected one");
  }

  std::string place(const std::string& path) const { return file_.place(kRoot + "/" + path); }
  bool has(const std::string& group, const std::string& name) const {
    return file_.has(kRoot + "/" + group) && file_.has(kRoot + "/" + group + "/" + name);
  }
  std::vector<double> numbers(const std::string& path) const { return file_.numbers(kRoot + "/" + path); }
  std::vector<std::string> names(const std::string& group) const {
    return file_.has(kRoot + "/" + group) ? file_.names(kRoot + "/" + group) : std::vector<std::string>{};
  }

  /// Returns the vertices and lines of the file. The number of a cell is its row in the arrays of cell data.
  VtkCells cells(std::size_t n_points) const {
    VtkCells out;
    if (is_grid_) {
      const std::vector<double> types = numbers("Types");
      add_cells(
          "", [&](std::size_t k) { return k < types.size() ? static_cast<int>(types[k]) : 0; }, n_points, out);
      if (types.size() != out.n)
        throw InputError(
            place("Types"),
            fmt::format("the array has {} numbers, expected one for each of {} cells", types.size(), out.n));
    } else {
      for (const auto& [kind, type] :
           {std::pair{"Vertices/", kVertexCell}, {"Lines/", kLineCell}, {"Polygons/", 0}, {"Strips/", 0}})
        if (file_.has(kRoot + "/" + kind + "Connectivity"))
          add_cells(
              kind, [type = type](std::size_t) { return type; }, n_points, out);
    }
    return out;
  }

 private:
  /// Adds the cells of one group of arrays.
  /// @param type_of  function that returns the type of a cell
  template <class TypeOf>
  void add_cells(const std::string& group, const TypeOf& type_of, std::size_t n_points, VtkCells& out) const {
    const std::vector<double> points = numbers(group + "Connectivity"), offsets = numbers(group + "Offsets");
    for (std::size_t k = 0; k < points.size(); ++k)
      if (!(points[k] >= 0.0 && points[k] < static_cast<double>(n_points)))
        throw InputError(
            place(group + "Connectivity"),
            fmt::format("entry {} is {}, expected a point from 0 to {}", k, points[k], n_points - 1));
    for (std::size_t k = 0; k + 1 < offsets.size(); ++k, ++out.n) {
      const double from = offsets[k], to = offsets[k + 1];
      if (!(from >= 0.0 && from <= to && to <= static_cast<double>(points.size())))
        throw InputError(place(group + "Offsets"),
                         fmt::format("entries {} and {} are {} and {}, expected ascending numbers "
                                     "from 0 to {}, the number of points of all cells",
                                     k, k + 1, from, to, points.size()));
      const auto first = static_cast<std::size_t>(from), size = static_cast<std::size_t>(to) - first;
      const auto point = [&](std::size_t i) { return static_cast<std::size_t>(points[first + i]); };
      const int type = type_of(k);
      if (type == kVertexCell && size == 1) out.vertices.push_back(point(0));
      if (type == kLineCell && size == 2) out.lines.push_back({out.n, point(0), point(1)});
      if ((type == kVertexCell && size != 1) || (type == kLineCell && size != 2))
        throw InputError(place(group + "Offsets"),
                         fmt::format("cell {} has {} points, expected {}", k, size,
                                     type == kVertexCell ? "1: a vertex" : "2: a line"));
    }
  }

  Hdf5Reader file_;
  bool is_grid_ = true;
};

/// One array of cell data; empty if the file does not contain it.
class CellArray {
 public:
  CellArray(const VtkHdf& file, const std::string& name, std::size_t components, std::size_t n_cells)
      : components_(components) {
    if (!file.has("CellData", name)) return;
    values_ = file.numbers("CellData/" + name);
    if (values_.size() != components * n_cells)
      throw InputError(file.place("CellData/" + name),
                       fmt::format("the array has {} numbers, expected {} for each of {} cells", values_.size(),
                                   components, n_cells));
  }
  bool empty() const { return values_.empty(); }
  double number(std::size_t cell) const { return values_[cell]; }
  std::optional<double> number_if(std::size_t cell) const {
    return empty() ? std::nullopt : std::optional<double>(number(cell));
  }
  Eigen::Vector3d vector(std::size_t cell) const {
    return Eigen::Map<const Eigen::Vector3d>(values_.data() + components_ * cell);
  }

 private:
  std::size_t components_;
  std::vector<double> values_;
};

std::int64_t whole_of(const std::string& place, std::size_t entry, double value) {
  if (const auto whole = whole_number(value)) return *whole;
  throw InputError(place, fmt::format("entry {} is {}, expected a whole number", entry, value));
}

/// Makes a contact from each line.
/// @param id  identifier of the grain at each point
std::vector<ListedContact> contacts_of(const VtkHdf& file, const VtkCells& cells,
                                       const std::vector<std::int64_t>& id) {
  const auto array = [&](const char* name, std::size_t components = 1) {
    return CellArray(file, name, components, cells.n);
  };
  const CellArray normal_force = array("normal_force"), shear_force = array("shear_force", 3),
                  rolling = array("rolling_moment", 3), twisting = array("twisting_moment"), kn = array("kn"),
                  kt = array("kt"), kr = array("kr"), ktw = array("ktw"),
                  bridge_volume = array("bridge_volume"), image = array("image", 3), wall = array("wall"),
                  bonded = array("bonded"), id2 = array("id2");
  std::vector<CellArray> strengths;
  for (const char* name : kStrengthNames) strengths.push_back(array(name));
  const auto place = std::make_shared<const std::string>(file.place("CellData") + ", cell ");
  std::vector<ListedContact> contacts;
  for (const VtkCells::Line& line : cells.lines) {
    const std::size_t k = line.cell;
    ListedContact c;
    c.place = {place, static_cast<int>(k)};
    c.id1 = id[line.from];
    c.id2 = id2.empty() ? id[line.to] : whole_of(file.place("CellData/id2"), k, id2.number(k));
    if (!wall.empty() && wall.number(k) != -1.0) {
      const std::int64_t number = whole_of(file.place("CellData/wall"), k, wall.number(k));
      if (number < 0 || number > 5)
        throw InputError(c.place.text(), fmt::format("wall = {}, expected -1 or a number from 0 to 5", number));
      c.wall = WallSide{static_cast<int>(number / 2), number % 2 == 0 ? -1 : 1};
    } else if (!image.empty()) {
      Eigen::Vector3i whole;
      for (int a = 0; a < 3; ++a) {
        constexpr double kFarthest = 1e9;
        if (!(std::abs(image.vector(k)[a]) <= kFarthest))
          throw InputError(c.place.text(),
                           fmt::format("image = {}, expected a number of cells up to 1e9", image.vector(k)[a]));
        whole[a] = static_cast<int>(whole_of(file.place("CellData/image"), k, image.vector(k)[a]));
      }
      c.image = whole;
    }
    if (!normal_force.empty())
      c.normal_force = -normal_force.number(k);  // in the file, the force is positive in tension
    if (!shear_force.empty()) c.shear_force = shear_force.vector(k);
    if (!rolling.empty()) c.rolling_moment = rolling.vector(k);
    c.twisting_moment = twisting.number_if(k);
    c.kn = kn.number_if(k);
    c.kt = kt.number_if(k);
    c.kr = kr.number_if(k);
    c.ktw = ktw.number_if(k);
    c.bridge_volume = bridge_volume.number_if(k);
    for (std::size_t s = 0; s < strengths.size(); ++s) {
      c.strengths[s] = strengths[s].number_if(k).value_or(0.0);
      if (c.strengths[s] < 0.0)
        throw InputError(c.place.text(), fmt::format("{} = {}, expected a strength of 0 or more",
                                                     kStrengthNames[s], c.strengths[s]));
    }
    c.bond = !bonded.empty() && bonded.number(k) != 0.0;
    contacts.push_back(std::move(c));
  }
  return contacts;
}

/// Returns the identifier of the grain at each point: the entry of the array id or, without this array, the index of
/// the point.
std::vector<std::int64_t> identifiers_of(const VtkHdf& file, std::size_t n_points) {
  std::vector<std::int64_t> out;
  const std::vector<double> listed =
      file.has("PointData", "id") ? file.numbers("PointData/id") : std::vector<double>{};
  if (!listed.empty() && listed.size() != n_points)
    throw InputError(
        file.place("PointData/id"),
        fmt::format("the array has {} numbers, expected one for each of {} points", listed.size(), n_points));
  for (std::size_t k = 0; k < n_points; ++k)
    out.push_back(listed.empty() ? static_cast<std::int64_t>(k)
                                 : whole_of(file.place("PointData/id"), k, listed[k]));
  return out;
}

}  // namespace

bool is_vtkhdf(const std::string& path) {
  return is_hdf5(path);
}

Imported read_vtkhdf(const std::string& path, const ImportOptions& options) {
  try {
    std::optional<StdinCopy> copy;
    if (path == "-") copy.emplace();
    const VtkHdf file(copy ? "stdin" : path, copy ? copy->path() : path);
    PointCloud cloud;
    cloud.path = path;
    cloud.x = file.numbers("Points");
    if (cloud.x.size() % 3 != 0)
      throw InputError(file.place("Points"),
                       fmt::format("the array has {} numbers, expected three for each point", cloud.x.size()));
    const std::size_t n_points = cloud.x.size() / 3;
    const VtkCells cells = file.cells(n_points);
    cloud.grains = cells.vertices;
    cloud.arrays = file.names("PointData");
    cloud.place = [&](const std::string& name) { return file.place("PointData/" + name); };
    cloud.read = [&](const std::string& name) { return file.numbers("PointData/" + name); };
    if (options.cell.empty())
      cloud.space = space_of_fields({[&](const std::string& name) { return file.has("FieldData", name); },
                                     [&](const std::string& name) { return file.numbers("FieldData/" + name); },
                                     [&](const std::string& name) { return file.place("FieldData/" + name); }});
    if (!cells.lines.empty()) cloud.contacts = contacts_of(file, cells, identifiers_of(file, n_points));
    return read_points(cloud, options);
  } catch (const Hdf5Failure& failure) {
    throw InputError(path, fmt::format("the file is damaged: {}", failure.what()));
  }
}

void write_vtkhdf(const std::string& path, const AnyState& any) {
  std::visit([&](const auto& state) { require_round(state.packing, "files of this format are written", path); },
             any);
  AtomicFile file(path);
  try {
    std::visit([&](const auto& state) { encode_vtkhdf(state, file.working_path()); }, any);
  } catch (const Hdf5Failure& failure) {
    throw file.cannot_be_written(failure.error());
  }
  file.commit();
}

}  // namespace floc
