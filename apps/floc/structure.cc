#include <fmt/format.h>

#include <memory>

#include "columns.h"
#include "command.h"
#include "fit_parameters.h"
#include "floc/base/error.h"
#include "floc/packing/require_periodic.h"
#include "output.h"
#include "structure_rows.h"

namespace floc {
namespace {

void append_parameter(int index, const std::string& name, std::vector<Column<StructureRow>>& columns) {
  const std::string parts[] = {"", "_stderr", "_low95", "_high95"};
  for (int part = 0; part < 4; ++part)
    columns.emplace_back(name + parts[part], [index, part](const StructureRow& r) {
      return r.fit && r.fit->found() ? parameter_cells(r.fit->parameters[index])[part] : TableValue{};
    });
}

std::vector<Column<StructureRow>> all_columns() {
  using Row = StructureRow;
  const auto maybe = [](const std::optional<std::int64_t>& n) { return n ? TableValue{*n} : TableValue{}; };
  std::vector<Column<Row>> columns = {{"file", [](const Row& r) { return r.file; }},
                                      {"dimension", [](const Row& r) { return count(r.dimension); }},
                                      {"n_grains", [](const Row& r) { return r.n_grains; }},
                                      {"P_star", [](const Row& r) { return r.reduced_pressure; }},
                                      {"phi", [](const Row& r) { return r.solid_fraction; }}};
  append_parameter(1, "xi", columns);
  append_parameter(2, "dF", columns);
  append_parameter(0, "I0", columns);
  const auto of_fit = [](auto value) {
    return [value](const Row& r) { return r.fit && r.fit->found() ? TableValue{value(*r.fit)} : TableValue{}; };
  };
  columns.emplace_back("fit_low", of_fit([](const ScatteringFit& f) { return f.low; }));
  columns.emplace_back("fit_high", of_fit([](const ScatteringFit& f) { return f.high; }));
  columns.emplace_back("fit_points", of_fit([](const ScatteringFit& f) { return count(f.n_points); }));
  columns.emplace_back("chi_square", of_fit([](const ScatteringFit& f) { return f.chi_square; }));
  columns.emplace_back("mesh_spacing", [](const Row& r) { return or_undefined(r.mesh_spacing); });
  for (const int a : {0, 1})
    columns.emplace_back(fmt::format("mesh{}", a + 1),
                         [a](const Row& r) { return r.mesh[a] > 0 ? count(r.mesh[a]) : TableValue{}; });
  columns.emplace_back("n_pores", [maybe](const Row& r) { return maybe(r.n_pores); });
  columns.emplace_back("pore_size", [](const Row& r) { return or_undefined(r.pore_size); });
  columns.emplace_back("pore_mean_area", [](const Row& r) { return or_undefined(r.pore_mean_area); });
  columns.emplace_back("pore_unbounded",
                       [](const Row& r) { return r.n_pores ? TableValue{r.unbounded} : TableValue{}; });
  columns.emplace_back("seconds", [](const Row& r) { return r.seconds; });
  const auto of_voids = [](auto value) {
    return [value](const Row& r) { return r.local ? TableValue{value(*r.local)} : TableValue{}; };
  };
  columns.emplace_back("local_phi_mean", of_voids([](const LocalStructure& l) { return l.mean; }));
  columns.emplace_back("local_phi_stddev", of_voids([](const LocalStructure& l) { return l.deviation; }));
  columns.emplace_back("n_voids", of_voids([](const LocalStructure& l) { return l.n_voids; }));
  columns.emplace_back("void_radius_mean", of_voids([](const LocalStructure& l) { return l.mean_void; }));
  columns.emplace_back("void_radius_largest", of_voids([](const LocalStructure& l) { return l.largest_void; }));
  return columns;
}

int run_structure(const StructureCommand& command) {
  if (command.fit_range.size() != 2 || !(command.fit_range[0] < command.fit_range[1]))
    throw InputError("floc structure", "--fit-range: expected LOW,HIGH with LOW < HIGH");
  std::vector<StructureRow> rows;
  Series series;
  const int code = for_each_state(command.files, [&](const std::string& file, const AnyState& any) {
    std::visit(
        [&](const auto& state) {
          require_periodic(state.packing, "structure is measured", file);
          rows.push_back(structure_row(file, state, command, series));
        },
        any);
    return int{kDone};
  });
  if (series.average && rows.size() > 1) rows.push_back(averaged(rows, command, series));
  for (const auto& [path, table] : {std::pair{&command.intensity, &series.intensity},
                                    {&command.pairs, &series.pairs},
                                    {&command.gaps, &series.gaps},
                                    {&command.pores, &series.pores},
                                    {&command.map, &series.map},
                                    {&command.prediction, &series.prediction},
                                    {&command.porosity, &series.porosity},
                                    {&command.profile, &series.profile}})
    if (!path->empty()) write_csv(*path, *table);
  print_table(to_table(all_columns(), rows), command.format);
  return code;
}

}  // namespace

Command add_structure(CommandLine program) {
  CommandLine app = program.add_subcommand(
      "structure",
      "Describe the structure of saved states: I(k) with xi and dF, pores, g(r), z(h), local "
      "solid fraction");
  const auto command = std::make_shared<StructureCommand>();
  add_states_argument(app, command->files);
  app.add_flag("--average", command->average, "a last row for all states together, as samples of one");
  app.add_option("--fit-range", command->fit_range,
                 "LOW,HIGH: wave numbers fitted, in 2 pi over the largest diameter")
      .delimiter(',')
      .expected(2)
      .show_default();
  app.add_option("--largest-k", command->scattering.largest,
                 "largest wave number, in 2 pi over the largest diameter")
      .positive()
      .show_default();
  app.add_option("--cells-per-wave", command->scattering.cells_per_wave,
                 "mesh cells for each wave length of the largest wave number, at least 4")
      .between(4.0, 1000.0)
      .show_default();
  app.add_option("--intensity", command->intensity, "file for I(k), a row a bin of k");
  app.add_option("--pair-correlation", command->pairs, "file for g(r), a row a bin of r");
  app.add_option("--reach", command->reach, "of g(r), in largest diameters").positive().show_default();
  app.add_option("--gaps", command->gaps,
                 "file for z(h), neighbours within a gap h: rattlers as found, and pushed against the others");
  app.add_option("--prediction", command->prediction,
                 "file for P and z that the first state would have at the solid fraction of each, shrunk or "
                 "expanded as a whole");
  app.add_option("--pores", command->pores, "file for the pores (3D: balls in the voids), a row each");
  app.add_option("--map", command->map,
                 "file for the local solid fraction, a row a mesh cell (3D: a Voronoi cell)");
  app.add_option("--map-size", command->map_size, "mesh cells along each lattice vector")
      .delimiter(',')
      .expected(2)
      .between(1, 10000)
      .show_default();
  app.add_option(
      "--porosity", command->porosity,
      "file for the porosity of cubes about the centre of the cell against their size, and of the cell "
      "itself shrunk about it");
  app.add_option("--probes", command->n_probes, "sizes of these").between(1, 10000).show_default();
  app.add_option(
      "--profile", command->profile,
      "file for solid fraction, coordination and particle pressure in slices of the cell, a row each");
  app.add_option("--profile-axis", command->profile_axis,
                 "lattice vector that the slices follow each other along")
      .one_of({"x", "y", "z"})
      .show_default();
  app.add_option("--slices", command->n_slices, "of a profile").between(1, 100000).show_default();
  add_format_option(app, command->format);
  return {app, [command] { return run_structure(*command); }};
}

}  // namespace floc
