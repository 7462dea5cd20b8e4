#include <fmt/format.h>

#include <iterator>
#include <optional>

#include "binding.h"
#include "chain_rows.h"
#include "compare_rows.h"
#include "equilibrium_check.h"
#include "moduli_request.h"
#include "network_rows.h"
#include "structure_columns.h"
#include "structure_rows.h"

namespace floc::python {
namespace {

using States = std::vector<NamedState>;
using Names = std::vector<std::string>;

/// Any text: the table is wanted, and goes to no file.
constexpr const char* kWanted = "wanted";

/// @throws EquilibriumError unless the state is an equilibrium or is taken all the same
void require_equilibrium(const NamedState& s, bool force) {
  const std::string faults = std::visit([](const auto& state) { return equilibrium_faults(state); }, *s.state);
  if (faults.empty()) return;
  if (!force)
    throw EquilibriumError(s.name + ": this state is not in equilibrium: " + faults +
                           "; force=True computes moduli anyway");
  warn(s.name, "this state is not in equilibrium: " + faults);
}

/// Adds the rows of one state. @param increments  null: none are wanted
void add_moduli(const NamedState& s, const ModuliCommand& command, const ModuliRequest& request,
                ModuliRows& computation, Table* increments, std::vector<ModuliRow>& rows) {
  require_equilibrium(s, command.force);
  require_strains(s.name, *s.state, request.options.strains);
  std::vector<ModuliRow> computed =
      std::visit([&](const auto& state) { return computation.of(s.name, state, increments); }, *s.state);
  for (const ModuliRow& row : computed)
    if (const std::string fault = accuracy_fault(row, request.accuracy); !fault.empty())
      throw NumericalError(s.name + ": " + fault);
  std::ranges::move(computed, std::back_inserter(rows));
}

py::tuple moduli(const States& states, const std::string& strains, bool prestress,
                 std::optional<double> tolerance, const std::string& method, const Names& accuracy,
                 std::optional<double> force_tolerance, const std::vector<double>& rolling_stiffness,
                 const Names& tables, bool force) {
  require_one_of("strains", strains, {"diagonal", "full"});
  require_one_of("method", method, {"factor", "single-factor", "iterative", "bounds"});
  require_tables(tables, {"increments"});
  ModuliCommand command;
  command.strains = strains;
  command.prestress = prestress;
  command.force = force;
  if (tolerance) command.options.tolerance = *tolerance;
  if (force_tolerance) command.options.force_tolerance = *force_tolerance;
  command.method = method;
  command.solver = "cholmod";
  command.accuracy = accuracy;
  command.rolling_stiffness = rolling_stiffness;
  if (contains(tables, "increments")) command.increments = kWanted;
  Table increments;
  const Table table = without_gil([&] {
    const ModuliRequest request = request_of(command);
    ModuliRows computation(request);
    std::vector<ModuliRow> rows;
    Table* const wanted = command.increments.empty() ? nullptr : &increments;
    for (const NamedState& s : states)
      of_state(s.name, [&] { add_moduli(s, command, request, computation, wanted, rows); });
    return moduli_table(command, rows);
  });
  py::dict further;
  if (!command.increments.empty()) further["increments"] = columns_to_python(increments);
  return py::make_tuple(to_python(table), further);
}

/// A table besides the rows, by its name in Python and the text that asks for it.
struct FurtherTable {
  const char* name;
  std::string* asked;
  const Table* table;
};

void ask_for(const Names& tables, const std::vector<FurtherTable>& further) {
  for (const FurtherTable& one : further)
    if (contains(tables, one.name)) *one.asked = kWanted;
}

py::dict asked_of(const std::vector<FurtherTable>& further) {
  py::dict tables;
  for (const FurtherTable& one : further)
    if (!one.asked->empty()) tables[one.name] = columns_to_python(*one.table);
  return tables;
}

py::tuple network(const States& states, std::optional<double> zero_force, std::optional<int> least_contacts,
                  const std::string& unit, double bin_width, const Names& groups, double near_zero,
                  int shuffles, double pressure_bin_width, const Names& without, const Names& tables) {
  require_one_of("unit", unit, {"mean", "F0", "P"});
  for (const std::string& group : without) require_one_of("without", group, {"mechanics"});
  for (const std::string& group : groups) require_one_of("groups", group, {"bonds", "phases"});
  require_tables(tables,
                 {"pdf", "particle_stress", "exponents", "pressure_pdf", "like_neighbours", "clusters"});
  NetworkCommand command;
  command.zero_force = zero_force;
  command.least_contacts = least_contacts;
  command.unit = unit;
  command.bin_width = bin_width;
  command.bonds.with = groups;
  command.without = without;
  command.bonds.near = near_zero;
  command.bonds.phases.n_shuffles = shuffles;
  command.bonds.bin_width = pressure_bin_width;
  NetworkTables side;
  const std::vector<FurtherTable> further = {
      {"pdf", &command.distributions, &side.distributions},
      {"particle_stress", &command.pressures, &side.pressures},
      {"exponents", &command.bonds.exponents, &side.bonds.exponents},
      {"pressure_pdf", &command.bonds.pressures, &side.bonds.pressures},
      {"like_neighbours", &command.bonds.neighbours, &side.bonds.neighbours},
      {"clusters", &command.bonds.clusters, &side.bonds.clusters}};
  ask_for(tables, further);
  const Table table = without_gil([&] {
    std::vector<NetworkRow> rows;
    for (const NamedState& s : states)
      of_state(s.name, [&] {
        std::visit([&](const auto& state) { rows.push_back(network_row(s.name, state, command, side)); },
                   *s.state);
      });
    add_pooled(command, rows.size(), side);
    return to_table(network_columns(command), rows);
  });
  return py::make_tuple(to_python(table), asked_of(further));
}

py::tuple structure(const States& states, bool average, const std::vector<double>& fit_range,
                    std::optional<double> largest_k, std::optional<double> cells_per_wave, double reach,
                    const std::vector<int>& map_size, int probes,
                    const std::optional<std::string>& profile_axis, int slices, const Names& tables) {
  if (profile_axis) require_one_of("profile_axis", *profile_axis, {"x", "y", "z"});
  require_tables(
      tables, {"intensity", "pair_correlation", "gaps", "pores", "map", "prediction", "porosity", "profile"});
  StructureCommand command;
  command.average = average;
  command.fit_range = fit_range;
  if (largest_k) command.scattering.largest = *largest_k;
  if (cells_per_wave) command.scattering.cells_per_wave = *cells_per_wave;
  command.reach = reach;
  command.map_size = map_size;
  command.n_probes = probes;
  command.profile_axis = profile_axis.value_or("");
  command.n_slices = slices;
  Series series;
  const std::vector<FurtherTable> further = {{"intensity", &command.intensity, &series.intensity},
                                             {"pair_correlation", &command.pairs, &series.pairs},
                                             {"gaps", &command.gaps, &series.gaps},
                                             {"pores", &command.pores, &series.pores},
                                             {"map", &command.map, &series.map},
                                             {"prediction", &command.prediction, &series.prediction},
                                             {"porosity", &command.porosity, &series.porosity},
                                             {"profile", &command.profile, &series.profile}};
  ask_for(tables, further);
  require_fit_range(command);
  if (map_size.size() != 2) throw InputError("map_size", "expected two numbers");
  const Table table = without_gil([&] {
    std::vector<StructureRow> rows;
    for (const NamedState& s : states)
      of_state(s.name, [&] {
        std::visit([&](const auto& state) { rows.push_back(structure_row(s.name, state, command, series)); },
                   *s.state);
      });
    if (series.average && rows.size() > 1) rows.push_back(averaged(rows, command, series));
    return to_table(structure_columns(), rows);
  });
  return py::make_tuple(to_python(table), asked_of(further));
}

py::tuple compare(const NamedState& before, const NamedState& after, double rigid_tolerance,
                  const Names& tables) {
  require_tables(tables, {"displacements", "contacts"});
  CompareCommand command;
  command.rigid_tolerance = rigid_tolerance;
  CompareTables side;
  const std::vector<FurtherTable> further = {{"displacements", &command.displacements, &side.displacements},
                                             {"contacts", &command.contacts, &side.contacts}};
  ask_for(tables, further);
  const Table table = without_gil([&] {
    std::vector<CompareRow> rows;
    std::visit(
        [&]<int Old, int New>(const State<Old>& p, const State<New>& q) {
          if constexpr (Old != New)
            throw InputError(after.name, fmt::format("is {}D, and {} is {}D", New, before.name, Old));
          else
            rows.push_back(compare_row(before.name, p, after.name, q, command, side));
        },
        *before.state, *after.state);
    return to_table(compare_columns(rows), rows);
  });
  return py::make_tuple(to_python(table), asked_of(further));
}

py::tuple chain(int n, double radius, double kn, double kt, double kr, double bend) {
  ChainCommand command;
  command.n = n;
  command.R = radius;
  command.k = {kn, kt, kr};
  command.bend = bend;
  return to_python(without_gil([&] { return chain_table(command, chain_rows(command)); }));
}

}  // namespace

void bind_analysis(py::module_& module) {
  module.def("moduli", &moduli, py::arg("states"), py::kw_only(), py::arg("strains"), py::arg("prestress"),
             py::arg("tolerance"), py::arg("method"), py::arg("accuracy"), py::arg("force_tolerance"),
             py::arg("rolling_stiffness"), py::arg("tables"), py::arg("force"));
  module.def("network", &network, py::arg("states"), py::kw_only(), py::arg("zero_force"),
             py::arg("least_contacts"), py::arg("unit"), py::arg("bin_width"), py::arg("groups"),
             py::arg("near_zero"), py::arg("shuffles"), py::arg("pressure_bin_width"), py::arg("without"),
             py::arg("tables"));
  module.def("structure", &structure, py::arg("states"), py::kw_only(), py::arg("average"),
             py::arg("fit_range"), py::arg("largest_k"), py::arg("cells_per_wave"), py::arg("reach"),
             py::arg("map_size"), py::arg("probes"), py::arg("profile_axis"), py::arg("slices"),
             py::arg("tables"));
  module.def("compare", &compare, py::arg("before"), py::arg("after"), py::kw_only(),
             py::arg("rigid_tolerance"), py::arg("tables"));
  module.def("chain", &chain, py::arg("n"), py::arg("R"), py::arg("kn"), py::arg("kt"), py::arg("kr"),
             py::arg("bend"));
}

}  // namespace floc::python
