#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <numeric>

#include "binding.h"
#include "floc/io/law_text.h"
#include "floc/packing/balance.h"
#include "floc/packing/equilibrium.h"
#include "floc/packing/equilibrium_check.h"
#include "floc/packing/overlaps.h"

namespace floc::python {
namespace {

/// A member of the C++ class Contact, which is a field of a structured array in Python.
struct ContactField {
  std::string name;
  const char* type;  ///< numpy type of one component
  int size;          ///< number of components
  std::ptrdiff_t offset;
};

template <int Dim>
std::vector<ContactField> contact_fields(const Law& law, bool shaped) {
  // Each field has the offset of its member in a contact. With the offsets, numpy reads the contacts directly from the
  // memory of the state.
  const Contact<Dim> c;
  const auto offset = [&c](const void* member) {
    return static_cast<const char*>(member) - reinterpret_cast<const char*>(&c);
  };
  constexpr int kTurns = kRotations<Dim>;
  std::vector<ContactField> fields = {{"id1", "i4", 1, offset(&c.i)},
                                      {"id2", "i4", 1, offset(&c.j)},
                                      {"image", "i4", Dim, offset(&c.image)},
                                      {"key", "i4", 1, offset(&c.key)},
                                      {"gap", "f8", 1, offset(&c.gap)},
                                      {"normal", "f8", Dim, offset(&c.normal)},
                                      {"normal_force", "f8", 1, offset(&c.normal_force)},
                                      {"elastic_force", "f8", 1, offset(&c.elastic_force)},
                                      {"shear_force", "f8", Dim, offset(&c.shear_force)},
                                      {"rolling_moment", "f8", kTurns, offset(&c.rolling_moment)},
                                      {"twisting_moment", "f8", 1, offset(&c.twisting_moment)},
                                      {"kn", "f8", 1, offset(&c.kn)},
                                      {"kt", "f8", 1, offset(&c.kt)},
                                      {"kr", "f8", 1, offset(&c.kr)},
                                      {"ktw", "f8", 1, offset(&c.ktw)},
                                      {"sliding", "?", 1, offset(&c.sliding)},
                                      {"rolling_yield", "?", 1, offset(&c.rolling_yield)},
                                      {"twisting_yield", "?", 1, offset(&c.twisting_yield)},
                                      {"distant", "?", 1, offset(&c.distant)}};
  if (shaped) {
    fields.push_back({"point", "f8", Dim, offset(&c.arm_i)});
    fields.push_back({"type", "u1", 1, offset(&c.type)});
  }
  // The contact law defines the names and places of the numbers in the member `history`.
  for (const HistoryQuantity& q : history_quantities(law, Dim))
    fields.push_back({q.declared.name, "f8", q.size, offset(c.history.data() + q.begin)});
  return fields;
}

template <int Dim>
py::dtype contact_type(const Law& law, bool shaped) {
  py::list names, formats, offsets;
  for (const ContactField& field : contact_fields<Dim>(law, shaped)) {
    names.append(field.name);
    formats.append(field.size == 1 ? std::string(field.type) : fmt::format("({},){}", field.size, field.type));
    offsets.append(field.offset);
  }
  return {names, formats, offsets, sizeof(Contact<Dim>)};
}

/// Returns a part of the memory of a state as a read-only array. The array keeps `owner`, the Python object of the
/// state, alive.
py::array view(const py::object& owner, const py::dtype& type, const std::vector<py::ssize_t>& shape,
               const std::vector<py::ssize_t>& strides, const void* data) {
  py::array array(type, shape, strides, data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Returns the items of a vector as a read-only array with `components` columns; the array is one-dimensional if there
/// is only one component.
template <class Item>
py::array view_of(const py::object& owner, const std::vector<Item>& items, py::ssize_t components) {
  const auto n = static_cast<py::ssize_t>(items.size());
  constexpr py::ssize_t kItem = sizeof(Item), kNumber = sizeof(double);
  if (components == 1) return view(owner, py::dtype::of<double>(), {n}, {kItem}, items.data());
  return view(owner, py::dtype::of<double>(), {n, components}, {kItem, kNumber}, items.data());
}

template <int Rows, int Columns>
py::array view_of(const py::object& owner, const Eigen::Matrix<double, Rows, Columns>& matrix) {
  constexpr py::ssize_t kNumber = sizeof(double);
  if constexpr (Columns == 1) return view(owner, py::dtype::of<double>(), {Rows}, {kNumber}, matrix.data());
  return view(owner, py::dtype::of<double>(), {Rows, Columns}, {kNumber, Rows * kNumber}, matrix.data());
}

const AnyState& state_in(const py::object& self) {
  return *self.cast<const NamedState&>().state;
}

/// Makes a Python property from a function get(self, state), which accepts both 2D and 3D states.
template <class Get>
auto property(Get get) {
  return [get](const py::object& self) {
    return std::visit([&](const auto& state) -> py::object { return get(self, state); }, state_in(self));
  };
}

template <int Dim>
py::list walls_of(const Packing<Dim>& packing) {
  py::list walls;
  for (const Wall<Dim>& w : packing.walls) {
    py::dict wall;
    wall["axis"] = w.axis, wall["side"] = w.side, wall["position"] = w.position;
    wall["velocity"] = w.velocity, wall["mass"] = w.mass, wall["open"] = w.open;
    walls.append(wall);
  }
  return walls;
}

py::dict residuals_of(const Residuals& r) {
  py::dict measures;
  measures["force"] = r.force, measures["moment"] = r.moment;
  measures["stress"] = r.stress, measures["energy"] = r.energy;
  return measures;
}

template <int Dim>
py::dict path_of(const State<Dim>& state) {
  py::dict path;
  path["step"] = state.path.step, path["branch"] = state.path.branch, path["time"] = state.path.time;
  path["n_steps"] = state.path.n_steps, path["ending"] = state.path.ending;
  return path;
}

/// Returns a copy of numbers as a one-dimensional array.
template <class Number>
py::array_t<Number> copied_array(const std::vector<Number>& numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// Returns the shapes of grains with corners as dicts of arrays; None for disks and spheres.
template <int Dim>
py::object shapes_of(const Packing<Dim>& packing) {
  if (packing.grains.are_round()) return py::none();
  py::list shapes;
  for (const Shape<Dim>& shape : *packing.grains.shapes) {
    py::array_t<double> vertices({static_cast<py::ssize_t>(shape.vertices.size()), py::ssize_t{Dim}});
    for (std::size_t k = 0; k < shape.vertices.size(); ++k)
      for (int a = 0; a < Dim; ++a) vertices.mutable_at(static_cast<py::ssize_t>(k), a) = shape.vertices[k][a];
    py::list faces;
    for (int f = 0; f < shape.n_faces(); ++f)
      faces.append(copied_array(std::vector<int>(shape.loop(f).begin(), shape.loop(f).end())));
    py::dict words;
    words["vertices"] = vertices, words["faces"] = faces;
    words["rounding"] = shape.rounding, words["volume"] = shape.volume;
    words["inertia"] = copied_array(std::vector<double>(shape.inertia.begin(), shape.inertia.end()));
    words["outer_radius"] = shape.outer_radius;
    shapes.append(words);
  }
  return shapes;
}

template <int Dim>
py::object motion_of(const State<Dim>& state) {
  if (!state.motion) return py::none();
  py::dict words;
  words["time_step"] = state.motion->time_step, words["residual"] = state.motion->residual;
  words["inertial_number"] = state.motion->inertial_number;
  return words;
}

template <int Dim>
py::dict provenance_of(const State<Dim>& state) {
  const Provenance& p = state.provenance;
  py::dict words;
  words["program"] = p.program, words["commit"] = p.commit, words["compiler"] = p.compiler;
  words["seed"] = p.seed, words["parent_sha256"] = p.parent_sha256, words["source"] = p.source;
  return words;
}

/// Binds the arrays of a state. The arrays are views of the memory of the state, except for the identifiers of grains
/// that were imported without identifiers: they are computed.
void bind_arrays(py::class_<NamedState>& bound) {
  bound
      .def_property_readonly("position", property([](const py::object& self, const auto& s) -> py::object {
                               return view_of(self, s.packing.grains.position, s.target_stress.size());
                             }))
      .def_property_readonly("position_low", property([](const py::object& self, const auto& s) -> py::object {
                               const auto& low = s.packing.grains.position_low;
                               if (low.empty()) return py::none();
                               return view_of(self, low, s.target_stress.size());
                             }))
      .def_property_readonly("velocity", property([](const py::object& self, const auto& s) -> py::object {
                               return view_of(self, s.packing.grains.velocity, s.target_stress.size());
                             }))
      .def_property_readonly("radius", property([](const py::object& self, const auto& s) -> py::object {
                               return view_of(self, s.packing.grains.radius, 1);
                             }))
      .def_property_readonly("mass", property([](const py::object& self, const auto& s) -> py::object {
                               return view_of(self, s.packing.grains.mass, 1);
                             }))
      .def_property_readonly("ids", property([](const py::object& self, const auto& s) -> py::object {
                               const auto& id = s.packing.grains.id;
                               const auto n = static_cast<py::ssize_t>(s.packing.grains.size());
                               constexpr py::ssize_t kItem = sizeof(std::int64_t);
                               if (!id.empty())
                                 return view(self, py::dtype::of<std::int64_t>(), {n}, {kItem}, id.data());
                               // Without imported identifiers, the indices of the grains are returned. This
                               // array is made read-only, like the views of the memory of the state.
                               py::array_t<std::int64_t> indices(n);
                               std::iota(indices.mutable_data(), indices.mutable_data() + n, std::int64_t{0});
                               py::detail::array_proxy(indices.ptr())->flags &=
                                   ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
                               return indices;
                             }))
      .def_property_readonly("orientation", property([](const py::object& self, const auto& s) -> py::object {
                               return view_of(self, s.packing.grains.orientation,
                                              s.target_stress.size() == 2 ? 1 : 4);
                             }))
      .def_property_readonly(
          "angular_velocity", property([](const py::object& self, const auto& s) -> py::object {
            return view_of(self, s.packing.grains.angular_velocity, s.target_stress.size() == 2 ? 1 : 3);
          }))
      .def_property_readonly(
          "contacts", property([]<int Dim>(const py::object& self, const State<Dim>& s) -> py::object {
            const std::vector<Contact<Dim>>& contacts = s.packing.contacts;
            return view(self, contact_type<Dim>(s.packing.law, !s.packing.grains.are_round()),
                        {static_cast<py::ssize_t>(contacts.size())}, {sizeof(Contact<Dim>)}, contacts.data());
          }))
      .def_property_readonly("cell", property([](const py::object& self, const auto& s) -> py::object {
                               return view_of(self, s.packing.cell.matrix);
                             }))
      .def_property_readonly("stress", property([](const py::object& self, const auto& s) -> py::object {
                               return view_of(self, s.stress);
                             }))
      .def_property_readonly("target_stress", property([](const py::object& self, const auto& s) -> py::object {
                               return view_of(self, s.target_stress);
                             }));
}

/// Returns the pressure of a state: the mean of the diagonal components of the stress that the contact forces give.
template <int Dim>
double pressure_of(const State<Dim>& state) {
  return static_stress(state.packing).trace() / Dim;
}

void bind_numbers(py::class_<NamedState>& bound) {
  bound
      .def_property_readonly(
          "dimension", property([]<int Dim>(const py::object&, const State<Dim>&) { return py::int_(Dim); }))
      .def_property_readonly("n_grains", property([](const py::object&, const auto& s) {
                               return py::int_(s.packing.grains.size());
                             }))
      .def_property_readonly("n_contacts", property([](const py::object&, const auto& s) {
                               return py::int_(s.packing.contacts.size());
                             }))
      .def_property_readonly(
          "pressure", property([](const py::object&, const auto& s) { return py::float_(pressure_of(s)); }))
      .def_property_readonly("reduced_pressure", property([](const py::object&, const auto& s) {
                               return py::float_(reduced_pressure(s.packing, pressure_of(s)));
                             }))
      .def_property_readonly("solid_fraction", property([](const py::object&, const auto& s) {
                               return py::float_(solid_fraction(s.packing));
                             }))
      .def_property_readonly("residuals", property([](const py::object&, const auto& s) {
                               return residuals_of(residuals(s.packing, s.target_stress));
                             }))
      .def_property_readonly("equilibrium_faults", property([](const py::object&, const auto& s) {
                               return py::str(equilibrium_faults(s));
                             }));
}

void bind_words(py::class_<NamedState>& bound) {
  bound.def_property_readonly("name", [](const NamedState& s) { return s.name; })
      .def_property_readonly("units",
                             property([](const py::object&, const auto& s) { return py::str(s.units); }))
      .def_property_readonly(
          "law", property([](const py::object&, const auto& s) { return py::str(law_text(s.packing.law)); }))
      .def_property_readonly("walls",
                             property([](const py::object&, const auto& s) { return walls_of(s.packing); }))
      .def_property_readonly("tolerance", property([](const py::object&, const auto& s) {
                               const EquilibriumTolerance& t = s.tolerance;
                               return residuals_of({t.force, t.moment, t.stress, t.energy});
                             }))
      .def_property_readonly("path", property([](const py::object&, const auto& s) { return path_of(s); }))
      .def_property_readonly("shapes",
                             property([](const py::object&, const auto& s) { return shapes_of(s.packing); }))
      // For disks and spheres, the vectors `shape` and `scale` are empty. Arrays without elements would have another
      // length than the array of radii, so these properties are None.
      .def_property_readonly("shape", property([](const py::object&, const auto& s) -> py::object {
                               if (s.packing.grains.are_round()) return py::none();
                               return copied_array(s.packing.grains.shape);
                             }))
      .def_property_readonly("scale", property([](const py::object&, const auto& s) -> py::object {
                               if (s.packing.grains.are_round()) return py::none();
                               return copied_array(s.packing.grains.scale);
                             }))
      .def_property_readonly("motion", property([](const py::object&, const auto& s) { return motion_of(s); }))
      .def_property_readonly("scene",
                             property([](const py::object&, const auto& s) { return py::str(s.scene); }))
      .def_property_readonly("provenance",
                             property([](const py::object&, const auto& s) { return provenance_of(s); }));
}

NamedState read(const std::string& path) {
  return without_gil([&](const Remarks& remarks) {
    auto state = std::make_shared<const AnyState>(read_state(path));
    const std::string deep = std::visit([](const auto& s) { return overlap_warning(s.packing); }, *state);
    if (!deep.empty()) remarks.warn(path, deep);
    return NamedState{std::move(state), path};
  });
}

/// Reads the state in a Python pickle and gives it its old name. Warnings are not repeated, because they were issued
/// when the state was first read.
NamedState restore(const std::string& path, const std::string& name) {
  const py::gil_scoped_release released;
  return NamedState{std::make_shared<const AnyState>(read_state(path)), name};
}

}  // namespace

void bind_state(py::module_& module) {
  py::class_<NamedState> bound(module, "State");
  bound.def(py::init<const NamedState&>());
  bind_arrays(bound);
  bind_numbers(bound);
  bind_words(bound);
  bound.def("write", [](const NamedState& self, const std::string& path) {
    const py::gil_scoped_release released;
    std::visit([&](const auto& state) { write_state(path, state); }, *self.state);
  });
  module.def("read", &read);
  module.def("restore", &restore);
}

}  // namespace floc::python
