#include <fmt/format.h>

#include <iterator>

#include "arguments.h"
#include "floc/elasticity/chain.h"
#include "floc/network/carrying_structure.h"
#include "floc/packing/equilibrium_check.h"
#include "floc/structure/axis_profile.h"
#include "floc/structure/pair_correlation.h"
#include "floc/structure/porosity_probe.h"
#include "floc/tables/chain_rows.h"
#include "floc/tables/compare_rows.h"
#include "floc/tables/equilibrium_warning.h"
#include "floc/tables/forces_rows.h"
#include "floc/tables/moduli_rows.h"
#include "floc/tables/network_rows.h"
#include "floc/tables/structure_columns.h"
#include "floc/tables/structure_rows.h"

namespace floc::python {
namespace {

using States = std::vector<NamedState>;
using Names = std::vector<std::string>;

/// Checks that a state is in equilibrium. @throws EquilibriumError if it is not in equilibrium and `force` is false. If
/// `force` is true, a warning is issued instead
void require_equilibrium(const NamedState& s, bool force, const Remarks& remarks) {
  if (force)
    return std::visit([&](const auto& state) { warn_unless_in_equilibrium(s.name, state, remarks); }, *s.state);
  const std::string faults = std::visit([](const auto& state) { return equilibrium_faults(state); }, *s.state);
  if (!faults.empty())
    throw EquilibriumError(s.name + ": this state is not in equilibrium: " + faults +
                           "; force=True computes the moduli nevertheless");
}

/// Options of the moduli, and whether all states have to be in equilibrium.
struct ModuliCall {
  ModuliTableOptions options;
  bool force = false;
};

/// Computes the moduli of one state and adds them to `rows`. @throws NumericalError if the moduli are less accurate
/// than the caller requested
void add_moduli(const NamedState& s, const ModuliCall& call, ModuliRows& computation, Table& increments,
                std::vector<ModuliRow>& rows, const Remarks& remarks) {
  require_equilibrium(s, call.force, remarks);
  require_moduli_of(s.name, *s.state, call.options);
  std::vector<ModuliRow> computed = std::visit(
      [&](const auto& state) {
        return computation.of(s.name, state, call.options.increments ? &increments : nullptr, remarks);
      },
      *s.state);
  for (const ModuliRow& row : computed)
    if (const std::string fault = accuracy_fault(row, call.options.accuracy); !fault.empty())
      throw NumericalError(s.name + ": " + fault);
  std::ranges::move(computed, std::back_inserter(rows));
}

py::tuple moduli(const States& states, const py::object& strains, const py::object& prestress,
                 const py::object& tolerance, const py::object& method, const Names& accuracy,
                 const py::object& force_tolerance, const py::object& rolling_stiffness, const py::object& kn,
                 const py::object& kt, const py::object& per, const py::object& asked_tables,
                 const py::object& force) {
  const Names tables = texts_of("tables", asked_tables);
  require_tables(tables, {"increments"});
  ModuliCall call{.options = {}, .force = flag_of("force", force)};
  ModuliTableOptions& options = call.options;
  options.moduli.strains = strain_set(word_of("strains", strains, {"diagonal", "full"}));
  options.moduli.prestress = flag_of("prestress", prestress);
  if (const auto given = number_if_any("tolerance", tolerance, kPositiveNumber))
    options.moduli.tolerance = *given;
  if (const auto given = number_if_any("force_tolerance", force_tolerance, kNotNegativeNumber))
    options.moduli.force_tolerance = *given;
  options.moduli.method =
      moduli_method(word_of("method", method, {"factor", "single-factor", "iterative", "bounds"}));
  options.solver = ModuliSolver::cholmod;
  options.accuracy = moduli_accuracy(accuracy);
  options.rolling_stiffness = numbers_of("rolling_stiffness", rolling_stiffness, kNotNegativeNumber);
  options.kn = number_if_any("kn", kn, kPositiveNumber);
  options.kt = number_if_any("kt", kt, kPositiveNumber);
  options.stiffness_per = stiffness_per(word_of("stiffness_per", per, {"point", "contact"}));
  options.increments = contains(tables, "increments");
  Table increments;
  const Table table = without_gil([&](const Remarks& remarks) {
    for (const std::string& fault : options.validate()) throw InputError("floc moduli", "--" + fault);
    ModuliRows computation(options);
    std::vector<ModuliRow> rows;
    for (const NamedState& s : states)
      of_state(s.name, [&] { add_moduli(s, call, computation, increments, rows, remarks); });
    return moduli_table(options, rows);
  });
  py::dict further;
  if (options.increments) further["increments"] = columns_to_python(increments);
  return py::make_tuple(to_python(table), further);
}

/// A table that a function returns only on request: its name in Python, the flag by which the caller requests it, and
/// the table.
struct FurtherTable {
  const char* name;
  bool* asked;
  const Table* table;
};

void ask_for(const Names& tables, const std::vector<FurtherTable>& further) {
  for (const FurtherTable& one : further) *one.asked = contains(tables, one.name);
}

py::dict asked_of(const std::vector<FurtherTable>& further) {
  py::dict tables;
  for (const FurtherTable& one : further)
    if (*one.asked) tables[one.name] = columns_to_python(*one.table);
  return tables;
}

py::tuple network(const States& states, const py::object& zero_force, const py::object& least_contacts,
                  const py::object& unit, const py::object& bin_width, const py::object& asked_groups,
                  const py::object& near_zero, const py::object& shuffles, const py::object& pressure_bin_width,
                  const py::object& left_out, const py::object& asked_tables) {
  const Names tables = texts_of("tables", asked_tables), groups = texts_of("groups", asked_groups),
              without = texts_of("without", left_out);
  for (const std::string& group : without) require_one_of("without", group, {"mechanics"});
  for (const std::string& group : groups) require_one_of("groups", group, {"bonds", "phases"});
  require_tables(tables,
                 {"pdf", "particle_stress", "exponents", "pressure_pdf", "like_neighbours", "clusters"});
  NetworkTableOptions options;
  options.zero_force = number_if_any("zero_force", zero_force, kNotNegativeNumber);
  options.least_contacts = whole_if_any("least_contacts", least_contacts, kLeastContacts);
  options.unit = force_unit_named(word_of("unit", unit, {"mean", "F0", "P"}));
  options.bin_width = number_of("bin_width", bin_width, kPositiveNumber);
  options.bonds.bonds = contains(groups, "bonds");
  options.bonds.phases = contains(groups, "phases");
  options.mechanics = !contains(without, "mechanics");
  options.bonds.near = number_of("near_zero", near_zero, kNotNegativeNumber);
  options.bonds.phase_structure.n_shuffles = whole_of("shuffles", shuffles, PhaseOptions::kShuffles);
  options.bonds.bin_width = number_of("pressure_bin_width", pressure_bin_width, kPositiveNumber);
  NetworkTables side;
  const std::vector<FurtherTable> further = {
      {"pdf", &options.distributions, &side.distributions},
      {"particle_stress", &options.pressures, &side.pressures},
      {"exponents", &options.bonds.exponents, &side.bonds.exponents},
      {"pressure_pdf", &options.bonds.pressures, &side.bonds.pressures},
      {"like_neighbours", &options.bonds.neighbours, &side.bonds.neighbours},
      {"clusters", &options.bonds.clusters, &side.bonds.clusters}};
  ask_for(tables, further);
  const Table table = without_gil([&](const Remarks& remarks) {
    std::vector<NetworkRow> rows;
    for (const NamedState& s : states)
      of_state(s.name, [&] {
        std::visit(
            [&](const auto& state) { rows.push_back(network_row(s.name, state, options, side, remarks)); },
            *s.state);
      });
    add_pooled(options, rows.size(), side, remarks);
    return to_table(network_columns(options), rows);
  });
  return py::make_tuple(to_python(table), asked_of(further));
}

/// Converts the argument fit_range, a pair (LOW, HIGH). @throws InputError naming the argument and its value
std::vector<double> fit_range_of(const py::object& given) {
  std::vector<double> range = numbers_of("fit_range", given);
  if (range.size() != 2 || !(range[0] < range[1]))
    throw InputError("", "fit_range = " + py::repr(given).cast<std::string>() +
                             ": expected two numbers, the lower number first");
  return range;
}

std::vector<int> map_size_of(const py::object& given) {
  std::vector<int> size = wholes_of("map_size", given, kMapSide);
  if (size.size() != 2)
    throw InputError("", "map_size = " + py::repr(given).cast<std::string>() +
                             ": expected two whole numbers, the numbers of cells along both sides of the map");
  return size;
}

py::tuple structure(const States& states, const py::object& average, const py::object& fit_range,
                    const py::object& largest_k, const py::object& cells_per_wave, const py::object& reach,
                    const py::object& map_size, const py::object& probes, const py::object& profile_axis,
                    const py::object& slices, const py::object& asked_tables) {
  const Names tables = texts_of("tables", asked_tables);
  require_tables(
      tables, {"intensity", "pair_correlation", "gaps", "pores", "map", "prediction", "porosity", "profile"});
  StructureTableOptions options;
  options.average = flag_of("average", average);
  options.fit_range = fit_range_of(fit_range);
  if (const auto given = number_if_any("largest_k", largest_k, ScatteringOptions::kLargest))
    options.scattering.largest = *given;
  if (const auto given = number_if_any("cells_per_wave", cells_per_wave, ScatteringOptions::kCellsPerWave))
    options.scattering.cells_per_wave = *given;
  options.reach = number_of("reach", reach, kPairReach);
  options.map_size = map_size_of(map_size);
  options.n_probes = whole_of("probes", probes, kPorosityProbes);
  if (!profile_axis.is_none())
    options.profile_axis =
        static_cast<int>(std::string("xyz").find(word_of("profile_axis", profile_axis, {"x", "y", "z"})));
  options.n_slices = whole_of("slices", slices, kProfileSlices);
  Series series;
  const std::vector<FurtherTable> further = {{"intensity", &options.intensity, &series.intensity},
                                             {"pair_correlation", &options.pairs, &series.pairs},
                                             {"gaps", &options.gaps, &series.gaps},
                                             {"pores", &options.pores, &series.pores},
                                             {"map", &options.map, &series.map},
                                             {"prediction", &options.prediction, &series.prediction},
                                             {"porosity", &options.porosity, &series.porosity},
                                             {"profile", &options.profile, &series.profile}};
  ask_for(tables, further);
  const Table table = without_gil([&](const Remarks& remarks) {
    std::vector<StructureRow> rows;
    for (const NamedState& s : states)
      of_state(s.name, [&] {
        std::visit(
            [&](const auto& state) { rows.push_back(structure_row(s.name, state, options, series, remarks)); },
            *s.state);
      });
    if (series.average && rows.size() > 1) rows.push_back(averaged(rows, options, series, remarks));
    return to_table(structure_columns(), rows);
  });
  return py::make_tuple(to_python(table), asked_of(further));
}

py::tuple compare(const NamedState& before, const NamedState& after, const py::object& rigid_tolerance,
                  const py::object& asked_tables) {
  const Names tables = texts_of("tables", asked_tables);
  require_tables(tables, {"displacements", "contacts"});
  CompareTableOptions options;
  options.rigid_tolerance = number_of("rigid_tolerance", rigid_tolerance, kPositiveNumber);
  CompareTables side;
  const std::vector<FurtherTable> further = {{"displacements", &options.displacements, &side.displacements},
                                             {"contacts", &options.contacts, &side.contacts}};
  ask_for(tables, further);
  const Table table = without_gil([&] {
    std::vector<CompareRow> rows;
    std::visit(
        [&]<int Old, int New>(const State<Old>& p, const State<New>& q) {
          if constexpr (Old != New)
            throw InputError(
                after.name,
                fmt::format("this is a {}D state, but {} is a {}D state: expected states of equal dimension",
                            New, before.name, Old));
          else
            rows.push_back(compare_row(before.name, p, after.name, q, options, side));
        },
        *before.state, *after.state);
    return to_table(compare_columns(rows), rows);
  });
  return py::make_tuple(to_python(table), asked_of(further));
}

py::tuple forces(const States& states, const py::object& selection, const py::object& friction,
                 const py::object& kn, const py::object& kt, const py::object& stress, const py::object& gap,
                 const py::object& asked_tables, const py::object& ranges, const py::object& range_of) {
  const Names tables = texts_of("tables", asked_tables);
  require_tables(tables, {"contacts"});
  ForcesTableOptions options;
  if (!selection.is_none())
    options.selection = force_selection_named(word_of("selection", selection, {"closest", "canonical"}));
  options.friction = number_if_any("friction", friction, kNotNegativeNumber);
  options.kn = number_if_any("kn", kn, kPositiveNumber);
  options.kt = number_if_any("kt", kt, kPositiveNumber);
  options.stress = numbers_of("stress", stress);
  options.gap = number_if_any("gap", gap, kNearGap);
  options.range_of = wholes_of("range_of", range_of, kAnyContact);
  options.ranges = flag_of("ranges", ranges) || !options.range_of.empty();
  if (options.ranges && !contains(tables, "contacts"))
    throw InputError(
        options.range_of.empty() ? "ranges" : "range_of",
        "ranges are columns of the table of contacts: expected tables=\"contacts\" beside this argument");
  Table contacts;
  const std::vector<FurtherTable> further = {{"contacts", &options.contacts, &contacts}};
  ask_for(tables, further);
  const Table table = without_gil([&](const Remarks& remarks) {
    std::vector<ForcesRow> rows;
    for (const NamedState& s : states)
      of_state(s.name, [&] {
        std::visit(
            [&](const auto& state) { rows.push_back(forces_row(s.name, state, options, contacts, remarks)); },
            *s.state);
      });
    return to_table(forces_columns(), rows);
  });
  return py::make_tuple(to_python(table), asked_of(further));
}

py::tuple chain(const py::object& n, const py::object& radius, const py::object& kn, const py::object& kt,
                const py::object& kr, const py::object& bend) {
  ChainOptions options;
  options.n = whole_of("n", n, kChainLength);
  options.R = number_of("R", radius, kPositiveNumber);
  options.k = {number_of("kn", kn, kPositiveNumber), number_of("kt", kt, kPositiveNumber),
               number_of("kr", kr, kPositiveNumber)};
  options.bend = number_of("bend", bend);
  return to_python(without_gil([&] { return chain_table(options, chain_rows(options)); }));
}

}  // namespace

void bind_analysis(py::module_& module) {
  module.def("moduli", &moduli, py::arg("states"), py::kw_only(), py::arg("strains"), py::arg("prestress"),
             py::arg("tolerance"), py::arg("method"), py::arg("accuracy"), py::arg("force_tolerance"),
             py::arg("rolling_stiffness"), py::arg("kn"), py::arg("kt"), py::arg("stiffness_per"),
             py::arg("tables"), py::arg("force"));
  module.def("network", &network, py::arg("states"), py::kw_only(), py::arg("zero_force"),
             py::arg("least_contacts"), py::arg("unit"), py::arg("bin_width"), py::arg("groups"),
             py::arg("near_zero"), py::arg("shuffles"), py::arg("pressure_bin_width"), py::arg("without"),
             py::arg("tables"));
  module.def("forces", &forces, py::arg("states"), py::kw_only(), py::arg("selection"), py::arg("friction"),
             py::arg("kn"), py::arg("kt"), py::arg("stress"), py::arg("gap"), py::arg("tables"),
             py::arg("ranges"), py::arg("range_of"));
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
