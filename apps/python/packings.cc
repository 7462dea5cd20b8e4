#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>

#include "arguments.h"
#include "floc/imports/complete_import.h"
#include "floc/imports/conversion_summary.h"
#include "floc/io/law_text.h"
#include "floc/io/listed_bodies.h"
#include "floc/io/listed_images.h"
#include "floc/io/listed_packing.h"
#include "floc/io/settle_space.h"
#include "floc/shape/manifold.h"
#include "floc/shape/shape.h"

namespace floc::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Integers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// Name in messages for a packing that is made from arrays.
constexpr const char* kName = "packing";

std::string shape_of(const py::array& array) {
  std::string text;
  for (py::ssize_t a = 0; a < array.ndim(); ++a)
    text += fmt::format("{}{}", a == 0 ? "" : ", ", array.shape(a));
  return "(" + text + (array.ndim() == 1 ? ",)" : ")");
}

/// Checks the shape of an array.
/// @param columns  number of columns that are required; -1 for a one-dimensional array
void require_shape(const std::string& name, const py::array& array, py::ssize_t rows, py::ssize_t columns) {
  const bool right = columns < 0 ? array.ndim() == 1 && array.shape(0) == rows
                                 : array.ndim() == 2 && array.shape(0) == rows && array.shape(1) == columns;
  if (right) return;
  throw InputError(
      name, fmt::format("this array has shape {}, expected {}", shape_of(array),
                        columns < 0 ? fmt::format("({},)", rows) : fmt::format("({}, {})", rows, columns)));
}

/// Checks one number of an array. @throws InputError if `right` is false; the message contains the array, the index i,
/// the value and the expectation
void require(bool right, const std::string& name, py::ssize_t i, double value, const char* expected) {
  if (!right)
    throw InputError(fmt::format("{}[{}]", name, i),
                     fmt::format("this number is {}, expected {}", value, expected));
}

double finite(const std::string& name, py::ssize_t i, double value) {
  require(std::isfinite(value), name, i, value, "a finite number");
  return value;
}

double positive(const std::string& name, py::ssize_t i, double value) {
  require(value > 0.0 && std::isfinite(value), name, i, value, "a positive number");
  return value;
}

/// Returns row i of an array with `components` columns, as a vector of three components; missing components are 0.
Eigen::Vector3d row_of(const std::string& name, const Numbers& array, py::ssize_t i, int components) {
  Eigen::Vector3d row = Eigen::Vector3d::Zero();
  for (int a = 0; a < components; ++a) row[a] = finite(name, i, array.data()[i * components + a]);
  return row;
}

/// Returns the grains that the arrays describe. With the array `radius` they are disks or spheres. Without this array
/// their shapes, positions and radii are set later, by ShapeArrays::give().
std::vector<ListedGrain> listed_grains(const Numbers& position, const std::optional<Numbers>& radius,
                                       const std::optional<Numbers>& mass, const std::optional<Integers>& ids,
                                       int dimension) {
  if (position.ndim() != 2 || position.shape(1) != dimension)
    throw InputError(
        "position",
        fmt::format(
            "this array has shape {}, expected (n, {}): as many columns as the cell has lattice vectors",
            shape_of(position), dimension));
  const py::ssize_t n = position.shape(0);
  if (n == 0) throw InputError("position", "this array has no rows: expected one row per grain");
  if (radius) require_shape("radius", *radius, n, -1);
  if (mass) require_shape("mass", *mass, n, -1);
  if (ids) require_shape("ids", *ids, n, -1);
  const auto before = std::make_shared<const std::string>("grain ");
  std::vector<ListedGrain> grains(static_cast<std::size_t>(n));
  for (py::ssize_t i = 0; i < n; ++i) {
    ListedGrain& grain = grains[static_cast<std::size_t>(i)];
    grain.place = {before, static_cast<int>(i)};
    grain.id = ids ? ids->data()[i] : i;
    grain.position = row_of("position", position, i, dimension);
    if (radius) grain.radius = positive("radius", i, radius->data()[i]);
    if (mass) grain.mass = positive("mass", i, mass->data()[i]);
  }
  return grains;
}

/// Arrays that describe grains with corners: the shapes, as dicts with vertices and rounding, and for each grain its
/// shape, scale and orientation.
class ShapeArrays {
 public:
  /// @param arrays  dict with the entry shapes and optionally shape, scale and orientation
  ShapeArrays(const py::dict& arrays, int dimension) : arrays_(arrays), dimension_(dimension) {}

  /// Assigns the shapes to the listed grains. The listed position of a grain is the position of the point at which the
  /// coordinates of the vertices are zero.
  void give(ListedPacking& listed) const {
    const auto given = arrays_["shapes"].cast<std::vector<py::dict>>();
    if (given.empty()) throw InputError("shapes", "there is no shape, expected at least one");
    for (std::size_t s = 0; s < given.size(); ++s) {
      if (dimension_ == 2)
        listed.shapes.in_2d.push_back(made<2>(s, given[s], listed.remarks));
      else
        listed.shapes.in_3d.push_back(made<3>(s, given[s], listed.remarks));
    }
    const auto n = static_cast<py::ssize_t>(listed.grains.size());
    const auto scale = optional<Numbers>("scale", n, -1);
    const auto orientation = optional<Numbers>("orientation", n, dimension_ == 2 ? -1 : 4);
    for (py::ssize_t i = 0; i < n; ++i) {
      ListedGrain& grain = listed.grains[static_cast<std::size_t>(i)];
      set_shape(listed.shapes, index(i, n, static_cast<std::int64_t>(given.size())),
                scale ? positive("scale", i, scale->data()[i]) : 1.0, grain.position, turn(orientation, i),
                grain);
    }
  }

 private:
  template <class Array>
  std::optional<Array> optional(const char* name, py::ssize_t n, int columns) const {
    if (!arrays_.contains(name)) return std::nullopt;
    auto found = arrays_[name].cast<Array>();
    require_shape(name, found, n, columns);
    return found;
  }

  /// Returns the index of the shape of grain i.
  int index(py::ssize_t i, py::ssize_t n, std::int64_t n_shapes) const {
    const auto shape = optional<Integers>("shape", n, -1);
    if (!shape && n_shapes > 1)
      throw InputError(
          "shape",
          fmt::format("there are {} shapes, expected an array with the index of the shape of each grain",
                      n_shapes));
    const std::int64_t s = shape ? shape->data()[i] : 0;
    if (s < 0 || s >= n_shapes)
      throw InputError(
          fmt::format("shape[{}]", i),
          fmt::format("this number is {}, expected the index of a shape, from 0 to {}", s, n_shapes - 1));
    return static_cast<int>(s);
  }

  /// Returns the rotation of grain i, from the axes of its shape to the axes of space.
  Eigen::Matrix3d turn(const std::optional<Numbers>& orientation, py::ssize_t i) const {
    if (!orientation) return Eigen::Matrix3d::Identity();
    if (dimension_ == 2)
      return Eigen::AngleAxisd(finite("orientation", i, orientation->data()[i]), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
    Eigen::Vector4d q;
    for (int a = 0; a < 4; ++a) q[a] = finite("orientation", i, orientation->data()[4 * i + a]);
    if (std::abs(q.norm() - 1.0) > kUnit)
      throw InputError(fmt::format("orientation[{}]", i),
                       fmt::format("the norm of this quaternion is {}, expected 1", q.norm()));
    return Eigen::Quaterniond(q).normalized().toRotationMatrix();
  }

  /// Makes shape number s: the hull of the given points, a capsule for two points, or a disk or sphere of radius
  /// `rounding` for no points.
  template <int Dim>
  static Shape<Dim> made(std::size_t s, const py::dict& words, std::vector<std::string>& remarks) {
    const std::string name = fmt::format("shapes[{}]", s);
    const double rounding = words.contains("rounding") ? words["rounding"].cast<double>() : 0.0;
    if (!(rounding >= 0.0) || !std::isfinite(rounding))
      throw InputError(name, fmt::format("rounding is {}, expected a number >= 0", rounding));
    const auto vertices = words["vertices"].cast<Numbers>();
    if (vertices.ndim() != 2 || vertices.shape(1) != Dim)
      throw InputError(name, fmt::format("vertices has shape {}, expected (k, {})", shape_of(vertices), Dim));
    std::vector<Vec<Dim>> points;
    for (py::ssize_t v = 0; v < vertices.shape(0); ++v)
      points.push_back(row_of(name + ": vertices", vertices, v, Dim).template head<Dim>());
    if (points.size() < 3 && !(rounding > 0.0))
      throw InputError(
          name, fmt::format("it has {} vertices and no rounding, expected a rounding > 0 or more vertices",
                            points.size()));
    if (points.empty()) return round_shape<Dim>(rounding);
    if (points.size() == 2) return capsule_between<Dim>(points[0], points[1], rounding, name);
    ShapeOfPoints<Dim> made = shape_of_points<Dim>(points, rounding, name);
    remarks.insert(remarks.end(), made.remarks.begin(), made.remarks.end());
    return std::move(made.shape);
  }

  static constexpr double kUnit = 1e-6;  ///< largest error of the norm of a quaternion
  const py::dict& arrays_;
  int dimension_;
};

/// Arrays that describe contacts. The arrays are named like the columns that `floc convert --contacts` reads.
class ContactArrays {
 public:
  /// @param name  word for the arrays in messages: contacts or bonds
  ContactArrays(const py::dict& arrays, int dimension, std::string name)
      : arrays_(arrays), dimension_(dimension), name_(std::move(name)) {}

  std::vector<ListedContact> listed() const {
    const auto id1 = required("id1"), id2 = required("id2");
    if (id1.ndim() != 1) throw InputError(name_, "id1 has shape " + shape_of(id1) + ", expected (n,)");
    const py::ssize_t n = id1.shape(0);
    require_shape(name_ + ": id2", id2, n, -1);
    // All contacts share one copy of this word. A copy in every contact would use much more memory.
    const auto before = std::make_shared<const std::string>(name_ == "bonds" ? "bond " : "contact ");
    std::vector<ListedContact> contacts(static_cast<std::size_t>(n));
    for (py::ssize_t c = 0; c < n; ++c) {
      ListedContact& contact = contacts[static_cast<std::size_t>(c)];
      contact.place = {before, static_cast<int>(c)};
      contact.id1 = id1.data()[c];
      contact.id2 = id2.data()[c];
    }
    // The images are set before the walls, because set_walls() removes the image of a contact with a wall: walls have
    // no periodic images.
    set_images(contacts);
    set_walls(contacts);
    vectors("force", &ListedContact::force, contacts);
    vectors("shear_force", &ListedContact::shear_force, contacts);
    // Beside a tangential force, the array force is the normal part, as in a csv file that `floc convert` reads.
    for (ListedContact& contact : contacts)
      if (contact.force && contact.shear_force) *contact.force += *contact.shear_force;
    rolling(contacts);
    numbers("normal_force", &ListedContact::normal_force, contacts);
    numbers("twisting_moment", &ListedContact::twisting_moment, contacts);
    numbers("kn", &ListedContact::kn, contacts);
    numbers("kt", &ListedContact::kt, contacts);
    numbers("kr", &ListedContact::kr, contacts);
    numbers("ktw", &ListedContact::ktw, contacts);
    numbers("bridge_volume", &ListedContact::bridge_volume, contacts);
    vectors("point", &ListedContact::point, contacts);
    vectors("normal", &ListedContact::normal, contacts);
    numbers("gap", &ListedContact::gap, contacts);
    set_kinds(contacts);
    return contacts;
  }

 private:
  Integers required(const char* name) const {
    if (!arrays_.contains(name)) throw InputError(name_, fmt::format("the required array {} is missing", name));
    return arrays_[name].cast<Integers>();
  }

  void set_images(std::vector<ListedContact>& contacts) const {
    if (!arrays_.contains("image")) return;
    const auto image = arrays_["image"].cast<Integers>();
    require_shape(name_ + ": image", image, static_cast<py::ssize_t>(contacts.size()), dimension_);
    const std::int64_t* next = image.data();
    for (ListedContact& contact : contacts) {
      contact.image = Eigen::Vector3i::Zero();
      for (int a = 0; a < dimension_; ++a) {
        const std::int64_t cells = *next++;
        if (static_cast<double>(cells) > kFarthestImage || static_cast<double>(cells) < -kFarthestImage)
          throw InputError(fmt::format("{}: image[{}]", name_, &contact - contacts.data()),
                           fmt::format("found {}, expected a number of cells up to 1e9 in magnitude", cells));
        (*contact.image)[a] = static_cast<int>(cells);
      }
    }
  }

  /// Reads the array `type`: the kind of each contact point, with the values that the contacts of a state have.
  void set_kinds(std::vector<ListedContact>& contacts) const {
    if (!arrays_.contains("type")) return;
    const auto type = arrays_["type"].cast<Integers>();
    require_shape(name_ + ": type", type, static_cast<py::ssize_t>(contacts.size()), -1);
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const std::int64_t value = type.data()[c];
      const bool known = value >= 0 && value <= static_cast<std::int64_t>(ContactType::kFaceFace);
      if (!known || !is_contact_type_in(static_cast<ContactType>(value), dimension_))
        throw InputError(
            fmt::format("{}: type[{}]", name_, c),
            fmt::format("found {}, expected {}", value,
                        dimension_ == 2 ? "0 (vertex-face) or 3 (face-face)"
                                        : "0 (vertex-face), 1 (edge-edge), 2 (double) or 3 (face-face)"));
      contacts[c].kind = static_cast<ContactType>(value);
    }
  }

  /// Reads the array `wall`. An entry is the name of a wall, such as "y-", or an empty text for a contact between
  /// grains.
  void set_walls(std::vector<ListedContact>& contacts) const {
    if (!arrays_.contains("wall")) return;
    const auto walls = arrays_["wall"].cast<std::vector<std::string>>();
    if (walls.size() != contacts.size())
      throw InputError(name_ + ": wall",
                       fmt::format("there are {} names of walls, expected one name for each of {} contacts",
                                   walls.size(), contacts.size()));
    for (std::size_t c = 0; c < walls.size(); ++c) {
      if (walls[c].empty()) continue;
      contacts[c].wall = wall_side(walls[c]);
      if (!contacts[c].wall)
        throw InputError(
            fmt::format("{}: wall[{}]", name_, c),
            fmt::format("\"{}\" is not the name of a wall, expected a name such as x- or y+, or an empty text",
                        walls[c]));
      contacts[c].image.reset();
    }
  }

  /// Returns the array called `name` after a check of its shape; absent if the user has not given this array.
  std::optional<Numbers> array(const std::string& name, std::size_t n, int columns) const {
    if (!arrays_.contains(name.c_str())) return std::nullopt;
    auto found = arrays_[name.c_str()].cast<Numbers>();
    require_shape(name_ + ": " + name, found, static_cast<py::ssize_t>(n), columns);
    return found;
  }

  void numbers(const char* name, std::optional<double> ListedContact::*member,
               std::vector<ListedContact>& contacts) const {
    const auto given = array(name, contacts.size(), -1);
    if (!given) return;
    const std::string words = name_ + ": " + name;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      contacts[c].*member = finite(words, static_cast<py::ssize_t>(c), given->data()[c]);
  }

  void vectors(const char* name, std::optional<Eigen::Vector3d> ListedContact::*member,
               std::vector<ListedContact>& contacts) const {
    const auto given = array(name, contacts.size(), dimension_);
    if (!given) return;
    const std::string words = name_ + ": " + name;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      contacts[c].*member = row_of(words, *given, static_cast<py::ssize_t>(c), dimension_);
  }

  /// Reads the rolling moments. In 2D the moment is a single number, because its axis is normal to the plane.
  void rolling(std::vector<ListedContact>& contacts) const {
    if (dimension_ == 3) return vectors("rolling_moment", &ListedContact::rolling_moment, contacts);
    const auto given = array("rolling_moment", contacts.size(), -1);
    if (!given) return;
    for (std::size_t c = 0; c < contacts.size(); ++c)
      contacts[c].rolling_moment = Eigen::Vector3d(
          0.0, 0.0, finite(name_ + ": rolling_moment", static_cast<py::ssize_t>(c), given->data()[c]));
  }

  const py::dict& arrays_;
  int dimension_;
  std::string name_;
};

/// Converts contact points to positions in space. The arrays contain the points relative to the centre of the first
/// grain.
void place_points(const std::vector<ListedGrain>& grains, std::vector<ListedContact>& contacts) {
  std::map<std::int64_t, Eigen::Vector3d> centre;
  for (const ListedGrain& grain : grains) centre.emplace(grain.id, grain.position);
  for (ListedContact& contact : contacts)
    if (const auto found = centre.find(contact.id1); contact.point && found != centre.end())
      *contact.point += found->second;
}

/// Makes a packing from the arrays and completes it, as `floc convert` completes a packing from files.
NamedState assembled(const ListedPacking& listed, const ImportCompletion& completion) {
  return without_gil([&](const Remarks& remarks) {
    Imported imported = assemble(listed);
    ConversionSummary summary;
    std::visit(
        [&](auto& state) {
          const std::string remarked = complete_import(kName, imported, completion, state);
          if (!remarked.empty()) remarks.remark(kName, remarked);
          state.provenance.source = "arrays of Python";
          summary = summarize(imported, state);
        },
        imported.state);
    for (const std::string& remark : imported.remarks) remarks.remark(kName, remark);
    for (const std::string& doubt : summary.inconsistencies) remarks.warn(kName, doubt);
    return NamedState{std::make_shared<const AnyState>(std::move(imported.state)), kName};
  });
}

/// Converts the argument `wall_ids`, a dict of the identifiers of bodies and the names of the walls that they are.
std::map<std::int64_t, WallSide> walls_of(const py::dict& wall_ids) {
  std::map<std::int64_t, WallSide> walls;
  for (const auto& [id, name] : wall_ids) {
    const std::string words = text_of("wall_ids", name, "the name of a wall, such as x- or y+");
    const std::optional<WallSide> side = wall_side(words);
    if (!side)
      throw InputError(
          "wall_ids", fmt::format("\"{}\" is not the name of a wall, expected a name such as x- or y+", words));
    walls.emplace(id.cast<std::int64_t>(), *side);
  }
  return walls;
}

NamedState from_arrays(const Numbers& position, const std::optional<Numbers>& radius, const Numbers& cell,
                       const std::optional<py::dict>& shapes, const std::string& law,
                       const std::optional<py::dict>& contacts, const std::optional<py::dict>& bonds,
                       const py::object& walls, const std::optional<std::string>& wall_law,
                       const py::dict& wall_ids, const py::object& touch_gap, const py::object& gravity,
                       const std::optional<Numbers>& mass, const std::optional<Integers>& ids,
                       const py::object& stress, const py::object& tolerance, const py::object& units,
                       const py::object& drop_tensile) {
  if (cell.ndim() != 2 || cell.shape(0) != cell.shape(1) || (cell.shape(0) != 2 && cell.shape(0) != 3))
    throw InputError("cell", fmt::format("this array has shape {}, expected (2, 2) or (3, 3)", shape_of(cell)));
  const auto dimension = static_cast<int>(cell.shape(0));
  ListedPacking listed;
  listed.place = kName;
  listed.cell_place = "cell";
  listed.law = parse_law("law", law);
  listed.units = word_of("units", units, {"reduced", "SI"});
  listed.drop_tensile = flag_of("drop_tensile", drop_tensile);
  const std::optional<double> gap = number_if_any("touch_gap", touch_gap, kNotNegativeNumber);
  if (gap && contacts)
    throw InputError(
        "touch_gap",
        "this argument is for contacts that are found from the geometry: leave out contacts or this "
        "argument");
  for (int a = 0; a < dimension; ++a) {
    const Eigen::Vector3d vector = row_of("cell", cell, a, dimension);
    listed.space.cell.emplace_back(vector.data(), vector.data() + 3);
  }
  listed.space.cell.resize(3, {0.0, 0.0, 1.0});
  listed.space.place = "cell";
  listed.space.dimension = dimension;
  listed.space.periodic = {true, true, true};
  if (wall_law) listed.wall_law = parse_law("wall_law", *wall_law);
  listed.grains = listed_grains(position, radius, mass, ids, dimension);
  if (shapes) ShapeArrays(*shapes, dimension).give(listed);
  ImportOptions options;
  options.walls = text_of("walls", walls, "a text such as \"x,y\" or \"y=0:5\"");
  options.gravity = numbers_of("gravity", gravity);
  settle_space(options, listed);
  if (contacts) listed.contacts = ContactArrays(*contacts, dimension, "contacts").listed();
  if (bonds) listed.bonds = ContactArrays(*bonds, dimension, "bonds").listed();
  const std::map<std::int64_t, WallSide> named = walls_of(wall_ids);
  for (ListedContact& bond : listed.bonds) name_wall(named, bond);
  if (listed.contacts) {
    for (ListedContact& contact : *listed.contacts) name_wall(named, contact);
    place_points(listed.grains, *listed.contacts);
    add_wall_contacts("the argument contacts", listed);
  }
  for (ListedContact& bond : listed.bonds) bond.bond = true;
  return assembled(listed, {.law_place = "law",
                            .stress = numbers_of("stress", stress),
                            .stress_place = "stress",
                            .tolerance = number_if_any("tolerance", tolerance, kPositiveNumber),
                            .touch_gap = gap.value_or(0.0)});
}

}  // namespace

void bind_packings(py::module_& module) {
  module.def("from_arrays", &from_arrays, py::kw_only(), py::arg("position"), py::arg("radius"),
             py::arg("cell"), py::arg("shapes"), py::arg("law"), py::arg("contacts"), py::arg("bonds"),
             py::arg("walls"), py::arg("wall_law"), py::arg("wall_ids"), py::arg("touch_gap"),
             py::arg("gravity"), py::arg("mass"), py::arg("ids"), py::arg("stress"), py::arg("tolerance"),
             py::arg("units"), py::arg("drop_tensile"));
}

}  // namespace floc::python
